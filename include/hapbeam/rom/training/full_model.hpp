// SPDX-License-Identifier: MIT
// The full model to train with: many elements, a tight solver, and its beam; and whether it is of the beam that is trained.
//
// Offline: allocates, and throws std::invalid_argument.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam {

/// A FemModel that can be refined, which gives its own error.
template <class Element = VonKarman<>>
class FullModel : public FemModel<Element> {
 public:
  FullModel(const Beam& beam, int elements) : FemModel<Element>(beam, elements, tight()), beam_(beam) {}

  const Beam& beam() const noexcept { return beam_; }
  /// The same beam with twice the elements.
  FullModel refined() const { return FullModel(beam_, 2 * this->elements()); }

 private:
  static NewtonRaphson tight() noexcept {
    NewtonRaphson solver;
    solver.relative_tolerance = 1e-13;
    solver.max_solves = 200;
    return solver;
  }

  Beam beam_;
};

/// A straight unloaded beam has no discretisation error.  Under loads, of finite rotation, or bent by nature it is of fourth order, and 256
/// elements leave 1e-6 of the force of a bar.  Where tension bends a strip within an element, k h = √(N/EI) h > 1, they leave up to 1e-3;
/// validate() measures it.
template <class Element = VonKarman<>>
FullModel<Element> full_model(const Beam& beam, int elements = 256) {
  return FullModel<Element>(beam, elements);
}

namespace detail {

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
    if (off > 1e-3 * size)
      refuse(
          "full model: must be of the beam that is trained; pressed at s = %g m their forces are %.3g N "
          "apart of "
          "%.3g N",
          s, off, size);
  }
}

}  // namespace detail

}  // namespace hapbeam
