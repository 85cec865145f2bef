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

/// What the mesh leaves [N].  Of a model that does not tell: not a number.
template <typename Model>
struct MeshError {
  explicit MeshError(const Parts&) {}
  double operator()(Model&) noexcept { return std::numeric_limits<double>::quiet_NaN(); }
};

#ifdef HAPBEAM_EXAMPLES_WINDOW
constexpr bool shows_mesh_error = true;

/// A press on a finer mesh.  More elements than the window has leave nothing to show, and a finer mesh would take longer than a tick.
template <typename Element>
class MeshError<hapbeam::FemModel<Element>> {
  using Model = hapbeam::FemModel<Element>;

 public:
  explicit MeshError(const Parts& parts) {
    constexpr int most = 64;
    if (const int elements = parts.options.elements; elements <= most)
      force_error_.emplace(std::get<typename Model::Body>(parts.slender), elements);
  }
  /// Real-time: as ForceError
  double operator()(const Model& model) noexcept {
    return force_error_ ? (*force_error_)(model) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::optional<hapbeam::ForceError<Element>> force_error_;
};
#else
constexpr bool shows_mesh_error = false;  // nothing but the window does
#endif

/// Ten times a second.
class ForceBound {
 public:
  explicit ForceBound(const Parts& parts) : stated_(parts.trained != nullptr) {
    if (stated_) relative_.store(parts.trained->errors.force_bound, std::memory_order_relaxed);
  }
  /// From the servo's thread.   @param error [N]() noexcept
  template <typename Error>
  void tick(const hapbeam::ServoRecord& record, Error&& error) noexcept {
    if (!shows_mesh_error || stated_) return;
    if (!record.pressing) return relative_.store(none, std::memory_order_relaxed);
    if (record.ticks % 100 != 0) return;
    const double force = record.force.norm();
    relative_.store(force > 0 ? error() / force : none, std::memory_order_relaxed);
  }
  double relative() const noexcept { return relative_.load(std::memory_order_relaxed); }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  bool stated_;
  std::atomic<double> relative_{none};
};

}  // namespace phantom
