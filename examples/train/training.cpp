#include "training.hpp"

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include <hapbeam/rom/training/train.hpp>

namespace train {

namespace {

using namespace hapbeam;

Truncation truncation(const Options& o) {
  switch (o.keep) {
    case Keep::modes: return Truncation::count(o.modes);
    case Keep::energy: return Truncation::energy(o.energy);
    case Keep::error: break;
  }
  return Truncation::error(o.left_out);
}

template <typename Work>
auto timed(std::vector<Stage>& stages, const char* name, const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  auto result = work();
  stages.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()});
  return result;
}

/// @throws TrainingError where interpolation makes something else than a beam of the numbers
template <typename Model>
Model make(const typename Model::Data& data) {
  try {
    return Model(data);
  } catch (const std::invalid_argument& error) {
    throw TrainingError(
        std::string("these presses make no model, more --depths, more --positions or less --depth may (") +
        error.what() + ")");
  }
}

/// The error is that of the model as it will be used, in its own scalar, and stays with it.  The reference has twice
/// the elements that trained, so that what those leave out is measured too.
template <typename Model>
Result measured(const typename Model::Data& trained, const Options& options, Result result) {
  const Model model = make<Model>(trained);
  const int elements = 2 * options.elements;
  const auto full = full_model(options.beam.make(), elements);
  ValidationOptions validation;
  validation.presses = options.presses;
  if (options.single_place()) validation.s_regions = 1;
  result.presses = timed(result.stages, "validation", [&] { return press_errors(model, full, validation); });
  typename Model::Data data = trained;
  data.errors =
      report_errors(model, full, result.presses, validation, std::to_string(elements) + " finite elements");
  result.errors = data.errors;
  result.model.emplace(Model(data));
  return result;
}

}  // namespace

Result run(const Options& options, const Progress& progress) {
  const Beam beam = options.beam.make();
  const auto full = full_model(beam, options.elements);
  const TrainingPlan plan = options.plan();
  const TrainingOptions training{options.threads, progress};
  const bool pod = options.kind == Kind::pod, in_float = options.scalar == Scalar::single_precision;

  Result result;
  const Snapshots snapshots = timed(result.stages, "presses", [&] {
    return pod ? take_snapshots(beam, full, plan, training)
               : take_snapshots_at_tensions(beam, full, plan, training);
  });
  result.columns = snapshots.columns;
  timed(result.stages, "modes", [&] {
    const Pod<> shapes(snapshot_matrix(snapshots), truncation(options));
    const Eigen::VectorXd& sigma = shapes.singular_values();
    result.singular_values.assign(sigma.data(), sigma.data() + sigma.size());
    return result.modes = shapes.modes();
  });
  const Truncation kept = Truncation::count(result.modes);
  if (pod) {
    const auto data = timed(result.stages, "interpolation", [&] { return train_pod(snapshots, kept); });
    if (in_float) return measured<PodModel<float>>(cast<float>(data), options, std::move(result));
    return measured<PodModel<>>(data, options, std::move(result));
  }
  const auto data = timed(result.stages, "interpolation", [&] { return train_galerkin(snapshots, kept); });
  if (in_float) return measured<GalerkinModel<float>>(cast<float>(data), options, std::move(result));
  return measured<GalerkinModel<>>(data, options, std::move(result));
}

}  // namespace train
