// What is modelled in space: a slender rod, its section and material, its natural shape, its two ends and its dead loads.
//
//   Rod wire(0.2, RodSection::circle(0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
//   wire.weight(7850, {0, -9.81, 0});
//
// A rod bends about both axes of its section, d1 and d2, twists about its tangent d3 and stretches.  It leaves its left end
// along x with d1 along y, unless it is placed elsewhere.  What bends in one plane is shorter to write as a Beam (beam.hpp).
// Plain values in SI, checked where they enter: every function here throws std::invalid_argument naming field, value,
// unit and what is allowed.  Offline only; nothing here is called in a servo tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// Cross-section of a rod, with its principal axes along d1 and d2.
struct RodSection {
  double area;       ///< A [m²]
  double inertia1;   ///< I about d1 [m⁴]
  double inertia2;   ///< I about d2 [m⁴]
  double torsion;    ///< Saint-Venant's J [m⁴]
  double thickness;  ///< [m] diameter of the round surface that an avatar touches: the smallest extent

  /// @param width [m] along d1   @param height [m] along d2
  /// J of a × b, a >= b, is ab³/3 (1 - 192 b/(π⁵ a) Σ tanh(kπa/2b)/k⁵) over odd k: Timoshenko and Goodier, Theory of
  /// Elasticity, 109.
  static RodSection rectangle(double width, double height) {
    const double a = std::max(detail::positive("section width", width, "m"), height),
                 b = std::min(width, detail::positive("section height", height, "m"));
    double sum = 0;
    for (int k = 1; k < 200; k += 2) sum += std::tanh(k * pi * a / (2 * b)) / std::pow(k, 5);
    return {width * height, width * height * height * height / 12, height * width * width * width / 12,
            a * b * b * b / 3 * (1 - 192 * b / (std::pow(pi, 5) * a) * sum), b};
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
    return {pi * a * b, pi * a * b * b * b / 4, pi * a * a * a * b / 4,
            pi * a * a * a * b * b * b / (a * a + b * b), std::min(width, height)};
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

/// How an end of a rod is held.
enum class RodSupport {
  free,     ///< not at all
  clamped,  ///< place, direction and twist
  hinged,   ///< place: a ball joint
  cardan,  ///< place and twist: a universal joint, whose director follows the tangent by the smallest rotation
};

/// Whether the end holds the section against turning about the tangent.
constexpr bool holds_twist(RodSupport support) noexcept {
  return support == RodSupport::clamped || support == RodSupport::cardan;
}

constexpr const char* name(RodSupport support) noexcept {
  switch (support) {
    case RodSupport::free: return "free";
    case RodSupport::clamped: return "clamped";
    case RodSupport::hinged: return "hinged";
    case RodSupport::cardan: return "cardan";
  }
  return "unknown";
}

/// Where an end is, and how its section is turned.
struct RodPose {
  VectorOf<double, 3> at{0, 0, 0};     ///< [m]
  VectorOf<double, 3> along{1, 0, 0};  ///< d3: direction of the tangent, from the left end to the right one
  VectorOf<double, 3> director{0, 1, 0};  ///< d1

  /// Makes both directions unit and perpendicular.  @return false where there are none
  bool make_valid() noexcept {
    along /= std::sqrt(along.squaredNorm());
    director -= along * along.dot(director);
    director /= std::sqrt(director.squaredNorm());
    return at.allFinite() && along.allFinite() && director.allFinite();
  }
};

/// Which end.
enum class RodSide { left, right };

/// A part of the rod with a natural curvature and twist: an arc, a ring or a helix.
struct RodArc {
  double end;         ///< [m] arc position at which it ends; it begins where the one before it does
  double curvature1;  ///< [1/m] about d1: positive turns the tangent from d3 toward -d2
  double curvature2;  ///< [1/m] about d2: positive turns it toward d1
  double twist;       ///< [1/m] of d1 and d2 about d3
};

/// A dead force at one point of the rod.
struct RodForce {
  double s;                   ///< [m] arc position
  VectorOf<double, 3> force;  ///< [N]
};

/// A dead load per unit length, as a function of arc position s [m] -> [N/m].
using RodLoad = std::function<VectorOf<double, 3>(double)>;

/// A rod, its ends and its loads; straight, unless it is given a natural shape, and its right end where that shape puts it,
/// unless it is placed elsewhere.  An immutable value but for what is added to it.
class Rod {
 public:
  /// @param length [m], positive
  [[gnu::cold]] Rod(double length, const RodSection& section, const RodMaterial& material, RodSupport left,
                    RodSupport right)
      : Rod(length,
            {detail::positive("young", material.young, "Pa") * detail::positive("area", section.area, "m²"),
             material.young * detail::positive("inertia1", section.inertia1, "m⁴"),
             material.young * detail::positive("inertia2", section.inertia2, "m⁴"),
             detail::positive("shear", material.shear, "Pa") *
                 detail::positive("torsion", section.torsion, "m⁴")},
            section.thickness, left, right) {
    area_ = section.area;
  }

  /// For a section known by its stiffness.   @param length [m]   @param thickness [m]
  [[gnu::cold]] Rod(double length, const RodStiffness& stiffness, double thickness, RodSupport left,
                    RodSupport right)
      : length_(detail::positive("length", length, "m")),
        stiffness_(stiffness),
        thickness_(detail::positive("thickness", thickness, "m")),
        left_(left),
        right_(right) {
    detail::positive("axial stiffness", stiffness.axial, "N");
    detail::positive("bending1 stiffness", stiffness.bending1, "N·m²");
    detail::positive("bending2 stiffness", stiffness.bending2, "N·m²");
    detail::positive("torsion stiffness", stiffness.torsion, "N·m²");
    if (left != RodSupport::clamped && right != RodSupport::clamped &&
        (left == RodSupport::free || right == RodSupport::free))
      throw std::invalid_argument(
          std::string("supports = ") + name(left) + ", " + name(right) +
          ": the rod is a mechanism, hold the direction of one end or the place of both");
  }

  /// Gives the rod a natural shape, from the left end on; straight and without twist where the parts end.
  /// @throws std::invalid_argument unless the ends increase, within the length
  Rod& naturally(std::vector<RodArc> arcs) {
    double from = 0;
    for (const RodArc& arc : arcs) {
      if (!(arc.end > from && arc.end <= length_ * (1 + 1e-12)))
        detail::reject("arc end", arc.end, "m", "beyond the arc before it and on the rod");
      detail::finite("arc curvature1", arc.curvature1, "1/m");
      detail::finite("arc curvature2", arc.curvature2, "1/m");
      detail::finite("arc twist", arc.twist, "1/m");
      from = arc.end;
    }
    return arcs_ = std::move(arcs), *this;
  }

  /// Places the left end; the rod is laid from there.
  Rod& place_left(const RodPose& pose) { return left_pose_ = checked(pose), *this; }
  /// Places the right end elsewhere than where the natural shape has it.
  Rod& place_right(const RodPose& pose) {
    right_pose_ = checked(pose);
    return right_is_placed_ = true, *this;
  }

  /// Sets the distributed dead load [N/m]; it must be finite on all of the rod.
  Rod& load(RodLoad f) { return load_ = std::move(f), *this; }
  Rod& load(const VectorOf<double, 3>& f) {
    return finite("load", f, "N/m"), load([f](double) { return f; });
  }
  /// Its own weight.   @param density [kg/m³]   @param gravity [m/s²] direction and size
  Rod& weight(double density, const VectorOf<double, 3>& gravity) {
    detail::positive("density", density, "kg/m³");
    finite("gravity", gravity, "m/s²");
    if (!(area_ > 0))
      detail::reject("area", area_, "m²",
                     "known for a weight: a rod that is given by its stiffness has load()");
    return load(VectorOf<double, 3>(density * area_ * gravity));
  }
  Rod& add(const RodForce& force) {
    if (!(force.s >= 0 && force.s <= length_))
      detail::reject("force s", force.s, "m", "on the rod, 0 to its length");
    finite("force", force.force, "N");
    return forces_.push_back(force), *this;
  }

  double length() const noexcept { return length_; }  ///< L [m]
  const RodStiffness& stiffness() const noexcept { return stiffness_; }
  double thickness() const noexcept { return thickness_; }  ///< [m]
  RodSupport left() const noexcept { return left_; }
  RodSupport right() const noexcept { return right_; }
  const std::vector<RodArc>& arcs() const noexcept { return arcs_; }  ///< empty where naturally straight
  const RodPose& left_pose() const noexcept { return left_pose_; }
  /// Null where the natural shape places it.
  const RodPose* right_pose() const noexcept { return right_is_placed_ ? &right_pose_ : nullptr; }
  const RodLoad& load() const noexcept { return load_; }  ///< empty where there is none
  const std::vector<RodForce>& forces() const noexcept { return forces_; }
  /// Whether it has one natural shape, straight, from which nothing bends it.
  bool straight() const noexcept { return arcs_.empty() && !right_is_placed_ && !load_ && forces_.empty(); }

 private:
  static void finite(const char* field, const VectorOf<double, 3>& x, const char* unit) {
    for (int k = 0; k < 3; ++k) detail::finite(field, x[k], unit);
  }
  static RodPose checked(const RodPose& pose) {
    finite("pose at", pose.at, "m");
    finite("pose along", pose.along, "");
    finite("pose director", pose.director, "");
    detail::positive("pose along", std::sqrt(pose.along.squaredNorm()), "");
    RodPose unit = pose;
    if (!unit.make_valid())
      detail::reject("pose director", std::sqrt(pose.director.squaredNorm()), "", "across along");
    return unit;
  }

  double length_;
  RodStiffness stiffness_;
  double thickness_, area_ = 0;
  RodSupport left_, right_;
  std::vector<RodArc> arcs_;
  RodPose left_pose_, right_pose_;
  bool right_is_placed_ = false;
  RodLoad load_;
  std::vector<RodForce> forces_;
};

}  // namespace hapbeam
