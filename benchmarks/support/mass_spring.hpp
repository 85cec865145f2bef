// A chain of masses and springs, integrated explicitly: the method people reach for (thesis eq. 2.2-2.5).
//
//   m ẍ = -c ẋ + g + f      springs of EA/l between neighbours, of EI/l in the angle at each mass; c = 2 ω m
//
// In space the angle has an axis, 2 tan(φ/2) along a × b.  A chain has no twist, so it is one of naturally straight rods: a hook of masses
// would swing out of its plane without resistance.
// As good as such a chain gets: its springs are those of the beam, its masses too, it is damped critically in its lowest
// mode ω, and the avatar holds it as a constraint and not as one more spring.  Masses are moved by symplectic Euler, in as
// many sub-steps of a tick as its fastest mode needs, ω_max Δt < 2: eq. 2.2 the other way round.
// Servo: noexcept, no allocation, O(masses × sub-steps).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::benchmarks {

/// Nodes of a rod at rest [m], elements + 1 of them.  In touch_scenes_in_space.cpp, which compiles the model in any case.
std::vector<VectorOf<double, 3>> nodes_at_rest(const Rod& rod, int elements);

/// @tparam D  of the space in which it bends: 2 | 3
template <int D>
class MassSpring {
  using Body = std::conditional_t<D == 2, Beam, Rod>;
  using Vector = VectorOf<double, D>;
  using Turn = std::conditional_t<D == 2, double, VectorOf<double, 3>>;  // about z, or about its axis

 public:
  static constexpr int dimension = D;
  static constexpr double tick_time = 1e-3;  // [s]

  /// @param mass_per_length [kg/m]   @param lowest  ω of its lowest mode [rad/s]
  /// @throws std::invalid_argument in space unless it is straight by nature, and each end clamped or free
  MassSpring(const Body& body, int links, double radius, double mass_per_length, double lowest)
      : link_(body.length() / links),
        mass_(mass_per_length * link_),
        damping_(2 * lowest),
        reach_(radius + body.thickness() / 2) {
    describe(body, links);
    // Along: 2 √(EA/(l m)).  Across: 4 √(EI/(l³ m)), and a free end moves twice the way.
    const double fastest = std::hypot(2 * std::sqrt(EA_ / (link_ * mass_)),
                                      4 * std::sqrt(2 * bending_ / (link_ * link_ * mass_)));
    steps_ = static_cast<int>(std::ceil(tick_time * fastest / (0.9 * 2)));
    force_.resize(rest_.size());
    natural_.assign(rest_.size(), none());
    load_.resize(rest_.size(), Vector::Zero());
    x_ = rest_;
    if constexpr (D == 2)
      for (std::size_t i = 0; i < rest_.size(); ++i) natural_[i] = bend(i).angle;
    reset();
    if constexpr (D == 3) {  // where the chain comes to rest
      for (int k = 0; k < 1000 * steps_; ++k) advance(tick_time / steps_);
      rest_ = x_;
      reset();
    }
  }

  void reset() noexcept {
    x_ = rest_;
    v_.assign(rest_.size(), Vector::Zero());
    near_ = 0;
    known_ = false;
  }

  [[nodiscard]] TouchResult<double, D> tick(const Vector& position) noexcept {
    if (!known_) before_ = position, known_ = true;
    const double dt = tick_time / steps_;
    Vector impulse = Vector::Zero();
    for (int k = 1; k <= steps_; ++k) {
      advance(dt);
      impulse += hold(before_ + (position - before_) * k / steps_, dt);
    }
    before_ = position;
    TouchResult<double, D> result;
    result.force = impulse / tick_time;
    result.pressing = result.force.squaredNorm() > 0;
    if (!result.force.allFinite()) result.force.setZero(), result.status = Status::non_finite;
    return result;
  }

  int steps() const noexcept { return steps_; }

  /// Lets it go without velocity, its links along the chords of a shape.
  void let_go_from(const Centreline<double, D>& shape) noexcept {
    const double l = shape.length() / static_cast<double>(x_.size() - 1);
    const auto at = [&](std::size_t i) { return shape.position(static_cast<double>(i) * l); };
    for (std::size_t i = 1; i < x_.size(); ++i)
      x_[i] = x_[i - 1] + link_ * Vector(at(i) - at(i - 1)).normalized();
    v_.assign(x_.size(), Vector::Zero());
  }
  const Vector& tip() const noexcept { return x_.back(); }
  /// A sub-step alone.
  void advance(double dt) noexcept {
    const std::size_t last = x_.size() - 1;
    force_ = load_;
    for (std::size_t i = 0; i < last; ++i) {
      const Vector link = x_[i + 1] - x_[i];
      const double length = link.norm();
      const Vector pull = EA_ * (length / link_ - 1) / length * link;
      force_[i] += pull;
      force_[i + 1] -= pull;
    }
    for (std::size_t i = 0; i <= last; ++i) {
      const Bend at = bend(i);
      const bool end = i == 0 || i == last;
      // A clamp holds the middle of what would be one more link.
      const Turn moment = (end ? 2 : 1) * bending_ * (at.angle - natural_[i]);
      if (is_none(moment)) continue;
      if (i > 0) {
        const Vector pair = pair_of(moment, at.a);
        force_[i - 1] -= pair;
        force_[i] += pair;
      }
      if (i < last) {
        const Vector pair = pair_of(moment, at.b);
        force_[i] += pair;
        force_[i + 1] -= pair;
      }
    }
    const double kept = 1 - damping_ * dt;
    for (std::size_t i = 0; i <= last; ++i) {
      const double inverse = inverse_mass(i);
      if (inverse == 0) continue;
      v_[i] = kept * v_[i] + dt * inverse * force_[i];
      x_[i] += dt * v_[i];
    }
  }

