// SPDX-License-Identifier: MIT
// One tick of the loop, for a program that has a loop of its own: CHAI3D, an HDAPI callback, Force Dimension's SDK, …
//
//   Servo<FemModel<>> servo(model, device_info, options);        // offline: allocates
//   const Eigen::Vector3d force = servo.tick(state);             // each period: where the hand is, what it feels
//
//   device ─► Placement ─► Coupling (Touch ─► model) ─► EnergyMonitor ─► ForceGuard ─► device
//                                   └─► newest record and shape, wait-free ─► graphics
//
// It is a servo of the device contract too: device.start(servo), or a ServoLoop, which does that.  Of a rod in space it takes the
// orientation of the stylus and answers with a torque where the device has them: Wrench wrench = servo.tick(oriented).
// tick(): no allocation, noexcept, wait-free but for the clock; at most one press of the model, whose work is bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/haptics/device/device_info.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>
#include <hapbeam/haptics/servo/stylus.hpp>
#include <hapbeam/haptics/servo/tick_times.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>
#include <hapbeam/haptics/stability/energy_monitor.hpp>
#include <hapbeam/haptics/stability/force_guard.hpp>

namespace hapbeam {

struct ServoOptions {
  Placement placement = {};      ///< of the device in the scene
  double avatar_radius = 0.005;  ///< [m] in the scene, not negative
  int delay_ticks = 0;           ///< whole periods between the servo's answer and the motors, 0 to 16
  bool dissipate = false;        ///< energy that the loop has generated is taken back by damping
  Friction friction = {};        ///< between avatar and beam: docs/contact.md
  StylusOptions stylus = {};     ///< touches a rod in space, where the device reads its orientation
};

/// The coupling of a servo that is given none.
template <typename Model>
struct CouplingOf {
  using Type = VirtualCoupling;
};

template <typename Model, typename Coupling = typename CouplingOf<Model>::Type>
class Servo {
  static_assert(is_coupling<Coupling> || detail::couples_pose<Coupling, Touch<Model>>,
                "a coupling has: tick(touch, hand, dt) noexcept -> CoupledForce<Scalar>; reset() noexcept; "
                "in_scene(scale) const noexcept -> itself; static for_device(info, delay_ticks) -> itself");

  template <typename State>
  using IfTurns = std::enable_if_t<dimension_of<Touch<Model>> == 3 && std::is_same_v<State, OrientedState>>;

 public:
  using Scalar = typename Model::Scalar;
  using Picture = typename Drawn<Model>::Picture;
  static constexpr int dimension = dimension_of<Touch<Model>>;

  /// @param model   kept by reference, and pressed by this object alone
  /// @param device  what the loop's device can do; its limits are the guard's
  /// @param coupling  in the device's metres; its figures, too, are for placement.scale() to change   @throws std::invalid_argument
  Servo(Model& model, const DeviceInfo& device, const ServoOptions& options, const Coupling& coupling);

  /// With the coupling that the device can render.   @throws as Coupling::for_device, too
  Servo(Model& model, const DeviceInfo& device, const ServoOptions& options = {})
      : Servo(model, device, options, Coupling::for_device(device, options.delay_ticks)) {}

  /// @param state  of the device, at the beginning of a period   @return [N] on the hand, device axes
  [[nodiscard]] Eigen::Vector3d tick(const DeviceState& state) noexcept;

  /// The same with the orientation of the stylus, of a rod in space.   @return on the hand, device axes
  template <typename State, typename = IfTurns<State>>
  [[nodiscard]] Wrench tick(const State& state) noexcept {
    return run<true>(state);
  }
  template <typename State>
  auto operator()(const State& state) noexcept {
    return tick(state);
  }

  /// For a host that hands over its own time step, or runs free.
  /// @param position [m] of the device   @param velocity [m/s]   @param dt [s] since the tick before, at most 1e6; another than
  /// a positive number counts as a clock that stands   @return as above
  [[nodiscard]] Eigen::Vector3d tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                                     double dt) noexcept {
    DeviceState state;
    state.position = position, state.velocity = velocity;
    state.time = record_.time + (dt > 0 && std::isfinite(dt) ? (std::min)(dt, 1e6) : 0);
    state.reset = record_.ticks == 0;
    return tick(state);
  }

