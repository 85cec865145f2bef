// SPDX-License-Identifier: MIT
// A simulated Phantom Premium 1.5/6DOF High Force and the hand that holds it.
//
// The arm is a mass with viscous damping and Coulomb friction on each axis, which encoders read (arm_axis.hpp). Its force is held over
// the period and limited to the peak. A hand of mass, spring and damper pulls the arm along a path (hand_path.hpp). There are three
// translations and, optionally, a gimbal (arm.hpp), which the torque turns. Figures: thesis Table 2.1.
//
// It fulfils the device contract (device.hpp) with a thread of its own, in real time. It also runs in lock step with
// simulated time: as fast as the machine can, with the same bits every time.
// Construction and start() allocate and throw. A tick does neither, and never waits for another thread.
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>

#include <hapbeam/haptics/device/arm.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/device/hand_path.hpp>

namespace hapbeam {

struct VirtualPhantomOptions {
  ArmOptions arm;
  HandOptions hand;
  GimbalOptions gimbal = {};

  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const VirtualPhantomOptions& check() const {
    arm.check(hand);
    gimbal.check(arm.period);
    return *this;
  }
};

/// True position and velocity of the arm's tip, which a real device cannot report.
struct Tip {
  Eigen::Vector3d position;  ///< [m]
  Eigen::Vector3d velocity;  ///< [m/s]
};

namespace detail {

[[gnu::cold]] inline DeviceInfo describe(const VirtualPhantomOptions& options) {
  const ArmOptions& arm = options.arm;
  DeviceInfo info;
  info.name = "virtual Phantom Premium 1.5/6DOF High Force", info.workspace = {0.381, 0.267, 0.191};
  info.peak_force = arm.peak_force, info.continuous_force = 6.2, info.max_stiffness = 3500;
  info.position_resolution = arm.resolution, info.friction = arm.friction, info.period = arm.period;
  info.damping = arm.damping, info.apparent_mass = arm.apparent_mass;
  info.gimbal = Gimbal::describe(options.gimbal);
  return info;
}

}  // namespace detail

/// @tparam Path  target of the hand: HandTarget path(double time) noexcept, time in [s]
template <typename Path = HandPath>
class VirtualPhantom {
  static_assert(std::is_nothrow_invocable_v<const Path&, double> &&
                    std::is_same_v<std::invoke_result_t<const Path&, double>, HandTarget>,
                "a hand's path is called as: HandTarget path(double time) const noexcept");

 public:
  /// @throws std::invalid_argument naming field, value and unit; also where a HandPath leaves the workspace
  explicit VirtualPhantom(Path path, const VirtualPhantomOptions& options = {})
      : path_(std::move(path)), options_(options.check()), info_(detail::describe(options)) {
    check_workspace();
    reset();
  }
  ~VirtualPhantom() { stop(); }
  VirtualPhantom(const VirtualPhantom&) = delete;
  VirtualPhantom& operator=(const VirtualPhantom&) = delete;

  const DeviceInfo& info() const noexcept { return info_; }
  const VirtualPhantomOptions& options() const noexcept { return options_; }
  bool running() const noexcept { return loop_.load(std::memory_order_acquire) != Loop::none; }
  DeviceStatus status() const noexcept { return running() ? DeviceStatus::running : DeviceStatus::stopped; }
  DeviceCounts counts() const noexcept {
    return {ticks_.load(std::memory_order_relaxed), missed_ticks_.load(std::memory_order_relaxed),
            force_cut_ticks_.load(std::memory_order_relaxed)};
  }

  /// Restarts the path and calls the servo in real time, at absolute deadlines. A tick that begins late by n whole
  /// periods counts as n missed ticks; meanwhile the arm moves under the last force. start() and stop() belong to one
  /// thread.
  /// @throws std::logic_error where it runs already, std::system_error where the system gives no thread
  template <typename Servo>
  void start(Servo& servo) {
    require_servo<Servo>();
    if (running()) throw std::logic_error("VirtualPhantom: runs already");
    stop();
    reset();
    thread_ = std::thread([this, &servo]() noexcept { run_in_real_time(servo); });
    loop_.store(Loop::runs, std::memory_order_release);
  }
  void stop() noexcept {
    if (!thread_.joinable()) return;
    loop_.store(Loop::ends, std::memory_order_relaxed);
    thread_.join();
    loop_.store(Loop::none, std::memory_order_release);
  }