 private:
  struct Bend {
    Vector a, b;  // links before and after the mass
    Turn angle;   // 2 tan(φ/2)
  };

  void describe(const Beam& beam, int links) {
    EA_ = beam.axial_stiffness();
    bending_ = beam.bending_stiffness() / link_;
    const FemModel<Corotational<>> resting(beam, links);
    for (int i = 0; i <= links; ++i) rest_.push_back(resting.shape().position(i * link_));
    link_ = (rest_[1] - rest_[0]).norm();  // the chord of what may be an arc
    const auto direction = [](double theta) { return Vector(std::cos(theta), -std::sin(theta)); };
    wall_ = {direction(beam.left_place().theta), direction(beam.right_place().theta)};
    held_ = {fixes_w(beam.left()), fixes_w(beam.right())};
    clamped_ = {fixes_theta(beam.left()), fixes_theta(beam.right())};
  }
  void describe(const Rod& rod, int links) {
    EA_ = rod.stiffness().axial;
    bending_ = rod.stiffness().bending1 / link_;
    rest_ = nodes_at_rest(rod, links);
    wall_.fill(rod.left_pose().along);
    std::size_t k = 0;
    for (const RodSupport& support : {rod.left(), rod.right()}) {
      if (!rod.arcs().empty() || !(support == RodSupport::clamped || support == RodSupport::free))
        throw std::invalid_argument(
            "rod: a chain of masses is straight by nature, clamped or free at its ends");
      held_[k] = clamped_[k] = support == RodSupport::clamped;
      ++k;
    }
    for (int i = 0; rod.load() && i <= links; ++i)
      load_.push_back((i == 0 || i == links ? 0.5 : 1.0) * link_ * rod.load()(i * link_));
  }

  static Turn none() noexcept {
    if constexpr (D == 2) return 0;
    else return Turn::Zero();
  }
  static Turn cross(const Vector& a, const Vector& b) noexcept {
    if constexpr (D == 2) return a.x() * b.y() - a.y() * b.x();
    else return detail::cross3<double>(a, b);
  }
  static bool is_none(const Turn& turn) noexcept {
    if constexpr (D == 2) return turn == 0;
    else return turn.isZero(0);
  }
  /// The pair of forces at the ends of a link that has this moment.
  static Vector pair_of(const Turn& moment, const Vector& a) noexcept {
    if constexpr (D == 2) return moment * Vector(Vector(-a.y(), a.x()) / a.squaredNorm());
    else return detail::cross3<double>(moment, a) / a.squaredNorm();
  }

  Bend bend(std::size_t i) const noexcept {
    const std::size_t last = x_.size() - 1;
    if ((i == 0 && !clamped_[0]) || (i == last && !clamped_[1]))
      return {Vector::UnitX(), Vector::UnitX(), none()};
    const Vector a = i == 0 ? wall_[0] : Vector(x_[i] - x_[i - 1]);
    const Vector b = i == last ? wall_[1] : Vector(x_[i + 1] - x_[i]);
    return {a, b, 2 * cross(a, b) / (std::sqrt(a.squaredNorm() * b.squaredNorm()) + a.dot(b))};
  }

  /// Moves the two masses of the link that the avatar has entered out of it.   @return [N·s] on the avatar
  Vector hold(const Vector& centre, double dt) noexcept {
    const std::size_t links = x_.size() - 1;
    const auto offset = [&](std::size_t i, double& t) {
      const Vector link = x_[i + 1] - x_[i];
      t = std::clamp(link.dot(centre - x_[i]) / link.squaredNorm(), 0.0, 1.0);
      return Vector(centre - x_[i] - t * link);
    };
    double t;
    if (near_ == 0) {  // anywhere; from then on it is near where it was
      for (std::size_t i = 0; i < links; ++i)
        if (offset(i, t).squaredNorm() < offset(near_, t).squaredNorm()) near_ = i;
    }
    for (const std::size_t i : {near_ - (near_ > 0), std::min(near_ + 1, links - 1)})
      if (offset(i, t).squaredNorm() < offset(near_, t).squaredNorm()) near_ = i;
    const Vector way = offset(near_, t), link = x_[near_ + 1] - x_[near_];
    Vector normal = way.normalized();
    if constexpr (D == 2) {
      const Vector above = Vector(-link.y(), link.x()).normalized();  // from where it is pressed
      if (!((t == 0 || t == 1) && way.dot(above) > 0)) normal = above;
    }
    const double depth = reach_ - way.dot(normal);
    if (depth <= 0) return Vector::Zero();
    const double first = (1 - t) * inverse_mass(near_), second = t * inverse_mass(near_ + 1);
    const double impulse = depth / (dt * ((1 - t) * first + t * second));
    const auto push = [&](std::size_t i, double share) {
      v_[i] -= impulse * share * normal;
      x_[i] -= impulse * share * dt * normal;
    };
    push(near_, first);
    push(near_ + 1, second);
    return impulse * normal;
  }

  /// Half of a link is at a free end.
  double inverse_mass(std::size_t i) const noexcept {
    const bool left = i == 0, right = i + 1 == rest_.size();
    if ((left && held_[0]) || (right && held_[1])) return 0;
    return (left || right ? 2 : 1) / mass_;
  }

  double EA_ = 0, bending_ = 0, link_, mass_, damping_, reach_;
  std::array<Vector, 2> wall_;
  std::array<bool, 2> held_, clamped_;
  std::vector<Vector> rest_, x_, v_, force_, load_;
  std::vector<Turn> natural_;
  Vector before_;
  bool known_ = false;
  std::size_t near_ = 0;
  int steps_;
};

}  // namespace hapbeam::benchmarks
