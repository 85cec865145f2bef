// From a plan to a model and its measured error.
//
// The one source file that compiles an SVD is behind this.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "options.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/validate.hpp>

namespace train {

using AnyModel = std::variant<hapbeam::PodModel<double>, hapbeam::PodModel<float>,
                              hapbeam::GalerkinModel<double>, hapbeam::GalerkinModel<float>>;

struct Stage {
  std::string name;
  double seconds;
};

struct Result {
  std::optional<AnyModel> model;             ///< with the report below; there once run() returns
  std::vector<double> singular_values;       ///< of the shapes, descending
  int modes = 0;                             ///< kept
  int columns = 0;                           ///< depths or tensions that were trained at each position
  std::vector<hapbeam::PressError> presses;  ///< held out
  hapbeam::ErrorReport errors;               ///< of them
  std::vector<Stage> stages;
};

/// Called after each press of the full model, by one thread at a time; what it throws ends the training.
using Progress = std::function<void(int done, int total)>;

/// @throws hapbeam::TrainingError, std::invalid_argument
Result run(const Options& options, const Progress& progress);

}  // namespace train
