// The servo that the device calls: it asks the body that is touched, and while that is changed the next one too.
//
// A change takes 0.4 s.  For 0.2 s the next body is approached, unfelt, by a hand that comes from beside it to where the
// hand is: so it is pressed from the same side.  Where the hand has slipped off the one that is felt meanwhile, the next begins
// anew, as a beam that nobody has pressed.  For 0.2 s the force goes over from the one to the other.  A guard behind
// both keeps the sum within what the device bears and within the slew rate, and knows how warm the motors are.
// operator(): no allocation, noexcept, wait-free but for the clock; one tick of a body, of two during a change.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>

#include "body.hpp"
#include "hand.hpp"
#include "tape.hpp"
#include <hapbeam/haptics/servo/exchange.hpp>
#include <hapbeam/haptics/stability/force_guard.hpp>

namespace phantom {

class Relay {
 public:
  static constexpr double approach = 0.2, handover = 0.2;  ///< [s]

  struct Newest {
    hapbeam::ServoRecord record;  ///< of the body that is felt, or of the next once that is felt a little
    hapbeam::ServoRecord second;  ///< the same of its second hand, where it has one
    int changes = 0;              ///< until it was that body
  };

  /// @param body, tape, hand  kept by reference   @param hand  or null: nobody but the device knows where it wants to be
  Relay(Body& body, const hapbeam::DeviceInfo& device, Tape& tape, const Hand* hand)
      : body_(&body), tape_(tape), hand_(hand), guard_(guard_of(device)) {}

  /// From one other thread, and only where settled().
  /// @param next  kept by reference   @param from [m] device axes: beside it, where the hand does not touch it
  void change(Body& next, const Eigen::Vector3d& from) noexcept {
    from_ = from;
    asked_.store(&next, std::memory_order_release);
  }
  /// No other body is asked than that of the last change.  From the same thread: wait-free.
  bool settled() const noexcept { return !asked_.load(std::memory_order_acquire); }

  /// From one other thread: wait-free.  It stays until the next call.
  const Newest& newest() noexcept {
    newest_.update();
    return newest_.value();
  }

  Eigen::Vector3d operator()(const hapbeam::DeviceState& state) noexcept {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    if (!next_) begin_change(state.time);
    Eigen::Vector3d force = body_->tick(state);
    double share = 0;
    if (next_) {
      share = std::clamp((state.time - begun_ - approach) / handover, 0.0, 1.0);
      const bool begins_anew = share > 0 && !felt_ && !body_->record().pressing;
      force = (1 - share) * force + share * next_->tick(approaching(state, begins_anew));
    }
    if (state.reset) guard_.reset();
    const hapbeam::GuardedForce guarded = guard_.limit(force, state.time, true);
    keep(share, guarded);
    const hapbeam::HandTarget target =
        hand_ ? hand_->last() : hapbeam::HandTarget{state.position, state.velocity};
    const Body& felt = *(felt_ ? next_ : body_);
    tape_.add({now_.record, target, std::chrono::duration<double>(Clock::now() - begin).count(), now_.changes,
               felt.moved()});
    if (share == 1) end_change();
    return guarded.force;
  }

 private:
  static hapbeam::ForceGuardOptions guard_of(const hapbeam::DeviceInfo& device) {
    hapbeam::ForceGuardOptions options = hapbeam::ForceGuard::for_device(device);
    options.engage_time = 0;  // each body's own guard engages
    return options;
  }

  void begin_change(double time) noexcept {
    next_ = asked_.load(std::memory_order_acquire);
    begun_ = time;
    approached_ = felt_ = false;
  }
  void end_change() noexcept {
    body_ = next_;
    next_ = nullptr;
    asked_.store(nullptr, std::memory_order_release);
  }

  hapbeam::DeviceState approaching(hapbeam::DeviceState state, bool begins_anew) noexcept {
    const double left = std::max(0.0, 1 - (state.time - begun_) / approach);
    state.position += left * (from_ - state.position);
    state.reset = state.reset || !approached_ || begins_anew;
    approached_ = true;
    return state;
  }

  void keep(double share, const hapbeam::GuardedForce& guarded) noexcept {
    using hapbeam::LoopStatus;
    if (share > 0 && !felt_) ++now_.changes, felt_ = true;
    hapbeam::ServoRecord& r = now_.record;
    const Body& felt = *(felt_ ? next_ : body_);
    r = felt.record();
    if (felt.second()) now_.second = *felt.second();
    r.force = guarded.force;
    r.heat = guard_.heat();
    if (guarded.limited) r.status = std::max(r.status, LoopStatus::limited);
    else if (share > 0 && share < 1 && r.pressing) r.status = std::max(r.status, LoopStatus::engaging);
    newest_.publish(now_);
  }

  Body* body_;
  Body* next_ = nullptr;
  Tape& tape_;
  const Hand* hand_;
  hapbeam::ForceGuard guard_;
  Newest now_;
  hapbeam::Exchange<Newest> newest_;
  double begun_ = 0;
  bool approached_ = false;  // the next body has been asked
  bool felt_ = false;        // it has a share of the force

  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  std::atomic<Body*> asked_{nullptr};
};

}  // namespace phantom
