// SPDX-License-Identifier: MIT
// The contract between a haptic device and the computation that gives it force.
//
// A device owns the servo loop. Once a period, on its own thread, it reads the position of the hand, calls a servo for
// the force and sends that force. A servo is a callable object, passed by reference. It must outlive the loop.
//
//   a servo S
//   s(state)      Eigen::Vector3d   noexcept; the force on the hand [N], device axes; no allocation or waiting
//                                   (called only while the device is calibrated)
//   s(oriented)   Wrench            optional, noexcept; of an OrientedState, force and torque: a device that reads the orientation of
//                                   its stylus (DeviceInfo::gimbal) calls this instead where the servo has it
//
//   a device D
//   d.info()      DeviceInfo        (or a const reference) what the device can do
//   d.start(s)    void              begins calling s each period; throws where the device runs or is broken
//   d.stop()      void              noexcept; blocks until the last tick has returned: s is called no more,
//                                   the force is zero.  Never from the servo.  Harmless where nothing runs
//   d.running()   bool              noexcept, wait-free; false again when the device ended the loop by itself
//   d.status()    DeviceStatus      noexcept, wait-free, from any thread: how it is, or what ended the loop
//   d.counts()    DeviceCounts      noexcept, wait-free, from any thread, while running and after
//
// A device sends only finite forces and torques within its peak, whatever the servo returns; the next tick's state has what was sent.
// DeviceState::status has the reason for less, and DeviceState::reset tells the servo to discard the contact.  Axes: x right, y up, z
// toward the user, as in OpenHaptics' HDAPI. Units are SI.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device_info.hpp>

namespace hapbeam {

/// What a device did to the force that it was given.
enum class ForceCut : std::uint8_t {
  none,        ///< sent as it was
  peak,        ///< |F| > peak: shortened to the peak, direction kept
  not_finite,  ///< a component was NaN or infinite: zero was sent
  ramped,      ///< scaled down, to zero perhaps, after a start or an error or with warm motors
};

/// The first five have a loop that runs or may be started; the last three have ended it, or prevented its start, until the next start().
enum class DeviceStatus : std::uint8_t {
  stopped,      ///< no loop, and nothing wrong
  running,      ///< the servo is called and its force sent
  warm,         ///< runs; motors near their limit: the force is scaled down to zero until they have cooled
  force_error,  ///< runs; the device rejected a force or a speed: zero was sent, and the force ramps in
  calibrating,  ///< runs; the device is calibrating itself: zero is sent, the servo is not called
  calibration_needed,  ///< not calibrated, and a person has to do it
  device_fault,        ///< the device or its driver reported an error that ends the loop
  communication_lost,  ///< unplugged, switched off, or the line disturbed
};

constexpr bool is_running(DeviceStatus status) noexcept {
  return status == DeviceStatus::running || status == DeviceStatus::warm ||
         status == DeviceStatus::force_error || status == DeviceStatus::calibrating;
}

constexpr const char* name(DeviceStatus status) noexcept {
  return detail::word_for<DeviceStatus::communication_lost>(
      status, {"stopped", "running", "warm", "force_error", "calibrating", "calibration_needed",
               "device_fault", "communication_lost"});
}

/// Input of the servo at the beginning of a tick.
struct DeviceState {
  Eigen::Vector3d position{0, 0, 0};            ///< [m] as the encoders read it, in the device's axes
  Eigen::Vector3d velocity{0, 0, 0};            ///< [m/s] as the device estimates it
  double time = 0;                              ///< [s] since start
  ForceCut cut = ForceCut::none;                ///< what the device did to the force of the tick before
  Eigen::Vector3d sent{0, 0, 0};                ///< [N] that force, as it was sent
  DeviceStatus status = DeviceStatus::running;  ///< running, warm or force_error
  /// Start without contact: in the first tick since the start or since a calibration, and in each tick in which a force
  /// error is found. A real device then sends zero and ramps the force in. A simulated one sends what is requested.
  bool reset = false;
};

/// The same of a device that reads the orientation of its stylus.
struct OrientedState : DeviceState {
  /// The axes of the stylus, one a column, in the device's axes; z along its shaft, from the tip to the hand.  A rotation.
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d sent_torque{0, 0, 0};  ///< [N·m] of the tick before, as it was sent
};

/// A force on the hand and a torque about the device's position.
struct Wrench {
  Eigen::Vector3d force{0, 0, 0};   ///< [N]
  Eigen::Vector3d torque{0, 0, 0};  ///< [N·m]
};

/// What happened since start.
struct DeviceCounts {
  std::uint64_t ticks = 0;            ///< calls of the servo
  std::uint64_t missed_ticks = 0;     ///< deadlines that passed by a whole period before a tick began
  std::uint64_t force_cut_ticks = 0;  ///< in which the servo's force was not sent unchanged
};

/// The force that a device may send: finite and no longer than its peak.
/// @param force  in: requested, out: permitted [N]   @param peak [N]
/// Real-time: no allocation, noexcept, wait-free, O(1).
[[nodiscard]] inline ForceCut limit_force(Eigen::Vector3d& force, double peak) noexcept {
  if (!force.allFinite()) return force.setZero(), ForceCut::not_finite;
  // In units of the largest component, whose square may overflow.
  const double largest = (std::max)({std::abs(force[0]), std::abs(force[1]), std::abs(force[2])});
  if (largest == 0) return ForceCut::none;
  const Eigen::Vector3d direction = force / largest;
  const double allowed = peak / direction.norm();
  if (!(largest > allowed)) return ForceCut::none;
  return force = direction * allowed, ForceCut::peak;
}

/// The same for force and torque together: if one is not finite, neither is sent.   @param peak_torque [N·m]; 0: it renders none
[[nodiscard]] inline ForceCut limit_wrench(Wrench& wrench, double peak_force, double peak_torque) noexcept {
  if (!wrench.force.allFinite() || !wrench.torque.allFinite()) return wrench = {}, ForceCut::not_finite;
  if (!(peak_torque > 0)) wrench.torque.setZero();
  const ForceCut force = limit_force(wrench.force, peak_force),
                 torque = limit_force(wrench.torque, peak_torque);
  return force != ForceCut::none ? force : torque;
}

namespace detail {

/// Whether a hand can be there: beyond 1e9 m positions are a reading or a unit gone wrong, and their powers overflow.
inline bool is_place(const Eigen::Vector3d& r) noexcept {
  return std::abs(r[0]) <= 1e9 && std::abs(r[1]) <= 1e9 && std::abs(r[2]) <= 1e9;
}

/// |RᵀR - 1|
inline double skew_of(const Eigen::Matrix3d& R) noexcept {
  double squared = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double error = R(0, i) * R(0, k) + R(1, i) * R(1, k) + R(2, i) * R(2, k) - (i == k);
      squared += error * error;
    }
  return std::sqrt(squared);
}
/// Whether a matrix is a rotation but for its last digits, and not a mirror.
inline bool is_rotation(const Eigen::Matrix3d& R) noexcept {
  const auto part = [&R](int i, int j, int k) { return R(0, i) * (R(1, j) * R(2, k) - R(1, k) * R(2, j)); };
  return skew_of(R) <= 1e-2 && part(0, 1, 2) + part(1, 2, 0) + part(2, 0, 1) > 0;
}

/// Axis times angle of a rotation [rad].   @param R  its entries, R(i, j)
template <class Rotation>
Eigen::Vector3d rotation_vector(const Rotation& R) noexcept {
  const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = twice.norm() / 2;
  if (!(sine > 0)) return Eigen::Vector3d::Zero();
  return twice * (std::atan2(sine, (R(0, 0) + R(1, 1) + R(2, 2) - 1) / 2) / (2 * sine));
}

// Signatures alone, to be called with null pointers: a contract is met where the first of two takes them.
template <typename S>
auto as_servo(S* s, const DeviceState* state)
    // Eigen::Vector3d itself: an Eigen expression would refer to what the servo has already left.
    -> std::bool_constant<noexcept((*s)(*state)) && std::is_same_v<decltype((*s)(*state)), Eigen::Vector3d>>;
template <typename>
std::false_type as_servo(...);

template <typename S>
auto as_turning(S* s, const OrientedState* state) -> std::is_same<decltype((*s)(*state)), Wrench>;
template <typename>
std::false_type as_turning(...);

struct AnyServo {
  Eigen::Vector3d operator()(const DeviceState&) noexcept;
};
template <typename D>
auto as_device(D* d, const D* seen, AnyServo* servo, decltype(d->start(*servo))* = nullptr)
    -> std::bool_constant<
        std::is_same_v<std::decay_t<decltype(seen->info())>, DeviceInfo>&& noexcept(d->stop()) && noexcept(
            seen->running()) && noexcept(seen->status()) && noexcept(seen->counts()) &&
        std::is_same_v<decltype(seen->running()), bool> &&
        std::is_same_v<decltype(seen->status()), DeviceStatus> &&
        std::is_same_v<decltype(seen->counts()), DeviceCounts>>;
template <typename>
std::false_type as_device(...);

}  // namespace detail

