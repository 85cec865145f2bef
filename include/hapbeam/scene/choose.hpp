// SPDX-License-Identifier: MIT
// The least model that a scene needs.
//
//   Scene scene = Scene::anywhere(beam, 0.02);
//   scene.force_error = 0.02, scene.tick = 20e-6;
//   const Choice choice = choose(scene);
//   std::puts(choice.text().c_str());                 // what was chosen, and which bound rejected what
//   SceneModel model = build(scene, choice.model());
//
// Each family of models (three kinematics, halves of the beam where the scene is symmetric, two reductions) is tried at
// growing size on the presses of a Pilot until its error is well below the tolerated one; of those that get there within the
// time, the cheapest is chosen.  There are no rules for kinds of beams: these presses are all that is known of a scene.
// Offline: allocates; takes tens of milliseconds, seconds for thin beams under dead loads; throws std::invalid_argument for a scene that makes no sense.
#pragma once

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <utility>

#include <hapbeam/scene/build.hpp>
#include <hapbeam/scene/choice.hpp>
#include <hapbeam/scene/deciding.hpp>
#include <hapbeam/scene/pilot.hpp>

namespace hapbeam {

namespace detail {

class Chooser : Deciding {
 public:
  Chooser(const Scene& scene, const TickCosts& costs)
      : Deciding(scene.force_error, scene.tick), scene_(scene), costs_(costs), pilot_(scene) {
    own_error_ = pilot_.own_error();
  }

  Choice choose() {
    for (const Kinematics kinematics :
         {Kinematics::linear, Kinematics::von_karman, Kinematics::corotational}) {
      elements(kinematics, false);
      if (scene_.mirrored() && kinematics != Kinematics::linear) elements(kinematics, true);
    }
    // The model that trains costs nothing in a tick, so the most accurate one is taken.  Galerkin's equation is von Kármán's.
    trained(Reduction::pod, Kinematics::corotational);
    trained(Reduction::galerkin, Kinematics::von_karman);
    decide();
    return std::move(choice_);
  }

 private:
  static constexpr double nothing = std::numeric_limits<double>::infinity();

  void elements(Kinematics kinematics, bool mirrored) {
    fewest(pilot_.elements(), mirrored ? 4 : 2, mirrored ? 2 : 1, [&](int n) {
      return judge({kinematics, Reduction::none, n, mirrored});
    });
  }

  /// Interpolation: first as many depths as one place takes, then as many places.
  void trained(Reduction reduction, Kinematics kinematics) {
    const Verdict& full = of(kinematics);
    // Fourth order: twice the elements leave a sixteenth of the error to the full model.
    Candidate candidate{kinematics, reduction, 2 * full.candidate.elements, false, 1, 2};
    Verdict verdict{candidate, nothing, candidate.tick(costs_, scene_.shape), false, {}};
    if (!full.right)
      verdict.refusal =
          std::string(name(kinematics)) + ", which would train it, is not accurate enough itself";
    const auto grow = [&] {
      const Verdict larger = judge(candidate);
      if (larger.error < verdict.error || verdict.refusal.empty()) verdict = larger;
      return verdict.right;
    };
    constexpr std::array<int, 9> all_depths{2, 3, 4, 6, 8, 12, 16, 24, 32};
    auto depths = all_depths.begin();
    for (; depths != all_depths.end(); ++depths) {
      candidate.depths = *depths;
      if (!full.right || (scene_.one_place() ? grow() : enough_depths(candidate))) break;
    }
    for (const int positions : {3, 4, 6, 8, 12, 16, 24, 32, 48}) {
      candidate.positions = positions;
      const double before = verdict.error;
      if (!full.right || scene_.one_place() || grow()) break;
      // More places that help no more leave the error to the depths, which have been looked at in three places.
      if (verdict.error <= before / 2 || depths == all_depths.end() || ++depths == all_depths.end()) continue;
      candidate.depths = *depths;
      if (grow()) break;
    }
    choice_.verdicts.push_back(verdict);
  }

  /// Of one kinematics by itself, on the whole beam.
  const Verdict& of(Kinematics kinematics) const {
    const auto is = [&](const Verdict& verdict) { return verdict.candidate.kinematics == kinematics; };
    return *std::find_if(choice_.verdicts.begin(), choice_.verdicts.end(), is);
  }

  bool enough_depths(const Candidate& candidate) const {
    try {
      for (const double s : pilot_.places()) {
        Scene place = scene_;
        place.s_min = place.s_max = s;
        SceneModel model = detail::build(place, candidate, 2);
        if (!(pilot_.error_at(model, s) <= 0.8 * wanted(candidate))) return false;
      }
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  Verdict judge(const Candidate& candidate) {
    return Deciding::judge(candidate, candidate.tick(costs_, scene_.shape), [&] {
      SceneModel model = detail::build(scene_, candidate, 2);
      return pilot_.error(model);
    });
  }

  const Scene& scene_;
  const TickCosts& costs_;
  Pilot pilot_;
};

}  // namespace detail

/// @param costs  what presses cost on the machine that will run them
/// @throws std::invalid_argument for a scene that makes no sense
inline Choice choose(const Scene& scene, const TickCosts& costs = TickCosts::typical()) {
  return detail::Chooser(scene, costs).choose();
}

}  // namespace hapbeam
