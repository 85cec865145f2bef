// Which beam: a named one, changed figure by figure.
#pragma once

#include <string>

#include "command_line.hpp"
#include <hapbeam/beam.hpp>

namespace cli {

/// Everything in SI; the thesis' beam unless something else is chosen.
struct BeamOptions {
  BeamOptions();

  std::string name;  ///< or "custom" where a figure of it was changed
  double length, width, height, young;
  hapbeam::Support left, right;

  /// @throws UsageError where it is a mechanism
  hapbeam::Beam make() const;
};

/// Names of the two ends, as they are typed: pinned-pinned.
std::string ends(hapbeam::Support left, hapbeam::Support right);
/// One line.
std::string describe(const BeamOptions& beam);

/// --beam, --length, --width, --height, --young, --ends.   @param beam  kept by reference
Entries beam_entries(BeamOptions& beam);

}  // namespace cli
