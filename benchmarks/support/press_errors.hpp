// How wrong a model's force is: 500 random presses of the thesis' pinned beam against the closed form.
//
// They are the same for every model: from 2 % of the depth up, both ways, at mid-span or from 5 to 95 % of the span.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "closed_form.hpp"
#include "statistics.hpp"
#include "thesis_beam.hpp"

namespace hapbeam::benchmarks {

/// A press and the force that it takes.
using Known = std::pair<Press<double>, double>;

/// @param from, to  part of the span; equal for one place   @param deepest  [m]
inline std::vector<Known> known_presses(double from, double to, double deepest = depth) {
  const Beam beam = thesis_beam();
  const PinnedClosedForm exact(beam.length(), beam.axial_stiffness(), beam.bending_stiffness());
  // The standard fixes the generator but not its distributions.
  std::mt19937_64 generator(2008);
  const auto random = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<Known> known;
  for (int k = 0; k < 500; ++k) {
    const double s = length * (from + (to - from) * random()), d = deepest * (0.02 + 0.98 * random());
    const Press<double> press{s, k % 2 ? -d : d};
    known.emplace_back(press, exact.force(press));
  }
  return known;
}

inline const std::vector<Known>& at_mid_span() {
  static const std::vector<Known> known = known_presses(0.5, 0.5);
  return known;
}
inline const std::vector<Known>& anywhere() {
  static const std::vector<Known> known = known_presses(0.05, 0.95);
  return known;
}

struct ForceErrors {
  double median, p95, max;  // relative
};

/// @throws std::runtime_error where the model does not answer with ok
template <class Model>
ForceErrors force_errors(Model model, const std::vector<Known>& known) {
  std::vector<double> errors;
  for (const auto& [press, force] : known) {
    model.reset();
    const Response<double> response = model.press(press);
    if (response.status != Status::ok)
      throw std::runtime_error("s = " + std::to_string(press.s) + " m, d = " + std::to_string(press.d) +
                               " m: " + name(response.status));
    errors.push_back(std::abs(response.force / force - 1));
  }
  return {quantile(errors, 0.5), quantile(errors, 0.95), quantile(errors, 1)};
}

}  // namespace hapbeam::benchmarks
