// Which beam, or rod in space: a named one, changed figure by figure.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/rod.hpp>

namespace cli {

/// In its plane, as a Beam, or in space, as a Rod.
enum class Bends { in_plane, in_space };
constexpr const char* name(Bends bends) { return bends == Bends::in_plane ? "beam" : "rod"; }

/// A part with a section of its own, which changes linearly along it.
struct SectionPart {
  double end;                    ///< [m] where it ends, from the left end
  double width, height;          ///< [m] where it begins
  double end_width, end_height;  ///< [m] where it ends
};

/// A dead force at one point.
struct PointForce {
  double s;        ///< [m] from the left end
  double x, y, z;  ///< [N]; z of a rod alone
};

/// Everything in SI; the thesis' beam unless something else is chosen.
struct BeamOptions {
  BeamOptions();

  std::string name;  ///< or "custom" where a figure of it was changed
  Bends bends = Bends::in_plane;
  double length, width, height, young;
  double material_density;  ///< [kg/m³], felt where it has mass
  hapbeam::Support left, right;
  bool round = false;                 ///< circular sections, of diameter height
  double rise = 0;                    ///< [m] of an arch, whose span is the length; 0: straight
  double tension = 0;                 ///< [N] that stretches it
  std::vector<SectionPart> parts;     ///< empty: prismatic
  std::vector<hapbeam::RodArc> arcs;  ///< natural shape of a rod; empty: straight
  std::vector<PointForce> forces;     ///< dead loads
  double density = 0;                 ///< [kg/m³]; 0: without weight
  double gravity = -9.81;             ///< [m/s²] along y

  bool in_space() const { return bends == Bends::in_space; }
  /// [m] Thickness of the round surface that an avatar touches: that in its middle.
  double touched() const;

  /// @throws UsageError where it is a mechanism, an arch on two kinds of ends, or a rod in space
  hapbeam::Beam make() const;
  /// @throws UsageError where it is none, a mechanism, or has ends that a rod has not
  hapbeam::Rod make_rod() const;
  /// @param left_end  in place of its own support there
  hapbeam::Rod make_rod(const hapbeam::RodSupport& left_end) const;
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
