// Where a scripted hand wants to be in space: timed places, joined as hapbeam::HandPath joins those in a plane, by the smoothest
// reach (Flash and Hogan, J. Neurosci. 5(7), 1985).
//
// Building allocates; asking does not, and is noexcept, wait-free, O(log places).
#pragma once

#include <algorithm>
#include <vector>

#include <hapbeam/haptics/device/hand_path.hpp>

namespace phantom {

class ReachPath {
 public:
  /// @param place  [m] device axes
  explicit ReachPath(const Eigen::Vector3d& place) : points_{{0, place}} {}

  /// @param duration  [s], positive
  ReachPath& move_to(const Eigen::Vector3d& place, double duration) {
    points_.push_back({points_.back().time + duration, place});
    return *this;
  }
  ReachPath& rest(double duration) { return move_to(points_.back().place, duration); }

  double duration() const noexcept { return points_.back().time; }  ///< [s]

  /// @param time  [s]; before the first place the first, after the last the last
  hapbeam::HandTarget operator()(double time) const noexcept {
    const auto next = std::upper_bound(points_.begin(), points_.end(), time,
                                       [](double t, const Point& point) { return t < point.time; });
    if (next == points_.begin()) return {points_.front().place, Eigen::Vector3d::Zero()};
    if (next == points_.end()) return {points_.back().place, Eigen::Vector3d::Zero()};
    const Point &a = *(next - 1), &b = *next;
    const double span = b.time - a.time, t = (time - a.time) / span, r = 1 - t;
    const Eigen::Vector3d way = b.place - a.place;
    return {a.place + way * (t * t * t * (10 + t * (6 * t - 15))), way * (30 * t * t * r * r / span)};
  }

 private:
  struct Point {
    double time;            // [s]
    Eigen::Vector3d place;  // [m]
  };
  std::vector<Point> points_;
};

}  // namespace phantom
