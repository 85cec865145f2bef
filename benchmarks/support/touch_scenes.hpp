// Scenes to touch: a beam or a rod, a hand's path over it, and stops whose force is known.
//
// All is said in positions of the avatar's centre, so that methods of any kinematics are asked the same and contact is part
// of the answer.  A stop is come down to from above, in space from the front, and held until the force rests.
//   bar_5mm, bar_50mm   the thesis' bar between hinges, pressed anywhere from 6 to 94 % of its span
//   strip               steel, 400 × 20 × 0.5 mm between hinges, pressed there by up to ten times its thickness
//   ruler               steel, 300 × 25 × 1 mm, clamped at one end, bent until the other is 0.8 of its length down
//   arch                steel, span 200 mm, rise 12 mm, 10 × 0.5 mm between hinges, pressed beside its middle: the force
//                       has its peak halfway, and some way beyond the deepest press the arch snaps through
//   wire                steel, 200 mm, 1 mm round, clamped at one end, hangs by a weight of 1.2 N/m and is pressed across it
//   hook                steel, half a circle of 100 mm, 2 mm round, clamped at one end and pressed out of its plane near the other
// Truth: for bar and strip the closed form of a von Kármán beam; for ruler and arch 256 elements of any rotation; in space 96
// TwistedRod, which the tests compare with an independent solution (tests/data/rods_in_space.csv).
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::benchmarks {

using Point = Vector2<double>;  // [m]

/// The avatar at rest and the force that it feels [N].
template <int D>
struct StopIn {
  VectorOf<double, D> position;
  VectorOf<double, D> away;  ///< [m] the way from there to where it comes from
  VectorOf<double, D> force;
};
using Stop = StopIn<2>;

/// @tparam D  of the space in which the beam bends: 2 | 3
template <int D>
struct TouchSceneIn {
  static constexpr int dimension = D;

  std::string name;
  std::conditional_t<D == 2, Beam, Rod> beam;
  double depth;                           ///< [m] of the deepest press
  double mass_per_length;                 ///< [kg/m]
  double lowest;                          ///< ω of its lowest mode [rad/s]
  std::vector<VectorOf<double, D>> path;  ///< a position for each tick of a second
  VectorOf<double, D> away;               ///< [m] the way from there to where the avatar comes from
  std::vector<StopIn<D>> stops, outside;  ///< up to the depth; up to 1.6 times as deep and beyond the depth
};
using TouchScene = TouchSceneIn<2>;

/// [m]  A sphere pushes a rod no deeper than it is thick, so that in space it is a larger one.
template <int D>
inline constexpr double radius_in = D == 2 ? 0.005 : 0.02;
inline constexpr double avatar_radius = radius_in<2>;

/// @param stops  in each scene; half as many outside
std::vector<TouchScene> touch_scenes(int stops);
std::vector<TouchSceneIn<3>> touch_scenes_in_space(int stops);

/// @param tick  position -> TouchResult, of a beam that is untouched   @return where the force has come to rest
template <int D, class Tick>
TouchResult<double, D> come_down(Tick&& tick, const StopIn<D>& stop) {
  constexpr int down = 60, apart = 20, most = 2000;
  for (int k = 0; k < down; ++k)
    (void)tick(VectorOf<double, D>(stop.position + stop.away * (down - k) / down));
  TouchResult<double, D> felt;
  VectorOf<double, D> before = VectorOf<double, D>::Zero();
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
