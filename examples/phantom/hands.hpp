// The loop of a model that one hand presses, or two.
//
// Of two, the first hand is the device's, the second a simulated Phantom that holds the beam or rod from below.  A tick of the first is
// followed by one of the second, in simulated time: in lock step the forces of both are deterministic.
#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "coupling.hpp"
#include "live.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace phantom {

template <typename M>
class OneHand {
 public:
  using Model = M;
  using Servo = hapbeam::Servo<Model, Coupling>;
  OneHand(std::unique_ptr<Model> model, const Parts& parts, const hapbeam::ServoOptions& options)
      : model_(std::move(model)), servo_(*model_, parts.device, options, Coupling(parts.options)) {}

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept { return servo_.tick(state); }
  void reset() noexcept { servo_.reset(); }
  const Model& model() const noexcept { return *model_; }
  Model& model() noexcept { return *model_; }
  Servo& servo() noexcept { return servo_; }
  const Servo& servo() const noexcept { return servo_; }
  const hapbeam::ServoRecord* second() const noexcept { return nullptr; }

 private:
  std::unique_ptr<Model> model_;
  Servo servo_;
};

/// A script that begins anew when it has ended.
struct Again {
  ReachPath script;
  hapbeam::HandTarget operator()(double time) const noexcept {
    return script(std::fmod(time, script.duration()));
  }
};

template <typename M>
class BothHands {
 public:
  using Model = M;
  using Servo = hapbeam::Servo<hapbeam::Hand<Model>, Coupling>;

  BothHands(std::unique_ptr<Model> model, const Parts& parts, const hapbeam::ServoOptions& options)
      : model_(std::move(model)),
        hands_(*model_),
        device_(Again{make_second_path(parts.options)}),
        first_(hands_[0], parts.device, options, Coupling(parts.options)),
        second_(hands_[1], device_.info(),
                servo_options(parts.options, model_->shape(), second_place(parts.options))) {}

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept {
    const Eigen::Vector3d force = first_.tick(state);
    device_.step(second_);
    return force;
  }
  void reset() noexcept {
    first_.reset(), second_.reset();
    device_.reset();
  }
  const Model& model() const noexcept { return *model_; }
  Model& model() noexcept { return *model_; }
  Servo& servo() noexcept { return first_; }
  const Servo& servo() const noexcept { return first_; }
  const hapbeam::ServoRecord* second() const noexcept { return &second_.record(); }

 private:
  std::unique_ptr<Model> model_;
  hapbeam::TwoHands<Model> hands_;
  hapbeam::VirtualPhantom<Again> device_;  // of the second hand
  Servo first_, second_;
};

/// A model that two hands can press.  One hand presses the same: a model for one contact would take as many instructions a tick, within 3 %,
/// and as long to compile again.
template <class Element>
using Touchable = hapbeam::FemModel<hapbeam::Several<Element, 2>>;

template <typename Model>
std::unique_ptr<Model> make_model(const Parts& parts) {
  return std::make_unique<Model>(std::get<typename Model::Body>(parts.slender), parts.options.elements);
}

template <typename Model>
std::unique_ptr<Body> couple_any(std::unique_ptr<Model> model, Parts parts) {
  constexpr bool asked = hapbeam::Drawn<Model>::for_who_looks;
  auto any = std::make_unique<AnyModel<hapbeam::dimension_of<Model>, asked>>(std::move(model), parts);
  return couple<OneHand>(std::move(any), std::move(parts));
}

template <class Element>
std::unique_ptr<Body> couple_hands(Parts parts) {
  auto model = make_model<Touchable<Element>>(parts);
  if (parts.options.hands == 2) return couple<BothHands>(std::move(model), std::move(parts));
  return couple_any(std::move(model), std::move(parts));
}

}  // namespace phantom
