// SPDX-License-Identifier: MIT
// A hand that holds an end of a rod: a fishing rod, a whip, a catheter.
//
//   const auto coupling = GripCoupling::for_device(device.info());
//   const Rod rod(0.6, section, material, coupling.support(), RodSupport::free);     // the hand's springs are the rod's support
//   FemModel<TwistedRod> model(rod, 16);
//   Grip<FemModel<TwistedRod>> grip(model, RodSide::left);
//   ServoLoop loop(device, grip, options);
//
// In the first tick the hand takes hold of the end where it is.  From then on the end goes where the hand goes, and turns as it turns.
// grip.let_go() leaves the end in a vice, grip.take() takes it again.  What is felt is the force on the hand and the torque about the end.
//
// The coupling is K, B between places and K_r, B_r between orientations.  Its springs belong to the rod, so that the end's
// equilibrium is Newton's: implicit, whatever is stiffer.  With the hand at h and the end at x, g = x - h, and by backward Euler
//
//   F = K g + B (g - g0)/T = K' (x - h'),   K' = K + B/T,   h' = h + β g0,   β = 1 - K/K'
//
// K' are the springs' stiffnesses, h' is where they are placed.  Orientations go the same way by the rotation vector.  Where the end is
// turned against the hand by more than `slip` the grip slips, and where no answer is found it is taken anew.
// A rod with mass has K and B within its steps, and goes on where it is let go.
// Real-time: no allocation, noexcept, wait-free; one hold() of the model a tick, or step().
#pragma once

#include <atomic>
#include <cmath>

#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/haptics/stability/coupling_limits.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam {

/// A rod, and the end of it that the hand holds; given to a Servo in place of the model.
template <typename Model>
class Grip {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = 3;

  /// @param model  kept by reference; its end at `side` is clamped, or has GripCoupling::support()
  Grip(Model& model, RodSide side) noexcept : model_(model), side_(side) {}

  /// From any thread: the end stays where it is, and the hand feels nothing.
  void let_go() noexcept { held_.store(false, std::memory_order_relaxed); }
  void take() noexcept { held_.store(true, std::memory_order_relaxed); }
  bool held() const noexcept { return held_.load(std::memory_order_relaxed); }

  Model& model() noexcept { return model_; }
  const Model& model() const noexcept { return model_; }
  RodSide side() const noexcept { return side_; }
  auto shape() const noexcept { return model_.shape(); }
  const RodNode<Scalar>& end() const noexcept {
    const auto line = model_.shape();
    return line[side_ == RodSide::left ? 0 : line.segments()];
  }

 private:
  Model& model_;
  RodSide side_;
  std::atomic<bool> held_{true};
};

/// The end as a hand has taken it.
template <typename Model>
class Touch<Grip<Model>> {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = 3;

  explicit Touch(Grip<Model>& grip, Scalar = 0) noexcept : grip_(grip) { reset(); }

  /// The rod goes back to rest, and the hand takes hold of it anew.
  void reset() noexcept {
    grip_.model().reset();
    aim_ = end();
    taken_ = false;
    rest_ = 0, rest_ = energy();
  }
  bool pressing() const noexcept { return taken_; }
  bool held() const noexcept { return grip_.held(); }
  void let_go() noexcept { taken_ = false; }
  /// The end slips out of the hand, which takes it anew where it has come to.
  void lose() noexcept { let_go(), aim_ = end(); }