  /// Lock step: one tick and one period of simulated time.  Only while it does not run.
  /// Real-time: no allocation, noexcept, wait-free; bounded work.
  template <typename Servo>
  void step(Servo& servo) noexcept {
    require_servo<Servo>();
    tick(servo);
    advance();
  }
  /// Lock step over a simulated duration [s], to the nearest whole period.  Only while it does not run.
  template <typename Servo>
  void run(Servo& servo, double duration) noexcept {
    for (auto left = std::llround(duration / options_.arm.period); left > 0; --left) step(servo);
  }
  /// Back to the beginning of the path, without motion, all counts zero.  Only while it does not run.
  void reset() noexcept;
  /// True state of the tip.  Only while it does not run, or from the servo.
  Tip tip() const noexcept { return {arm_.position(), arm_.velocity()}; }
  /// True orientation of the stylus.  As tip().
  const Gimbal& gimbal() const noexcept { return gimbal_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Loop : std::uint8_t { none, runs, ends };

  template <typename Servo>
  void tick(Servo& servo) noexcept {
    OrientedState state;
    state.position = arm_.encoders().position(), state.velocity = arm_.encoders().velocity();
    state.time = time_, state.cut = cut_, state.sent = sent_.force, state.sent_torque = sent_.torque;
    state.reset = ticks_.load(std::memory_order_relaxed) == 0;
    if (options_.gimbal.present) state.orientation = gimbal_.orientation();
    sent_ = detail::ask(servo, state, options_.gimbal.present);
    cut_ = limit_wrench(sent_, options_.arm.peak_force, info_.gimbal.peak_torque);
    ticks_.fetch_add(1, std::memory_order_relaxed);
    if (cut_ != ForceCut::none) force_cut_ticks_.fetch_add(1, std::memory_order_relaxed);
  }

  /// One period under the last force.
  void advance() noexcept;

  /// [s] of the next tick: up to half the jitter to either side of where it should be, the same every time.
  double next_time() noexcept {
    // SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
    std::uint64_t bits = ++periods_ * 0x9E3779B97F4A7C15u;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
    const double random = static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1p-53 - 0.5;
    return (static_cast<double>(periods_) + options_.arm.jitter * random) * options_.arm.period;
  }

  template <typename Servo>
  void run_in_real_time(Servo& servo) noexcept {
    const auto period =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.arm.period));
    auto deadline = Clock::now();
    while (loop_.load(std::memory_order_relaxed) != Loop::ends) {
      tick(servo);
      deadline += period;
      std::this_thread::sleep_until(deadline);
      advance();
      for (; Clock::now() - deadline > period; deadline += period) {
        missed_ticks_.fetch_add(1, std::memory_order_relaxed);
        advance();
      }
    }
  }

  void check_workspace() const;

  Path path_;
  VirtualPhantomOptions options_;
  DeviceInfo info_;
  Arm arm_{options_.arm.axis(options_.hand), options_.hand.damping, options_.arm.resolution,
           options_.arm.velocity_cutoff};
  Gimbal gimbal_{options_.gimbal, options_.arm.velocity_cutoff};
  HandTarget target_{};
  Wrench sent_;
  detail::DelayLine late_, late_motors_;  // the last: of the gimbal
  ForceCut cut_ = ForceCut::none;
  std::uint64_t periods_ = 0;
  double time_ = 0;  // [s]
  std::atomic<std::uint64_t> ticks_{0}, missed_ticks_{0}, force_cut_ticks_{0};
  std::atomic<Loop> loop_{Loop::none};
  std::thread thread_;
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "counting in a tick must not lock");
};

// Outside of the class: only so does "extern template class VirtualPhantom<>;" keep a compiler from it.
template <typename Path>
void VirtualPhantom<Path>::reset() noexcept {
  periods_ = 0;
  time_ = 0;
  ticks_ = missed_ticks_ = force_cut_ticks_ = 0;
  sent_ = {};
  late_.clear(), late_motors_.clear();
  cut_ = ForceCut::none;
  target_ = path_(0);
  arm_.place(target_.position);
  gimbal_.reset(target_);
}

template <typename Path>
void VirtualPhantom<Path>::advance() noexcept {
  const double begun = std::exchange(time_, next_time()), period = time_ - begun;
  const HandTarget from = target_;
  target_ = path_(time_);
  const int delay = options_.arm.delay_ticks;
  arm_.advance(late_.pass(sent_.force, delay) + from.push, from.position, from.velocity, target_.position,
               target_.velocity, period);
  if (!options_.gimbal.present) return;
  gimbal_.advance(late_motors_.pass(gimbal_.by_axes(sent_.torque), delay), from, target_, period);
}

template <typename Path>
void VirtualPhantom<Path>::check_workspace() const {
  if constexpr (std::is_same_v<Path, HandPath>)
    for (const HandPath::WayPoint& point : path_.points())
      for (int i = 0; i < 2; ++i)
        if (const double most = info_.workspace[i] / 2; std::abs(point.position[i]) > most)
          detail::refuse("hand path %c = %g m: must be in the workspace, %g to %g", "xy"[i],
                         point.position[i], -most, most);
}

}  // namespace hapbeam
