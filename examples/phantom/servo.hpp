// What happens a thousand times a second: position in, force out, and a note of what was.
//
// operator() is noexcept, allocates nothing and waits for nobody; the notes are atomics that the table reads.
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>

#include "scene.hpp"
#include "tick_times.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/device.hpp>
#include <hapbeam/rom/guarded.hpp>

namespace phantom {

/// Worse than another: failures before answers that were moved into range, those before ok.
constexpr bool worse(hapbeam::Status a, hapbeam::Status b) noexcept {
  const auto rank = [](hapbeam::Status s) {
    return static_cast<int>(s) < 0 ? 100 - static_cast<int>(s) : static_cast<int>(s);
  };
  return rank(a) > rank(b);
}

/// The latest tick and the extremes so far.  Each figure is whole; together they may be of two ticks.
struct Notes {
  std::atomic<double> time{0};                     ///< [s]
  std::atomic<double> x{0}, y{0};                  ///< [m] of the hand, device
  std::atomic<double> press{0}, force{0};          ///< [m], [N] of the latest tick; zero without contact
  std::atomic<double> max_press{0}, max_force{0};  ///< [m], [N] magnitudes
  std::atomic<hapbeam::Status> worst{hapbeam::Status::ok};  ///< so far
  std::atomic<std::uint64_t> contact_ticks{0};              ///< the beam pushed the hand
  std::atomic<std::uint64_t> full_ticks{0};                 ///< of these, the full model of a guarded one
  std::atomic<std::uint64_t> touches{0};                    ///< contact began
  TickTimes times;
};

/// Whether the last press was answered by the full model behind a trained one.
template <typename Model>
bool full_answers(const Model&) noexcept {
  return false;
}
template <typename Fast, typename Full>
bool full_answers(const hapbeam::Guarded<Fast, Full>& model) noexcept {
  return model.full_answers();
}

template <typename Model>
class Servo {
 public:
  /// @param model, notes  kept by reference
  Servo(Model& model, const Options& options, Notes& notes)
      : model_(model), touch_(model, options.radius), placement_(options), notes_(notes) {}

  Eigen::Vector3d operator()(const hapbeam::DeviceState& state) noexcept {
    const auto begin = Clock::now();
    const hapbeam::TouchResult<double> result = touch_.tick(placement_.to_scene(state.position));
    const Eigen::Vector3d force = placement_.to_device(result.force);
    note(state, result, force.norm());
    notes_.times.add(std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count());
    return force;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto relaxed = std::memory_order_relaxed;

  static void raise(std::atomic<double>& highest, double value) noexcept {
    if (value > highest.load(relaxed)) highest.store(value, relaxed);
  }

  void note(const hapbeam::DeviceState& state, const hapbeam::TouchResult<double>& result,
            double force) noexcept {
    const double press = result.pressing ? result.press.d : 0;
    notes_.time.store(state.time, relaxed);
    notes_.x.store(state.position.x(), relaxed);
    notes_.y.store(state.position.y(), relaxed);
    notes_.press.store(press, relaxed);
    notes_.force.store(force, relaxed);
    raise(notes_.max_press, std::abs(press));
    raise(notes_.max_force, force);
    if (worse(result.status, notes_.worst.load(relaxed))) notes_.worst.store(result.status, relaxed);
    if (result.pressing) notes_.contact_ticks.fetch_add(1, relaxed);
    if (result.pressing && full_answers(model_)) notes_.full_ticks.fetch_add(1, relaxed);
    if (result.pressing && !pressing_) notes_.touches.fetch_add(1, relaxed);
    pressing_ = result.pressing;
  }

  const Model& model_;
  hapbeam::Touch<Model> touch_;
  Placement placement_;
  Notes& notes_;
  bool pressing_ = false;
};

}  // namespace phantom
