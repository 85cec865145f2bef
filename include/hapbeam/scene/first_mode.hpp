// SPDX-License-Identifier: MIT
// The first mode of a beam or a rod about its rest, by statics alone: what it is pulled by is its own inertia.
//
//   K φ' = ω² μ φ,   ω² = ∫ω² μ φ·φ' ds / ∫μ φ'² ds        (inverse iteration, Rayleigh's quotient)
//
// It begins with the shape of a press, and takes no mode of twist.
// Offline: allocates; takes some milliseconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::detail {

inline void add_load(Beam& beam, const std::function<Vector2<double>(double)>& f) {
  beam.axial([f, was = beam.axial()](double s) { return (was ? was(s) : 0) + f(s).x(); });
  beam.transverse([f, was = beam.transverse()](double s) { return (was ? was(s) : 0) + f(s).y(); });
}
inline void add_load(Rod& rod, const RodLoad& f) {
  using Vector = VectorOf<double, 3>;
  rod.load(
      [f, was = rod.load()](double s) { return Vector((was ? was(s) : Vector(Vector::Zero())) + f(s)); });
}

/// @param press  (FemModel<Element>&, how far [m]) -> Response
/// @return [Hz], to 1e-3; 0 where the body has no density, or does not answer
template <class Element, class Body, class Press>
double first_mode(const Body& body, Press&& press) {
  using Vector = VectorOf<double, dimension_of<Element>>;
  constexpr int elements = 32, places = 8 * elements, times = 8;
  const double length = body.length(), small = body.thickness() / 100;
  if (!(body.mass_per_length(length / 2) > 0)) return 0;
  const auto lies = [&](const FemModel<Element>& model) {
    const auto shape = model.shape();
    std::vector<Vector> at;
    for (int i = 0; i <= places; ++i) at.push_back(shape.position(length * i / places));
    return at;
  };
  FemModel<Element> model(body, elements);
  const std::vector<Vector> rest = lies(model);
  std::vector<Vector> mode(rest.size());
  /// ∫μ φ·ψ ds
  const auto product = [&](const std::vector<Vector>& a, const std::vector<Vector>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += (i == 0 || i == places ? 0.5 : 1) * body.mass_per_length(length * double(i) / places) *
             a[i].dot(b[i]);
    return sum * length / places;
  };
  const auto response = press(model, small);
  if (!is_answer(response.status)) return 0;
  std::vector<Vector> now = lies(model);
  for (std::size_t i = 0; i < now.size(); ++i) mode[i] = now[i] - rest[i];
  double square = std::abs(response.force) * small / product(mode, mode);
  for (int k = 0; k < times; ++k) {
    double largest = 0;
    for (const Vector& v : mode) largest = (std::max)(largest, v.norm());
    for (Vector& v : mode) v *= small / largest;
    Body pulled = body;
    add_load(pulled, [&, square](double s) {
      const double x = std::clamp(s / length, 0.0, 1.0) * places;
      const auto i = static_cast<std::size_t>((std::min)(x, places - 1.0));
      const double t = x - static_cast<double>(i);
      return Vector(square * body.mass_per_length(s) * ((1 - t) * mode[i] + t * mode[i + 1]));
    });
    now = lies(FemModel<Element>(pulled, elements));
    for (std::size_t i = 0; i < now.size(); ++i) now[i] -= rest[i];
    square *= product(mode, now) / product(now, now);
    mode.swap(now);
  }
  return std::sqrt(square) / (2 * std::acos(-1.0));
}

}  // namespace hapbeam::detail
