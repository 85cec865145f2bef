// SPDX-License-Identifier: MIT
// What any piece of a beam is made of: stiffness, and the shape that it has by nature.
//
// Allocates and throws at construction; all else is noexcept and allocation-free, O(parts and arcs of the beam).
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/body/rod_profile.hpp>
#include <hapbeam/element/element.hpp>

namespace hapbeam {

/// Stiffness of a beam whose section changes along it, or that shears.  An element carries a moment that is linear between its ends, and one normal
/// force.  Its flexibility against end moments is
///
///   F = l ∫ (m mᵀ/EI + m' m'ᵀ/κGA) dξ,   m = (ξ - 1, ξ),   m' = (1, 1)/l,   l/EA the mean of 1/EA,
///
/// by three Gauss points on each piece of a part. Its stiffness is F⁻¹: without an axial load the nodes are exact.
/// Source: shear, Timoshenko, Phil. Mag. 41 (1921); Przemieniecki, Theory of Matrix Structural Analysis, 5.6.
template <typename Scalar>
class BeamProfile {
 public:
  /// @throws std::invalid_argument where a section of the beam makes no sense
  [[gnu::cold]] explicit BeamProfile(const Beam& beam)
      : profile_(as_rod(beam)),
        shears_(beam.shear_stiffness() > 0 ? beam.axial_stiffness() / beam.shear_stiffness() : 0) {
    for (const BeamPart& part : beam.parts()) ends_.push_back(part.end);
    if (ends_.empty()) ends_.push_back(beam.length());
  }

  /// EA [N] and EI [N·m²] at s [m].
  std::pair<Scalar, Scalar> at(Scalar s) const noexcept {
    const RodStiffness k = profile_.at(s);
    return {static_cast<Scalar>(k.axial), static_cast<Scalar>(k.bending1)};
  }

  /// Gives the element from s [m] on its stiffness.   @param length [m]   @param p  overwritten
  void apply(Scalar s, Scalar length, ElementProperties<Scalar>& p) const noexcept {
    const double from = s, l = length;
    double stretching = 0, f11 = 0, f12 = 0, f22 = 0, begin = from;
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const double end = k + 1 < ends_.size() ? (std::min)(ends_[k], from + l) : from + l;
      if (!(end > begin)) continue;
      for (int g = 0; g < 3; ++g) {
        const double at = begin + detail::three_points.x[g] * (end - begin), x = (at - from) / l,
                     weight = detail::three_points.weight[g] * (end - begin) / l;
        const RodStiffness here = profile_.at(at);
        const double bends = weight / here.bending1, stretches = weight / here.axial,
                     shears = shears_ * stretches / (l * l);
        stretching += stretches;
        f11 += bends * (1 - x) * (1 - x) + shears, f22 += bends * x * x + shears;
        f12 -= bends * x * (1 - x) - shears;
      }
      begin = end;
    }
    const double scale = 1 / (l * l * l * (f11 * f22 - f12 * f12)), k11 = scale * f22, k12 = -scale * f12,
                 k22 = scale * f11, one = (k11 + k12 + k22) / 10;
    p = ElementProperties<Scalar>(length, static_cast<Scalar>(1 / stretching),
                                  static_cast<Scalar>(one * l * l * l));
    p.taper11 = static_cast<Scalar>(k11 - 4 * one);
    p.taper12 = static_cast<Scalar>(k12 - 2 * one);
    p.taper22 = static_cast<Scalar>(k22 - 4 * one);
  }

 private:
  /// A rod with the beam's EA and EI along it. Its twist is asked by nobody.
  static Rod as_rod(const Beam& beam) {
    const RodStiffness one{beam.axial_stiffness(), beam.bending_stiffness(), beam.bending_stiffness(),
                           beam.bending_stiffness()};
    if (beam.parts().empty())
      return Rod(beam.length(), one, beam.thickness(), RodSupport::clamped, RodSupport::clamped);
    const auto in_space = [](const Section& section) {
      return RodSection{section.area, section.inertia, section.inertia, section.inertia, section.thickness};
    };
    std::vector<RodPart> parts;
    for (const BeamPart& part : beam.parts()) {
      const double young = part.material ? part.material->young : beam.young();
      parts.emplace_back(
          part.end, [section = part.section, in_space](double s) { return in_space(section(s)); },
          RodMaterial{young, young});
    }
    Rod rod(beam.length(), in_space(beam.parts().front().section(0)), RodMaterial{beam.young(), beam.young()},
            RodSupport::clamped, RodSupport::clamped);
    return rod.sections(std::move(parts));
  }

  RodProfile<double> profile_;
  double shears_;  // EA/κGA; 0: it does not
  std::vector<double> ends_;
};

namespace detail {

/// In its place where the element has one section.
struct OneSection {
  /// @throws std::invalid_argument where the section changes, or the beam shears
  [[gnu::cold]] explicit OneSection(const Beam& beam) {
    constexpr const char* allowed = "none, unless the elements are Tapered<> or Corotational<Tapered<>>";
    if (!beam.parts().empty()) reject("beam sections", static_cast<double>(beam.parts().size()), "", allowed);
    if (!beam.uniform()) reject("beam shear stiffness", beam.shear_stiffness(), "N", allowed);
  }
};

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

}  // namespace detail

}  // namespace hapbeam
