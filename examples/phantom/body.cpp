#include "body.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "counted.hpp"
#include "scene.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>

namespace phantom {

namespace {

using Count = std::atomic<std::uint64_t>;

/// From the centreline to the avatar's centre [m].
double reach_of(const Options& options) { return options.radius + options.beam.touched() / 2; }

/// Where the centreline is at rest that is to be pressed [m].
Eigen::Vector3d pressed(const Options& options, const hapbeam::Centreline<double>&) {
  return {options.place, options.beam.rest(options.place), 0};
}
Eigen::Vector3d pressed(const Options& options, const hapbeam::Centreline<double, 3>& rest) {
  return rest.at(options.place).r;
}

template <int D>
hapbeam::ServoOptions servo_options(const Options& options, const hapbeam::Centreline<double, D>& rest) {
  hapbeam::ServoOptions servo;
  servo.placement = placement(pressed(options, rest), reach_of(options), options.scale);
  servo.avatar_radius = options.radius;
  servo.friction = hapbeam::Friction(options.friction, options.friction);
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
  Slender slender;
  std::shared_ptr<const Trained> trained;
  hapbeam::DeviceInfo device;
  std::unique_ptr<Count> full_answers = nullptr;
};

template <typename Model>
auto rest_of(const Model& model) {
  return model.shape();
}
template <typename Model>
hapbeam::Centreline<double> rest_of(const hapbeam::BeamArray<Model>& array) {
  return array.rest(0);
}

template <int D>
void show(const hapbeam::ServoPicture<double, D>& picture, std::vector<DrawnBeam>& beams) noexcept {
  beams[0].shape = picture.shape();
}
/// Those that are not pressed are at rest.
void show(const hapbeam::ArrayPicture<double>& picture, std::vector<DrawnBeam>& beams) noexcept {
  for (int i = 0; i < picture.size(); ++i)
    beams[static_cast<std::size_t>(picture.beam(i))].shape = picture.shape(i);
}

template <typename Model, typename Coupling>
class Live final : public Body {
  static constexpr int dimension = hapbeam::dimension_of<Model>;

 public:
  Live(Model model, Parts parts)
      : parts_(std::move(parts)),
        model_(std::move(model)),
        rest_(rest_of(model_)),
        servo_options_(servo_options(parts_.options, rest_.shape())),
        servo_(model_, parts_.device, servo_options_, make_coupling<Coupling>(parts_.options)) {
    for (int i = 0; i < parts_.options.beams; ++i) beams_.push_back({rest(), -parts_.options.pitch * i});
  }

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept override {
    const double before = record().dissipated;
    const Eigen::Vector3d force = servo_.tick(state);
    dissipated_ += record().dissipated < before ? record().dissipated : record().dissipated - before;
    if constexpr (dimension == 3) deepest_ = std::max(deepest_, depth(record()));
    if constexpr (hapbeam::has_internal_forces<Model>)
      if (record().pressing && record().ticks % 8 == 0)
        if (const auto peak = hapbeam::peak_strain(model_); peak.strain > peak_.strain) peak_ = peak;
    return force;
  }
  const hapbeam::ServoRecord& record() const noexcept override { return servo_.record(); }
  void reset() noexcept override {
    servo_.reset();
    deepest_ = 0;
    peak_ = {0, 0};
    dissipated_ = 0;
  }
  const std::vector<DrawnBeam>& beams() noexcept override {
    for (DrawnBeam& beam : beams_) beam.shape = rest();
    show(servo_.picture(), beams_);
    return beams_;
  }
  Shape rest() const noexcept override { return rest_.shape(); }
  const hapbeam::Placement& placement() const noexcept override { return servo_options_.placement; }
  double depth(const hapbeam::ServoRecord& r) const noexcept override {
    const Options& o = parts_.options;
    if (!r.pressing) return 0;
    if constexpr (dimension == 2) return o.beam.rest(r.press.s) - r.press.d;
    // Along the normal; the device's axes are the scene's.
    else if (const double force = r.force.norm(); force > 0)
      return r.force.dot(rest_.shape().at(r.press.s).r - r.avatar) / force + reach_of(o);
    return 0;
  }
  double deepest() const noexcept override { return dimension == 3 ? deepest_ : record().max_press; }
  hapbeam::PeakStrain<double> peak() const noexcept override { return peak_; }
  double dissipated() const noexcept override { return dissipated_; }
  const hapbeam::TickTimes& times() const noexcept override { return servo_.times(); }
  std::uint64_t full_answers() const noexcept override {
    return parts_.full_answers ? parts_.full_answers->load() : 0;
  }
  const Options& options() const noexcept override { return parts_.options; }
  const Slender& slender() const noexcept override { return parts_.slender; }
  const Trained* trained() const noexcept override { return parts_.trained.get(); }

 private:
  Parts parts_;
  Model model_;
  hapbeam::ServoPicture<double, dimension> rest_;
  hapbeam::ServoOptions servo_options_;
  hapbeam::Servo<Model, Coupling> servo_;
  std::vector<DrawnBeam> beams_;
  double deepest_ = 0;  // [m] of a rod
  hapbeam::PeakStrain<double> peak_{0, 0};
  double dissipated_ = 0;  // [J]
};

template <typename Model>
std::unique_ptr<Body> couple(Model model, Parts parts) {
  if (parts.options.coupling == CouplingChoice::direct)
    return std::make_unique<Live<Model, hapbeam::Direct>>(std::move(model), std::move(parts));
  return std::make_unique<Live<Model, hapbeam::VirtualCoupling>>(std::move(model), std::move(parts));
}

template <typename Element>
std::unique_ptr<Body> couple_full(Parts parts) {
  using Model = hapbeam::FemModel<Element>;
  Model model(std::get<typename Model::Body>(parts.slender), parts.options.elements);
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
  hapbeam::BeamArray<Tooth> array(Tooth(std::get<hapbeam::Beam>(parts.slender), options.elements), places);
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
        Counted<Fast, Full> guarded(
            fast, Full(std::get<hapbeam::Beam>(parts.slender), parts.options.elements), *parts.full_answers);
        return couple(std::move(guarded), std::move(parts));
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
    case ElementChoice::assumed_strain:
    case ElementChoice::round_rod:
    case ElementChoice::twisted_rod: break;
  }
  return couple_full<VonKarman<AssumedStrain>>(std::move(parts));
}

}  // namespace phantom
