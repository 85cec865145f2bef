// The hand: a script that it follows, a recording that it repeats, or a cursor that pulls it.
//
// The cursor comes sixty times a second from the window and the arm is asked a thousand times.  So the hand follows the
// cursor as a critically damped mass on a spring of 8 Hz, no faster than an arm moves: the target that the simulated hand
// gets is smooth.  In the same way it goes to where another script begins.  The first script is followed to the bit.
// follow(), pull(): from one thread; they allocate.  at(): no allocation, noexcept, wait-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "reach_path.hpp"
#include <hapbeam/haptics/device/hand_path.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>

namespace phantom {

/// Targets, each of which holds until the next one.
struct Replay {
  struct Row {
    long long tick;  ///< periods since the start
    hapbeam::HandTarget target;
  };
  std::vector<Row> rows;  ///< at least one, ascending; the first one also holds before its tick

  hapbeam::HandTarget operator()(double time) const noexcept {
    const auto after = std::upper_bound(rows.begin(), rows.end(), tick(std::max(time, 0.0)),
                                        [](long long now, const Row& row) { return now < row.tick; });
    return after == rows.begin() ? after->target : std::prev(after)->target;
  }
  double duration() const noexcept { return static_cast<double>(rows.back().tick + 1) * period; }
  static long long tick(double time) noexcept { return std::llround(time / period); }
  static constexpr double period = 1e-3;  ///< [s] the simulated Phantom's
};

using Way = std::variant<hapbeam::HandPath, ReachPath, Replay>;

class Hand {
 public:
  /// @param repeat  begins a script anew when it has ended
  explicit Hand(Way script, bool repeat = false)
      : repeat_(repeat),
        wish_{0, false, {0, 0, 0}, std::make_shared<const Way>(std::move(script))},
        wishes_(wish_) {}

  /// Pulls the hand to a place, where it stays.  @param place [m] device axes
  void pull(const Eigen::Vector3d& place) {
    wish_.pulled = true, wish_.place = place;
    wishes_.publish(wish_);
  }
  /// Goes to where the script begins, and follows it.
  void follow(Way script) {
    wish_ = {wish_.scripts + 1, false, {0, 0, 0}, std::make_shared<const Way>(std::move(script))};
    wishes_.publish(wish_);
  }
  double duration() const noexcept { return length(*wish_.script); }  ///< [s] of the script

  /// From the servo's thread, times in order; 0 begins anew.
  hapbeam::HandTarget at(double time) noexcept {
    wishes_.update();
    const Wish& wish = wishes_.value();
    if (wish.scripts != scripts_) scripts_ = wish.scripts, begin_ = time + approach;
    if (!wish.pulled && time >= begin_) last_ = scripted(*wish.script, time - begin_);
    else if (time > time_) lead(wish.pulled ? wish.place : start(*wish.script), time - time_);
    time_ = time;
    return last_;
  }
  const hapbeam::HandTarget& last() const noexcept { return last_; }  ///< the same thread's

 private:
  struct Wish {
    int scripts;  // before this one
    bool pulled;
    Eigen::Vector3d place;
    // Copied and dropped by the window alone, so that the servo's thread frees nothing.
    std::shared_ptr<const Way> script;
  };

  static double length(const Way& way) noexcept {
    return std::visit([](const auto& script) { return script.duration(); }, way);
  }
  hapbeam::HandTarget scripted(const Way& way, double time) const noexcept {
    return std::visit(
        [&](const auto& script) { return script(repeat_ ? std::fmod(time, script.duration()) : time); }, way);
  }
  Eigen::Vector3d start(const Way& way) const noexcept { return scripted(way, 0).position; }

  /// x'' = ω² (to - x) - 2 ω x', implicit in x', so that it is stable with any step.
  void lead(const Eigen::Vector3d& to, double step) noexcept {
    for (int i = 0; i < 3; ++i) {
      const double far = 2 * fastest / omega, way = std::clamp(to[i] - last_.position[i], -far, far);
      double& v = last_.velocity[i];
      v = (v + step * omega * omega * way) / (1 + 2 * omega * step);
      last_.position[i] += step * v;
    }
  }

  static constexpr double omega = 2 * 3.141592653589793 * 8;  // [1/s]
  static constexpr double fastest = 1;                        // [m/s]
  static constexpr double approach = 0.6;  // [s] across the workspace, and at rest to a micrometre

  bool repeat_;
  Wish wish_;
  hapbeam::Exchange<Wish> wishes_;
  int scripts_ = 0;
  double begin_ = 0;  // [s] of the script
  double time_ = 0;
  hapbeam::HandTarget last_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// What the simulated Phantom calls.
struct Guided {
  Hand* hand;
  hapbeam::HandTarget operator()(double time) const noexcept { return hand->at(time); }
};

}  // namespace phantom
