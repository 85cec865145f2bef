// Beams with two shapes at rest, and what an equilibrium path says of them.
#pragma once

#include <algorithm>

#include "support/arch.hpp"
#include "support/mesh_nodes.hpp"
#include "support/path.hpp"

namespace hapbeam::testing {

/// A steel strip of 200 × 10 × 0.5 mm between clamps, 4 mm too long for its place.
inline Beam buckled_strip() {
  Beam strip(0.2, Section::rectangle(0.01, 0.0005), Material{2e11}, Support::clamped, Support::clamped);
  return strip.place({}, {-0.004, 0, 0});
}
/// A hinged arch of 200 mm, naturally bent by 0.8 rad: its other shape is not the mirror image.
inline Beam hinged_arch() {
  return level_arch(0.2, 0.8, 1e6, 0.02, 0.0005, Support::pinned, Support::pinned);
}

/// The dead load in the middle under which a beam first gives way, from the given shape; on the symmetric path, before or
/// at its limit point.  @param side  +1: pressed from above
template <class Element, class Model>
double first_critical_load(Beam beam, const Model& resting, int side) {
  const int n = resting.elements();
  const double s = beam.length() / 2;
  beam.add({s, 0, -1.0 * side, 0});
  System<Element> system(beam, n);
  typename System<Element>::State state(n);
  const auto nodes = mesh_nodes(resting);
  std::copy(nodes.begin(), nodes.end(), state.nodes.begin());
  system.go_back(state, 0);
  system.find_tensions();
  ArcLength arc;
  arc.first_step = arc.largest_step = 2e-5;
  double before = 0, critical = 0;
  arc.solve(system, [&](const auto&, const PathPoint& point) {
    if (point.negative_pivots > 0) critical = (before + point.load) / 2;
    before = point.load;
    return critical == 0 && std::abs(point.load) < 1e6;
  });
  return critical;
}

/// How far a shape is from its mirror image in the middle [m].
template <class Model>
double lean(const Model& model) {
  const auto shape = model.shape();
  return std::abs(shape.at(shape.length() / 4).w - shape.at(3 * shape.length() / 4).w);
}
template <class Model>
double middle(const Model& model) {
  return model.shape().at(model.shape().length() / 2).w;
}

}  // namespace hapbeam::testing
