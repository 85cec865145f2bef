// A force interpolated between snapshots that are not exact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "support/closed_form.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/lagrange.hpp>

namespace hapbeam::testing {

/// Lagrange's polynomial through F/d at the nodes of a policy, each value off by up to `noise` of itself.
template <class Nodes>
class NoisyForce {
 public:
  /// @param force  depth [m] -> [N]
  template <class Force>
  NoisyForce(int nodes, double shallowest, double deepest, double noise, Force&& force)
      : axis_(nodes, shallowest, deepest), weights_(static_cast<std::size_t>(nodes)) {
    Random random(1);
    for (int k = 0; k < nodes; ++k)
      values_.push_back(force(axis_.node(k)) / axis_.node(k) * (1 + random(noise)));
  }
  double operator()(double d) {
    axis_.weights(d, weights_.data());
    double sum = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) sum += weights_[k] * values_[k];
    return sum * d;
  }
  /// Largest relative error at so many even depths.
  template <class Force>
  double worst_error(int depths, Force&& force) {
    double worst = 0;
    for (int k = 0; k < depths; ++k) {
      const double d = axis_.low() + (axis_.high() - axis_.low()) * (k + 0.5) / depths;
      worst = std::max(worst, relative_error((*this)(d), force(d)));
    }
    return worst;
  }

 private:
  Lagrange<Nodes> axis_;
  std::vector<double> values_, weights_;
};

/// The thesis' beam between hinges, pressed at mid-span, d [m] -> [N]: what trainings go wrong on, 1 to 50 mm deep.
inline double force_at_mid_span(double d) {
  return PinnedPress(thesis_length, thesis_EA, thesis_EI)(thesis_length / 2, d);
}
inline constexpr double shallowest = 1e-3, deepest = 50e-3;  // [m]

template <class Nodes>
double worst_error(int nodes, double noise, int depths) {
  return NoisyForce<Nodes>(nodes, shallowest, deepest, noise, force_at_mid_span)
      .worst_error(depths, force_at_mid_span);
}

}  // namespace hapbeam::testing
