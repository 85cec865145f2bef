// SPDX-License-Identifier: MIT
// The requirements of a scene in space: a rod, where and how deep it is pushed, and the tolerated error and time; and the model for it.
//
//   RodModel model = build(scene, choose(scene).model());
//   model.push({s, d, n});                           // one switch and the model's own push: nothing virtual
//
// Offline: allocates; throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/rod/rod_range.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/scene/build.hpp>
#include <hapbeam/turning_plane.hpp>

namespace hapbeam {

struct RodScene {
  Rod rod;
  double s_min, s_max;  ///< [m] where it is pushed; equal: at one place
  double
      depth;  ///< [m] how far it is pushed from where it rests, to any side; beside a support a fifth of the distance
  double force_error = 0.05;  ///< largest relative error of the force; a hand tells forces apart from 7 % on
  double force_floor = 0;  ///< [N] smaller forces count as this one, where they change sign or cannot be felt
  double tick = 50e-6;     ///< [s] largest time of a push
  bool shape = true;       ///< contact and drawing want the shape in each tick

  /// Anywhere from 5 to 95 % of the length, or up to an end that yields.
  static RodScene anywhere(const Rod& rod, double depth) {
    const double L = rod.length();
    const Range<double> range = RodRange<double>(rod).range();
    return {rod, range.s_min > 0 ? 0.05 * L : 0, range.s_max < L ? 0.95 * L : L, depth};
  }
  /// At one place.
  static RodScene at(const Rod& rod, double s, double depth) { return {rod, s, s, depth}; }

  bool one_place() const noexcept { return s_min == s_max; }

  /// How deep it is pushed at s along cos d1 + sin d2 [m].  A flat rod that is pushed askew gives way across the push: its depth is
  /// less by that, as a straight one's of even stiffness is.
  double depth_at(double s, double cosine, double sine) const noexcept {
    const Range<double> range = RodRange<double>(rod).range();
    double deep = depth;
    if (range.s_min > 0) deep = (std::min)(deep, s / 5);
    if (range.s_max < rod.length()) deep = (std::min)(deep, (rod.length() - s) / 5);
    const double x = cosine / rod.stiffness().bending2, y = sine / rod.stiffness().bending1;
    return deep * (cosine * x + sine * y) / std::hypot(x, y);
  }

  /// The same in a plane, where that is exact: turning_plane.hpp.
  std::optional<Scene> in_any_plane() const {
    try {
      const Beam beam = beam_in_any_plane(rod);
      (void)TurningPlane<FemModel<Corotational<>>>(rod, {beam, 16});  // it rests straight
      // Turned, a push by all of the depth is a press by that and its round-off.
      return Scene{beam, s_min, s_max, depth * (1 + 1e-12), force_error, force_floor, tick, shape};
    } catch (const std::invalid_argument&) {
      return {};
    }
  }

  /// @throws std::invalid_argument
  const RodScene& check() const {
    const Range<double> range = RodRange<double>(rod).range();
    detail::check_scene(*this, 0.999999 * range.s_min, range.s_max + 1e-6 * range.s_min, "rod");
    return *this;
  }
};

namespace detail {

/// Those of a scene in the plane, turned; and the rods.
template <class Planar>
struct ModelsInSpace;
template <class... Planar>
struct ModelsInSpace<AnyOf<2, Planar...>> {
  using Type = AnyOf<3, TurningPlane<Planar>..., FemModel<RoundRod>, FemModel<TwistedRod>>;
};

}  // namespace detail

/// The model that a scene in space needs, whichever it is, as one ForceModel.
using RodModel = detail::ModelsInSpace<SceneModel>::Type;

/// @throws std::invalid_argument, TrainingError
inline RodModel build(const RodScene& scene, const Candidate& candidate, int segments = 32) {
  scene.check();
  if (candidate.kinematics == Kinematics::round_rod)
    return RodModel(FemModel<RoundRod>(scene.rod, candidate.elements));
  if (candidate.kinematics == Kinematics::twisted_rod)
    return RodModel(FemModel<TwistedRod>(scene.rod, candidate.elements));
  const auto planar = scene.in_any_plane();
  if (!planar)
    detail::refuse("kinematics = %s: must be that of a rod, for this one is not the same in each plane",
                   name(candidate.kinematics));
  SceneModel model = build(*planar, candidate, segments);
  return model.visit([&](auto& chosen) {
    using Model = std::decay_t<decltype(chosen)>;
    return RodModel(TurningPlane<Model>(scene.rod, std::move(chosen)));
  });
}

}  // namespace hapbeam
