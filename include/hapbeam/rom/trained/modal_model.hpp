// SPDX-License-Identifier: MIT
// A beam with mass as a few modes about its rest: for sound, and where many beams ring.
//
//   q_i" + 2 a_i q_i' + ω_i² q_i = φ_i(s) · n λ        r(s) = r0(s) + Σ φ_i(s) q_i
//
// A part of a step is exact for each mode under a force that lasts for it, so parts are as long as the hand and the ear require.  A hand touches through its
// coupling, λ = K δ + B (δ - δ0)/h >= 0 at the end of a part.  What modes lack to the flexibility of a place is a spring without mass, in series with that:
// a hand that rests feels the force of the beam.  Each part takes energy: the spring's end is reached with the force of the end.
// Linear: to the square of the deflection over the thickness.  Modes are found by modes_of() (rom/training/modes.hpp).
// Allocates and throws at construction.  Real-time: all else is noexcept and allocation-free, O(modes · parts), and O(modes · nodes) a step for the shape.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include <hapbeam/check.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What a ModalModel steps.  Unknowns are u, w, θ of each node.
struct Modes {
  double thickness = 0;                      ///< [m]
  std::vector<CentrelineNode<double>> rest;  ///< nodes
  Eigen::MatrixXd shapes;                    ///< a row a mode, a column an unknown, of mass 1 [1/√kg]
  Eigen::VectorXd frequencies;               ///< ω [1/s], rising
  Eigen::VectorXd decays;                    ///< a [1/s], each below ω
  /// Of each element, flexibility of both nodes' unknowns less that of the modes.
  std::vector<Eigen::Matrix<double, 6, 6>> rest_flexibility;
  /// Of both ends: forces along x and w at rest [N], and what a unit of each mode adds to them [N √kg/m].
  Eigen::Vector2d held[2];
  Eigen::Matrix<double, 2, Eigen::Dynamic> holds[2];
};

template <typename ScalarType = double>
class ModalModel {
 public:
  using Scalar = ScalarType;
  static constexpr int dimension = 2, contacts = 1;
  using Vector = Vector2<Scalar>;
  using Hand = Coupled<Scalar>;
  using Felt = Pushed<Scalar>;
  /// No step is longer: what a late tick has missed is left out [s].
  static constexpr Scalar longest = Scalar(2e-3);

  /// At rest.   @param parts  of a step
  /// @throws std::invalid_argument where parts is below 1
  explicit ModalModel(const Modes& modes, int parts = 4)
      : parts_(parts),
        thickness_(static_cast<Scalar>(modes.thickness)),
        shapes_(modes.shapes.cast<Scalar>()),
        omega_(modes.frequencies.cast<Scalar>()),
        decay_(modes.decays.cast<Scalar>()) {
    for (Row* row : {&q_, &v_, &along_, &cosine_, &sine_, &by_force_, &speeds_}) row->setZero(omega_.size());
    if (parts < 1) detail::reject("parts", parts, "", "1 or more");
    for (const auto& node : modes.rest)
      rest_.push_back({Scalar(node.s), Scalar(node.u), Scalar(node.w), Scalar(node.theta)});
    nodes_ = rest_;
    for (const auto& block : modes.rest_flexibility)
      rest_flexibility_.push_back(block.template cast<Scalar>());
    for (int k = 0; k < 2; ++k)
      held_[k] = modes.held[k].cast<Scalar>(), holds_[k] = modes.holds[k].cast<Scalar>();
  }

  void reset() noexcept {
    q_.setZero(), v_.setZero();
    hand_ = Seen::never, deep_ = 0;
    nodes_ = rest_;
  }
  /// As if a force had held it for long, and is gone.   @param force  [N] on the beam at arc position s
  void let_go_of(Scalar s, const Vector& force) noexcept {
    reset();
    look_along(s, force);
    q_ = along_.cwiseQuotient(omega_.cwiseAbs2());
    draw();
  }

  /// Goes on by a time.   @return ok | invalid_request: nothing has changed
  Status step(Scalar dt) noexcept { return go(dt, nullptr); }
  /// The same with a hand, which moves evenly from where it was, without friction.   @return force and place at the end of the step
  Felt step(Scalar dt, const Hand& hand) noexcept {
    felt_ = {0, Status::ok};
    const Status status = go(dt, &hand);
    felt_.status = status;
    return felt_;
  }

