// Trained models for the tests.  They are made in trained.cpp alone, for an SVD takes seconds to compile.
#pragma once

#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/training/snapshots.hpp>

namespace hapbeam::testing {

/// Of the library's full_model() with so many elements.
PodModelData<double> trained_pod(const Beam& beam, const TrainingPlan& plan, int elements = 256);
GalerkinModelData<double> trained_galerkin(const Beam& beam, const TrainingPlan& plan, int elements = 256);
/// Of other elements and other snapshots.
PodModelData<double> trained_pod(const Snapshots& snapshots);
GalerkinModelData<double> trained_galerkin(const Snapshots& snapshots);
/// For models with EquispacedNodes.
PodModelData<double> trained_equispaced_pod(const Snapshots& snapshots);
GalerkinModelData<double> trained_equispaced_galerkin(const Snapshots& snapshots);

}  // namespace hapbeam::testing
