// SPDX-License-Identifier: MIT
// Which presses a model is trained with, and running them: each must be answered, and they are shared out to threads.
//
// Offline: allocates; throws TrainingError for a press that the full model does not answer with ok, and std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam {

/// A grid of presses: positions along the beam, and at each so many depths.
struct TrainingPlan {
  double s_min, s_max;  ///< [m] equal for a single position
  int positions;        ///< 2 to 64, or 1
  double depth;         ///< [m] largest |d|
  int depths;           ///< 2 to 64; for a GalerkinModel, of tensions
  bool symmetric =
      true;  ///< train d > 0 alone, for a beam without dead loads; else both signs, with the same number of depths
  int segments =
      32;  ///< pieces of the shape that the model draws; even where there is more than one position

  /// Anywhere from 5 to 95 % of the span, or up to an end that yields.
  static TrainingPlan anywhere(const Beam& beam, double depth, int positions = 16, int depths = 12) {
    const double L = beam.length();
    return {fixes_w(beam.left()) ? 0.05 * L : 0, fixes_w(beam.right()) ? 0.95 * L : L, positions, depth,
            depths};
  }
  /// At one place.
  static TrainingPlan at(double s, double depth, int depths = 14) { return {s, s, 1, depth, depths}; }

  /// The node of the shape that follows the contact.
  int contact_node(const Beam& beam) const {
    if (positions > 1) return segments / 2;
    if (s_min == 0 || s_min == beam.length()) return s_min == 0 ? 0 : segments;
    return std::clamp(static_cast<int>(std::lround(s_min / beam.length() * segments)), 1, segments - 1);
  }

  /// @return the plan   @throws std::invalid_argument
  const TrainingPlan& check(const Beam& beam) const {
    detail::check_count("positions", positions, 1, 64);
    detail::check_count("depths", depths, 2, 64);
    detail::check_count("segments", segments, 2, 1 << 14);
    if (positions > 1 && segments % 2 != 0) detail::reject_data("segments", segments, "even");
    if (!beam.straight())
      detail::refuse(
          "beam: must be straight, with its ends where they are in the straight beam, to train a model of "
          "it");
    detail::check_range(BeamData<double>::of(beam), s_min, s_max, depth, positions);
    if (!(depth < beam.length())) detail::reject("depth", depth, "m", "less than the beam's length");
    return *this;
  }
};

/// A press that failed in the full model; what() has its place, depth and status.
struct TrainingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct TrainingOptions {
  int threads = 0;  ///< 0: as many as the machine runs at once
  /// Called after each press, by one thread at a time.
  std::function<void(int done, int total)> progress;
};

namespace detail {

inline std::string describe(double s, double d) { return "s = " + number(s) + " m, d = " + number(d) + " m"; }

/// One press, or a TrainingError.
template <class Model>
double press_for_training(Model& model, double s, double d) {
  using S = typename Model::Scalar;
  const Response<S> response = model.press({static_cast<S>(s), static_cast<S>(d)});
  if (response.status == Status::ok) return static_cast<double>(response.force);
  const double limit = static_cast<double>(model.range().depth_at(static_cast<S>(s)));
  throw TrainingError("the press at " + describe(s, d) + ": " + name(response.status) +
                      (response.status == Status::out_of_range
                           ? ", the full model answers up to " + number(limit) + " m there"
                           : ""));
}

/// Runs work(model, i) for each position i on as many threads.  The first exception ends all and is thrown again.
template <class Model, class Work>
void for_each_position(const Model& full, int positions, int threads, const Work& work) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    try {
      Model model(full);
      for (int i = next++; i < positions; i = next++) work(model, i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = positions;
    }
  };
  const int wanted = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> pool;
  try {
    for (int t = 1; t < (std::min)(wanted, positions); ++t) pool.emplace_back(run);
  } catch (const std::system_error&) {  // a system that has no more threads has these
  }
  run();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace detail

}  // namespace hapbeam