  int modes() const noexcept { return static_cast<int>(omega_.size()); }
  Scalar thickness() const noexcept { return thickness_; }  ///< [m]
  Centreline<Scalar> shape() const noexcept { return {nodes_.data(), static_cast<int>(nodes_.size()), true}; }
  /// [m/s] at arc position s.
  Vector velocity(Scalar s) const noexcept { return moved(v_, s); }
  struct Energy {
    Scalar kinetic, strain;  ///< [J], over that at rest
    Scalar sum() const noexcept { return kinetic + strain; }
  };
  Energy energy() const noexcept { return {v_.squaredNorm() / 2, omega_.cwiseProduct(q_).squaredNorm() / 2}; }
  /// Of what holds an end on the beam along x and w [N], but for what a hand adds in its place.   @param side  0: left, 1: right
  Vector reaction(int side) const noexcept { return held_[side] + Vector(holds_[side] * q_); }

  /// Called at the end of each part of a step.   @param part  its length [s]
  using Listener = void (*)(void* who, const ModalModel& model, Scalar part) noexcept;
  /// One at a time; null: none.  The model stays where it is meanwhile.
  void listen(void* who, Listener listener) noexcept { listens_ = who, listener_ = listener; }

 private:
  using Row = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Both = Eigen::Matrix<Scalar, 6, 1>;

