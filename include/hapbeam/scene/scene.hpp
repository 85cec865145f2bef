// SPDX-License-Identifier: MIT
// The requirements of a scene: a beam, where and how deep it is pressed, and the tolerated error and time; the models among which it
// chooses, what each is expected to cost, and what choose() found, in numbers and in words.
//
// Plain data; the figures of TickCosts::typical() were measured on one processor (docs/benchmarks.md says which) and are meant to be
// compared with each other.  choose() takes others.
// Offline: throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/check.hpp>

namespace hapbeam {

namespace detail {

/// What a Scene and a RodScene have alike.   @param low, high [m] where it may be pressed
template <class S>
[[gnu::cold]] void check_scene(const S& scene, double low, double high, const char* body) {
  finite("s_min", scene.s_min, "m");
  finite("s_max", scene.s_max, "m");
  const char* const away = "a thousandth away from an end that is held";
  if (!(scene.s_min >= low && scene.s_min <= scene.s_max))
    refuse("s_min = %g m: must be on the %s, at most s_max, %s", scene.s_min, body, away);
  if (!(scene.s_max <= high)) refuse("s_max = %g m: must be on the %s, %s", scene.s_max, body, away);
  positive("depth", scene.depth, "m");
  positive("force_error", scene.force_error, "");
  not_negative("force_floor", scene.force_floor, "N");
  positive("tick", scene.tick, "s");
}

}  // namespace detail

struct Scene {
  Beam beam;
  double s_min, s_max;  ///< [m] where it is pressed; equal: at one place
  /// [m] How deep, from the untouched beam, to either side.  Beside a support no deeper than press() of Corotational<> answers, a third
  /// of the distance or so.  A beam that rests aside by more than a tenth of that limit needs a depth that is answered there from rest.
  double depth;
  double force_error = 0.05;  ///< largest relative error of the force; a hand tells forces apart from 7 % on
  double force_floor = 0;  ///< [N] smaller forces count as this one, where they change sign or cannot be felt
  double tick = 50e-6;     ///< [s] largest time of a press
  bool shape = true;  ///< contact and drawing want the shape in each tick; a hand at a known place may not

  /// Anywhere from 5 to 95 % of the length, or up to an end that yields.
  static Scene anywhere(const Beam& beam, double depth) {
    const double L = beam.length();
    return {beam, fixes_w(beam.left()) ? 0.05 * L : 0, fixes_w(beam.right()) ? 0.95 * L : L, depth};
  }
  static Scene at(const Beam& beam, double s, double depth) { return {beam, s, s, depth}; }

  bool one_place() const noexcept { return s_min == s_max; }

  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const Scene& check() const {
    const double margin = 0.999999 * beam.length() / 1000;
    detail::check_scene(*this, fixes_w(beam.left()) ? margin : 0,
                        beam.length() - (fixes_w(beam.right()) ? margin : 0), "beam");
    constexpr const char* allowed =
        "none: take FemModel<Tapered<>>, or FemModel<Corotational<Tapered<>>> for finite rotation";
    if (!beam.parts().empty())
      detail::reject("scene beam sections", static_cast<double>(beam.parts().size()), "", allowed);
    if (!beam.uniform()) detail::reject("scene beam shear stiffness", beam.shear_stiffness(), "N", allowed);
    return *this;
  }
};

/// fixed + per_unit × size, in seconds.
struct TickCost {
  double fixed, per_unit;
  double operator()(int size) const noexcept { return fixed + per_unit * size; }
};

/// A moving hand's press, from the press of a tick before.  Finite elements: by element.  Trained models: by snapshot.
struct TickCosts {
  TickCost linear, von_karman, corotational;
  TickCost pod_force, pod_shape, galerkin_force, galerkin_shape;
  TickCost round_rod, twisted_rod;  ///< pushes of rods in space, by element

