#include "instructions/strokes.hpp"
#include "once_training.hpp"
#include "support/thesis_beam.hpp"

void hapbeam::testing::trained() {
  const auto full = full_model(pinned(), 32);
  const auto plan = TrainingPlan::anywhere(pinned(), 0.05);
  const Vector2<double> top(1, 0.0227);
  press_and_slide("PodModel", PodModel<>(train_pod(take_snapshots(pinned(), full, plan))), 0.01, top, 0.04,
                  0.1);
  press_and_slide("GalerkinModel",
                  GalerkinModel<>(train_galerkin(take_snapshots_at_tensions(pinned(), full, plan))), 0.01,
                  top, 0.04, 0.1);
}
