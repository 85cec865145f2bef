// SPDX-License-Identifier: MIT
// What is modelled in space: a slender rod, its section and material, its natural shape, its two ends, its bed and its dead loads.
//
//   Rod wire(0.2, RodSection::circle(0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
//   wire.weight(7850, {0, -9.81, 0});
//
// A rod bends about both axes of its section, d1 and d2, twists about its tangent d3 and stretches.  It leaves its left end
// along x with d1 along y, unless it is placed elsewhere.  What bends in one plane is shorter to write as a Beam (beam.hpp).
// Plain values in SI, checked where they enter: every function here throws std::invalid_argument naming field, value,
// unit and what is allowed.  Offline only.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/section.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam {

/// A part of the rod with a natural curvature and twist: an arc, a ring or a helix.
struct RodArc {
  double end;         ///< [m] arc position at which it ends; it begins where the one before it does
  double curvature1;  ///< [1/m] about d1: positive turns the tangent from d3 toward -d2
  double curvature2;  ///< [1/m] about d2: positive turns it toward d1
  double twist;       ///< [1/m] of d1 and d2 about d3

  bool bends_as(const RodArc& other) const noexcept {
    return curvature1 == other.curvature1 && curvature2 == other.curvature2 && twist == other.twist;
  }
  void check() const {
    detail::finite("arc curvature1", curvature1, "1/m");
    detail::finite("arc curvature2", curvature2, "1/m");
    detail::finite("arc twist", twist, "1/m");
  }
};

/// A part of the rod with a section of its own, which may change along it, and a material: a taper, a step, a soft tip.
using RodPart = detail::PartOf<RodSection, RodMaterial>;

/// Springs along a part of the rod that pull each point back to where it is in the natural shape: a needle in tissue.
struct RodFoundation {
  double from, to;  ///< [m] arc positions
  double across;    ///< [N/m²] force per length and displacement, across the natural tangent
  double along;     ///< [N/m²] along it
};

/// A dead force and a moment at one point of the rod.
struct RodForce {
  double s;                             ///< [m] arc position
  VectorOf<double, 3> force;            ///< [N]
  VectorOf<double, 3> moment{0, 0, 0};  ///< [N·m] has a potential: fem/rod/rod_moments.hpp
};

/// A dead load per unit length, as a function of arc position s [m] -> [N/m].
using RodLoad = std::function<VectorOf<double, 3>(double)>;

/// Extents of a section along both axes, for the strain at its surface.
struct RodOutline {
  double width, height;  ///< [m] along d1 and d2
  bool corners;          ///< whether both extents meet: a rectangle
};

/// A rod, its ends and its loads, which a World's joints may hold where the ends do not.  It is straight unless it is given a natural
/// shape, and its right end is where that shape puts it unless it is placed elsewhere.  Immutable but for what is added to it.
class Rod : public detail::Slender<Rod, RodSection, RodMaterial, RodArc> {
 public:
  static constexpr const char* word = "rod";

  /// @param length [m], positive
  [[gnu::cold]] Rod(double length, const RodSection& section, const RodMaterial& material,
                    const RodSupport& left, const RodSupport& right)
      : Rod(length, stiffness(section, material), section.thickness, left, right) {
    material_ = material;
    outline_ = {section.width > 0 ? section.width : thickness_,
                section.height > 0 ? section.height : thickness_, section.corners};
    build_of(material, section.area);
  }

  /// For a section known by its stiffness.   @param length [m]   @param thickness [m]
  [[gnu::cold]] Rod(double length, const RodStiffness& stiffness, double thickness, const RodSupport& left,
                    const RodSupport& right)
      : Slender(length, thickness),
        stiffness_(stiffness),
        outline_{thickness, thickness, false},
        left_(left),
        right_(right) {
    detail::positive("axial stiffness", stiffness.axial, "N");
    detail::positive("bending1 stiffness", stiffness.bending1, "N·m²");
    detail::positive("bending2 stiffness", stiffness.bending2, "N·m²");
    detail::positive("torsion stiffness", stiffness.torsion, "N·m²");
  }

  /// Lays a part of the rod in an elastic foundation.
  Rod& add(const RodFoundation& foundation) {
    if (!(foundation.from >= 0 && foundation.from < length_))
      detail::reject("foundation from", foundation.from, "m", "on the rod, 0 to its length");
    if (!(foundation.to > foundation.from && foundation.to <= length_ * (1 + 1e-12)))
      detail::reject("foundation to", foundation.to, "m", "beyond where it begins and on the rod");
    detail::not_negative("foundation across", foundation.across, "N/m²");
    detail::not_negative("foundation along", foundation.along, "N/m²");
    return foundations_.push_back(foundation), *this;
  }

  /// Places the left end; the rod begins there.
  Rod& place_left(const RodPose& pose) { return left_pose_ = checked(pose), *this; }
  /// Places the right end, elsewhere than where the natural shape has it.
  Rod& place_right(const RodPose& pose) { return right_pose_ = checked(pose), *this; }

