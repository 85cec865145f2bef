// The hand: a script that it follows, a recording that it repeats, or a cursor that pulls it.
//
// The cursor comes sixty times a second from the window and the arm is asked a thousand times.  So the hand follows the
// cursor as a critically damped mass on a spring of 8 Hz, no faster than an arm moves: the target that the simulated hand
// gets is smooth.  Until the cursor first takes it, the script is followed to the bit.
// pull(), at(): no allocation, noexcept, wait-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include <hapbeam/haptics/exchange.hpp>
#include <hapbeam/haptics/hand_path.hpp>

namespace phantom {

/// A target for each period of the loop.
struct Replay {
  std::vector<hapbeam::HandTarget> targets;  ///< at least one

  hapbeam::HandTarget operator()(double time) const noexcept {
    const auto tick = static_cast<std::size_t>(std::llround(std::max(time, 0.0) / period));
    return targets[std::min(tick, targets.size() - 1)];
  }
  double duration() const noexcept { return static_cast<double>(targets.size()) * period; }
  static constexpr double period = 1e-3;  ///< [s] the simulated Phantom's
};

using Way = std::variant<hapbeam::HandPath, Replay>;

class Hand {
 public:
  /// @param repeat  begins the script anew when it has ended
  explicit Hand(Way script, bool repeat = false) : script_(std::move(script)), repeat_(repeat) {}

  /// From the window: pulls the hand to a place.  @param place [m] device axes
  void pull(const hapbeam::Vector2<double>& place) noexcept { cursor_.publish(Cursor{true, place}); }
  /// The script again.  While no loop runs.
  void let_go() noexcept {
    cursor_.publish(Cursor{});
    taken_ = false;
  }

  /// From the servo's thread, times in order; 0 begins anew.
  hapbeam::HandTarget at(double time) noexcept {
    cursor_.update();
    const Cursor& cursor = cursor_.value();
    if (!cursor.pulls && !taken_) return last_ = scripted(time), time_ = time, last_;
    if (time > time_) follow(cursor.place, time - time_);
    taken_ = true, time_ = time;
    return last_;
  }
  double duration() const noexcept {
    return std::visit([](const auto& script) { return script.duration(); }, script_);
  }
  const hapbeam::HandTarget& last() const noexcept { return last_; }  ///< the same thread's

 private:
  struct Cursor {
    bool pulls = false;
    hapbeam::Vector2<double> place = hapbeam::Vector2<double>::Zero();
  };

  hapbeam::HandTarget scripted(double time) const noexcept {
    return std::visit(
        [&](const auto& script) { return script(repeat_ ? std::fmod(time, script.duration()) : time); },
        script_);
  }

  /// x'' = ω² (cursor - x) - 2 ω x', implicit in x', so that it is stable with any step.
  void follow(const hapbeam::Vector2<double>& to, double step) noexcept {
    for (int i = 0; i < 2; ++i) {
      const double far = 2 * fastest / omega, way = std::clamp(to[i] - last_.position[i], -far, far);
      double& v = last_.velocity[i];
      v = (v + step * omega * omega * way) / (1 + 2 * omega * step);
      last_.position[i] += step * v;
    }
  }

  static constexpr double omega = 2 * 3.141592653589793 * 8;  // [1/s]
  static constexpr double fastest = 1;                        // [m/s]

  Way script_;
  bool repeat_;
  hapbeam::Exchange<Cursor> cursor_;
  bool taken_ = false;
  double time_ = 0;
  hapbeam::HandTarget last_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// What the simulated Phantom calls.
struct Guided {
  Hand* hand;
  hapbeam::HandTarget operator()(double time) const noexcept { return hand->at(time); }
};

}  // namespace phantom
