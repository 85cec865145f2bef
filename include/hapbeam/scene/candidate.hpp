// SPDX-License-Identifier: MIT
// The models among which a scene chooses, and what each is expected to cost.
//
// Plain data.
#pragma once

#include <cstdio>
#include <string>

#include <hapbeam/scene/tick_costs.hpp>

namespace hapbeam {

enum class Kinematics {
  linear,
  von_karman,
  corotational,
  round_rod,
  twisted_rod
};  ///< the last two: of rods
enum class Reduction { none, pod, galerkin };

constexpr const char* name(Kinematics kinematics) noexcept {
  switch (kinematics) {
    case Kinematics::linear: return "Linear";
    case Kinematics::von_karman: return "VonKarman";
    case Kinematics::corotational: return "Corotational";
    case Kinematics::round_rod: return "RoundRod";
    case Kinematics::twisted_rod: return "TwistedRod";
  }
  return "unknown";
}

/// One model: build() makes it.
struct Candidate {
  Kinematics kinematics;
  Reduction reduction;
  int elements;           ///< of the model, or of the one that trains it
  bool mirrored = false;  ///< half of the beam, with half of the elements
  int positions = 0,
      depths = 0;        ///< snapshots of a trained model, at Chebyshev's nodes; tensions for Galerkin's
  bool turning = false;  ///< planar, of a rod in space: TurningPlane

  int snapshots() const noexcept { return positions * depths; }

  /// Expected time of a press [s].
  double tick(const TickCosts& costs, bool shape) const noexcept {
    if (reduction == Reduction::pod) return (shape ? costs.pod_shape : costs.pod_force)(snapshots());
    if (reduction == Reduction::galerkin)
      return (shape ? costs.galerkin_shape : costs.galerkin_force)(snapshots());
    const TickCost& cost = kinematics == Kinematics::linear        ? costs.linear
                           : kinematics == Kinematics::von_karman  ? costs.von_karman
                           : kinematics == Kinematics::round_rod   ? costs.round_rod
                           : kinematics == Kinematics::twisted_rod ? costs.twisted_rod
                                                                   : costs.corotational;
    return cost(mirrored ? elements / 2 : elements);
  }

  /// In words, as "VonKarman, 8 elements" or "POD of VonKarman, 16 x 12 snapshots".
  std::string text() const {
    const char* const plane = turning ? ", in the plane that turns" : "";
    char text[120];
    if (reduction == Reduction::none)
      std::snprintf(text, sizeof text, "%s, %d elements%s%s", name(kinematics), elements,
                    mirrored ? ", half of them by symmetry" : "", plane);
    else
      std::snprintf(text, sizeof text, "%s of %s, %d x %d snapshots%s",
                    reduction == Reduction::pod ? "POD" : "Galerkin", name(kinematics), positions, depths,
                    plane);
    return text;
  }
};

}  // namespace hapbeam
