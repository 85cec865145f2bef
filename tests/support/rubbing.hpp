// What friction takes, ∫ T · dslip by trapezoids, from what a circle felt on a beam in a plane.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace hapbeam::testing {

/// One contact in one tick.
struct Rubbing {
  double s = 0;                      ///< [m] along the beam
  Eigen::Vector2d normal, friction;  ///< out of the beam, upward or downward;  on the hand [N]
  double stretch = 1;                ///< |dr/ds|
};

/// Between two ticks [J].   @param reach  [m] from the circle's centre to the centreline
inline double rubbed(const Rubbing& a, const Rubbing& b, double reach) {
  const Eigen::Vector2d &m = a.normal, &n = b.normal;
  const double turned = std::atan2(m.x() * n.y() - m.y() * n.x(), m.dot(n)), side = n.y() < 0 ? -1 : 1;
  // Where the circle rolls it has no slip.
  const double slip = side * (a.stretch + b.stretch) / 2 * (b.s - a.s) - reach * turned;
  const auto along = [](const Rubbing& r) {
    return r.normal.y() * r.friction.x() - r.normal.x() * r.friction.y();
  };
  return -(along(a) + along(b)) / 2 * slip;
}

/// |dr/ds| of a centreline, beside a node as well.
template <class Line>
double stretch_at(const Line& line, double s) {
  const double h = 1e-4 * line.length(), from = std::max(s - h, 0.0), to = std::min(s + h, line.length());
  const auto a = line.at(from), b = line.at(to);
  return std::hypot(to + b.u - from - a.u, b.w - a.w) / (to - from);
}

}  // namespace hapbeam::testing
