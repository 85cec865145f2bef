#include "training.hpp"

#include <chrono>

#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/rom/training/validate.hpp>

namespace hapbeam::benchmarks {

namespace {

/// @param take, train  the two halves of the training
template <class Model, class Take, class Train>
Trained<typename Model::Data> timed(const Beam& beam, int elements, bool validated, const Take& take,
                                    const Train& train) {
  using Clock = std::chrono::steady_clock;
  const auto ms = [](Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
  };
  const auto full = full_model(beam, elements);
  const auto begin = Clock::now();
  const Snapshots snapshots = take(full);
  const auto between = Clock::now();
  Trained<typename Model::Data> trained{train(snapshots), ms(between - begin), 0};
  trained.pod_ms = ms(Clock::now() - between);
  if (validated) trained.data.errors = validate(Model(trained.data), full);
  return trained;
}

}  // namespace

template <class Nodes>
Trained<PodModelData<double>> time_pod_training(const Beam& beam, const TrainingPlan& plan, int elements,
                                                bool validated, int modes) {
  const Truncation truncation = modes > 0 ? Truncation::count(modes) : Truncation::error(1e-4);
  return timed<PodModel<double, Nodes>>(
      beam, elements, validated, [&](const auto& full) { return take_snapshots<Nodes>(beam, full, plan); },
      [&](const Snapshots& snapshots) { return train_pod<Nodes>(snapshots, truncation); });
}
template Trained<PodModelData<double>> time_pod_training<ChebyshevNodes>(const Beam&, const TrainingPlan&,
                                                                         int, bool, int);
template Trained<PodModelData<double>> time_pod_training<EquispacedNodes>(const Beam&, const TrainingPlan&,
                                                                          int, bool, int);

Trained<GalerkinModelData<double>> time_galerkin_training(const Beam& beam, const TrainingPlan& plan,
                                                          int elements, bool validated) {
  return timed<GalerkinModel<>>(
      beam, elements, validated,
      [&](const auto& full) { return take_snapshots_at_tensions(beam, full, plan); },
      [](const Snapshots& snapshots) { return train_galerkin(snapshots); });
}

}  // namespace hapbeam::benchmarks
