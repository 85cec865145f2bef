// SPDX-License-Identifier: MIT
// Target of a scripted hand: timed way-points in the plane, joined by minimum-jerk motion.
//
// Between two way-points the hand moves on the straight line with minimum jerk (Flash and Hogan, J. Neurosci. 5(7),
// 1985), the profile of a human reach. It starts and stops without velocity or acceleration, so position, velocity and acceleration are continuous:
//
//   p(τ) = a + (b - a)(10τ³ - 15τ⁴ + 6τ⁵),  τ in [0, 1]
// Building allocates and throws std::invalid_argument naming field, value and unit; evaluation does neither.
#pragma once

#include <algorithm>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

/// Target position and velocity of the hand, and the force it adds.
struct HandTarget {
  Eigen::Vector3d position;       ///< [m] device axes
  Eigen::Vector3d velocity;       ///< [m/s]
  Eigen::Vector3d push{0, 0, 0};  ///< [N] held until the next target; a weight, for example
  // Of a device with a gimbal: about its axes of yaw, pitch and roll (arm.hpp).
  Eigen::Vector3d turn{0, 0, 0};   ///< [rad] any number of turns
  Eigen::Vector3d spin{0, 0, 0};   ///< [rad/s]
  Eigen::Vector3d twist{0, 0, 0};  ///< [N·m] held until the next target
};

/// A script for the hand in the device's x-y plane (z = 0). It begins at a place and appends one motion after the
/// other, for example `HandPath({0, 0.02}).press(0.03, 1).slide(0.1, 2).release(0.03, 1)`.
class HandPath {
 public:
  /// One way-point, passed without velocity.
  struct WayPoint {
    double time;                    ///< [s] since the beginning
    Vector2<double> position;       ///< [m] x to the right, y up
    Eigen::Vector3d turn{0, 0, 0};  ///< [rad] yaw, pitch and roll of the stylus
  };

  /// A hand that rests at a place.
  /// @param place [m]   @throws std::invalid_argument where a coordinate is not finite
  explicit HandPath(const Vector2<double>& place)
      : points_{{0, detail::all_finite("hand path place", place, "m")}} {}

  /// Way-points in the order of their times.
  /// @throws std::invalid_argument where there is none, the first is not at 0 s, a time does not come after
  ///         the one before it, anything is not finite, or the hand would be faster than 1e9 m/s
  explicit HandPath(const std::vector<WayPoint>& points) {
    if (points.empty()) detail::refuse("hand path: must have at least one way-point");
    if (points.front().time != 0) detail::reject("hand path first time", points.front().time, "s", "0");
    for (const WayPoint& point : points) go_to(point);
  }

  /// Reaches for a place.  @param place [m]   @param duration [s], positive
  HandPath& move_to(const Vector2<double>& place, double duration) {
    detail::positive("hand path duration", duration, "s");
    return go_to({points_.back().time + duration, place, points_.back().turn});
  }
  /// Turns the stylus where it is.  @param by [rad] yaw, pitch and roll   @param duration [s]
  HandPath& turn(const Eigen::Vector3d& by, double duration) {
    detail::positive("hand path duration", duration, "s");
    const WayPoint& last = points_.back();
    return go_to({last.time + duration, last.position, last.turn + by});
  }
  /// Moves along the beam.  @param distance [m] to the right, either sign   @param duration [s]
  HandPath& slide(double distance, double duration) { return move_by(distance, 0, duration); }
  /// Presses down.  @param depth [m], positive   @param duration [s]
  HandPath& press(double depth, double duration) {
    return move_by(0, -detail::positive("hand path depth", depth, "m"), duration);
  }
  /// Lets go upwards.  @param height [m], positive   @param duration [s]
  HandPath& release(double height, double duration) {
    return move_by(0, detail::positive("hand path height", height, "m"), duration);
  }
  /// Stays where it is.  @param duration [s]
  HandPath& rest(double duration) { return move_by(0, 0, duration); }

  const std::vector<WayPoint>& points() const noexcept { return points_; }
  double duration() const noexcept { return points_.back().time; }  ///< [s]

  /// Target at a time; before the first way-point the first, after the last the last.
  /// @param time [s]
  /// Real-time: no allocation, noexcept, wait-free, O(log way-points).
  HandTarget operator()(double time) const noexcept {
    const auto next = std::upper_bound(points_.begin(), points_.end(), time,
                                       [](double t, const WayPoint& point) { return t < point.time; });
    const WayPoint& b = next == points_.end() ? points_.back() : *next;
    const WayPoint& a = next == points_.begin() ? b : *(next - 1);
    const double span = b.time - a.time, t = span > 0 ? (time - a.time) / span : 0, r = 1 - t;
    const double share = t * t * t * (10 + t * (6 * t - 15)), rate = span > 0 ? 30 * t * t * r * r / span : 0;
    const Vector2<double> way = b.position - a.position, position = a.position + way * share;
    const Eigen::Vector3d turn = b.turn - a.turn;
    HandTarget target{{position.x(), position.y(), 0}, {way.x() * rate, way.y() * rate, 0}};
    target.turn = a.turn + turn * share, target.spin = turn * rate;
    return target;
  }

 private:
  HandPath& go_to(const WayPoint& next) {
    detail::all_finite("hand path place", next.position, "m");
    detail::all_finite("hand path turn", next.turn, "rad");
    if (!points_.empty()) {
      const WayPoint& last = points_.back();
      if (!(std::isfinite(next.time) && next.time > last.time))
        detail::reject("hand path time", next.time, "s", "finite and after the one before it");
      const double speed = 1.875 * (next.position - last.position).norm() / (next.time - last.time);
      if (!(speed <= fastest)) detail::reject("hand path speed", speed, "m/s", "at most 1e9");
      const double spin = 1.875 * (next.turn - last.turn).norm() / (next.time - last.time);
      if (!(spin <= fastest)) detail::reject("hand path spin", spin, "rad/s", "at most 1e9");
    }
    return points_.push_back(next), *this;
  }
  HandPath& move_by(double x, double y, double duration) {
    return move_to(points_.back().position + Vector2<double>(x, y), duration);
  }

  static constexpr double fastest = 1e9;  // [m/s], [rad/s]

  std::vector<WayPoint> points_;
};

}  // namespace hapbeam
