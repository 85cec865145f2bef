// The rods in space, of the figures that a beam has.
#include <stdexcept>

#include "sections.hpp"

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

}  // namespace

hapbeam::Rod BeamOptions::make_rod() const { return make_rod(cli::in_space(left, *this)); }

hapbeam::Rod BeamOptions::make_rod(const RodSupport& left_end) const {
  if (!in_space()) refuse("--beam", name, "a rod in space");
  if (rise != 0) refuse("--rise", digits(rise), "0 for a rod in space");
  if (tension != 0) refuse("--tension", digits(tension), "0 for a rod in space");
  const auto material = hapbeam::RodMaterial::isotropic(young, 0.3);
  try {
    const Cut cut = cut_at(*this, length / 2);
    hapbeam::Rod made(length, section_of<RodSection>(*this, cut), material, left_end,
                      cli::in_space(right, *this));
    made.check_held();
    if (!arcs.empty()) made.naturally(arcs);
    if (!parts.empty()) made.sections(parts_of<hapbeam::RodPart, RodSection>(*this));
    if (density > 0) made.weight(density, {0, gravity, 0});
    for (const PointForce& force : forces) made.add(hapbeam::RodForce{force.s, {force.x, force.y, force.z}});
    return made;
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace cli
