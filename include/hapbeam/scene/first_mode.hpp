// SPDX-License-Identifier: MIT
// The first mode of a beam or a rod about its rest, by statics alone: what it is pulled by is its own inertia.
//
//   K φ' = ω² μ φ,   ω² = ∫ω² μ φ·φ' ds / ∫μ φ'² ds        (inverse iteration, Rayleigh's quotient)
//
// It begins with the shape of a press, and takes no mode of twist.
// Offline: allocates; takes some milliseconds.
#pragma once

#include <cmath>

#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::detail {

template <class F>
void add_load(Beam& beam, const F& f) {
  beam.axial([f, was = beam.axial()](double s) { return (was ? was(s) : 0) + f(s).x(); });
  beam.transverse([f, was = beam.transverse()](double s) { return (was ? was(s) : 0) + f(s).y(); });
}
template <class F>
void add_load(Rod& rod, const F& f) {
  rod.load([f, was = rod.load()](double s) { return was ? VectorOf<double, 3>(was(s) + f(s)) : f(s); });
}

/// @param press  (FemModel<Element>&, how far [m]) -> Response
/// @return [Hz], to 1e-3; 0 where the body has no density, or does not answer
template <class Element, class Body, class Press>
double first_mode(const Body& body, Press&& press) {
  constexpr int elements = 32, places = 8 * elements, D = dimension_of<Element>;
  using Shape = Eigen::Matrix<double, D, places + 1>;
  const double step = body.length() / places, tiny = body.thickness() / 100;
  Eigen::Matrix<double, 1, places + 1> mass;  // at each place [kg]
  for (int i = 0; i <= places; ++i)
    mass[i] = body.mass_per_length(i * step) * step * (i % places == 0 ? 0.5 : 1);
  if (!(mass.sum() > 0)) return 0;
  const auto product = [&](const Shape& a, const Shape& b) {
    return mass.dot(a.cwiseProduct(b).colwise().sum());
  };
  const auto lies = [&](const FemModel<Element>& model) {
    const auto line = model.shape();
    Shape at;
    for (int i = 0; i <= places; ++i) at.col(i) = line.position(i * step);
    return at;
  };
  FemModel<Element> model(body, elements);
  const Shape rest = lies(model);
  const auto response = press(model, tiny);
  if (!is_answer(response.status)) return 0;
  Shape mode = lies(model) - rest;
  double square = std::abs(response.force) * tiny / product(mode, mode);
  for (int k = 0; k < 8; ++k) {
    mode *= tiny / mode.colwise().norm().maxCoeff();
    Body pulled = body;
    add_load(pulled, [&](double s) {
      return VectorOf<double, D>(square * body.mass_per_length(s) * mode.col(std::lround(s / step)));
    });
    const Shape next = lies(FemModel<Element>(pulled, elements)) - rest;
    square *= product(mode, next) / product(next, next);
    mode = next;
  }
  return std::sqrt(square) / (2 * std::acos(-1.0));
}

}  // namespace hapbeam::detail
