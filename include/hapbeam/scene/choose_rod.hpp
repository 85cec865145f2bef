// SPDX-License-Identifier: MIT
// The least model that a scene in space needs.
//
//   RodScene scene = RodScene::anywhere(rod, 0.01);
//   const Choice choice = choose(scene);
//   RodModel model = build(scene, choice.model());
//
// A rod that answers in any plane alike is chosen for as a beam is (choose.hpp), and its model turned (turning_plane.hpp).  For all
// others RoundRod and TwistedRod are tried at growing size on the pushes of a RodPilot.
// Offline: allocates; takes tenths of a second; throws std::invalid_argument for a scene that makes no sense.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

#include <hapbeam/scene/choose.hpp>
#include <hapbeam/scene/deciding.hpp>
#include <hapbeam/scene/rod_model.hpp>
#include <hapbeam/scene/rod_pilot.hpp>

namespace hapbeam {

/// @throws std::invalid_argument, TrainingError
inline RodModel build(const RodScene& scene, const Candidate& candidate) {
  scene.check();
  if (candidate.kinematics == Kinematics::round_rod)
    return RodModel(FemModel<RoundRod>(scene.rod, candidate.elements));
  if (candidate.kinematics == Kinematics::twisted_rod)
    return RodModel(FemModel<TwistedRod>(scene.rod, candidate.elements));
  const auto planar = scene.in_any_plane();
  if (!planar)
    throw std::invalid_argument(std::string("kinematics = ") + name(candidate.kinematics) +
                                ": must be that of a rod, for this one is not the same in each plane");
  SceneModel model = build(*planar, candidate);
  return model.visit([&](auto& chosen) {
    using Model = std::decay_t<decltype(chosen)>;
    return RodModel(TurningPlane<Model>(scene.rod, std::move(chosen)));
  });
}

namespace detail {

class RodChooser : Deciding {
 public:
  RodChooser(const RodScene& scene, const TickCosts& costs)
      : Deciding(scene.force_error, scene.tick), scene_(scene), costs_(costs), pilot_(scene) {
    own_error_ = pilot_.own_error();
  }

  Choice choose() {
    elements(Kinematics::round_rod);
    elements(Kinematics::twisted_rod);
    decide();
    return std::move(choice_);
  }

 private:
  void elements(Kinematics kinematics) {
    // Two or three elements of a bent rod turn by so much each that they are accurate to one side alone, by chance.
    fewest(pilot_.elements(), scene_.rod.straight() ? 2 : 4, 1, [&](int n) {
      const Candidate candidate{kinematics, Reduction::none, n};
      return judge(candidate, candidate.tick(costs_, scene_.shape), [&] {
        RodModel model = build(scene_, candidate);
        return pilot_.error(model);
      });
    });
  }

  const RodScene& scene_;
  const TickCosts& costs_;
  RodPilot pilot_;
};

}  // namespace detail

/// @param costs  what presses cost on the machine that will run them
/// @throws std::invalid_argument for a scene that makes no sense
inline Choice choose(const RodScene& scene, const TickCosts& costs = TickCosts::typical()) {
  if (const auto planar = scene.check().in_any_plane()) {
    try {
      Choice choice = choose(*planar, costs);
      if (choice.candidate) choice.candidate->turning = true;
      for (Verdict& verdict : choice.verdicts) verdict.candidate.turning = true;
      return choice;
    } catch (const std::invalid_argument&) {  // deeper than a press across the axis goes: pushes go on
    }
  }
  return detail::RodChooser(scene, costs).choose();
}

}  // namespace hapbeam
