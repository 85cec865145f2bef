// Training for the benchmarks, with its time.  Compiled once: an SVD takes longer to compile than all else here.
#pragma once

#include <hapbeam/rom/trained/lagrange.hpp>
#include <hapbeam/rom/trained/model_data.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam::benchmarks {

template <class Data>
struct Trained {
  Data data;
  double snapshots_ms;  // presses of the full model, positions shared out to all processors
  double pod_ms;        // the rest of the training: decomposition and tables
};

/// @param elements  of the full model   @param validated  fills data.errors, by the same full model
/// @param modes  of the shape; 0: as many as the default truncation keeps
template <class Nodes = ChebyshevNodes>
Trained<PodModelData<double>> time_pod_training(const Beam& beam, const TrainingPlan& plan,
                                                int elements = 256, bool validated = false, int modes = 0);
Trained<GalerkinModelData<double>> time_galerkin_training(const Beam& beam, const TrainingPlan& plan,
                                                          int elements = 256, bool validated = false);

}  // namespace hapbeam::benchmarks
