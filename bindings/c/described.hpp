// SPDX-License-Identifier: MIT
// Beams and devices as C describes them.  Offline: std::invalid_argument names field, value, unit and what is allowed.
#pragma once

#include <stdexcept>

#include "hapbeam.h"
#include <hapbeam/beam.hpp>
#include <hapbeam/haptics/device/device_info.hpp>

namespace hapbeam::border {

inline Support support(const char* end, int value) {
  if (!(value >= HAPBEAM_FREE && value <= HAPBEAM_GUIDED))
    detail::reject(end, value, "", "HAPBEAM_FREE, CLAMPED, PINNED, ROLLER or GUIDED");
  return static_cast<Support>(value);
}

inline Beam beam_of(const hapbeam_beam* b) {
  if (!b) throw std::invalid_argument("beam = null: must be a description of one");
  Beam beam(b->length, b->axial_stiffness, b->bending_stiffness, b->thickness, support("left", b->left),
            support("right", b->right));
  if (b->transverse_load != 0) beam.transverse(b->transverse_load);
  if (b->axial_load != 0) beam.axial(b->axial_load);
  return beam;
}

inline hapbeam_beam described(double length, const Section& section, double young, int left,
                              int right) noexcept {
  return {length, young * section.area, young * section.inertia, section.thickness, 0, 0, left, right};
}

/// Of a device whose name and workspace nobody asks for.
inline DeviceInfo device_of(const hapbeam_device* d) {
  if (!d) throw std::invalid_argument("device = null: must be a description of one");
  DeviceInfo info{
      "",          {0, 0, 0}, d->peak_force, d->continuous_force, d->max_stiffness, d->position_resolution,
      d->friction, d->period, d->damping,    d->apparent_mass};
  return info.check();
}

inline hapbeam_device described(const DeviceInfo& info) noexcept {
  return {info.peak_force, info.continuous_force, info.max_stiffness, info.position_resolution,
          info.friction,   info.damping,          info.apparent_mass, info.period};
}

}  // namespace hapbeam::border
