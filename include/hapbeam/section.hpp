// SPDX-License-Identifier: MIT
// What a rod is made of, its section and its material; and what a beam and a rod have alike: both may change along it, and its natural shape.
//
// Plain values in SI, checked where they enter: std::invalid_argument names field, value, unit and what is allowed.  Offline only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>

namespace hapbeam {

/// A branch of a material that relaxes: strained at once it is stiffer by g E, which goes as exp(-t/τ).
struct Relaxation {
  double share = 0;  ///< g, not negative; 0: none
  double time = 1;   ///< τ [s], positive
};

/// What a beam or rod that moves loses, in its material and in the air: σ = E (ε + τ ε') + the branches', and a force of α m v.
/// A model without mass has no time, and none of this.
struct Damping {
  double viscosity = 0;                     ///< τ [s], not negative
  double drag = 0;                          ///< α [1/s], not negative
  std::array<Relaxation, 4> branches = {};  ///< of a Prony series; E is what is left when all have relaxed

  /// Of the material, with a damping ratio at a frequency [Hz], and ratios that rise with it.
  static Damping ratio(double ratio, double frequency) {
    return {detail::not_negative("damping ratio", ratio, "") / (pi * of(frequency)), 0, {}};
  }
  /// The same by its loss factor η = 2 ζ.
  static Damping loss_factor(double factor, double frequency) { return ratio(factor / 2, frequency); }
  /// Of the air, with ratios that fall as frequencies rise.
  static Damping air(double ratio, double frequency) {
    return {0, detail::not_negative("damping ratio", ratio, "") * 4 * pi * of(frequency), {}};
  }
  bool viscous() const noexcept {
    return viscosity > 0 ||
           std::any_of(branches.begin(), branches.end(), [](const Relaxation& b) { return b.share > 0; });
  }
  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const Damping& check() const {
    detail::not_negative("damping viscosity", viscosity, "s");
    detail::not_negative("damping drag", drag, "1/s");
    for (const Relaxation& branch : branches) {
      detail::not_negative("relaxation share", branch.share, "");
      detail::positive("relaxation time", branch.time, "s");
    }
    return *this;
  }

 private:
  static constexpr double pi = 3.14159265358979323846;
  static double of(double frequency) { return detail::positive("damping frequency", frequency, "Hz"); }
};

/// Cross-section of a rod, with its principal axes along d1 and d2.
struct RodSection {
  double area;       ///< A [m²]
  double inertia1;   ///< I about d1 [m⁴]
  double inertia2;   ///< I about d2 [m⁴]
  double torsion;    ///< Saint-Venant's J [m⁴]
  double thickness;  ///< [m] diameter of the round surface that an avatar touches: the smallest extent
  /// For the strain at the surface; 0: the thickness.
  double width = 0;      ///< [m] extent along d1
  double height = 0;     ///< [m] extent along d2
  bool corners = false;  ///< whether both extents meet: a rectangle

  /// @param width [m] along d1   @param height [m] along d2
  /// J of a × b, a >= b, is ab³/3 (1 - 192 b/(π⁵ a) Σ tanh(kπa/2b)/k⁵) over odd k: Timoshenko and Goodier, Theory of Elasticity, 109.
  static RodSection rectangle(double width, double height) {
    const double a = (std::max)(detail::positive("section width", width, "m"), height),
                 b = (std::min)(width, detail::positive("section height", height, "m"));
    double sum = 0;
    for (int k = 1; k < 200; k += 2) sum += std::tanh(k * pi * a / (2 * b)) / std::pow(k, 5);
    const double area = width * height,
                 torsion = a * b * b * b / 3 * (1 - 192 * b / (std::pow(pi, 5) * a) * sum);
    return {area, area * height * height / 12, area * width * width / 12, torsion, b, width, height, true};
  }
  static RodSection circle(double diameter) {
    return ellipse(detail::positive("section diameter", diameter, "m"), diameter);
  }
  static RodSection tube(double outer_diameter, double inner_diameter) {
    RodSection tube = circle(detail::positive("section outer_diameter", outer_diameter, "m"));
    detail::positive("section inner_diameter", inner_diameter, "m");
    if (!(inner_diameter < outer_diameter))
      detail::reject("section inner_diameter", inner_diameter, "m", "less than outer_diameter");
    const RodSection hole = circle(inner_diameter);
    tube.area -= hole.area, tube.inertia1 -= hole.inertia1, tube.inertia2 -= hole.inertia2;
    return tube.torsion -= hole.torsion, tube;
  }
  /// @param width [m] diameter along d1   @param height [m] along d2.   J = πa³b³/(a² + b²), Timoshenko and Goodier, 107
  static RodSection ellipse(double width, double height) {
    const double a = detail::positive("section width", width, "m") / 2,
                 b = detail::positive("section height", height, "m") / 2;
    const double area = pi * a * b, torsion = area * a * a * b * b / (a * a + b * b);
    return {area, area * b * b / 4, area * a * a / 4, torsion, (std::min)(width, height), width, height};
  }

 private:
  static constexpr double pi = 3.141592653589793238462643;
};

/// Linear elastic material of a rod.
struct RodMaterial {
  double young;          ///< Young's modulus E [Pa]
  double shear;          ///< shear modulus G [Pa]
  double density = 0;    ///< [kg/m³]; 0: not known, and the rod has no mass
  Damping damping = {};  ///< of a model with mass; viscous ones are of TwistedRod

