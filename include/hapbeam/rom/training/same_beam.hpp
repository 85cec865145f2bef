// SPDX-License-Identifier: MIT
// Whether a full model and a trained model are of the same beam: their data and their forces are compared.
//
// Offline: allocates; throws std::invalid_argument.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam::detail {

template <class Model, typename = void>
inline constexpr bool is_finite_elements = false;
template <class Model>
inline constexpr bool is_finite_elements<
    Model, std::void_t<typename Model::ElementType, decltype(std::declval<const Model&>().elements())>> =
    true;

/// Compares length and thickness of any ForceModel. With finite elements, which can be rebuilt for the beam, forces are
/// compared as well. A difference in stiffness, ends, dead loads or natural shape changes the force.
/// @throws std::invalid_argument
template <class Model>
void check_same_beam(const Beam& beam, const Model& full, const TrainingPlan& plan) {
  using S = typename Model::Scalar;
  const auto compare = [](const char* what, double found, double wanted) {
    if (std::abs(found - wanted) > 1e-6 * wanted)
      reject(what, found, "m", "that of the beam that is trained");
  };
  compare("length of the full model", static_cast<double>(full.shape().length()), beam.length());
  compare("thickness of the full model", static_cast<double>(full.thickness()), beam.thickness());
  if constexpr (is_finite_elements<Model>) {
    Model given(full);
    FemModel<typename Model::ElementType, S> own(beam, full.elements());
    const double s = (plan.s_min + plan.s_max) / 2;
    double off = 0, size = 0;
    for (const double d : {plan.depth, -plan.depth, plan.depth / 10}) {
      const Press<S> press{static_cast<S>(s), static_cast<S>(d)};
      given.reset(), own.reset();
      const Response<S> a = given.press(press), b = own.press(press);
      if (a.status != Status::ok || b.status != Status::ok) continue;
      off = (std::max)(off, std::abs(static_cast<double>(a.force) - static_cast<double>(b.force)));
      size = (std::max)(size, std::abs(static_cast<double>(b.force)));
    }
    if (!(off > 1e-3 * size)) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "full model: must be of the beam that is trained; pressed at s = %g m their forces are "
                  "%.3g N apart of %.3g N",
                  s, off, size);
    throw std::invalid_argument(text);
  }
}

}  // namespace hapbeam::detail