  /// What the unknowns of an element's nodes move a place by: along x and along w.
  struct Place {
    int element;
    Eigen::Matrix<Scalar, 2, 6> by;
  };
  Place place(Scalar s) const noexcept {
    const int e = shape().segment_at(s);
    const auto &a = rest_[at(e)], &b = rest_[at(e + 1)];
    const Scalar l = b.s - a.s, t = (s - a.s) / l, r = 1 - t, h0 = r * r * (1 + 2 * t), h2 = 1 - h0,
                 h1 = l * t * r * r, h3 = -l * t * t * r;
    Place there{e, Eigen::Matrix<Scalar, 2, 6>::Zero()};
    there.by(0, 0) = there.by(1, 1) = h0, there.by(0, 3) = there.by(1, 4) = h2;
    // A tangent (cos θ, -sin θ) turns with θ.
    there.by.col(2) = h1 * Vector(-std::sin(a.theta), -std::cos(a.theta));
    there.by.col(5) = h3 * Vector(-std::sin(b.theta), -std::cos(b.theta));
    return there;
  }
  Vector moved(const Row& by_mode, Scalar s) const noexcept {
    const Place there = place(s);
    Vector sum = Vector::Zero();
    for (int k = 0; k < 6; ++k) sum += there.by.col(k) * shapes_.col(3 * there.element + k).dot(by_mode);
    return sum;
  }
  /// Finds φ·n of each mode.   @return what the modes lack of the flexibility there [m/N]
  Scalar look_along(Scalar s, const Vector& n) noexcept {
    const Place there = place(s);
    const Both by = there.by.transpose() * n;
    along_.setZero();
    for (int k = 0; k < 6; ++k) along_ += by[k] * shapes_.col(3 * there.element + k);
    return (std::max)(by.dot(rest_flexibility_[at(there.element)] * by), Scalar(0));
  }
  /// By what a part carries the modes on, exactly.
  void set_part(Scalar h) noexcept {
    if (h == part_) return;
    part_ = h;
    for (int i = 0; i < modes(); ++i) {
      const Scalar w = omega_[i], a = decay_[i], d = std::sqrt((w - a) * (w + a)), fades = std::exp(-a * h),
                   c = fades * std::cos(d * h), s = fades * std::sin(d * h) / d;
      cosine_[i] = c + a * s, sine_[i] = s, speeds_[i] = c - a * s;
      by_force_[i] = (1 - cosine_[i]) / (w * w);
    }
  }
  Status go(Scalar dt, const Hand* hand) noexcept {
    const bool valid = dt >= 0 && std::isfinite(dt) &&
                       (!hand || (is_finite(hand->hand) && hand->stiffness > 0 && hand->damping >= 0 &&
                                  !(hand->friction && hand->friction->sticking > 0)));
    if (!valid) return Status::invalid_request;
    if (!(dt > 0)) return Status::ok;
    set_part((std::min)(dt, longest) / Scalar(parts_));
    if (!hand) hand_ = Seen::never;
    else if (hand_ != Seen::touching) begin(*hand);
    for (int k = 1; k <= parts_; ++k) {
      along_.setZero();
      const Scalar force = hand ? touch(*hand, Scalar(k) / Scalar(parts_)) : Scalar(0);
      for (int i = 0; i < modes(); ++i) {
        const Scalar q = q_[i], v = v_[i], f = along_[i] * force, w = omega_[i];
        q_[i] = cosine_[i] * q + sine_[i] * v + by_force_[i] * f;
        v_[i] = speeds_[i] * v - sine_[i] * (w * w * q - f);
      }
      if (listener_) listener_(listens_, *this, part_);
    }
    if (hand) from_ = hand->hand.centre;
    draw();
    return Status::ok;
  }
  /// One that does not touch.  One that comes from nowhere has its spring bent as it lies, and a damper at rest.
  void begin(const Hand& hand) noexcept {
    s_ = hand.hand.s;
    if (hand_ == Seen::never) {
      from_ = hand.hand.centre;
      const Vector off = from_ - lies(s_);
      deep_ = (std::max)(hand.hand.reach - hand.hand.side * across(s_).dot(off), Scalar(0));
    }
    hand_ = Seen::beside;
  }
  /// To the left of the beam beside a place, by its chord there.
  Vector across(Scalar s) const noexcept {
    const int e = shape().segment_at(s);
    const auto &a = nodes_[at(e)], &b = nodes_[at(e + 1)];
    const Vector chord((b.s + b.u) - (a.s + a.u), b.w - a.w);
    return Vector(-chord.y(), chord.x()) / std::sqrt(chord.squaredNorm());
  }
  /// The hand in a part.   @param way  that it has gone at its end, 0 to 1   @return force on the modes, along what look_along() has found [N]
  Scalar touch(const Hand& hand, Scalar way) noexcept {
    const Vector centre = from_ + way * (hand.hand.centre - from_);
    const Scalar length = rest_.back().s;
    // The foot of the centre, as the beam lies.
    const Vector left = across(s_), normal = hand.hand.side * left, tangent(left.y(), -left.x());
    const Vector off = centre - lies(s_);
    s_ = std::clamp(s_ + tangent.dot(off), Scalar(0), length);
    // Where the modes are at the end of the part without a force.
    const Scalar lacks = look_along(s_, normal);
    const Vector at_rest = shape_at_rest(s_);
    Scalar free = normal.dot(at_rest), yields = lacks;
    for (int i = 0; i < modes(); ++i)
      free += along_[i] * (cosine_[i] * q_[i] + sine_[i] * v_[i]),
          yields += along_[i] * along_[i] * by_force_[i];
    const Scalar deep = hand.hand.reach - (normal.dot(centre) - free), K = hand.stiffness,
                 B = hand.damping / part_, pull = K * deep + B * (deep - deep_);
    const Scalar force = (std::max)(pull, Scalar(0)) / (1 + (K + B) * yields);
    hand_ = force > 0 ? Seen::touching : Seen::beside;
    deep_ = force > 0 ? deep - force * yields : (std::max)(Scalar(0), B * deep_ / (K + B));
    felt_.force = -force, felt_.s = s_, felt_.normal = normal;
    felt_.point = centre - (hand.hand.reach - deep_) * normal;
    return -force;
  }
  Vector shape_at_rest(Scalar s) const noexcept {
    return Centreline<Scalar>(rest_.data(), static_cast<int>(rest_.size()), true).position(s);
  }
  Vector lies(Scalar s) const noexcept { return shape_at_rest(s) + moved(q_, s); }
  void draw() noexcept {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(3 * i);
      nodes_[i].u = rest_[i].u + shapes_.col(k).dot(q_);
      nodes_[i].w = rest_[i].w + shapes_.col(k + 1).dot(q_);
      nodes_[i].theta = rest_[i].theta + shapes_.col(k + 2).dot(q_);
    }
  }
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  int parts_;
  Scalar thickness_;
  Matrix shapes_;
  Row omega_, decay_, q_, v_;
  Row along_, cosine_, sine_, by_force_, speeds_;  // of the hand's place; of a part
  std::vector<CentrelineNode<Scalar>> rest_, nodes_;
  std::vector<Eigen::Matrix<Scalar, 6, 6>> rest_flexibility_;
  Vector held_[2];
  Eigen::Matrix<Scalar, 2, Eigen::Dynamic> holds_[2];
  Scalar part_ = 0;
  Vector from_ = Vector::Zero();  // the hand at the end of the last step [m]
  Scalar s_ = 0, deep_ = 0;       // its place, and how deep it was at the end of the last part [m]
  enum class Seen { never, beside, touching } hand_ = Seen::never;
  Felt felt_{};
  void* listens_ = nullptr;
  Listener listener_ = nullptr;
};

}  // namespace hapbeam