  /// Where a hand has the end; the first one takes it as it is held.
  HandPose follow(const HandPose& hand) noexcept {
    if (!taken_ && hand.place.allFinite() && hand.turn.allFinite()) {
      from_hand_ = {aim_.place - hand.place, hand.turn.transpose() * aim_.turn};
      taken_ = true;
    }
    return {hand.place + from_hand_.place, hand.turn * from_hand_.turn};
  }
  /// The grip slips: the end is turned in the hand.   @param by  a rotation, in the scene
  void slip(const HandPose& hand, const Eigen::Matrix3d& by) noexcept {
    from_hand_.turn = hand.turn.transpose() * by * hand.turn * from_hand_.turn;
  }
  /// @param damper, dt  of a rod with mass, which goes on by dt [s]
  HeldEnd<Scalar> hold(const HandPose& aim, [[maybe_unused]] const HoldDamper& damper,
                       [[maybe_unused]] double dt) noexcept {
    Model& model = grip_.model();
    const RodPose pose{aim.place, aim.turn.col(2), aim.turn.col(0)};
    HeldEnd<Scalar> held;
    if constexpr (has_mass<Model>) {
      Status status = model.hold(grip_.side(), pose, damper);
      if (is_answer(status)) status = go_on(dt);
      held = model.reaction(grip_.side());
      if (status != Status::ok) held.status = status;
    } else {
      held = model.hold(grip_.side(), pose);
    }
    if (is_answer(held.status)) aim_ = aim;
    return held;
  }
  /// Where it is; the columns are d1, d2 and the tangent.
  HandPose end() const noexcept {
    const auto& node = grip_.end();
    HandPose pose{detail::in_scene(node.r)};
    const Eigen::Vector3d d3 = detail::unit(detail::in_scene(node.tangent)),
                          d1 = detail::across<double>(detail::in_scene(node.director), d3);
    pose.turn.col(0) = d1, pose.turn.col(1) = detail::cross3<double>(d3, d1), pose.turn.col(2) = d3;
    return pose;
  }
  Scalar s() const noexcept { return grip_.end().s; }
  /// What the rod has; with mass, more than at rest [J].
  double energy() const noexcept {
    if constexpr (has_mass<Model>) return static_cast<double>(grip_.model().energy().sum()) - rest_;
    else return static_cast<double>(grip_.model().strain_energy());
  }
  /// A rod with mass goes on without the hand.   @param dt [s]
  Status go_on(double dt) noexcept { return grip_.model().step(static_cast<Scalar>(dt)); }

 private:
  Grip<Model>& grip_;
  HandPose aim_, from_hand_;
  double rest_ = 0;  // energy at rest [J]
  bool taken_ = false;
};

/// Between a hand that turns and the end that it holds.
class GripCoupling {
 public:
  /// Ticks in a row that go on without an answer, with the last one.
  static constexpr int max_continued = 20;
  /// [rad]  A spring against a turn has its largest moment at a quarter turn.
  static constexpr double slip = 1;

  /// @param place  K [N/m] and B [N·s/m]   @param turning  K_r [N·m/rad] and B_r [N·m·s/rad]   @param period T [s]
  /// @throws std::invalid_argument unless stiffnesses are positive, dampings not negative and all finite
  GripCoupling(const CouplingFigures& place, const CouplingFigures& turning, double period)
      : place_(detail::checked(place, "grip", "N/m", "N·s/m")),
        turning_(detail::checked(turning, "grip turning", "N·m/rad", "N·m·s/rad")),
        period_(detail::loop_period("grip period", period)) {}
  /// What the device can render.   @throws as safe_coupling()
  static GripCoupling for_device(const DeviceInfo& device, int delay_ticks = 0) {
    return {safe_coupling(device, delay_ticks), safe_turning_coupling(device, delay_ticks), device.period};
  }

  CouplingFigures place() const noexcept { return place_; }
  CouplingFigures turning() const noexcept { return turning_; }
  /// Between places and torques of a scene of so many metres to one of the device's.
  GripCoupling in_scene(double scale) const noexcept {
    GripCoupling scaled = *this;
    scaled.place_ = place_ * (1 / scale), scaled.turning_ = turning_ * scale;
    return scaled;
  }
  /// How the held end of the rod is supported: K' and K_r'.   @throws std::invalid_argument where the scene's scale overflows them
  RodSupport support() const {
    const double k = stiff(place_), t = stiff(turning_);
    return RodSupport::elastic(detail::positive("grip stiffness", k, "N/m"), k, k,
                               detail::positive("grip turning stiffness", t, "N·m/rad"), t, t);
  }
  void reset() noexcept {
    gap_.setZero(), turn_.setZero();
    continued_ = 0, last_ = {};
  }

