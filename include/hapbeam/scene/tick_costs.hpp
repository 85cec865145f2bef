// SPDX-License-Identifier: MIT
// What a press of each model costs, in seconds: a line over its size.
//
// Plain data; the figures of typical() were measured on one processor (docs/benchmarks.md says which) and are meant to be
// compared with each other.  choose() takes others.
#pragma once

namespace hapbeam {

/// fixed + per_unit × size, in seconds.
struct TickCost {
  double fixed, per_unit;
  double operator()(int size) const noexcept { return fixed + per_unit * size; }
};

/// A moving hand's press, from the press of a tick before.  Finite elements: by element.  Trained models: by snapshot.
struct TickCosts {
  TickCost linear, von_karman, corotational;
  TickCost pod_force, pod_shape, galerkin_force, galerkin_shape;
  TickCost round_rod, twisted_rod;  ///< pushes of rods in space, by element

  static TickCosts typical() noexcept {
    return {{170e-9, 70e-9},   {205e-9, 100e-9},  {300e-9, 207e-9},  {50e-9, 0.4e-9},   {190e-9, 0.77e-9},
            {178e-9, 0.58e-9}, {310e-9, 1.13e-9}, {1500e-9, 630e-9}, {2000e-9, 1250e-9}};
  }
};

}  // namespace hapbeam
