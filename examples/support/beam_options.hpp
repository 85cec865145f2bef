// Which beam, or rod in space: a named one, changed figure by figure.
#pragma once

#include <string>

#include "command_line.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/rod.hpp>

namespace cli {

/// What a rod in space is by nature; none: a beam, which bends in its plane.
enum class RodShape { none, straight, tapered, hook };

/// Everything in SI; the thesis' beam unless something else is chosen.
struct BeamOptions {
  BeamOptions();

  std::string name;  ///< or "custom" where a figure of it was changed
  double length, width, height, young;
  hapbeam::Support left, right;
  bool round = false;  ///< a circular section, of diameter height
  double rise = 0;     ///< [m] of an arch, whose span is the length; 0: straight
  double tension = 0;  ///< [N] that stretches it
  RodShape rod = RodShape::none;
  double hanging = 0;  ///< [N] weight that hangs from the right end of a rod

  bool in_space() const { return rod != RodShape::none; }
  /// [m] Thickness of the round surface that an avatar touches: of a taper that in its middle.
  double touched() const { return rod == RodShape::tapered ? 0.625 * height : height; }

  /// @throws UsageError where it is a mechanism, an arch on two kinds of ends, or a rod in space
  hapbeam::Beam make() const;
  /// @throws UsageError where it is none, a mechanism, or has ends that a rod has not
  hapbeam::Rod make_rod() const;
  /// Where its centreline is before it is touched; beside it, where the nearer end is.  @param x [m]   @return w [m]
  double rest(double x) const;
};

/// Takes a named beam.  @throws UsageError
void set_beam(BeamOptions& options, const std::string& label);
/// Names of the two ends, as they are typed: pinned-pinned.
std::string ends(hapbeam::Support left, hapbeam::Support right);
/// One line.
std::string describe(const BeamOptions& beam);

/// --beam, --length, --width, --height, --young, --ends, --rise, --tension.   @param beam  kept by reference
Entries beam_entries(BeamOptions& beam);

}  // namespace cli
