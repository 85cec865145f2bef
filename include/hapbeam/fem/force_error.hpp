// SPDX-License-Identifier: MIT
// A bound on the error that the mesh of a FemModel leaves in its force, and how many elements an error takes.
//
//   const int elements = elements_for<Corotational<>>(beam, 0.02, 0.01);   // 1 % of the force, pressed up to 20 mm deep
//   FemModel<Corotational<>> model(beam, elements);
//   ForceError<Corotational<>> force_error(beam, elements);
//   touch.tick(hand);                                                      // or press(), or push()
//   force_error(model);                                                    // [N], where it is asked for
//
// A mesh of four times the elements takes the model's shape.  It is held at each place where the model is touched, along the force
// there, friction included.  The bound is six times the difference of the forces, because elements are of fourth order, and of lower where
// tension bends a beam within an element.  It bounds what the mesh does, not the kinematics.  In float round-off is most of the difference.
// Offline: construction and elements_for() allocate and throw.  Servo: the call is noexcept and allocation-free, at most
// NewtonRaphson::max_solves linear solves of four times the elements.  docs/limits.md says how often the bound holds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/check.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam {

/// @tparam Element  of the model, FemModel<Element>
template <class Element>
class ForceError {
 public:
  using Model = FemModel<Element>;

  /// @param elements  of the model   @throws std::invalid_argument as the model with four times as many
  ForceError(const typename Model::Body& body, int elements) : finer_(body, finer(elements)) {}

  /// Of the model's last answer.   @param model  of the same body
  /// @return largest error of the force at a contact [N]; 0 where the model is exact or nothing touches it; infinite where the finer mesh
  ///         has no such equilibrium
  double operator()(const Model& model) noexcept {
    const MeshDifference<double> found = finer_.differ_from(model);
    return factor * found.difference + least * found.force;
  }

 private:
  static constexpr double factor = 6, least = 1e-6;  // the second: of the force, what solvers leave
  static int finer(int elements) noexcept {
    return elements < (std::numeric_limits<int>::max)() / 4 ? 4 * elements : elements;
  }

  Model finer_;
};

namespace detail {

/// Presses a model from rest at one place along one direction.
/// @return largest bound over the largest force, as far as both meshes answer; infinite where that is less than half the way
template <class Element, class Press>
double worst_of_line(FemModel<Element>& model, ForceError<Element>& force_error, Press&& press) {
  constexpr int steps = 8;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double bound = 0, force = 0;
  model.reset();
  for (int k = 1; k <= steps; ++k) {
    const Response<double> answer = press(double(k) / steps);
    const double may_err = is_answer(answer.status) ? force_error(model) : infinity;
    if (std::isinf(may_err)) {
      if (2 * k <= steps) return infinity;
      break;
    }
    bound = (std::max)(bound, may_err), force = (std::max)(force, std::abs(answer.force));
  }
  return force > 0 ? bound / force : 0;
}

/// The same at a few places of all of the body, to both sides, of a rod along both axes of its section.
template <class Element>
double worst_press(FemModel<Element>& model, ForceError<Element>& force_error, double depth) {
  constexpr double slope = 0.3;  // of a hand beside a support
  double worst = 0;
  const auto range = model.range();
  // Uneven, lest they meet the nodes.
  for (const double along : {0.07, 0.18, 0.31, 0.46, 0.62, 0.77, 0.91}) {
    model.reset();
    const auto line = model.shape();
    const double s = along * line.length(),
                 deepest =
                     (std::min)(depth, slope * (std::min)(s - range.left_support, range.right_support - s));
    const auto go = [&](auto&& press) {
      worst = (std::max)(worst, worst_of_line(model, force_error, press));
    };
    for (const double side : {1.0, -1.0}) {
      if constexpr (dimension_of<Element> == 2) {
        const double w = line.at(s).w, most = (std::min)(deepest, 0.99 * range.depth_at(s) - side * w);
        if (most > 0) go([&](double t) { return model.press({s, w + side * t * most}); });
      } else {
        const auto& node = line[line.segment_at(s)];
        const VectorOf<double, 3> r = line.position(s), d1 = node.director,
                                  d2 = detail::cross3<double>(detail::unit(node.tangent), d1);
        for (const VectorOf<double, 3>& n : {d1, d2}) {
          const double from = n.dot(r);
          go([&](double t) { return model.push(Push<double, 3>{s, from + side * t * deepest, n}); });
        }
      }
    }
  }
  return worst;
}

}  // namespace detail

/// The fewest elements, doubled from four on, whose ForceError is within an error.  Lines of presses are judged, from rest to the depth, at
/// seven places: their bounds by the largest force of the line.  Beside a support that holds w the depth is at most 0.3 of the distance.
/// @param depth [m] from rest   @param error  of the force, relative, less than 1
/// @throws std::invalid_argument where a value makes no sense, or no number of elements that the scalar allows is enough
template <class Element = VonKarman<>>
[[gnu::cold]] int elements_for(const typename FemModel<Element>::Body& body, double depth, double error) {
  detail::positive("depth", depth, "m");
  if (!(error > 0 && error < 1))
    detail::reject("error", error, "", "of the force, more than 0 and less than 1");
  constexpr int most = 256;
  double worst = 0;
  for (int elements = (std::max)(4, contacts_of<Element> + 1); elements <= most; elements *= 2) {
    FemModel<Element> model(body, elements);
    ForceError<Element> force_error(body, elements);
    worst = detail::worst_press(model, force_error, depth);
    if (worst <= error) return elements;
  }
  detail::refuse(
      "error = %g: must be more, or depth = %g m less; with %d elements the bound is %.2g of the force",
      error, depth, most, worst);
}

}  // namespace hapbeam
