// SPDX-License-Identifier: MIT
// Rods as C describes them.  Offline: std::invalid_argument names field, value, unit and what is allowed.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hapbeam.h"
#include <hapbeam/rod.hpp>

namespace hapbeam::border {

inline RodSupport rod_support(const char* end, int value) {
  switch (value) {
    case HAPBEAM_FREE: return RodSupport::free;
    case HAPBEAM_CLAMPED: return RodSupport::clamped;
    case HAPBEAM_PINNED: return RodSupport::hinged;
    default: break;
  }
  detail::reject(end, value, "", "HAPBEAM_FREE, CLAMPED or PINNED for a rod");
}

/// A table of C, which is null where it has no rows.
template <class Row>
std::vector<Row> rows(const char* name, const Row* first, int count) {
  if (!(count >= 0 && (first || count == 0)))
    throw std::invalid_argument(std::string(name) +
                                " = null, or a negative count: must be as many as counted");
  return {first, first + count};
}

/// Size of a part's section at s, in that of the rod.   @param begin  of the part [m]
inline double size_in(const hapbeam_part& part, double begin, double s) noexcept {
  return part.from + (part.to - part.from) * (s - begin) / (part.end - begin);
}
inline double size_at(const std::vector<hapbeam_part>& parts, double s) noexcept {
  double begin = 0;
  for (const hapbeam_part& part : parts) {
    if (s < part.end || &part == &parts.back()) return size_in(part, begin, s);
    begin = part.end;
  }
  return 1;
}

/// A rod is given by its stiffness: that is its section, of a material whose moduli are 1.
inline RodSection section_of(const hapbeam_rod& r, double size) {
  const double area = size * size, inertia = area * area;
  return {r.axial_stiffness * area, r.bending_stiffness1 * inertia, r.bending_stiffness2 * inertia,
          r.torsional_stiffness * inertia, r.thickness * size};
}

inline void take_parts(Rod& rod, const hapbeam_rod& r, const std::vector<hapbeam_part>& parts) {
  std::vector<RodPart> all;
  double begin = 0;
  for (const hapbeam_part& part : parts) {
    detail::positive("part from", part.from, "");
    detail::positive("part to", part.to, "");
    all.emplace_back(part.end, [r, part, begin](double s) { return section_of(r, size_in(part, begin, s)); });
    begin = part.end;
  }
  rod = Rod(r.length, section_of(r, 1), {1, 1}, rod.left(), rod.right());
  rod.sections(std::move(all));
}

inline void take_loads(Rod& rod, const hapbeam_rod& r, const std::vector<hapbeam_part>& parts) {
  const bool heavy = detail::not_negative("density", r.density, "kg/m³") > 0;
  const double mass = heavy ? r.density * detail::positive("area", r.area, "m²") : 0;  // [kg/m]
  VectorOf<double, 3> load, weight;
  for (int k = 0; k < 3; ++k) {
    load[k] = detail::finite("load", r.load[k], "N/m");
    weight[k] = mass * detail::finite("gravity", r.gravity[k], "m/s²");
  }
  if (load.isZero(0) && weight.isZero(0)) return;
  rod.load([load, weight, parts](double s) {
    const double size = size_at(parts, s);
    return VectorOf<double, 3>(load + size * size * weight);
  });
}

inline Rod rod_of(const hapbeam_rod* r) {
  if (!r) throw std::invalid_argument("rod = null: must be a description of one");
  Rod rod(r->length,
          {r->axial_stiffness, r->bending_stiffness1, r->bending_stiffness2, r->torsional_stiffness},
          r->thickness, rod_support("left", r->left), rod_support("right", r->right));
  const auto parts = rows("parts", r->parts, r->part_count);
  if (!parts.empty()) take_parts(rod, *r, parts);
  std::vector<RodArc> arcs;
  for (const hapbeam_arc& arc : rows("arcs", r->arcs, r->arc_count))
    arcs.push_back({arc.end, arc.curvature1, arc.curvature2, arc.twist});
  if (!arcs.empty()) rod.naturally(std::move(arcs));
  take_loads(rod, *r, parts);
  return rod;
}

}  // namespace hapbeam::border