  /// Once a period.   @param hand  in the scene   @param dt [s] since the tick before, which matters to a rod with mass alone
  template <typename Model>
  [[nodiscard]] CoupledForce<typename Model::Scalar, 3> tick(Touch<Grip<Model>>& touch, const HandPose& hand,
                                                             double dt) noexcept {
    CoupledForce<typename Model::Scalar, 3> result;
    result.avatar = touch.end().place;
    if (!touch.held()) {
      touch.let_go();
      reset();
      if constexpr (has_mass<Model>) result.touch.status = touch.go_on(dt), result.energy = touch.energy();
      return result;
    }
    const HandPose at = touch.follow(hand);
    const HandPose aim{at.place + share(place_) * gap_, turn_by(share(turning_) * turn_) * at.turn};
    const auto held = touch.hold(has_mass<Model> ? at : aim, {share(place_), share(turning_), period_}, dt);
    result.touch.status = held.status;
    result.touch.press = {touch.s(), 0};
    if (is_answer(held.status)) {
      const HandPose end = touch.end();
      gap_ = end.place - at.place, turn_ = detail::rotation_vector(end.turn * at.turn.transpose());
      last_ = {-detail::in_scene(held.force), -detail::in_scene(held.moment)};
      continued_ = 0;
      const double angle = turn_.norm();
      if (angle > slip) {
        touch.slip(hand, turn_by(turn_ * (1 - slip / angle)));
        turn_ *= slip / angle;
      }
    } else if (!has_mass<Model> && held.status == Status::iteration_limit && continued_ < max_continued) {
      ++continued_;
    } else {
      touch.lose();
      reset();
    }
    result.continued = continued_ > 0;
    result.touch.pressing = touch.pressing();
    result.avatar = touch.end().place;
    if (!(last_.force.allFinite() && last_.torque.allFinite() && gap_.allFinite() && turn_.allFinite())) {
      reset();
      result.touch.status = Status::non_finite;
    }
    result.force = last_.force, result.torque = last_.torque;
    if (!result.force.isZero(0)) result.energy = touch.energy();
    return result;
  }

 private:
  double stiff(const CouplingFigures& figures) const noexcept {
    return figures.stiffness + figures.damping / period_;
  }
  /// β
  double share(const CouplingFigures& figures) const noexcept {
    return 1 - figures.stiffness / stiff(figures);
  }

  static Eigen::Matrix3d turn_by(const Eigen::Vector3d& by) noexcept {
    const double angle = by.norm();
    if (!(angle > 0)) return Eigen::Matrix3d::Identity();
    Eigen::Matrix3d K;  // by × …
    K << 0, -by[2], by[1], by[2], 0, -by[0], -by[1], by[0], 0;
    return Eigen::Matrix3d::Identity() + std::sin(angle) / angle * K +
           (1 - std::cos(angle)) / (angle * angle) * (K * K);
  }

  CouplingFigures place_, turning_;
  double period_;
  Eigen::Vector3d gap_{0, 0, 0};   // g [m]
  Eigen::Vector3d turn_{0, 0, 0};  // of the end against the hand [rad]
  Wrench last_;                    // of the last answer
  int continued_ = 0;
};

template <typename Model>
struct CouplingOf<Grip<Model>> {
  using Type = GripCoupling;
};
template <typename Model>
struct Drawn<Grip<Model>> {
  using Picture = ServoPicture<typename Model::Scalar, 3>;
  static constexpr bool for_who_looks = false;
  static auto of(const Grip<Model>& grip, const Touch<Grip<Model>>&) noexcept { return grip.shape(); }
};

}  // namespace hapbeam
