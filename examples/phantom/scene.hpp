// Where the beam lies in the device's workspace, and what the hand does with it.
//
// The beam lies along the device's x axis, the place to be pressed below the middle of the workspace: the
// avatar touches the beam at rest there from above when the device reads (0, 0, 0).  The scene is larger than the
// workspace.  Displacements are mapped with a scale (1: true to size), forces are not scaled; with a scale of
// two, say, the hand therefore feels a beam twice as stiff.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "hand.hpp"
#include "options.hpp"
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/world/rigid_body.hpp>

namespace phantom {

/// [m, device] from where the avatar touches the beam at rest: where a script begins.
inline constexpr double height_above = 0.02;

/// From the centreline to the avatar's centre, or to the needle's centreline [m].
inline double reach_of(const Options& options) { return options.radius + options.beam.touched() / 2; }

/// From where the beam is touched to the hand [m]: a needle crosses the rod and comes from who looks.  An end that is held is in the hand
/// where a script begins.
inline Eigen::Vector3d to_hand(const Options& options) {
  if (holds_end(options.avatar)) return {0, -height_above * options.scale, 0};
  return {0, reach_of(options), options.avatar == Avatar::needle ? 0.15 : 0};
}

/// @param pressed  [m] of the centreline at rest, at the place to be pressed
inline hapbeam::Placement placement(const Eigen::Vector3d& pressed, const Options& options) {
  return {Eigen::Matrix3d::Identity(), pressed + to_hand(options), options.scale};
}

/// The needle in the hand, of steel.   @param hand  [m] where it is held   @param held  how
inline hapbeam::Rod needle(const Options& options, const Eigen::Vector3d& hand,
                           const hapbeam::RodSupport& held) {
  const auto section = hapbeam::RodSection::circle(2 * options.radius);
  hapbeam::Rod rod(0.2, section, hapbeam::RodMaterial::isotropic(200e9, 0.3), held,
                   hapbeam::RodSupport::free);
  return rod.place_left({hand, {0, 0, -1}, {0, 1, 0}});
}

/// The vessel that a held rod is pushed into, which bends up.  Empty where the hand holds something else.
inline std::vector<hapbeam::RigidBody> vessel(const Options& options) {
  if (options.avatar != Avatar::end) return {};
  constexpr double bend = 0.08, lead = 0.04, turn = 1.5707963, radius = 0.004;  // [m], [m], [rad], [m]
  const Eigen::Vector3d entry(options.beam.length - 0.03, 0, 0);
  return {hapbeam::RigidBody::tube(
      hapbeam::ArcSpline(entry, {1, 0, 0}).arc(lead).arc(turn * bend, {0, 1 / bend, 0}), radius)};
}

/// Along x: into a vessel, and away from a knot.
inline double along_end(const Options& options) { return options.avatar == Avatar::knot ? -1 : 1; }

/// How far the hand slides to either side of the place [m, device]: 0.15 m of the half width of 0.19 m, or less
/// where there is less beam.
inline double reach(const Options& options) {
  const double to_end = std::min(options.place - options.from, options.to - options.place);
  return std::min(0.15, 0.8 * std::max(to_end, 0.0) / options.scale);
}

/// [m, device] How far the hand keeps from a rod's axis on its way to another side of it: farther than it touches.
inline double hand_away(const Options& options) {
  const double touching = (options.radius + options.beam.touched() / 2) / options.scale;
  return touching + std::max(0.02, 0.6 * touching);
}

/// [m] along the beam, where the second hand holds it.
inline double second_place(const Options& options) { return 0.6 * options.place; }

/// The second hand comes from below, lifts what it holds and goes.  It aims 10 mm above the surface: 5 N of the 500 N/m of a simulated
/// hand, which no device cuts.
inline ReachPath make_second_path(const Options& options) {
  const double T = options.duration, touching = (options.radius + options.beam.touched() / 2) / options.scale;
  const Eigen::Vector3d up(0, 1, 0), away = -(touching + hand_away(options)) * up;
  return ReachPath(away).move_to((0.01 - 2 * touching) * up, 0.1 * T).rest(0.8 * T).move_to(away, 0.1 * T);
}

/// Presses a rod from above, from the front and from below, and goes back the way it came.
inline ReachPath make_path_around(const Options& options) {
  const Eigen::Vector3d sides[] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  const double T = options.duration, touching = (options.radius + options.beam.touched() / 2) / options.scale;
  const double away = hand_away(options);
  const Eigen::Vector3d axis(0, -touching, 0);
  ReachPath path(axis + away * sides[0]);
  for (const Eigen::Vector3d& side : sides) {
    if (&side != sides) path.move_to(axis + away * side, 0.07 * T);
    path.move_to(axis + (touching - options.depth) * side, 0.1 * T).rest(0.06 * T);
    path.move_to(axis + away * side, 0.08 * T);
  }
  return path.move_to(axis + away * sides[1], 0.07 * T).move_to(axis + away * sides[0], 0.07 * T);
}

/// The script in the device's axes; its parts take fixed fractions of the duration.
inline Way make_path(const Options& options) {
  if (options.script == Script::around) return make_path_around(options);
  const double down = height_above + options.depth, T = options.duration;
  hapbeam::HandPath path({0, height_above});
  switch (options.script) {
    case Script::slide: {
      const double r = reach(options);
      path.press(down, 0.15 * T).rest(0.1 * T).slide(r, 0.15 * T).slide(-2 * r, 0.3 * T).slide(r, 0.15 * T);
      path.release(down, 0.1 * T).rest(0.05 * T);
      break;
    }
    case Script::press: path.press(down, 0.3 * T).rest(0.4 * T).release(down, 0.25 * T).rest(0.05 * T); break;
    case Script::around: break;
    case Script::push: {
      const double way = along_end(options) * options.depth;
      path.slide(way, 0.4 * T).rest(0.1 * T).slide(-way, 0.4 * T).rest(0.1 * T);
      break;
    }
    case Script::pluck:
      for (int i = 0; i < 3; ++i)
        path.press(down, 0.1 * T).rest(0.03 * T).release(down, 0.02).rest(0.2 * T - 0.02);
      break;
    case Script::tap:
      for (int i = 0; i < 5; ++i) path.press(down, 0.08 * T).release(down, 0.08 * T).rest(0.04 * T);
      break;
  }
  return path;
}

}  // namespace phantom
