// SPDX-License-Identifier: MIT
// What any piece of a beam is made of: stiffness, and the shape that it has by nature.
//
// Allocates and throws at construction; all else is noexcept and allocation-free, O(parts and arcs of the beam).
#pragma once

#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/beam_profile.hpp>
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/element/element.hpp>

namespace hapbeam::detail {

template <class Element, typename Scalar>
class BeamPieces {
 public:
  /// EA [N] and EI [N·m²]
  struct Stiffness {
    Scalar axial, bending;
  };

  /// @throws std::invalid_argument where the section changes and Element does not take that
  explicit BeamPieces(const Beam& beam)
      : natural_(beam),
        profile_(beam),
        stiffness_{static_cast<Scalar>(beam.axial_stiffness()),
                   static_cast<Scalar>(beam.bending_stiffness())},
        length_(static_cast<Scalar>(beam.length())) {}

  /// An element between two places of the beam.
  ElementProperties<Scalar> between(Scalar from, Scalar to) const noexcept {
    ElementProperties<Scalar> p(to - from, stiffness_.axial, stiffness_.bending);
    if constexpr (tapers<Element>) profile_.apply(from, to - from, p);
    if (!natural_.straight()) natural_.apply(from, p);
    return p;
  }
  /// Of the section at s.
  Stiffness stiffness([[maybe_unused]] Scalar s) const noexcept {
    if constexpr (tapers<Element>) {
      const auto [EA, EI] = profile_.at(s);
      return {EA, EI};
    } else {
      return stiffness_;
    }
  }
  const NaturalShape<Scalar>& natural_shape() const noexcept { return natural_; }
  Scalar length() const noexcept { return length_; }  ///< of the beam [m]

 private:
  NaturalShape<Scalar> natural_;
  std::conditional_t<tapers<Element>, BeamProfile<Scalar>, OneSection> profile_;
  Stiffness stiffness_;
  Scalar length_;
};

}  // namespace hapbeam::detail