  /// The distributed dead load [N/m]; it must be finite on all of the rod.
  Rod& load(RodLoad f) { return load_ = std::move(f), specific_weight_.setZero(), *this; }
  Rod& load(const VectorOf<double, 3>& f) {
    return detail::all_finite("load", f, "N/m"), load([f](double) { return f; });
  }
  /// Its own weight, in place of another distributed load.   @param density [kg/m³]   @param gravity [m/s²] direction and size
  Rod& weight(double density, const VectorOf<double, 3>& gravity) {
    detail::positive("density", density, "kg/m³");
    detail::all_finite("gravity", gravity, "m/s²");
    if (!area_)
      detail::reject("area", 0, "m²", "known for a weight: a rod that is given by its stiffness has load()");
    return specific_weight_ = density * gravity, load_ = nullptr, *this;
  }
  Rod& add(const RodForce& force) {
    if (!(force.s >= 0 && force.s <= length_))
      detail::reject("force s", force.s, "m", "on the rod, 0 to its length");
    detail::all_finite("force", force.force, "N");
    detail::all_finite("moment", force.moment, "N·m");
    return forces_.push_back(force), *this;
  }

  /// A joint of a World holds it there.   @param turns  also against turns
  Rod& join(double s, bool turns = false) {
    joined_ = true, welded_ = welded_ || turns;
    return add(RodForce{s, {0, 0, 0}});
  }

  const RodStiffness& stiffness() const noexcept { return stiffness_; }
  /// Of the section that it was built with; a rod that is given by its stiffness has a round one of its thickness.
  const RodOutline& outline() const noexcept { return outline_; }
  /// Whether its ends hold it.
  bool held() const noexcept { return detail::hold_rod(left_, right_); }
  /// @throws std::invalid_argument unless they do
  void check_held() const { detail::check_supports(left_, right_); }
  /// Whether its ends resist a turn of its section about the tangent.
  bool holds_own_twist() const noexcept {
    return hapbeam::holds_twist(left_) || hapbeam::holds_twist(right_);
  }
  /// Whether they or joints do.
  bool holds_twist() const noexcept { return welded_ || holds_own_twist(); }
  /// Whether ends or joints may draw it taut.
  bool drawn() const noexcept { return joined_ || (left_.along > 0 && right_.along > 0); }
  const RodSupport& left() const noexcept { return left_; }
  const RodSupport& right() const noexcept { return right_; }
  /// That of a part at s [m].   @throws std::invalid_argument where it makes no sense
  RodStiffness stiffness(const RodPart& part, double s) const {
    return stiffness(part.section(s), part.material.value_or(material_));
  }
  const std::vector<RodFoundation>& foundations() const noexcept { return foundations_; }
  const RodPose& left_pose() const noexcept { return left_pose_; }
  /// ρ I_p [kg·m] of a section that turns about the tangent; 0 where the density is not known.
  double spin_per_length(double s) const {
    const RodPart* const part = part_at(parts_, s);
    const RodStiffness k = part ? stiffness(*part, s) : stiffness_;
    return mass_per_length(s) * (k.bending1 + k.bending2) / k.axial;
  }
  /// Null where the natural shape places it.
  const RodPose* right_pose() const noexcept { return right_pose_ ? &*right_pose_ : nullptr; }
  RodLoad load() const {
    if (specific_weight_.isZero(0)) return load_;
    return
        [area = area_, weight = specific_weight_](double s) { return VectorOf<double, 3>(area(s) * weight); };
  }
  const std::vector<RodForce>& forces() const noexcept { return forces_; }
  /// Whether it has one natural shape, straight, from which nothing bends it.
  bool straight() const noexcept {
    return arcs_.empty() && !right_pose_ && !load_ && specific_weight_.isZero(0) && forces_.empty();
  }

 private:
  static RodStiffness stiffness(const RodSection& section, const RodMaterial& material) {
    return {
        detail::positive("young", material.young, "Pa") * detail::positive("area", section.area, "m²"),
        material.young * detail::positive("inertia1", section.inertia1, "m⁴"),
        material.young * detail::positive("inertia2", section.inertia2, "m⁴"),
        detail::positive("shear", material.shear, "Pa") * detail::positive("torsion", section.torsion, "m⁴")};
  }
  static RodPose checked(const RodPose& pose) {
    detail::all_finite("pose at", pose.at, "m");
    detail::all_finite("pose along", pose.along, "");
    detail::all_finite("pose director", pose.director, "");
    detail::positive("pose along", std::sqrt(pose.along.squaredNorm()), "");
    RodPose unit = pose;
    if (!unit.make_valid())
      detail::reject("pose director", std::sqrt(pose.director.squaredNorm()), "", "across along");
    return unit;
  }

  RodStiffness stiffness_;
  bool joined_ = false, welded_ = false;
  RodMaterial material_{0, 0};  // not known where the stiffness is given
  RodOutline outline_;
  RodSupport left_, right_;
  std::vector<RodFoundation> foundations_;
  RodPose left_pose_;
  std::optional<RodPose> right_pose_;  // none: where the natural shape has it
  RodLoad load_;
  VectorOf<double, 3> specific_weight_{0, 0, 0};
  std::vector<RodForce> forces_;
};

}  // namespace hapbeam
