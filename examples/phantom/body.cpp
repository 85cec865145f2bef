#include "body.hpp"

#include <atomic>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "counted.hpp"
#include "scene.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>

namespace phantom {

namespace {

using Count = std::atomic<std::uint64_t>;

hapbeam::ServoOptions servo_options(const Options& options) {
  hapbeam::ServoOptions servo;
  servo.placement = placement(options);
  servo.avatar_radius = options.radius;
  return servo;
}

/// The coupling's figures, where none were asked for.
Options filled_in(Options options, const hapbeam::DeviceInfo& device) {
  if (options.coupling == CouplingChoice::direct) return options;
  const hapbeam::CouplingFigures safe = hapbeam::safe_coupling(device);
  if (std::isnan(options.stiffness)) options.stiffness = safe.stiffness;
  if (std::isnan(options.damping)) options.damping = safe.damping;
  return options;
}

template <typename Coupling>
Coupling make_coupling(const Options& options) {
  if constexpr (std::is_same_v<Coupling, hapbeam::Direct>) return {};
  else return Coupling({options.stiffness, options.damping});
}

/// What all bodies are made of, but for the model.
struct Parts {
  Options options;
  hapbeam::Beam beam;
  std::shared_ptr<const Trained> trained;
  hapbeam::DeviceInfo device;
  std::unique_ptr<Count> full_answers = nullptr;
};

template <typename Model>
hapbeam::Centreline<double> rest_of(const Model& model) {
  return model.shape();
}
template <typename Model>
hapbeam::Centreline<double> rest_of(const hapbeam::BeamArray<Model>& array) {
  return array.rest(0);
}

void show(const hapbeam::ServoPicture<double>& picture, std::vector<DrawnBeam>& beams) noexcept {
  beams[0].shape = picture.shape();
}
/// Those that are not pressed are at rest.
void show(const hapbeam::ArrayPicture<double>& picture, std::vector<DrawnBeam>& beams) noexcept {
  for (int i = 0; i < picture.size(); ++i)
    beams[static_cast<std::size_t>(picture.beam(i))].shape = picture.shape(i);
}

template <typename Model, typename Coupling>
class Live final : public Body {
 public:
  Live(Model model, Parts parts)
      : parts_(std::move(parts)),
        model_(std::move(model)),
        rest_(rest_of(model_)),
        servo_(model_, parts_.device, servo_options(parts_.options),
               make_coupling<Coupling>(parts_.options)) {
    for (int i = 0; i < parts_.options.beams; ++i) beams_.push_back({rest(), -parts_.options.pitch * i});
  }

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept override { return servo_.tick(state); }
  const hapbeam::ServoRecord& record() const noexcept override { return servo_.record(); }
  void reset() noexcept override { servo_.reset(); }
  const std::vector<DrawnBeam>& beams() noexcept override {
    for (DrawnBeam& beam : beams_) beam.shape = rest();
    show(servo_.picture(), beams_);
    return beams_;
  }
  hapbeam::Centreline<double> rest() const noexcept override { return rest_.shape(); }
  const hapbeam::TickTimes& times() const noexcept override { return servo_.times(); }
  std::uint64_t full_answers() const noexcept override {
    return parts_.full_answers ? parts_.full_answers->load() : 0;
  }
  const Options& options() const noexcept override { return parts_.options; }
  const hapbeam::Beam& beam() const noexcept override { return parts_.beam; }
  const Trained* trained() const noexcept override { return parts_.trained.get(); }

 private:
  Parts parts_;
  Model model_;
  hapbeam::ServoPicture<double> rest_;
  hapbeam::Servo<Model, Coupling> servo_;
  std::vector<DrawnBeam> beams_;
};

template <typename Model>
std::unique_ptr<Body> couple(Model model, Parts parts) {
  if (parts.options.coupling == CouplingChoice::direct)
    return std::make_unique<Live<Model, hapbeam::Direct>>(std::move(model), std::move(parts));
  return std::make_unique<Live<Model, hapbeam::VirtualCoupling>>(std::move(model), std::move(parts));
}

template <typename Element>
std::unique_ptr<Body> couple_full(Parts parts) {
  hapbeam::FemModel<Element> model(parts.beam, parts.options.elements);
  return couple(std::move(model), std::move(parts));
}

/// Below one another.  Teeth that bend far slip off the hand; other elements are for small turns.
std::unique_ptr<Body> couple_many(Parts parts) {
  const Options& options = parts.options;
  if (options.model_choice != ModelChoice::finite_elements || options.element != ElementChoice::corotational)
    throw cli::UsageError("--beams " + std::to_string(options.beams) + ": must be of --element corotational");
  std::vector<hapbeam::BeamPlace> places;
  for (int i = 0; i < options.beams; ++i) places.push_back({{0, -options.pitch * i}, 0, 0});
  using Tooth = hapbeam::FemModel<hapbeam::Corotational<>>;
  hapbeam::BeamArray<Tooth> array(Tooth(parts.beam, options.elements), places);
  return couple(std::move(array), std::move(parts));
}

std::unique_ptr<Body> couple_trained(Parts parts) {
  using Full = hapbeam::FemModel<>;
  const std::shared_ptr<const Trained> trained = parts.trained;
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!parts.options.guarded) return couple(fast, std::move(parts));
        parts.full_answers = std::make_unique<Count>(0);
        Counted<Fast, Full> guarded(fast, Full(parts.beam, parts.options.elements), *parts.full_answers);
        return couple(std::move(guarded), std::move(parts));
      },
      trained->model);
}

}  // namespace

std::unique_ptr<Body> make_body(const Options& options, std::shared_ptr<const Trained> trained,
                                const hapbeam::DeviceInfo& device) {
  using namespace hapbeam;
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
    case ElementChoice::assumed_strain: break;
  }
  return couple_full<VonKarman<AssumedStrain>>(std::move(parts));
}

}  // namespace phantom
