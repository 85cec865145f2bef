// Relative force errors over random presses of the pinned thesis beam, against the closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/closed_form.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

struct ForceErrors {
  std::vector<double> sorted;
  double median() const { return sorted[sorted.size() / 2]; }
  double max() const { return sorted.back(); }
};

/// @param presses  drawn even over 5 to 95 % of the span and from `shallowest` to `deepest` [m], both ways
template <class Model, class Reference>
ForceErrors force_errors(Model& model, const Reference& reference, double shallowest, double deepest,
                         int presses = 500, Status wanted = Status::ok) {
  using S = typename Model::Scalar;
  Random random(7);
  ForceErrors errors;
  for (int k = 0; k < presses; ++k) {
    const S s = static_cast<S>(thesis_length * random(0.05, 0.95));
    const S d = static_cast<S>((k % 2 ? -1 : 1) * random(shallowest, deepest));
    const Response<S> response = model.press({s, d});
    INFO("s " << s << " m, d " << d << " m");
    REQUIRE(response.status == wanted);
    const double force = reference(static_cast<double>(s), static_cast<double>(d));
    errors.sorted.push_back(std::abs(static_cast<double>(response.force) - force) / std::abs(force));
  }
  std::sort(errors.sorted.begin(), errors.sorted.end());
  return errors;
}

inline double pinned_closed_form(double s, double d) {
  return PinnedPress(thesis_length, thesis_EA, thesis_EI)(s, d);
}

/// Full model that is asked from rest each time.
template <class Model>
auto from_rest(Model& model) {
  return [&model](double s, double d) {
    model.reset();
    const Response<double> response = model.press({s, d});
    REQUIRE(response.status == Status::ok);
    return response.force;
  };
}

}  // namespace hapbeam::testing