  /// As new, but for the motors' heat.  While no tick runs.
  void reset() noexcept {
    release();
    energy_.start();
    record_ = {};
    publish();
    times_.pause();
  }

  const TickTimes& times() const noexcept { return times_; }
  const Coupling& coupling() const noexcept { return coupling_; }  ///< in the scene's metres

  /// Of the last tick.  From the servo's own thread, or while no tick runs.
  const ServoRecord& record() const noexcept { return record_; }

  /// The newest record and shape.  One reader, from any thread: wait-free.  They stay until the next call.
  /// The shape of a trained model is computed for who looks, and is that of a tick up to shape_period before the last look.
  const Picture& picture() noexcept { return pictures_.newest(); }

 private:
  using Coupled = CoupledForce<Scalar, dimension>;
  static constexpr bool couples_pose = detail::couples_pose<Coupling, Touch<Model>>;
  using Stylus = detail::Stylus<Scalar, dimension>;

  /// @tparam Turns  the state has an orientation that was read
  template <bool Turns>
  Wrench run(const OrientedState& state) noexcept;
  template <bool Turns>
  [[nodiscard]] Coupled couple(const OrientedState& state, double dt) noexcept;

  /// The hand may be anywhere: no contact, and what reaches it begins anew.
  void release() noexcept {
    touch_.reset();
    coupling_.reset();
    stylus_.reset();
    energy_.reset();
    guard_.reset();
  }

  static LoopStatus status(const DeviceState& state, const Coupled& coupled, const GuardedForce& guarded,
                           bool safe) noexcept {
    if (state.reset || state.status != DeviceStatus::running) return LoopStatus::device;
    if (!safe) return LoopStatus::no_answer;
    if (coupled.continued) return LoopStatus::continued;
    if (guarded.limited || state.cut != ForceCut::none) return LoopStatus::limited;
    if (!coupled.touch.pressing) return LoopStatus::free;
    if (guarded.engaging) return LoopStatus::engaging;
    return coupled.touch.status == Status::out_of_range ? LoopStatus::out_of_range : LoopStatus::touching;
  }

  void keep(const DeviceState& state, const Coupled& coupled, const GuardedForce& guarded,
            bool safe) noexcept;
  template <bool Turns>
  void keep_place(const OrientedState& state, const Coupled& coupled) noexcept {
    record_.position = state.position;
    record_.hand = detail::in_scene(options_.placement.template position_of<dimension>(state.position));
    record_.avatar = detail::in_scene(coupled.avatar);
    if constexpr (Turns && !couples_pose) {
      const HandPose hand{record_.hand, options_.placement.scene_orientation(state.orientation)};
      record_.avatar += stylus_.tip(hand), record_.shaft = stylus_.shaft(hand);
    }
  }

  void publish() noexcept {
    // What another hand may move now is drawn by ticks alone.
    if (detail::offers<detail::Meanwhile, Touch<Model>> && record_.ticks == 0)
      return pictures_.publish(record_);
    pictures_.publish(record_, record_.ticks % shape_period == 0);
  }

  static constexpr int shape_period = 8;  // [ticks]
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  ServoOptions options_;
  Touch<Model> touch_;
  Coupling coupling_;
  Stylus stylus_;
  LoopClock clock_;
  EnergyMonitor energy_;
  ForceGuard guard_;
  TickTimes times_;
  ServoRecord record_;
  detail::Pictures<Model> pictures_;
};

// What costs a compiler time is defined outside of the class: only so does "extern template class Servo<FemModel<>>;" keep it out of
// all files but one.
template <typename Model, typename Coupling>
Servo<Model, Coupling>::Servo(Model& model, const DeviceInfo& device, const ServoOptions& options,
                              const Coupling& coupling)
    : options_(options),
      touch_(detail::make_touch(model, static_cast<Scalar>(options.avatar_radius), options.friction)),
      coupling_(coupling.in_scene(options.placement.scale())),
      stylus_(options.stylus),
      clock_(device.period),
      energy_(device, options.delay_ticks),
      guard_(ForceGuard::for_device(device)),
      times_(device.period),
      pictures_(model, touch_) {}

