// SPDX-License-Identifier: MIT
// What is modelled: a slender beam, its section and material, its two ends and its dead loads, which keep their direction.
//
// Plain values in SI, checked where they enter: every function here throws std::invalid_argument naming field, value, unit and what is
// allowed.  Offline only.
// x runs along the beam from its left end, w across it (up), theta = -dw/dx.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/section.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam {

/// Cross-section: area, second moment about the bending axis, and extent in the bending direction.
struct Section {
  double area;       ///< A [m²]
  double inertia;    ///< I [m⁴]
  double thickness;  ///< [m] across the beam, in the plane of bending: what the avatar touches

  /// @param width [m] out of the plane of bending   @param height [m] in it
  static Section rectangle(double width, double height) {
    const RodSection section = RodSection::rectangle(width, height);
    return {section.area, section.inertia1, height};
  }
  static Section circle(double diameter) { return of(RodSection::circle(diameter)); }
  /// @param outer_diameter [m]   @param inner_diameter [m] of the hole, not the thickness of the wall
  static Section tube(double outer_diameter, double inner_diameter) {
    return of(RodSection::tube(outer_diameter, inner_diameter));
  }

 private:
  static Section of(const RodSection& section) { return {section.area, section.inertia1, section.thickness}; }
};

/// Material of a beam.
struct Material {
  double young;          ///< Young's modulus E [Pa]
  double density = 0;    ///< [kg/m³]; 0: not known, and the beam has no mass
  Damping damping = {};  ///< of a model with mass
};

/// A force and a moment at one point of the beam.  They keep their direction as the beam turns (dead, non-follower loads).
struct PointLoad {
  double s;               ///< [m] arc position
  double axial = 0;       ///< [N] along x
  double transverse = 0;  ///< [N] along w
  double moment = 0;      ///< [N·m] does work on theta
};

/// A load per unit length as a function of arc position s [m] -> [N/m].  It keeps its direction.
using DistributedLoad = std::function<double(double)>;

/// Where a support holds its end.  A component that the support leaves free is the place of the unloaded end.
struct EndPlace {
  double u = 0;      ///< [m] from the end's place in the straight beam, along x
  double w = 0;      ///< [m]
  double theta = 0;  ///< [rad]
};

/// A part of the beam that is naturally an arc.
struct Arc {
  double end;        ///< [m] arc position at which it ends; it begins where the one before it does
  double curvature;  ///< dθ/ds [1/m] without load: positive where the beam bulges up

  bool bends_as(const Arc& other) const noexcept { return curvature == other.curvature; }
  void check() const { detail::finite("arc curvature", curvature, "1/m"); }
};

/// Damping of its material is not counted.
using BeamPart = detail::PartOf<Section, Material>;

/// A beam, its ends and its loads.  Prismatic unless sections() says otherwise, straight unless naturally() gives it a curvature, with the
/// ends of the straight beam unless place() moves them.  Immutable but for what is added to it.
class Beam : public detail::Slender<Beam, Section, Material, Arc> {
 public:
  static constexpr const char* word = "beam";

  /// @param length [m], positive
  [[gnu::cold]] Beam(double length, const Section& section, const Material& material, Support left,
                     Support right)
      : Beam(length,
             detail::positive("young", material.young, "Pa") * detail::positive("area", section.area, "m²"),
             material.young * detail::positive("inertia", section.inertia, "m⁴"), section.thickness, left,
             right) {
    build_of(material, section.area);
  }

  /// For a section known by its stiffness.
  /// @param length [m]   @param axial_stiffness EA [N]   @param bending_stiffness EI [N·m²]   @param thickness [m]
  [[gnu::cold]] Beam(double length, double axial_stiffness, double bending_stiffness, double thickness,
                     Support left, Support right)
      : Slender(length, thickness),
        axial_stiffness_(detail::positive("axial_stiffness", axial_stiffness, "N")),
        bending_stiffness_(detail::positive("bending_stiffness", bending_stiffness, "N·m²")),
        left_(left),
        right_(right) {
    detail::check_supports(left, right);
  }