  static TickCosts typical() noexcept {
    return {{170e-9, 70e-9},   {205e-9, 100e-9},  {300e-9, 207e-9},  {50e-9, 0.4e-9},   {190e-9, 0.77e-9},
            {178e-9, 0.58e-9}, {310e-9, 1.13e-9}, {1500e-9, 630e-9}, {2000e-9, 1250e-9}};
  }
};

enum class Kinematics { linear, von_karman, corotational, round_rod, twisted_rod };
enum class Reduction { none, pod, galerkin };

constexpr const char* name(Kinematics kinematics) noexcept {
  return detail::word_for<Kinematics::twisted_rod>(
      kinematics, {"Linear", "VonKarman", "Corotational", "RoundRod", "TwistedRod"});
}

/// One model: build() makes it.
struct Candidate {
  Kinematics kinematics;
  Reduction reduction;
  int elements;                   ///< of the model, or of the one that trains it
  int positions = 0, depths = 0;  ///< snapshots of a trained model; tensions for Galerkin's

  int snapshots() const noexcept { return positions * depths; }

  /// Expected time of a press [s].
  double tick(const TickCosts& costs, bool shape) const noexcept {
    if (reduction == Reduction::pod) return (shape ? costs.pod_shape : costs.pod_force)(snapshots());
    if (reduction == Reduction::galerkin)
      return (shape ? costs.galerkin_shape : costs.galerkin_force)(snapshots());
    const TickCost of_elements[] = {costs.linear, costs.von_karman, costs.corotational, costs.round_rod,
                                    costs.twisted_rod};  // as Kinematics counts
    return of_elements[static_cast<int>(kinematics)](elements);
  }

  /// In words, as "VonKarman, 8 elements" or "POD of VonKarman, 16 x 12 snapshots".
  std::string text() const {
    char text[120];
    if (reduction == Reduction::none)
      std::snprintf(text, sizeof text, "%s, %d elements", name(kinematics), elements);
    else
      std::snprintf(text, sizeof text, "%s of %s, %d x %d snapshots",
                    reduction == Reduction::pod ? "POD" : "Galerkin", name(kinematics), positions, depths);
    return text;
  }
};

/// What became of one family of models.
struct Verdict {
  Candidate candidate;  ///< its least size that is accurate enough; where none is, the best that was tried
  double error;  ///< [-] largest relative error of the force that was seen; infinite where it did not answer
  double tick;   ///< [s] expected time of a press
  bool right;    ///< whether the error is small enough
  std::string refusal;  ///< reason why it could not be built, or empty
};

struct Choice {
  std::optional<Candidate> candidate;  ///< empty where no model is admissible
  std::vector<Verdict> verdicts;       ///< of every family
  double force_error;                  ///< [-] that was allowed
  double tick;                         ///< [s] that was allowed
  std::string advice;                  ///< what to relax, where no model is admissible
  double first_mode = 0;               ///< [Hz] of what is pressed; 0 where it has no density

  /// @throws std::runtime_error with the advice, where no model is admissible
  const Candidate& model() const {
    if (!candidate) throw std::runtime_error(advice);
    return *candidate;
  }

  /// The choice, and a line for each family: which bound rejected it, or what it would cost; and from which frequency of the hand on
  /// its mass, which none of them has, is more than 7 % of the force.
  std::string text() const {
    std::string out = candidate ? "chosen: " + candidate->text() + "\n" : advice + "\n";
    for (const Verdict& verdict : verdicts)
      out += "  " + verdict.candidate.text() + ": " + reason(verdict) + "\n";
    char text[120] = "";
    const char* const mass =
        "  first mode %.2g Hz: a hand feels mass at more than %.2g Hz, take DynamicModel there\n";
    if (first_mode > 0) std::snprintf(text, sizeof text, mass, first_mode, first_mode / 4);
    return out + text;
  }

  std::string reason(const Verdict& verdict) const {
    if (!verdict.refusal.empty()) return "not built: " + verdict.refusal;
    char text[160];
    const double percent = 100 * verdict.error, micro = 1e6 * verdict.tick;
    const bool elements = verdict.candidate.reduction == Reduction::none;
    if (!std::isfinite(verdict.error)) std::snprintf(text, sizeof text, "does not answer all presses");
    else if (!verdict.right)
      std::snprintf(text, sizeof text, "force error %.2g %% %s; allowed %.2g %%", percent,
                    elements ? "with any number of elements" : "at best", 100 * force_error);
    else if (verdict.tick > tick)
      std::snprintf(text, sizeof text, "force within %.2g %%, but %.2g us a press; allowed %.2g us", percent,
                    micro, 1e6 * tick);
    else std::snprintf(text, sizeof text, "force within %.2g %%, %.2g us a press", percent, micro);
    return text;
  }
};

}  // namespace hapbeam
