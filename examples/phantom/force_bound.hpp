// How far the force may be off, as the model states it: finite elements by what their mesh leaves, a trained model by its file.
#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <variant>

#include "couple.hpp"
#include <hapbeam/fem/force_error.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>

namespace phantom {

/// Of a model that is no FemModel.
template <typename Model>
class ForceBound {
 public:
  explicit ForceBound(const Parts& parts) {
    if (parts.trained) stated_ = parts.trained->errors.force_bound;
  }
  void tick(const Model&, const hapbeam::ServoRecord&) noexcept {}
  double relative() const noexcept { return stated_; }

 private:
  double stated_ = std::numeric_limits<double>::quiet_NaN();
};

#ifdef HAPBEAM_EXAMPLES_WINDOW
/// Nothing but the window shows it: a press on a finer mesh, ten times a second.  More elements than the window has leave nothing to show,
/// and a finer mesh would take longer than a tick.
template <typename Element>
class ForceBound<hapbeam::FemModel<Element>> {
  using Model = hapbeam::FemModel<Element>;

 public:
  explicit ForceBound(const Parts& parts) {
    constexpr int most = 64;
    if (const int elements = parts.options.elements; elements <= most)
      force_error_.emplace(std::get<typename Model::Body>(parts.slender), elements);
  }
  /// From the servo's thread.   Real-time: as ForceError
  void tick(const Model& model, const hapbeam::ServoRecord& record) noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!force_error_) return;
    if (!record.pressing) return relative_.store(none, std::memory_order_relaxed);
    if (record.ticks % 100 != 0) return;
    const double force = record.force.norm();
    relative_.store(force > 0 ? (*force_error_)(model) / force : none, std::memory_order_relaxed);
  }
  double relative() const noexcept { return relative_.load(std::memory_order_relaxed); }

 private:
  std::optional<hapbeam::ForceError<Element>> force_error_;
  std::atomic<double> relative_{std::numeric_limits<double>::quiet_NaN()};
};
#endif

}  // namespace phantom
