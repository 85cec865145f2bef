// The command line: which beam, which presses, which model, and where it goes.
#pragma once

#include <string>
#include <vector>

#include "support/beam_options.hpp"
#include "support/command_line.hpp"
#include <hapbeam/rom/training/training_plan.hpp>

namespace train {

enum class Kind { pod, galerkin };
enum class Scalar { double_precision, single_precision };
/// How the number of modes is chosen: so many, or by what they leave out.
enum class Keep { modes, error, energy };

/// Everything in SI.
struct Options {
  cli::BeamOptions beam;
  Kind kind = Kind::pod;
  Scalar scalar = Scalar::double_precision;

  double from, to;     ///< [m] range of positions; equal for a single place
  double depth;        ///< [m]
  int positions = 16;  ///< 1 for a single place
  int depths = 12;     ///< or tensions
  int segments = 32;   ///< of the shape
  int elements = 256;  ///< of the full model
  int presses = 500;   ///< held out, for the stated error
  int threads = 0;     ///< 0: as many as the machine runs at once
  Keep keep = Keep::error;
  int modes = 0;           ///< of Keep::modes
  double left_out = 1e-4;  ///< of Keep::error
  double energy = 0;       ///< of Keep::energy

  std::string output = "beam.json";
  std::string plot;  ///< .svg or .png, or empty

  bool single_place() const { return from == to; }
  hapbeam::TrainingPlan plan() const;
};

/// Names as they are typed.
const char* name(Kind kind);
const char* name(Scalar scalar);

/// @throws cli::UsageError
Options parse(const std::vector<std::string>& arguments);
std::string help();

}  // namespace train
