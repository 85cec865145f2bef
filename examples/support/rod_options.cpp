// The rods in space: round ones, of the figures that a beam has.
#include <cmath>
#include <stdexcept>
#include <vector>

#include "beam_options.hpp"

namespace cli {

namespace {

using hapbeam::RodSection, hapbeam::RodSupport, hapbeam::Support;

RodSupport in_space(Support support, const BeamOptions& beam) {
  switch (support) {
    case Support::free: return RodSupport::free;
    case Support::clamped: return RodSupport::clamped;
    case Support::pinned: return RodSupport::hinged;
    case Support::roller:
    case Support::guided: break;
  }
  refuse("--ends", ends(beam.left, beam.right), "free, clamped or pinned for a rod in space");
}

/// A straight stem, and two thirds of a circle in the plane of d1 that opens to the stem.
std::vector<hapbeam::RodArc> hook(double length) {
  constexpr double turn = 4 * 3.141592653589793 / 3;
  const double stem = 0.4 * length;
  return {{stem, 0, 0, 0}, {length, 0, turn / (length - stem), 0}};
}

}  // namespace

hapbeam::Rod BeamOptions::make_rod() const {
  if (!in_space()) refuse("--beam", name, "a rod in space");
  if (rise != 0) refuse("--rise", digits(rise), "0 for a rod in space");
  if (tension != 0) refuse("--tension", digits(tension), "0 for a rod in space");
  const auto material = hapbeam::RodMaterial::isotropic(young, 0.3);
  try {
    hapbeam::Rod made(length, RodSection::circle(touched()), material, cli::in_space(left, *this),
                      cli::in_space(right, *this));
    if (rod == RodShape::hook) made.naturally(hook(length));
    if (rod == RodShape::tapered)
      made.section([L = length, d = height](double s) { return RodSection::circle(d * (1 - 0.75 * s / L)); });
    if (hanging > 0) made.add(hapbeam::RodForce{length, {0, -hanging, 0}});
    return made;
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--ends: ") + error.what());
  }
}

}  // namespace cli
