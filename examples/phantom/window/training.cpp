#include "training.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/rom/training/validate.hpp>

namespace phantom {

namespace {

using namespace hapbeam;

constexpr int elements = 64;  // of the full model: its force is right to 1e-5

struct GivenUp : std::exception {};

/// As deep as the scene's script, from what `train` takes by default up to what the full model answers beside a support.
double trained_depth(const Options& o) {
  return std::clamp(o.depth * o.scale, 0.02 * o.beam.length, 0.024 * o.beam.length);
}

template <typename Model>
std::shared_ptr<const Trained> measured(typename Model::Data data, const Beam& beam) {
  ValidationOptions validation;
  validation.presses = 200;
  data.errors = validate(Model(data), full_model(beam, 2 * elements), validation);
  return std::make_shared<const Trained>(Model(data));
}

}  // namespace

Training::Training(const Options& options) : options_(options), thread_([this] { run(); }) {}

Training::~Training() {
  given_up_.store(true, std::memory_order_relaxed);
  thread_.join();
}

std::shared_ptr<const Trained> Training::result() const {
  if (failure_) std::rethrow_exception(failure_);
  return trained_;
}

void Training::run() {
  try {
    const Beam beam = options_.beam.make();
    const auto full = full_model(beam, elements);
    const TrainingPlan plan = TrainingPlan::anywhere(beam, trained_depth(options_));
    // One thread: the other cores are the servo's and the window's.
    const TrainingOptions training{1, [this](int done, int total) {
                                     if (given_up_.load(std::memory_order_relaxed)) throw GivenUp();
                                     done_.store(static_cast<double>(done) / total,
                                                 std::memory_order_relaxed);
                                   }};
    if (options_.model_choice == ModelChoice::pod)
      trained_ = measured<PodModel<>>(train_pod(take_snapshots(beam, full, plan, training)), beam);
    else
      trained_ = measured<GalerkinModel<>>(
          train_galerkin(take_snapshots_at_tensions(beam, full, plan, training)), beam);
  } catch (...) {
    failure_ = std::current_exception();
  }
  ended_.store(true, std::memory_order_release);
}

}  // namespace phantom