/// True where S can be called in a servo loop, noexcept included.
template <typename S>
inline constexpr bool is_servo = decltype(detail::as_servo<S>(nullptr, nullptr))::value;

/// True where S takes an orientation and answers with a torque besides.
template <typename S>
inline constexpr bool takes_orientation = decltype(detail::as_turning<S>(nullptr, nullptr))::value;

/// True where D fulfils the contract above, every noexcept included.
template <typename D>
inline constexpr bool is_device = decltype(detail::as_device<D>(nullptr, nullptr, nullptr))::value;

/// Stops compilation with the signature that is missing.
template <typename S>
constexpr void require_servo() noexcept {
  static_assert(is_servo<S>, "a servo is called as: Eigen::Vector3d servo(const DeviceState&) noexcept");
  if constexpr (takes_orientation<S>)
    static_assert(
        noexcept(std::declval<S&>()(std::declval<const OrientedState&>())),
        "a servo that takes an orientation is called as: Wrench servo(const OrientedState&) noexcept");
}

/// Stops compilation with the contract that is not met.
template <typename D>
constexpr void require_device() noexcept {
  static_assert(is_device<D>,
                "a device has: info() const -> DeviceInfo; start(Servo&); stop() noexcept; "
                "running() const noexcept -> bool; status() const noexcept -> DeviceStatus; "
                "counts() const noexcept -> DeviceCounts");
}

namespace detail {

/// The servo's answer, with a torque where it takes the orientation.   @param oriented  the device reads one
template <typename Servo>
Wrench ask(Servo& servo, const OrientedState& state, [[maybe_unused]] bool oriented) noexcept {
  if constexpr (takes_orientation<Servo>)
    if (oriented) return servo(state);
  return {servo(static_cast<const DeviceState&>(state)), Eigen::Vector3d::Zero()};
}

}  // namespace detail

}  // namespace hapbeam