  /// @param poisson  ν, more than -1 and at most 0.5; G = E/(2 (1 + ν))
  static RodMaterial isotropic(double young, double poisson, double density = 0) {
    if (!(poisson > -1 && poisson <= 0.5))
      detail::reject("poisson", poisson, "", "more than -1 and at most 0.5");
    return {young, young / (2 * (1 + poisson)), density, {}};
  }
};

struct RodStiffness {
  double axial;     ///< EA [N]
  double bending1;  ///< EI about d1 [N·m²]
  double bending2;  ///< EI about d2 [N·m²]
  double torsion;   ///< GJ [N·m²]
};

namespace detail {

/// A part with a section of its own, which may change along it, and a material: a taper, a step, a soft tip.
template <class SectionType, class MaterialType>
struct PartOf {
  double end;                                  ///< [m] arc position at which it ends
  std::function<SectionType(double)> section;  ///< by arc position s [m]; smooth within the part
  std::optional<MaterialType> material;        ///< moduli and density; none: that of the whole

  PartOf(double part_end, std::function<SectionType(double)> by_s,
         const std::optional<MaterialType>& of = std::nullopt)
      : end(part_end), section(std::move(by_s)), material(of) {}
  PartOf(double part_end, const SectionType& same, const std::optional<MaterialType>& of = std::nullopt)
      : PartOf(
            part_end, [same](double) { return same; }, of) {}
};

/// Which one of some parts in a row holds s; the first or last one where it lies off them.
template <class Parts, typename Scalar>
std::size_t part_with(const Parts& parts, Scalar s) noexcept {
  std::size_t k = 0;
  while (k + 1 < parts.size() && parts[k].end <= s) ++k;
  return k;
}

/// What a Beam and a Rod have alike.
/// @tparam Body  the one or the other, with its word for itself   @tparam Arc  a part of the natural shape, with check()
template <class Body, class SectionType, class MaterialType, class Arc>
class Slender {
 public:
  using Part = PartOf<SectionType, MaterialType>;

  /// Gives it a natural shape of arcs, from the left end on; straight and without twist where they end.
  /// @throws std::invalid_argument unless the ends increase, within the length
  Body& naturally(std::vector<Arc> arcs) {
    check_order("arc", arcs);
    for (const Arc& arc : arcs) arc.check();
    return arcs_ = std::move(arcs), body();
  }
  /// [kg/m] at arc position s; 0 where the density is not known.
  double mass_per_length(double s) const {
    const Part* const part = part_at(parts_, s);
    const double density = part && part->material ? part->material->density : density_;
    return density > 0 ? density * area_(s) : 0;
  }
  /// Gives parts of it sections and materials of their own, from the left end on: a taper or steps.  For contact and surface strain it keeps
  /// the thickness that it was built with.
  /// @throws std::invalid_argument unless the ends increase, up to the length, and it was built of a material
  Body& sections(std::vector<Part> parts) {
    if (!(young_ > 0))
      refuse("young = %g Pa: must be known for sections: build the %s of a section and a material", young_,
             Body::word);
    const double last = check_order("part", parts);
    if (!(last >= length_ * (1 - 1e-12)))
      refuse("part end = %g m: must be the %s's length for the last part", last, Body::word);
    for (const Part& part : parts)
      if (part.material) not_negative("part density", part.material->density, "kg/m³");
    parts_ = std::move(parts);
    area_ = [parts = parts_](double s) { return part_at(parts, s)->section(s).area; };
    return body();
  }
  /// The same with one section that changes along all of it.
  Body& section(std::function<SectionType(double)> by_s) {
    return body().sections({Part(length_, std::move(by_s))});
  }

  /// Of its material and of the air.
  const Damping& damping() const noexcept { return damping_; }
  double length() const noexcept { return length_; }                  ///< L [m]
  double thickness() const noexcept { return thickness_; }            ///< [m]
  const std::vector<Part>& parts() const noexcept { return parts_; }  ///< empty where prismatic
  const std::vector<Arc>& arcs() const noexcept { return arcs_; }     ///< empty where naturally straight

 protected:
  Slender(double length, double thickness)
      : length_(positive("length", length, "m")), thickness_(positive("thickness", thickness, "m")) {}
  /// Keeps what it was built of.
  void build_of(const MaterialType& material, double area) {
    young_ = material.young;
    density_ = not_negative("density", material.density, "kg/m³");
    damping_ = material.damping.check();
    area_ = [area](double) { return area; };
  }

  /// That which holds s [m], null where there are none.
  static const Part* part_at(const std::vector<Part>& parts, double s) noexcept {
    return parts.empty() ? nullptr : &parts[part_with(parts, s)];
  }

  double length_, thickness_, young_ = 0, density_ = 0;
  Damping damping_;
  std::function<double(double)> area_;  // empty where only the stiffness is known
  std::vector<Arc> arcs_;
  std::vector<Part> parts_;

 private:
  Body& body() noexcept { return static_cast<Body&>(*this); }
  /// @return where the last one ends
  template <class Parts>
  double check_order(const char* what, const Parts& parts) const {
    double from = 0;
    for (const auto& part : parts) {
      if (!(part.end > from && part.end <= length_ * (1 + 1e-12)))
        refuse("%s end = %g m: must be beyond the %s before it and on the %s", what, part.end, what,
               Body::word);
      from = part.end;
    }
    return from;
  }
};

}  // namespace detail
}  // namespace hapbeam
