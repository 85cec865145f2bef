// SPDX-License-Identifier: MIT
// The full model to train with: many elements, a tight solver, and its beam.
//
// Offline: construction allocates, and throws std::invalid_argument.
#pragma once

#include <hapbeam/fem/fem_model.hpp>

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

}  // namespace hapbeam
