// SPDX-License-Identifier: MIT
// The least model that a scene needs.
//
//   Scene scene = Scene::anywhere(beam, 0.02);
//   scene.force_error = 0.02, scene.tick = 20e-6;
//   const Choice choice = choose(scene);
//   std::puts(choice.text().c_str());                 // what was chosen, and which bound rejected what
//   SceneModel model = build(scene, choice.model());
//
// Each family of models (three kinematics, two reductions) is tried at growing size on the presses of a Pilot until its error is well below
// the tolerated one; of those that get there within the time, the cheapest is chosen.
// Offline: allocates; takes tens of milliseconds, seconds for thin beams under dead loads; throws std::invalid_argument.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include <hapbeam/rod.hpp>
#include <hapbeam/scene/build.hpp>
#include <hapbeam/scene/pilot.hpp>
#include <hapbeam/scene/scene.hpp>

namespace hapbeam {

namespace detail {

/// Tries candidates on the presses of a pilot.
/// @tparam S  Scene | RodScene, of which build() makes models   @tparam P  Pilot | RodPilot
template <class S, class P>
class Chooser {
 public:
  /// The pilot's presses do not meet the worst press of all, so a model has to do better on them than is tolerated.
  /// Finite elements are at their worst at the corners of the range, which the pilot meets, and interpolation is between.
  static constexpr double elements_margin = 0.85, trained_margin = 0.6;
  /// Where no candidate is that much better, one is taken whose error on the pilot is just below the tolerated one.
  static constexpr double elements_least = 0.97, trained_least = 0.85;

  Chooser(const S& scene, const TickCosts& costs) : scene_(scene), costs_(costs), pilot_(scene) {
    choice_.force_error = scene.force_error, choice_.tick = scene.tick;
  }

  /// Finite elements: the fewest that are accurate enough, if many are.   @param least  that a model can have
  void elements(Kinematics kinematics, int least) {
    const auto of = [&](int n) { return judge({kinematics, Reduction::none, n}); };
    Verdict verdict = of(pilot_.elements());
    for (const int n : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384}) {
      if (!barely_right(verdict) || n >= pilot_.elements()) break;
      if (n < least) continue;
      const Verdict fewer = of(n);
      if (!fewer.right) continue;
      verdict = fewer;
      break;
    }
    choice_.verdicts.push_back(verdict);
  }

