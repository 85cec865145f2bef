// The coupling of hand and beam that the options ask for: none or virtual, behind one type.
//
// So each model is compiled with one servo.  Real-time: as hapbeam/haptics/stability/coupling.hpp.
#pragma once

#include <variant>

#include "options.hpp"
#include <hapbeam/haptics/stability/coupling.hpp>

namespace phantom {

/// Whether a touch takes the coupling: of a tool in the hand, which has the coupling's springs itself, or of any model.
template <typename Touch, typename = void>
inline constexpr bool is_led = false;
template <typename Touch>
inline constexpr bool is_led<Touch, std::void_t<decltype(&Touch::lead)>> = true;

class Coupling {
 public:
  /// @throws std::invalid_argument as hapbeam::VirtualCoupling
  explicit Coupling(const Options& options) {
    if (options.coupling == CouplingChoice::virtual_coupling)
      kind_ = hapbeam::VirtualCoupling({options.stiffness, options.damping});
  }
  static Coupling for_device(const hapbeam::DeviceInfo& device, int delay_ticks) {
    return Coupling(hapbeam::VirtualCoupling::for_device(device, delay_ticks));
  }
  Coupling in_scene(double scale) const noexcept {
    return std::visit([scale](const auto& kind) { return Coupling(kind.in_scene(scale)); }, kind_);
  }
  void reset() noexcept {
    std::visit([](auto& kind) { kind.reset(); }, kind_);
  }
  template <typename Touch>
  [[nodiscard]] auto tick(Touch& touch, const hapbeam::VectorOf<double, hapbeam::dimension_of<Touch>>& hand,
                          double dt) noexcept {
    // A beam with mass has no other coupling.
    if constexpr (is_led<Touch>) return touch.lead(*this, hand, dt);
    else if constexpr (hapbeam::detail::offers<hapbeam::detail::Stored, Touch>)
      return std::get_if<hapbeam::VirtualCoupling>(&kind_)->tick(touch, hand, dt);
    else return std::visit([&](auto& kind) { return kind.tick(touch, hand, dt); }, kind_);
  }

 private:
  using Kind = std::variant<hapbeam::Direct, hapbeam::VirtualCoupling>;
  explicit Coupling(const Kind& kind) noexcept : kind_(kind) {}

  Kind kind_;
};

}  // namespace phantom
