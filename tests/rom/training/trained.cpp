#include "rom/training/trained.hpp"

#include "once_training.hpp"
#include <hapbeam/rom/training/train.hpp>

namespace hapbeam::testing {

PodModelData<double> trained_pod(const Snapshots& snapshots) { return train_pod(snapshots); }
GalerkinModelData<double> trained_galerkin(const Snapshots& snapshots) { return train_galerkin(snapshots); }

PodModelData<double> trained_equispaced_pod(const Snapshots& snapshots) {
  return train_pod<EquispacedNodes>(snapshots);
}
GalerkinModelData<double> trained_equispaced_galerkin(const Snapshots& snapshots) {
  return train_galerkin<EquispacedNodes>(snapshots);
}

PodModelData<double> trained_pod(const Beam& beam, const TrainingPlan& plan, int elements) {
  return train_pod(take_snapshots(beam, full_model(beam, elements), plan));
}
GalerkinModelData<double> trained_galerkin(const Beam& beam, const TrainingPlan& plan, int elements) {
  return train_galerkin(take_snapshots_at_tensions(beam, full_model(beam, elements), plan));
}

}  // namespace hapbeam::testing
