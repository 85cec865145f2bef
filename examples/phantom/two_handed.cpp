#include "two_handed.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "live.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace phantom {

namespace {

/// A script that begins anew when it has ended.
struct Again {
  ReachPath script;
  hapbeam::HandTarget operator()(double time) const noexcept {
    return script(std::fmod(time, script.duration()));
  }
};

template <typename M, typename Coupling>
class BothHands {
 public:
  using Model = M;
  using Second = hapbeam::Servo<hapbeam::Hand<Model>>;
  using First = hapbeam::Servo<hapbeam::Hand<Model>, Coupling>;

  BothHands(Model model, const Parts& parts, const hapbeam::ServoOptions& options)
      : model_(std::move(model)),
        hands_(model_),
        device_(Again{make_second_path(parts.options)}),
        first_(hands_[0], parts.device, options, make_coupling<Coupling>(parts.options)),
        second_(hands_[1], device_.info(),
                servo_options(parts.options, model_.shape(), second_place(parts.options))) {}

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept {
    const Eigen::Vector3d force = first_.tick(state);
    device_.step(second_);
    return force;
  }
  void reset() noexcept {
    first_.reset(), second_.reset();
    device_.reset();
  }
  const Model& model() const noexcept { return model_; }
  First& servo() noexcept { return first_; }
  const First& servo() const noexcept { return first_; }
  const hapbeam::ServoRecord* second() const noexcept { return &second_.record(); }

 private:
  Model model_;
  hapbeam::TwoHands<Model> hands_;
  hapbeam::VirtualPhantom<Again> device_;  // of the second hand
  First first_;
  Second second_;
};

template <typename Element>
std::unique_ptr<Body> couple_both(Parts parts) {
  using Model = hapbeam::FemModel<hapbeam::Several<Element, 2>>;
  Model model(std::get<typename Model::Body>(parts.slender), parts.options.elements);
  return couple<BothHands>(std::move(model), std::move(parts));
}

}  // namespace

std::unique_ptr<Body> make_two_handed(const Options& options, const hapbeam::DeviceInfo& device) {
  if (options.beams > 1) cli::refuse("--beams", std::to_string(options.beams), "1 with --hands 2");
  if (options.model_choice != ModelChoice::finite_elements)
    throw cli::UsageError("--hands 2: a trained model is pressed by one hand");
  const bool in_space = options.beam.in_space();
  if (in_space ? !bends_in_space(options.element) : options.element != ElementChoice::corotational)
    cli::refuse("--element", name(options.element),
                in_space ? "round-rod or twisted-rod for two hands on a rod in space"
                         : "corotational for two hands on a beam");
  if (!in_space) return couple_both<hapbeam::Corotational<>>({options, options.beam.make(), nullptr, device});
  Parts parts{options, options.beam.make_rod(), nullptr, device};
  if (options.element == ElementChoice::round_rod) return couple_both<hapbeam::RoundRod>(std::move(parts));
  return couple_both<hapbeam::TwistedRod>(std::move(parts));
}

}  // namespace phantom