template <typename Model, typename Coupling>
Eigen::Vector3d Servo<Model, Coupling>::tick(const DeviceState& state) noexcept {
  return run<false>(OrientedState{state}).force;
}

template <typename Model, typename Coupling>
template <bool Turns>
auto Servo<Model, Coupling>::couple(const OrientedState& state, double dt) noexcept -> Coupled {
  const VectorOf<double, dimension> place =
      options_.placement.template position_of<dimension>(state.position);
  if constexpr (couples_pose || Turns) {
    HandPose hand{place};
    if constexpr (Turns) hand.turn = options_.placement.scene_orientation(state.orientation);
    if constexpr (couples_pose) return coupling_.tick(touch_, hand, dt);
    else return stylus_.tick(coupling_, touch_, hand, dt);
  } else {
    return coupling_.tick(touch_, place, dt);
  }
}

template <typename Model, typename Coupling>
template <bool Turns>
Wrench Servo<Model, Coupling>::run(const OrientedState& state) noexcept {
  if (state.reset) times_.pause();  // the device had no ticks for it meanwhile
  times_.begin();
  const bool known = detail::is_place(state.position) && (!Turns || detail::is_rotation(state.orientation));
  // Ticks in which nobody knows where the hand is are no time of the loop: many of them are a pause.
  const LoopClock::Passed passed = clock_.passed(known ? state.time : not_a_number);
  const bool whole = state.cut == ForceCut::none;
  energy_.observe(state.position, state.orientation,
                  whole ? Wrench{guard_.force(), guard_.torque()} : Wrench{state.sent, state.sent_torque},
                  passed.step);
  if (state.reset || passed.pause || (known && detail::was_lifted(touch_))) release();
  Coupled coupled;
  if (known) coupled = couple<Turns>(state, passed.step);
  else coupled.touch.status = Status::invalid_request;
  const bool safe = is_answer(coupled.touch.status) || coupled.continued;
  Wrench wanted{options_.placement.device_force(detail::in_scene(coupled.force))};
  if constexpr (Turns) wanted.torque = options_.placement.device_torque(coupled.torque);
  if (options_.dissipate && coupled.touch.pressing) wanted.force += energy_.dissipation(state.velocity);
  if constexpr (couples_pose)
    if (!coupled.touch.pressing) guard_.reset();  // the hand has let go: what it takes again comes in anew
  const GuardedForce guarded = guard_.limit(wanted, state.time, safe);
  const double stored = coupled.energy / options_.placement.scale();
  energy_.lend(guard_.came_in() * stored);
  if (known && !coupled.touch.pressing) energy_.keep(stored);
  keep(state, coupled, guarded, safe);
  if (known) keep_place<Turns>(state, coupled);
  publish();
  times_.end();
  return guarded;
}

template <typename Model, typename Coupling>
void Servo<Model, Coupling>::keep(const DeviceState& state, const Coupled& coupled,
                                  const GuardedForce& guarded, bool safe) noexcept {
  ServoRecord& r = record_;
  const bool pressing = coupled.touch.pressing || coupled.continued, touched = pressing && !r.pressing;
  r.status = status(state, coupled, guarded, safe);
  r.time = state.time;
  r.heat = guard_.heat();
  r.keep(coupled.touch, guarded, pressing, !safe);
  r.touches += touched;
  r.saturated_ticks += guarded.limited || state.cut != ForceCut::none;
  r.continued_ticks += coupled.continued;
  if (pressing) r.max_press = (std::max)(r.max_press, std::abs(r.press.d));
  r.max_force = (std::max)(r.max_force, guarded.force.norm());
  r.max_torque = (std::max)(r.max_torque, guarded.torque.norm());
  r.energy_generated = energy_.generated();
  if (worse(r.model, r.worst)) r.worst = r.model;
}

}  // namespace hapbeam
