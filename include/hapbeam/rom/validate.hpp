// How wrong is a trained model?  Measured on presses that it was not trained with, against a full one.
//
// Offline: allocates; throws TrainingError where the full model does not answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/error_report.hpp>
#include <hapbeam/rom/training_run.hpp>

namespace hapbeam {

struct ValidationOptions {
  int presses = 500;       ///< at random over the range, on its edges and nearly at rest, both ways
  std::uint64_t seed = 1;  ///< the same seed draws the same presses on every machine
  int s_regions = 3;       ///< parts of the range along the beam
  int depth_regions = 3;   ///< and in depth
};

/// Of one press.
struct PressError {
  double s;      ///< [m]
  double depth;  ///< [m] |d|
  double force;  ///< relative
  double shape;  ///< largest |Δw| along the beam over the largest |w|
};

namespace detail {

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
  return {static_cast<int>(errors.size()),
          quantile(force, 0.5),
          quantile(force, 0.95),
          quantile(force, 1),
          quantile(shape, 0.5),
          quantile(shape, 1)};
}

}  // namespace detail

/// Compares force and shape, press by press.
template <class Fast, class Full>
std::vector<PressError> press_errors(Fast fast, const Full& full, const ValidationOptions& options = {}) {
  using S = typename Fast::Scalar;
  using F = typename Full::Scalar;
  const Range<S> range = fast.range();
  const Range<F> known = full.range();
  const double s_min = static_cast<double>(range.s_min), s_max = static_cast<double>(range.s_max);
  const double depth = static_cast<double>(range.depth);

  // The standard fixes the generator but not its distributions.
  std::mt19937_64 generator(options.seed);
  const auto random = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  Full model(full);
  model.reset();
  std::vector<Press<S>> presses;
  for (int k = 0; k < options.presses; ++k) {
    // First the corners of the range, then one of ten on each of its edges: there a polynomial is at its worst.
    double along = random(), deep = random();
    if (k < 4) along = k / 2, deep = k % 2 ? 1 : 0.02;
    else if (k % 10 == 4 || k % 10 == 5) along = k % 10 - 4;
    else if (k % 10 == 6) deep = 1;
    const bool shallow = k >= 4 && k % 10 > 7;  // down to a ten-thousandth of the depth
    S s = along == 1 ? range.s_max : static_cast<S>(s_min + (s_max - s_min) * along);
    S size = deep == 1 ? range.depth : static_cast<S>(depth * (shallow ? std::pow(10, -4 * deep) : deep));
    // In float an edge of the range may have been rounded to the number beyond the full model's.
    if (static_cast<double>(s) > static_cast<double>(known.s_max)) s = std::nextafter(s, S(0));
    if (static_cast<double>(s) < static_cast<double>(known.s_min)) s = std::nextafter(s, range.s_max + 1);
    if (static_cast<double>(size) > static_cast<double>(known.depth_at(static_cast<F>(s))))
      size = std::nextafter(size, S(0));
    // Depth counts from the untouched beam: where that hangs the force is zero, and has no relative error.
    const S rest = static_cast<S>(model.shape().at(static_cast<F>(s)).w);
    if (rest != 0) size = std::max(size, range.depth / 50);
    const auto cut = [&](S d) { return std::min(std::max(d, -range.depth), range.depth); };
    const S up = cut(rest + size), down = cut(rest - size);
    const bool upward = std::abs(up - rest) < size / 2 || std::abs(down - rest) < size / 2
                            ? up - rest > rest - down
                            : k / 2 % 2 == 0;
    presses.push_back({s, upward ? up : down});
  }

  std::vector<PressError> errors;
  for (const Press<S>& press : presses) {
    model.reset();
    const double wanted =
        detail::press_for_training(model, static_cast<double>(press.s), static_cast<double>(press.d));
    const double found = static_cast<double>(fast.press(press).force);
    const double d = std::abs(static_cast<double>(press.d));
    double off = 0, size = d;
    for (const CentrelineNode<S>& node : fast.shape()) {
      const double w = static_cast<double>(model.shape().at(static_cast<F>(node.s)).w);
      off = std::max(off, std::abs(static_cast<double>(node.w) - w));
      size = std::max(size, std::abs(w));
    }
    errors.push_back(
        {static_cast<double>(press.s), d, std::abs(found - wanted) / std::abs(wanted), off / size});
  }
  return errors;
}

/// All of them in figures, and by regions of a range.   @param reference  what the full model is called in the report
template <typename Scalar>
ErrorReport report_errors(const std::vector<PressError>& errors, const Range<Scalar>& range,
                          const ValidationOptions& options = {},
                          const std::string& reference = "finite elements") {
  const double s_min = static_cast<double>(range.s_min), s_max = static_cast<double>(range.s_max);
  const double depth = static_cast<double>(range.depth);
  ErrorReport report{reference, detail::summarize(errors), {}};
  for (int i = 0; i < options.s_regions; ++i)
    for (int j = 0; j < options.depth_regions; ++j) {
      const auto part = [](double low, double high, int k, int n) { return low + (high - low) * k / n; };
      RegionError region{part(s_min, s_max, i, options.s_regions),
                         part(s_min, s_max, i + 1, options.s_regions),
                         part(0, depth, j, options.depth_regions),
                         part(0, depth, j + 1, options.depth_regions),
                         {}};
      std::vector<PressError> inside;
      for (const PressError& error : errors)
        if (error.s >= region.s_min && (error.s < region.s_max || i + 1 == options.s_regions) &&
            error.depth >= region.depth_min &&
            (error.depth < region.depth_max || j + 1 == options.depth_regions))
          inside.push_back(error);
      region.errors = detail::summarize(inside);
      report.regions.push_back(region);
    }
  return report;
}

/// Both: how wrong a model is.   @param reference  what the full model is called in the report
template <class Fast, class Full>
ErrorReport validate(const Fast& fast, const Full& full, const ValidationOptions& options = {},
                     const std::string& reference = "finite elements") {
  return report_errors(press_errors(fast, full, options), fast.range(), options, reference);
}

}  // namespace hapbeam
