// SPDX-License-Identifier: MIT
// A stylus that touches a rod in space, for C: the rod, where it lies, and the ticks.
// Both kinds of rods in one unit: half of what they compile is the same.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "border.hpp"
#include "rod_of.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

using namespace hapbeam;
using border::created;

struct hapbeam_stylus {
  virtual ~hapbeam_stylus() = default;
  virtual hapbeam_wrench tick(const hapbeam::HandPose& hand) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual int shape(double* x_y_z, int count) noexcept = 0;
};

namespace {

/// What a stylus is made of, as C described it.
struct StylusRequest {
  const Rod& rod;
  int elements;
  double radius;  // [m]
  StylusOptions options;
  const Placement& placement;
  const Friction& friction;
};

template <class Element>
class StylusOn final : public hapbeam_stylus {
 public:
  explicit StylusOn(const StylusRequest& r)
      : model_(r.rod, r.elements), touch_(model_, r.radius, r.placement, r.options, r.friction) {}

  hapbeam_wrench tick(const HandPose& hand) noexcept override {
    const Wrench on_hand = touch_.tick(hand);
    const auto& felt = touch_.felt();
    const Eigen::Vector3d friction = touch_.placement().device_force(felt.friction);
    return {{on_hand.force[0], on_hand.force[1], on_hand.force[2]},
            {on_hand.torque[0], on_hand.torque[1], on_hand.torque[2]},
            {friction[0], friction[1], friction[2]},
            felt.press.s,
            felt.dissipated,
            felt.pressing,
            felt.sliding,
            static_cast<int>(felt.status)};
  }
  void reset() noexcept override { touch_.reset(); }
  int shape(double* x_y_z, int count) noexcept override {
    const auto line = model_.shape();
    for (int i = 0; i < count; ++i) {
      const double s = (std::min)(line.length() * i / (count - 1), line.length());
      const Eigen::Vector3d at = touch_.placement().device_position(detail::in_scene(line.position(s)));
      std::copy(at.data(), at.data() + 3, x_y_z + 3 * i);
    }
    return count;
  }

 private:
  FemModel<Element> model_;
  PlacedTouch<FemModel<Element>> touch_;
};

template <class Element>
std::unique_ptr<hapbeam_stylus> stylus_on(const StylusRequest& request) {
  return std::make_unique<StylusOn<Element>>(request);
}

hapbeam_rod described(const RodSection& section, double length, double young, double shear, int left,
                      int right) noexcept {
  hapbeam_rod rod{};
  rod.length = length;
  rod.axial_stiffness = young * section.area;
  rod.bending_stiffness1 = young * section.inertia1, rod.bending_stiffness2 = young * section.inertia2;
  rod.torsional_stiffness = shear * section.torsion;
  rod.thickness = section.thickness, rod.area = section.area;
  rod.left = left, rod.right = right;
  return rod;
}

constexpr double pi = 3.141592653589793;

VectorOf<double, 3> vector(const double* v) { return {v[0], v[1], v[2]}; }

Eigen::Matrix3d matrix(const double* rows) noexcept {
  Eigen::Matrix3d m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = rows[i];
  return m;
}

Placement placement_of(const hapbeam_placement* p) {
  if (!p) return {};
  return Placement(matrix(p->rotation), vector(p->origin), p->scale);
}

}  // namespace

// Not RodSection's own, which throws: what is wrong with a size is said when it is used.
hapbeam_rod hapbeam_wire(double length, double diameter, double young, double shear, int left, int right) {
  const double area = pi * diameter * diameter / 4, inertia = area * diameter * diameter / 16;
  return described({area, inertia, inertia, 2 * inertia, diameter}, length, young, shear, left, right);
}

hapbeam_rod hapbeam_bar(double length, double width, double height, double young, double shear, int left,
                        int right) {
  const bool sizes = std::isfinite(width) && width > 0 && std::isfinite(height) && height > 0;
  const RodSection section =
      sizes ? RodSection::rectangle(width, height) : RodSection{0, 0, 0, 0, width > 0 ? height : width};
  return described(section, length, young, shear, left, right);
}

hapbeam_rod hapbeam_tube(double length, double outer, double inner, double young, double shear, int left,
                         int right) {
  const double area = pi * outer * outer / 4, hole = inner >= 0 ? pi * inner * inner / 4 : std::nan("");
  const double inertia = (area * outer * outer - hole * inner * inner) / 16;
  return described({area - hole, inertia, inertia, 2 * inertia, outer}, length, young, shear, left, right);
}

hapbeam_placement hapbeam_placement_at(double x, double y, double z, double scale) {
  return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {x, y, z}, scale};
}

hapbeam_stylus* hapbeam_stylus_create(const hapbeam_rod* rod, int kinematics, int elements, double radius,
                                      double length, double ahead, const hapbeam_friction* friction,
                                      const hapbeam_placement* placement, char* message) {
  return created(message, [&] {
    if (!(elements >= 2 && elements <= 4096)) detail::reject("elements", elements, "", "2 to 4096");
    const Rod touched = border::rod_of(rod);
    const Placement placed = placement_of(placement);
    const Friction rough = border::friction_of(friction);
    const StylusRequest request{touched, elements, radius, {length, ahead}, placed, rough};
    switch (kinematics) {
      case HAPBEAM_ROUND_ROD: return stylus_on<RoundRod>(request);
      case HAPBEAM_TWISTED_ROD: return stylus_on<TwistedRod>(request);
      default: break;
    }
    detail::reject("kinematics", kinematics, "", "HAPBEAM_ROUND_ROD or TWISTED_ROD");
  });
}

void hapbeam_stylus_destroy(hapbeam_stylus* stylus) { delete stylus; }

hapbeam_wrench hapbeam_stylus_tick(hapbeam_stylus* stylus, const double position[3],
                                   const double orientation[9]) {
  hapbeam_wrench nothing{};
  nothing.status = HAPBEAM_INVALID_REQUEST;
  if (!stylus || !position || !orientation) return nothing;
  return stylus->tick({vector(position), matrix(orientation)});
}

void hapbeam_stylus_reset(hapbeam_stylus* stylus) {
  if (stylus) stylus->reset();
}

int hapbeam_stylus_shape(hapbeam_stylus* stylus, double* x_y_z, int count) {
  return stylus && x_y_z && count >= 2 ? stylus->shape(x_y_z, count) : 0;
}
