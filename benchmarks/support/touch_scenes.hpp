// Scenes to touch: a beam, a hand's path over it, and stops whose force is known.
//
// All is said in positions of the avatar's centre, so that methods of any kinematics are asked the same and contact is part
// of the answer.  A stop is come down to from above, and held until the force rests.
//   bar_5mm, bar_50mm   the thesis' bar between hinges, pressed anywhere from 6 to 94 % of its span
//   strip               steel, 400 × 20 × 0.5 mm between hinges, pressed there by up to ten times its thickness
//   ruler               steel, 300 × 25 × 1 mm, clamped at one end, bent until the other is 0.8 of its length down
//   arch                steel, span 200 mm, rise 12 mm, 10 × 0.5 mm between hinges, pressed beside its middle: the force
//                       has its peak halfway, and some way beyond the deepest press the arch snaps through
// Truth: for bar and strip the closed form of a von Kármán beam; for ruler and arch 256 elements of any rotation.
#pragma once

#include <string>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/contact/touch.hpp>

namespace hapbeam::benchmarks {

using Point = Vector2<double>;  // [m]

/// The avatar at rest and the force that it feels [N].
struct Stop {
  Point position;
  double height;  ///< [m] from where it comes down
  Point force;
};

struct TouchScene {
  std::string name;
  Beam beam;
  double depth;                      ///< [m] of the deepest press
  double mass_per_length;            ///< [kg/m]
  double lowest;                     ///< ω of its lowest mode [rad/s]
  std::vector<Point> path;           ///< a position for each tick of a second
  std::vector<Stop> stops, outside;  ///< up to the depth; up to 1.6 times as deep and beyond the depth
};

inline constexpr double avatar_radius = 0.005;  // [m]

/// @param stops  in each scene; half as many outside
std::vector<TouchScene> touch_scenes(int stops);

/// @param tick  Point -> TouchResult, of a beam that is untouched   @return where the force has come to rest
template <class Tick>
TouchResult<double> come_down(Tick&& tick, const Stop& stop) {
  constexpr int down = 60, apart = 20, most = 2000;
  for (int k = 0; k < down; ++k) (void)tick(stop.position + Point(0, stop.height * (down - k) / down));
  TouchResult<double> felt;
  Point before = Point::Zero();
  for (int k = 1; k <= most; ++k) {
    felt = tick(stop.position);
    if (k % apart != 0) continue;
    // A beam that was thrown off will be back.
    if (felt.pressing && (felt.force - before).norm() <= 1e-6 * felt.force.norm()) break;
    before = felt.force;
  }
  return felt;
}

}  // namespace hapbeam::benchmarks