  /// Adds a force and moment at one point.
  Beam& add(const PointLoad& load) {
    if (!(load.s >= 0 && load.s <= length_))
      detail::reject("point load s", load.s, "m", "on the beam, 0 to its length");
    detail::finite("point load axial", load.axial, "N");
    detail::finite("point load transverse", load.transverse, "N");
    detail::finite("point load moment", load.moment, "N·m");
    point_loads_.push_back(load);
    return *this;
  }
  /// Sets the distributed transverse load q [N/m], along w.  It must be finite on all of the beam.
  Beam& transverse(DistributedLoad q) { return transverse_ = std::move(q), specific_weight_.y() = 0, *this; }
  Beam& transverse(double q) {
    return detail::finite("transverse load", q, "N/m"), transverse([q](double) { return q; });
  }
  /// Sets the distributed axial load f [N/m], along x.
  Beam& axial(DistributedLoad f) { return axial_ = std::move(f), specific_weight_.x() = 0, *this; }
  Beam& axial(double f) {
    return detail::finite("axial load", f, "N/m"), axial([f](double) { return f; });
  }
  /// Its own weight, in place of other distributed loads; each of those that is set later replaces its part in that direction.
  /// @param density [kg/m³]   @param gravity [m/s²] direction and size, (x, w): {0, -9.81} where w points up
  Beam& weight(double density, const Vector2<double>& gravity) {
    detail::positive("density", density, "kg/m³");
    detail::all_finite("gravity", gravity, "m/s²");
    if (!area_)
      detail::reject(
          "area", 0, "m²",
          "known for a weight: a beam that is given by its stiffness has transverse() and axial()");
    transverse_ = axial_ = nullptr;
    return specific_weight_ = density * gravity, weigh(), *this;
  }

  /// Parts with sections and materials of their own, as Slender's.  Elements of Tapered<Local> take them; a FemModel of other elements rejects the beam.
  /// @throws std::invalid_argument unless the ends increase, up to the length, and the beam was built of a material
  Beam& sections(std::vector<BeamPart> parts) { return Slender::sections(std::move(parts)), weigh(), *this; }
  /// Lets it shear, as Timoshenko's: elements of Tapered<Local> take it; a FemModel of other elements rejects the beam.
  /// @param stiffness  κGA [N] of the section that it was built with; that of other sections is as their area
  Beam& shear(double stiffness) {
    return shear_stiffness_ = detail::positive("shear stiffness", stiffness, "N"), *this;
  }
  /// Places the ends: an end shortening or a stretch, an arch or an inclined beam.
  Beam& place(const EndPlace& left, const EndPlace& right) {
    for (const EndPlace* end : {&left, &right}) {
      detail::finite("end place u", end->u, "m");
      detail::finite("end place w", end->w, "m");
      detail::finite("end place theta", end->theta, "rad");
    }
    return left_place_ = left, right_place_ = right, *this;
  }

  /// Of the section that the beam was built with.
  double axial_stiffness() const noexcept { return axial_stiffness_; }      ///< EA [N]
  double bending_stiffness() const noexcept { return bending_stiffness_; }  ///< EI [N·m²]
  double shear_stiffness() const noexcept { return shear_stiffness_; }  ///< κGA [N]; 0: it does not shear
  double young() const noexcept { return young_; }  ///< E [Pa]; 0 where only the stiffness is known
  Support left() const noexcept { return left_; }
  Support right() const noexcept { return right_; }
  const std::vector<PointLoad>& point_loads() const noexcept { return point_loads_; }
  const DistributedLoad& transverse() const noexcept { return transverse_; }  ///< empty where there is none
  const DistributedLoad& axial() const noexcept { return axial_; }            ///< empty where there is none
  const EndPlace& left_place() const noexcept { return left_place_; }
  const EndPlace& right_place() const noexcept { return right_place_; }
  /// Whether EA and EI say all of its stiffness: it has one section and does not shear.
  bool uniform() const noexcept { return parts_.empty() && shear_stiffness_ == 0; }
  /// Whether it lies on the x axis, at full length, where nothing loads it.
  bool straight() const noexcept {
    const auto home = [](const EndPlace& p) { return p.u == 0 && p.w == 0 && p.theta == 0; };
    return arcs_.empty() && home(left_place_) && home(right_place_);
  }

 private:
  /// The loads that are a weight, by the sections as they are.
  void weigh() {
    const auto load = [this](double specific) -> DistributedLoad {
      return [area = area_, specific](double s) { return area(s) * specific; };
    };
    if (specific_weight_.x() != 0) axial_ = load(specific_weight_.x());
    if (specific_weight_.y() != 0) transverse_ = load(specific_weight_.y());
  }

  double axial_stiffness_, bending_stiffness_, shear_stiffness_ = 0;
  Support left_, right_;
  std::vector<PointLoad> point_loads_;
  DistributedLoad transverse_, axial_;
  Vector2<double> specific_weight_{0, 0};  // [N/m³] along x and w
  EndPlace left_place_, right_place_;
};

}  // namespace hapbeam
