// SPDX-License-Identifier: MIT
// Running a full model for training: presses that must be answered, shared out to threads.
//
// Offline: allocates; throws TrainingError for a press that the full model does not answer with ok.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

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