  /// Interpolation: first as many depths as one place takes, then as many places.
  void trained(Reduction reduction, Kinematics kinematics) {
    const Verdict& full = of(kinematics);
    // Fourth order: twice the elements leave a sixteenth of the error to the full model.
    Candidate candidate{kinematics, reduction, 2 * full.candidate.elements, 1, 2};
    Verdict verdict{candidate, infinity, time_of(candidate), false, {}};
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

  /// The cheapest of what is accurate enough and fast enough, or what to relax.
  Choice decide() {
    const Verdict* least = nullptr;
    for (const Verdict& verdict : choice_.verdicts)
      if (verdict.right && (!least || verdict.tick < least->tick)) least = &verdict;
    if (least && least->tick <= choice_.tick) {
      choice_.candidate = least->candidate;
      return choice_;
    }
    if (barely_) {
      barely_->right = true;
      choice_.candidate = barely_->candidate;
      choice_.verdicts.push_back(*barely_);
      return choice_;
    }
    // A twentieth more than that, for it is written with two digits.
    char text[400], slower[150] = "", coarser[150] = "";
    if (least)
      std::snprintf(slower, sizeof slower, "a tick of %.2g us (%s)", 1.05e6 * least->tick,
                    least->candidate.text().c_str());
    const double enough = 1.05 * (in_time_.error + pilot_.own_error()) / trained_margin;
    if (enough < 1)
      std::snprintf(coarser, sizeof coarser, "%sa force error of %.2g %% (%s)", least ? ", or " : "",
                    100 * enough, in_time_.candidate.text().c_str());
    std::snprintf(text, sizeof text, "no model is within %.2g %% of the force in %.2g us: %s%s%s",
                  100 * choice_.force_error, 1e6 * choice_.tick,
                  least || *coarser ? "allow " : "press less deep or in a smaller range", slower, coarser);
    choice_.advice = text;
    return choice_;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Of one kinematics by itself.
  const Verdict& of(Kinematics kinematics) const {
    const auto is = [&](const Verdict& verdict) { return verdict.candidate.kinematics == kinematics; };
    return *std::find_if(choice_.verdicts.begin(), choice_.verdicts.end(), is);
  }

  bool enough_depths(const Candidate& candidate) const {
    try {
      for (const double s : pilot_.places()) {
        Scene place = scene_;
        place.s_min = place.s_max = s;
        SceneModel model = build(place, candidate, 2);
        if (!(pilot_.error_at(model, s) <= 0.8 * wanted(candidate))) return false;
      }
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  Verdict judge(const Candidate& candidate) {
    Verdict verdict{candidate, infinity, time_of(candidate), false, {}};
    try {
      auto model = build(scene_, candidate, 2);
      verdict.error = pilot_.error(model);
      verdict.right = verdict.error + pilot_.own_error() <= wanted(candidate);
    } catch (const std::exception& why) {
      verdict.refusal = why.what();
    }
    const bool in_time = verdict.tick <= choice_.tick;
    if (in_time && verdict.error < in_time_.error) in_time_ = verdict;
    if (in_time && barely_right(verdict) && (!barely_ || verdict.tick < barely_->tick)) barely_ = verdict;
    return verdict;
  }

  bool barely_right(const Verdict& verdict) const noexcept {
    const bool trained = verdict.candidate.reduction != Reduction::none;
    return verdict.error + pilot_.own_error() <=
           (trained ? trained_least : elements_least) * choice_.force_error;
  }

  /// Models of rods have their shape from the push.
  double time_of(const Candidate& candidate) const noexcept {
    if constexpr (std::is_same_v<S, Scene>) return candidate.tick(costs_, scene_.shape);
    else return candidate.tick(costs_, true);
  }
  double wanted(const Candidate& candidate) const noexcept {
    return (candidate.reduction == Reduction::none ? elements_margin : trained_margin) * choice_.force_error;
  }

  const S& scene_;
  const TickCosts& costs_;
  P pilot_;
  Choice choice_;
  Verdict in_time_{{}, infinity, 0, false, {}};  // the least error of all that are fast enough
  std::optional<Verdict> barely_;                // the cheapest that is fast enough and barely_right()
};

template <class F>
void add_load(Beam& beam, const F& f) {
  beam.axial([f, was = beam.axial()](double s) { return (was ? was(s) : 0) + f(s).x(); });
  beam.transverse([f, was = beam.transverse()](double s) { return (was ? was(s) : 0) + f(s).y(); });
}
template <class F>
void add_load(Rod& rod, const F& f) {
  rod.load([f, was = rod.load()](double s) { return was ? VectorOf<double, 3>(was(s) + f(s)) : f(s); });
}

/// The first mode of a beam or a rod about its rest, by statics alone: what it is pulled by is its own inertia.
///   K φ' = ω² μ φ,   ω² = ∫ω² μ φ·φ' ds / ∫μ φ'² ds        (inverse iteration, Rayleigh's quotient)
/// It begins with the shape of a press, and takes no mode of twist.   @param press  (FemModel<Element>&, how far [m]) -> Response
/// @return [Hz], to 1e-3; 0 where the body has no density, or does not answer
template <class Element, class Body, class Press>
double first_mode(const Body& body, Press&& press) {
  constexpr int elements = 32, places = 8 * elements, D = dimension_of<Element>;
  using Shape = Eigen::Matrix<double, D, places + 1>;
  const double step = body.length() / places, tiny = body.thickness() / 100;
  Eigen::Matrix<double, 1, places + 1> mass;  // at each place [kg]
  for (int i = 0; i <= places; ++i)
    mass[i] = body.mass_per_length(i * step) * step * (i % places == 0 ? 0.5 : 1);
  if (!(mass.sum() > 0)) return 0;
  const auto product = [&](const Shape& a, const Shape& b) {
    return mass.dot(a.cwiseProduct(b).colwise().sum());
  };
  const auto lies = [&](const FemModel<Element>& model) {
    const auto line = model.shape();
    Shape at;
    for (int i = 0; i <= places; ++i) at.col(i) = line.position(i * step);
    return at;
  };
  FemModel<Element> model(body, elements);
  const Shape rest = lies(model);
  const auto response = press(model, tiny);
  if (!is_answer(response.status)) return 0;
  Shape mode = lies(model) - rest;
  double square = std::abs(response.force) * tiny / product(mode, mode);
  for (int k = 0; k < 8; ++k) {
    mode *= tiny / mode.colwise().norm().maxCoeff();
    Body pulled = body;
    add_load(pulled, [&](double s) {
      return VectorOf<double, D>(square * body.mass_per_length(s) * mode.col(std::lround(s / step)));
    });
    const Shape next = lies(FemModel<Element>(pulled, elements)) - rest;
    square *= product(mode, next) / product(next, next);
    mode = next;
  }
  return std::sqrt(square) / (2 * std::acos(-1.0));
}

}  // namespace detail

/// @param costs  what presses cost on the machine that will run them
/// @throws std::invalid_argument for a scene that makes no sense
inline Choice choose(const Scene& scene, const TickCosts& costs = TickCosts::typical()) {
  detail::Chooser<Scene, Pilot> chooser(scene, costs);
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::von_karman, Kinematics::corotational})
    chooser.elements(kinematics, 2);
  // The model that trains costs nothing in a tick, so the most accurate one is taken.  Galerkin's equation is von Kármán's.
  chooser.trained(Reduction::pod, Kinematics::corotational);
  chooser.trained(Reduction::galerkin, Kinematics::von_karman);
  Choice choice = chooser.decide();
  const double s = (scene.s_min + scene.s_max) / 2;
  choice.first_mode = detail::first_mode<Corotational<>>(scene.beam, [s](auto& model, double by) {
    return model.press({s, model.shape().at(s).w + by});
  });
  return choice;
}

}  // namespace hapbeam
