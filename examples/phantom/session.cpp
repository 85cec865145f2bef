#include "session.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <type_traits>
#include <utility>

#include "counted.hpp"
#include "scene.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo.hpp>
#include <hapbeam/haptics/virtual_phantom.hpp>

namespace phantom {

namespace {

using Device = hapbeam::VirtualPhantom<Guided>;
using Count = std::atomic<std::uint64_t>;

/// A servo whose ticks are taped.
template <typename Servo>
struct Taped {
  Servo& servo;
  const Hand& hand;
  Tape& tape;

  Eigen::Vector3d operator()(const hapbeam::DeviceState& state) noexcept {
    const auto begin = std::chrono::steady_clock::now();
    const Eigen::Vector3d force = servo.tick(state);
    const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
    tape.add({servo.record(), hand.last(), duration.count()});
    return force;
  }
};

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
Coupling make_coupling(const Options& options, const hapbeam::DeviceInfo& device) {
  if constexpr (std::is_same_v<Coupling, hapbeam::Direct>) return {};
  else return Coupling({options.stiffness, options.damping}, device.period);
}

template <typename Model, typename Coupling>
class Live final : public Session {
 public:
  Live(Model model, const Options& options, Hand& hand, Tape& tape, std::unique_ptr<Count> full_answers)
      : full_answers_(std::move(full_answers)),
        model_(std::move(model)),
        device_(Guided{&hand}),
        options_(filled_in(options, device_.info())),
        servo_(model_, device_.info(), servo_options(options_),
               make_coupling<Coupling>(options_, device_.info())),
        taped_{servo_, hand, tape} {}
  ~Live() override { device_.stop(); }

  void start() override {
    device_.stop();
    servo_.reset();
    device_.start(taped_);
  }
  void stop() noexcept override { device_.stop(); }
  void run(double duration) noexcept override { device_.run(taped_, duration); }
  Picture picture() noexcept override {
    const auto& picture = servo_.picture();
    return {picture.record, picture.shape()};
  }
  const hapbeam::TickTimes& times() const noexcept override { return servo_.times(); }
  const hapbeam::DeviceInfo& device() const noexcept override { return device_.info(); }
  hapbeam::DeviceCounts counts() const noexcept override { return device_.counts(); }
  std::uint64_t full_answers() const noexcept override { return full_answers_ ? full_answers_->load() : 0; }
  const Options& options() const noexcept override { return options_; }

 private:
  using Servo = hapbeam::Servo<Model, Coupling>;

  std::unique_ptr<Count> full_answers_;
  Model model_;
  Device device_;
  Options options_;
  Servo servo_;
  Taped<Servo> taped_;
};

template <typename Model>
std::unique_ptr<Session> couple(Model model, const Options& options, Hand& hand, Tape& tape,
                                std::unique_ptr<Count> full_answers = nullptr) {
  if (options.coupling == CouplingChoice::direct)
    return std::make_unique<Live<Model, hapbeam::Direct>>(std::move(model), options, hand, tape,
                                                          std::move(full_answers));
  return std::make_unique<Live<Model, hapbeam::VirtualCoupling>>(std::move(model), options, hand, tape,
                                                                 std::move(full_answers));
}

template <typename Element>
std::unique_ptr<Session> couple_full(const Options& options, Hand& hand, Tape& tape) {
  return couple(hapbeam::FemModel<Element>(options.beam.make(), options.elements), options, hand, tape);
}

std::unique_ptr<Session> couple_trained(const Trained& trained, const Options& options, Hand& hand,
                                        Tape& tape) {
  using Full = hapbeam::FemModel<>;
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!options.guarded) return couple(fast, options, hand, tape);
        auto count = std::make_unique<Count>(0);
        const Full full(trained.make_beam(), options.elements);
        Counted<Fast, Full> guarded(fast, full, *count);
        return couple(std::move(guarded), options, hand, tape, std::move(count));
      },
      trained.model);
}

}  // namespace

std::unique_ptr<Session> make_session(const Options& options, const Trained* trained, Hand& hand,
                                      Tape& tape) {
  using namespace hapbeam;
  if (trained) return couple_trained(*trained, options, hand, tape);
  switch (options.element) {
    case ElementChoice::linear: return couple_full<Linear>(options, hand, tape);
    case ElementChoice::full: return couple_full<VonKarman<FullIntegration>>(options, hand, tape);
    case ElementChoice::reduced: return couple_full<VonKarman<ReducedIntegration>>(options, hand, tape);
    case ElementChoice::corotational: return couple_full<Corotational<>>(options, hand, tape);
    case ElementChoice::assumed_strain: break;
  }
  return couple_full<VonKarman<AssumedStrain>>(options, hand, tape);
}

}  // namespace phantom
