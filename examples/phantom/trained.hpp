// A trained model, whichever kind it is, and what the user should know of it.
#pragma once

#include <string>
#include <variant>

#include "options.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace phantom {

struct Trained {
  explicit Trained(const hapbeam::PodModel<>& pod);
  explicit Trained(const hapbeam::GalerkinModel<>& galerkin);

  std::variant<hapbeam::PodModel<>, hapbeam::GalerkinModel<>> model;
  const char* kind;                ///< pod | galerkin
  hapbeam::BeamData<double> beam;  ///< in SI
  double s_min, s_max, depth;      ///< [m] the trained range
  int positions, columns;          ///< of the grid: columns are depths or tensions
  int modes;                       ///< of the shape
  bool loaded;                     ///< trained under dead loads, which the model does not keep
  hapbeam::ErrorReport errors;     ///< stated when it was trained

  /// The same beam for a full model.
  hapbeam::Beam make_beam() const {
    return {beam.length, beam.axial_stiffness, beam.bending_stiffness, beam.thickness, beam.left, beam.right};
  }
};

/// The model of options.model; its beam and range take the place of those in the options.
/// @throws cli::UsageError where that cannot be; what load_model throws for a file that is not right
Trained load(Options& options);

}  // namespace phantom
