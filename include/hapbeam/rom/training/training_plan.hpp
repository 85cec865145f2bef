// SPDX-License-Identifier: MIT
// Which presses a model is trained with, the full model that answers them, and running them on several threads.
//
// Offline: allocates; throws TrainingError for a press that the full model does not answer with ok, and std::invalid_argument
// naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam {

/// A grid of presses: positions along the beam, and at each so many depths.
struct TrainingPlan {
  double s_min, s_max;    ///< [m] equal for a single position
  int positions;          ///< 2 to 64, or 1
  double depth;           ///< [m] largest |d|
  int depths;             ///< 2 to 64; for a GalerkinModel, of tensions
  bool symmetric = true;  ///< train d > 0 alone, for a beam without dead loads; else as many of both signs
  int segments = 32;      ///< pieces of the shape that the model draws; even where positions > 1

  /// Anywhere from 5 to 95 % of the span, or up to an end that yields.
  static TrainingPlan anywhere(const Beam& beam, double depth, int positions = 16, int depths = 12) {
    const double L = beam.length();
    return {fixes_w(beam.left()) ? 0.05 * L : 0, fixes_w(beam.right()) ? 0.95 * L : L, positions, depth,
            depths};
  }
  static TrainingPlan at(double s, double depth, int depths = 14) { return {s, s, 1, depth, depths}; }

  /// The node of the shape that follows the contact.
  int contact_node(const Beam& beam) const {
    if (positions > 1) return segments / 2;
    if (s_min == 0 || s_min == beam.length()) return s_min == 0 ? 0 : segments;
    return std::clamp(static_cast<int>(std::lround(s_min / beam.length() * segments)), 1, segments - 1);
  }

  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const TrainingPlan& check(const Beam& beam) const {
    detail::check_count("positions", positions, 1, 64);
    detail::check_count("depths", depths, 2, 64);
    detail::check_count("segments", segments, 2, 1 << 14);
    if (positions > 1 && segments % 2 != 0) detail::reject("segments", segments, "", "even");
    if (!beam.straight())
      detail::refuse(
          "beam: must be straight, with its ends where they are in the straight beam, "
          "to train a model of it");
    detail::check_range(BeamData<double>::of(beam), s_min, s_max, depth, positions);
    if (!(depth < beam.length())) detail::reject("depth", depth, "m", "less than the beam's length");
    return *this;
  }
};

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

/// One press, or a TrainingError.
template <class Model>
double press_for_training(Model& model, double s, double d) {
  const Response<double> response = model.press({s, d});
  if (response.status == Status::ok) return response.force;
  char limit[80] = "";
  if (response.status == Status::out_of_range)
    std::snprintf(limit, sizeof limit, ", the full model answers up to %g m there",
                  model.range().depth_at(s));
  refuse<TrainingError>("the press at s = %g m, d = %g m: %s%s", s, d, name(response.status), limit);
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

/// Finite elements can be built anew for a beam.
template <class Model>
using FiniteElements =
    std::pair<typename Model::ElementType, decltype(std::declval<const Model&>().elements())>;

/// Compares length and thickness of any ForceModel, and of finite elements the forces: a difference in stiffness, ends, dead
/// loads or natural shape changes them.   @throws std::invalid_argument
template <class Model>
void check_same_beam(const Beam& beam, const Model& full, const TrainingPlan& plan) {
  const auto compare = [](const char* what, double found, double wanted) {
    if (std::abs(found - wanted) > 1e-6 * wanted)
      reject(what, found, "m", "that of the beam that is trained");
  };
  compare("length of the full model", full.shape().length(), beam.length());
  compare("thickness of the full model", full.thickness(), beam.thickness());
  if constexpr (offers<FiniteElements, Model>) {
    Model given(full);
    FemModel<typename Model::ElementType> own(beam, full.elements());
    const double s = (plan.s_min + plan.s_max) / 2;
    double off = 0, size = 0;
    for (const double d : {plan.depth, -plan.depth, plan.depth / 10}) {
      given.reset(), own.reset();
      const Response<double> a = given.press({s, d}), b = own.press({s, d});
      if (a.status != Status::ok || b.status != Status::ok) continue;
      off = (std::max)(off, std::abs(a.force - b.force));
      size = (std::max)(size, std::abs(b.force));
    }
    if (off > 1e-3 * size)
      refuse(
          "full model: must be of the beam that is trained; pressed at s = %g m forces are %.3g N "
          "apart of %.3g N",
          s, off, size);
  }
}

}  // namespace detail

}  // namespace hapbeam
