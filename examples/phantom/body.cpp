#include "body.hpp"

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "counted.hpp"
#include "live.hpp"
#include "two_handed.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace phantom {

namespace {

/// The coupling's figures, where none were asked for.
Options filled_in(Options options, const hapbeam::DeviceInfo& device) {
  if (options.coupling == CouplingChoice::direct) return options;
  const hapbeam::CouplingFigures safe = hapbeam::safe_coupling(device);
  if (std::isnan(options.stiffness)) options.stiffness = safe.stiffness;
  if (std::isnan(options.damping)) options.damping = safe.damping;
  return options;
}

template <typename M, typename Coupling>
class OneHand {
 public:
  using Model = M;
  OneHand(Model model, const Parts& parts, const hapbeam::ServoOptions& options)
      : model_(std::move(model)),
        servo_(model_, parts.device, options, make_coupling<Coupling>(parts.options)) {}

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept { return servo_.tick(state); }
  void reset() noexcept { servo_.reset(); }
  const Model& model() const noexcept { return model_; }
  hapbeam::Servo<Model, Coupling>& servo() noexcept { return servo_; }
  const hapbeam::Servo<Model, Coupling>& servo() const noexcept { return servo_; }
  const hapbeam::ServoRecord* second() const noexcept { return nullptr; }

 private:
  Model model_;
  hapbeam::Servo<Model, Coupling> servo_;
};

template <typename Element>
std::unique_ptr<Body> couple_full(Parts parts) {
  using Model = hapbeam::FemModel<Element>;
  Model model(std::get<typename Model::Body>(parts.slender), parts.options.elements);
  return couple<OneHand>(std::move(model), std::move(parts));
}

/// Below one another.  Teeth that bend far slip off the hand; other elements are for small turns.
std::unique_ptr<Body> couple_many(Parts parts) {
  const Options& options = parts.options;
  if (options.model_choice != ModelChoice::finite_elements || options.element != ElementChoice::corotational)
    throw cli::UsageError("--beams " + std::to_string(options.beams) + ": must be of --element corotational");
  std::vector<hapbeam::BeamPlace> places;
  for (int i = 0; i < options.beams; ++i) places.push_back({{0, -options.pitch * i}, 0, 0});
  using Tooth = hapbeam::FemModel<hapbeam::Corotational<>>;
  hapbeam::BeamArray<Tooth> array(Tooth(std::get<hapbeam::Beam>(parts.slender), options.elements), places);
  return couple<OneHand>(std::move(array), std::move(parts));
}

std::unique_ptr<Body> couple_trained(Parts parts) {
  using Full = hapbeam::FemModel<>;
  const std::shared_ptr<const Trained> trained = parts.trained;
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!parts.options.guarded) return couple<OneHand>(fast, std::move(parts));
        parts.full_answers = std::make_unique<Count>(0);
        Counted<Fast, Full> guarded(
            fast, Full(std::get<hapbeam::Beam>(parts.slender), parts.options.elements), *parts.full_answers);
        return couple<OneHand>(std::move(guarded), std::move(parts));
      },
      trained->model);
}

std::unique_ptr<Body> couple_rod(Parts parts) {
  const Options& options = parts.options;
  if (options.beams > 1) cli::refuse("--beams", std::to_string(options.beams), "1 for a rod in space");
  if (options.model_choice != ModelChoice::finite_elements)
    throw cli::UsageError("a rod in space has no trained model");
  if (!bends_in_space(options.element))
    cli::refuse("--element", name(options.element), "round-rod or twisted-rod for a rod in space");
  if (options.element == ElementChoice::round_rod) return couple_full<hapbeam::RoundRod>(std::move(parts));
  return couple_full<hapbeam::TwistedRod>(std::move(parts));
}

}  // namespace

std::unique_ptr<Body> make_body(const Options& options, std::shared_ptr<const Trained> trained,
                                const hapbeam::DeviceInfo& device) {
  using namespace hapbeam;
  if (options.hands == 2) return make_two_handed(filled_in(options, device), device);
  if (options.beam.in_space())
    return couple_rod({filled_in(options, device), options.beam.make_rod(), nullptr, device});
  if (bends_in_space(options.element))
    cli::refuse("--element", name(options.element), "one of a beam that bends in its plane");
  const Beam beam = options.model.empty() ? options.beam.make() : trained->make_beam();
  if (options.beams > 1) return couple_many({filled_in(options, device), beam, nullptr, device});
  if (options.model_choice != ModelChoice::finite_elements)
    return couple_trained({filled_in(options, device), beam, std::move(trained), device});
  if (!options.model.empty() && trained->loaded)
    throw cli::UsageError("finite elements: " + options.model +
                          " was trained under dead loads, which the file does not say");
  Parts parts{filled_in(options, device), beam, nullptr, device};
  switch (options.element) {
    case ElementChoice::linear: return couple_full<Linear>(std::move(parts));
    case ElementChoice::full: return couple_full<VonKarman<FullIntegration>>(std::move(parts));
    case ElementChoice::reduced: return couple_full<VonKarman<ReducedIntegration>>(std::move(parts));
    case ElementChoice::corotational: return couple_full<Corotational<>>(std::move(parts));
    case ElementChoice::tapered: return couple_full<Corotational<Tapered<>>>(std::move(parts));
    case ElementChoice::stability_functions:
    case ElementChoice::round_rod:
    case ElementChoice::twisted_rod: break;
  }
  return couple_full<VonKarman<>>(std::move(parts));
}

}  // namespace phantom
