#include "curves.hpp"

#include <variant>

namespace phantom {

namespace {

/// As stiff all the way as the first of the others is where it begins.
Curve tangent_of(const Curve& first, double depth) {
  const float slope = first.force[1] / first.depth[1];
  return {"linear", {0, static_cast<float>(depth)}, {0, slope * static_cast<float>(depth)}};
}

}  // namespace

std::vector<Curve> force_curves(const Slender& slender, const PressLine& line) {
  if (const auto* const beam = std::get_if<hapbeam::Beam>(&slender)) return curves_in_plane(*beam, line);
  std::vector<Curve> curves = curves_in_space(std::get<hapbeam::Rod>(slender), line);
  if (!curves.empty()) curves.insert(curves.begin(), tangent_of(curves.front(), line.depth));
  return curves;
}

}  // namespace phantom
