// SPDX-License-Identifier: MIT
// What a rod is made of at one place: its section and its material.
//
// Plain values in SI, checked where they enter: std::invalid_argument names field, value, unit and what is allowed.  Offline only.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/check.hpp>

namespace hapbeam {

/// Cross-section of a rod, with its principal axes along d1 and d2.
struct RodSection {
  double area;       ///< A [m²]
  double inertia1;   ///< I about d1 [m⁴]
  double inertia2;   ///< I about d2 [m⁴]
  double torsion;    ///< Saint-Venant's J [m⁴]
  double thickness;  ///< [m] diameter of the round surface that an avatar touches: the smallest extent
  /// What is strained at the surface; 0: as far as the thickness.
  double width = 0;      ///< [m] extent along d1
  double height = 0;     ///< [m] extent along d2
  bool corners = false;  ///< whether both extents meet: a rectangle

  /// @param width [m] along d1   @param height [m] along d2
  /// J of a × b, a >= b, is ab³/3 (1 - 192 b/(π⁵ a) Σ tanh(kπa/2b)/k⁵) over odd k: Timoshenko and Goodier, Theory of
  /// Elasticity, 109.
  static RodSection rectangle(double width, double height) {
    const double a = (std::max)(detail::positive("section width", width, "m"), height),
                 b = (std::min)(width, detail::positive("section height", height, "m"));
    double sum = 0;
    for (int k = 1; k < 200; k += 2) sum += std::tanh(k * pi * a / (2 * b)) / std::pow(k, 5);
    return {width * height,
            width * height * height * height / 12,
            height * width * width * width / 12,
            a * b * b * b / 3 * (1 - 192 * b / (std::pow(pi, 5) * a) * sum),
            b,
            width,
            height,
            true};
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
    return {pi * a * b,
            pi * a * b * b * b / 4,
            pi * a * a * a * b / 4,
            pi * a * a * a * b * b * b / (a * a + b * b),
            (std::min)(width, height),
            width,
            height};
  }

 private:
  static constexpr double pi = 3.141592653589793238462643;
};

/// Linear elastic material.
struct RodMaterial {
  double young;  ///< Young's modulus E [Pa]
  double shear;  ///< shear modulus G [Pa]

  /// @param poisson  ν, more than -1 and at most 0.5; G = E/(2 (1 + ν))
  static RodMaterial isotropic(double young, double poisson) {
    if (!(poisson > -1 && poisson <= 0.5))
      detail::reject("poisson", poisson, "", "more than -1 and at most 0.5");
    return {young, young / (2 * (1 + poisson))};
  }
};

/// Stiffness of a section.
struct RodStiffness {
  double axial;     ///< EA [N]
  double bending1;  ///< EI about d1 [N·m²]
  double bending2;  ///< EI about d2 [N·m²]
  double torsion;   ///< GJ [N·m²]
};

}  // namespace hapbeam
