// SPDX-License-Identifier: MIT
// The error of a trained model, measured on presses that it was not trained with, against a full model.
//
//   data.errors = validate(PodModel<>(data), full_model(beam));
//   data.errors.force_bound;                 // no press in range has a larger relative error of its force
//
// A sample of presses gives the usual errors; worst_press.hpp gives the bound.
// Offline: allocates; throws TrainingError where the full model does not answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <hapbeam/rom/trained/model_data.hpp>
#include <hapbeam/rom/training/worst_press.hpp>

namespace hapbeam {

struct ValidationOptions {
  int presses = 500;       ///< random over the range, on its edges and at very small depths, both ways
  std::uint64_t seed = 1;  ///< the same seed draws the same presses on every machine
  int s_regions = 3;       ///< parts of the range along the beam
  int depth_regions = 3;   ///< and in depth
};

namespace detail {

/// Below it is the round-off of finite elements: without tension 1024 of them differ from the closed form by 1e-9.
inline constexpr double least_bound = 1e-8;

/// Value that a part of all do not exceed.
inline double quantile(std::vector<double>& values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline ErrorSummary summarize(const std::vector<PressError>& errors) {
  if (errors.empty()) return {};
  std::vector<double> force, shape;
  for (const PressError& error : errors) force.push_back(error.force), shape.push_back(error.shape);
  const int presses = static_cast<int>(errors.size());
  const double half = quantile(force, 0.5), most = quantile(force, 0.95), all = quantile(force, 1);
  return {presses, half, most, all, quantile(shape, 0.5), quantile(shape, 1)};
}

}  // namespace detail

/// Compares force and shape on a sample of presses.
template <class Fast, class Full>
std::vector<PressError> press_errors(const Fast& fast, const Full& full,
                                     const ValidationOptions& options = {}) {
  detail::PressComparison<Fast, Full> comparison(fast, full, fast.range());
  // The standard fixes the generator but not its distributions.
  std::mt19937_64 generator(options.seed);
  const auto random = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<PressError> errors;
  for (int k = 0; k < options.presses; ++k) {
    // First the corners of the range, then one of ten on each of its edges: there a polynomial is at its worst.
    double along = random(), deep = random();
    if (k < 4) along = k / 2, deep = k % 2 ? 1 : 0.02;
    else if (k % 10 == 4 || k % 10 == 5) along = k % 10 - 4;
    else if (k % 10 == 6) deep = 1;
    else if (k % 10 > 7) deep = std::pow(10, -4 * deep);  // down to a ten-thousandth of the depth
    const double s = along == 1 ? comparison.s_max()
                                : comparison.s_min() + (comparison.s_max() - comparison.s_min()) * along;
    const bool up = k / 2 % 2 == 0;
    errors.push_back(comparison(s, (up ? deep : -deep) * comparison.reach(s, up)));
  }
  return errors;
}

/// The sample in figures, as a whole and by regions of the range, and a bound for all presses.
/// @param sample  of press_errors()   @param reference  what the full model is called in the report
template <class Fast, class Full>
ErrorReport report_errors(const Fast& fast, const Full& full, const std::vector<PressError>& sample,
                          const ValidationOptions& options = {},
                          const std::string& reference = "finite elements") {
  const auto range = fast.range();
  const double s_min = range.s_min, s_max = range.s_max;
  const double depth = range.depth;
  detail::PressComparison<Fast, Full> comparison(fast, full, range);
  std::vector<PressError> starts = sample;
  detail::add_shallow_presses(comparison, starts);
  const double worst = detail::worst_error(comparison, std::move(starts), 8),
               own = detail::own_error(full, range, sample);
  ErrorReport report{
      reference, detail::summarize(sample), {}, (std::max)(1.1 * worst + own, detail::least_bound), own};
  for (int i = 0; i < options.s_regions; ++i)
    for (int j = 0; j < options.depth_regions; ++j) {
      const auto along = [&](int k) { return s_min + (s_max - s_min) * k / options.s_regions; };
      const auto deep = [&](int k) { return depth * k / options.depth_regions; };
      RegionError region{along(i), along(i + 1), deep(j), deep(j + 1), {}};
      std::vector<PressError> inside;
      for (const PressError& error : sample)
        if (error.s >= region.s_min && (error.s < region.s_max || i + 1 == options.s_regions) &&
            error.depth >= region.depth_min &&
            (error.depth < region.depth_max || j + 1 == options.depth_regions))
          inside.push_back(error);
      region.errors = detail::summarize(inside);
      report.regions.push_back(region);
    }
  return report;
}

/// Both: the errors of a model.
/// @param full  of full_model(); any other ForceModel counts as exact   @param reference  what it is called in the report
template <class Fast, class Full>
ErrorReport validate(const Fast& fast, const Full& full, const ValidationOptions& options = {},
                     const std::string& reference = "finite elements") {
  return report_errors(fast, full, press_errors(fast, full, options), options, reference);
}

}  // namespace hapbeam
