// SPDX-License-Identifier: MIT
// What a section of a beam carries: normal force, shear, bending moment, torsion, and the strain that they make.
//
//   const auto cut = model.internal_forces(s);          // at arc position s, of the model's present shape
//   const auto peak = peak_strain(model);               // the largest strain anywhere, and where
//   if (peak.strain > 0.01) …                           // it breaks there
//
// A cut at s shows what the part beyond s does to the part before it.  FemModel has internal_forces(); nothing is computed
// unless it is asked for.
// Forces are those of equilibrium: an element's forces on its nodes, and between its nodes the moments of those about the
// bent centreline and of the dead loads.
// Real-time: noexcept, no allocation; a cut takes O(log n), a peak O(n).
#pragma once

#include <type_traits>

#include <hapbeam/centreline.hpp>

namespace hapbeam {

template <typename Scalar, int D = 2>
struct InternalForces {
  Scalar normal;        ///< [N] along the tangent; positive: tension
  Scalar shear;         ///< [N] across it, toward w: dM/ds
  Scalar moment;        ///< [N·m] EI (dθ/ds - natural curvature): positive where loads bend it to bulge up
  Scalar axial_strain;  ///< [-] of the centreline
  /// [-] Largest absolute strain along the fibres of the section: |ε| + |κ| thickness/2.  A beam that is given by its stiffness
  /// has the thickness that it is touched with.
  Scalar surface_strain;
};

/// In the axes of the section: d1, d2, and the tangent d3.
template <typename Scalar>
struct InternalForces<Scalar, 3> {
  Scalar normal;            ///< [N] along d3; positive: tension
  Scalar shear1, shear2;    ///< [N] along d1 and d2
  Scalar moment1, moment2;  ///< [N·m] EI (κ - natural) about d1 and d2
  Scalar torsion;           ///< [N·m] GJ (τ - natural) about d3
  Scalar axial_strain;      ///< [-] of the centreline
  /// [-] Largest absolute strain along the fibres of the section, of stretching and bending; shear of torsion is not in it.
  Scalar surface_strain;
};

template <typename Scalar>
struct PeakStrain {
  Scalar strain;  ///< [-] largest surface_strain; times Young's modulus: stress [Pa]
  Scalar s;       ///< [m] where
};

namespace detail {

template <typename M>
auto with_internal_forces(const M* m, typename M::Scalar s)
    -> std::bool_constant<noexcept(m->internal_forces(0, s))>;
template <typename>
std::false_type with_internal_forces(...);

}  // namespace detail

/// Whether a model tells what its sections carry:
///   `m.internal_forces(s) const noexcept -> InternalForces<S, D>`, and `m.internal_forces(i, s)` in piece i of m.shape(), which
///   holds s: at a node on the side of that piece
template <typename M>
inline constexpr bool has_internal_forces = decltype(detail::with_internal_forces<M>(nullptr, 0))::value;

/// Largest strain of a model's present shape.  Each piece is looked at at its ends and in its middle, and where a parabola
/// through those has its top.   O(n)
template <class Model>
PeakStrain<typename Model::Scalar> peak_strain(const Model& model) noexcept {
  static_assert(
      has_internal_forces<Model>,
      "peak_strain(model): a model with internal_forces(i, s) noexcept, see hapbeam/internal_forces.hpp");
  using Scalar = typename Model::Scalar;
  const auto line = model.shape();
  PeakStrain<Scalar> peak{-1, 0};
  for (int i = 0; i < line.segments(); ++i) {
    const Scalar a = line[i].s, l = line[i + 1].s - a;
    const auto look = [&](Scalar t) {
      const Scalar s = t < 1 ? a + t * l : line[i + 1].s;
      const Scalar strain = model.internal_forces(i, s).surface_strain;
      if (strain > peak.strain) peak = {strain, s};
      return strain;
    };
    const Scalar from = look(0), middle = look(Scalar(0.5)), to = look(1);
    const Scalar bow = from - 2 * middle + to, top = (3 * from - 4 * middle + to) / (4 * bow);
    if (bow < 0 && top > 0 && top < 1) look(top);
  }
  return peak;
}

}  // namespace hapbeam
