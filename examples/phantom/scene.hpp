// Where the beam lies in the device's workspace, and what the hand does with it.
//
// The beam lies along the device's x axis, the place to be pressed below the middle of the workspace: the
// avatar touches the undeformed beam there when the device reads (0, 0).  The scene is larger than the
// workspace.  Displacements are mapped with a scale (1: true to size), forces are not scaled; with a scale of
// two, say, the hand therefore feels a beam twice as stiff.
#pragma once

#include <algorithm>

#include "options.hpp"
#include <hapbeam/haptics/device/hand_path.hpp>
#include <hapbeam/haptics/servo/placement.hpp>

namespace phantom {

inline hapbeam::Placement placement(const Options& options) {
  const double surface = options.beam.rest(options.place) + options.beam.height / 2;
  return hapbeam::Placement::in_plane({options.place, surface + options.radius}, options.scale);
}

/// How far the hand slides to either side of the place [m, device]: 0.15 m of the half width of 0.19 m, or less
/// where there is less beam.
inline double reach(const Options& options) {
  const double to_end = std::min(options.place - options.from, options.to - options.place);
  return std::min(0.15, 0.8 * std::max(to_end, 0.0) / options.scale);
}

/// The script in the device's axes; its parts take fixed fractions of the duration.
inline hapbeam::HandPath make_path(const Options& options) {
  const double above = 0.02, down = above + options.depth, T = options.duration;
  hapbeam::HandPath path({0, above});
  switch (options.script) {
    case Script::slide: {
      const double r = reach(options);
      path.press(down, 0.15 * T).rest(0.1 * T).slide(r, 0.15 * T).slide(-2 * r, 0.3 * T).slide(r, 0.15 * T);
      path.release(down, 0.1 * T).rest(0.05 * T);
      break;
    }
    case Script::press: path.press(down, 0.3 * T).rest(0.4 * T).release(down, 0.25 * T).rest(0.05 * T); break;
    case Script::tap:
      for (int i = 0; i < 5; ++i) path.press(down, 0.08 * T).release(down, 0.08 * T).rest(0.04 * T);
      break;
  }
  return path;
}

}  // namespace phantom
