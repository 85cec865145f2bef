// SPDX-License-Identifier: MIT
// The least model that a scene in space needs.
//
//   RodScene scene = RodScene::anywhere(rod, 0.01);
//   const Choice choice = choose(scene);
//   RodModel model = build(scene, choice.model());
//
// RoundRod and TwistedRod are tried at growing size on the pushes of a RodPilot.  Its reference is TwistedRod, or RoundRod where
// nobody holds the twist, with at most 256 elements.  A rod that rests straight is pushed along three directions across it, another along
// eight: it gives way to one side many times as much as to another, and the relative error of its force peaks near the stiffest side.
// With C the compliance across the rod,
//
//   F = d/(nᵀC n),   n ~ C^(-½) m:   δF/F = -mᵀ C^(-½) δC C^(-½) m        for unit m
//
// is a plain quadratic form of m.  So m is spread evenly, and n follows: directions are close where the rod is stiff.  Of a form
// with one sign, four of them and their opposites meet 0.85 of the largest value at least, which is the margin of choose().
// Offline: allocates; takes tenths of a second; throws std::invalid_argument for a scene that makes no sense.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/press.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/scene/choose.hpp>

namespace hapbeam {

/// The requirements of a scene in space: a rod, where and how deep it is pushed, and the tolerated error and time.
struct RodScene {
  Rod rod;
  double s_min, s_max;  ///< [m] where it is pushed; equal: at one place
  double depth;         ///< [m] from where it rests, to any side; beside a support a fifth of the distance
  double force_error = 0.05;  ///< largest relative error of the force; a hand tells forces apart from 7 % on
  double force_floor = 0;  ///< [N] smaller forces count as this one, where they change sign or cannot be felt
  double tick = 50e-6;     ///< [s] largest time of a push

  /// Anywhere from 5 to 95 % of the length, or up to an end that yields.
  static RodScene anywhere(const Rod& rod, double depth) {
    const double L = rod.length();
    const Range<double> range = PressRange<double>(rod).range();
    return {rod, range.s_min > 0 ? 0.05 * L : 0, range.s_max < L ? 0.95 * L : L, depth};
  }
  static RodScene at(const Rod& rod, double s, double depth) { return {rod, s, s, depth}; }

  bool one_place() const noexcept { return s_min == s_max; }
  bool twists() const noexcept { return holds_twist(rod.left()) || holds_twist(rod.right()); }
  Range<double> range() const { return PressRange<double>(rod).range(); }

  /// How deep it is pushed at s along cos d1 + sin d2 [m].  A flat rod that is pushed askew gives way across the push: its depth is
  /// less by that, as a straight one's of even stiffness is.
  double depth_at(double s, double cosine, double sine) const noexcept {
    const Range<double> range = this->range();
    double deep = depth;
    if (range.s_min > 0) deep = (std::min)(deep, s / 5);
    if (range.s_max < rod.length()) deep = (std::min)(deep, (rod.length() - s) / 5);
    const double x = cosine / rod.stiffness().bending2, y = sine / rod.stiffness().bending1;
    return deep * (cosine * x + sine * y) / std::hypot(x, y);
  }

  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const RodScene& check() const {
    const Range<double> range = this->range();
    detail::check_scene(*this, 0.999999 * range.s_min, range.s_max + 1e-6 * range.s_min, "rod");
    return *this;
  }
};

/// The model that a scene in space needs, whichever it is, as one ForceModel.
using RodModel = AnyOf<3, FemModel<RoundRod>, FemModel<TwistedRod>>;

/// @throws std::invalid_argument, TrainingError
inline RodModel build(const RodScene& scene, const Candidate& candidate, [[maybe_unused]] int segments = 32) {
  scene.check();
  if (candidate.kinematics == Kinematics::round_rod)
    return RodModel(FemModel<RoundRod>(scene.rod, candidate.elements));
  if (candidate.kinematics == Kinematics::twisted_rod)
    return RodModel(FemModel<TwistedRod>(scene.rod, candidate.elements));
  detail::refuse("kinematics = %s: must be that of a rod for a RodScene", name(candidate.kinematics));
}

namespace detail {

/// Pushes at one place and to one side, from rest outward.
struct PushLine {
  static constexpr const char *body = "rod", *motion = "push";
  double s;
  VectorOf<double, 3> normal;
  double home;                 // n · r at rest [m]
  std::vector<double> depths;  // n · r [m]
  std::vector<double> forces;  // [N] of the reference

  /// On to the next depth, as a hand goes.
  template <class Model>
  Response<double> go(Model& model, std::size_t k) const {
    const double from = k > 0 ? depths[k - 1] : home, to = depths[k];
    for (const double share : {0.25, 0.5, 0.75}) (void)model.push({s, from + share * (to - from), normal});
    return model.push({s, to, normal});
  }
};

}  // namespace detail

class RodPilot : public detail::PilotOf<detail::PushLine> {
  using Vector3 = VectorOf<double, 3>;

 public:
  explicit RodPilot(const RodScene& scene) : PilotOf(scene.check().force_floor) {
    scene.twists() ? search<TwistedRod>(scene) : search<RoundRod>(scene);
  }

 private:
  template <class Element>
  void search(const RodScene& scene) {
    FemModel<Element> resting(scene.rod, 64);
    place(scene, resting);
    refine(scene, resting, 256, [&](int n) { return FemModel<Element>(scene.rod, n); });
  }

  template <class Model>
  void place(const RodScene& scene, Model& model) {
    const bool straight = scene.rod.straight();
    // Uneven, lest they meet what is symmetric.
    for (const double along : {0.0, 0.23, 0.52, 0.78, 1.0}) {
      if (scene.one_place() && along > 0) break;
      const double s = scene.s_min + (scene.s_max - scene.s_min) * along;
      model.reset();
      const Centreline<double, 3> rest = model.shape();
      const Vector3 r = rest.at(s).r, d3 = detail::unit(rest.at(s).tangent),
                    d1 = detail::across(rest[rest.segment_at(s)].director, d3),
                    d2 = detail::cross3<double>(d3, d1);
      const auto toward = [&](double cosine, double sine, int steps) {
        const Vector3 normal = cosine * d1 + sine * d2;
        const double home = normal.dot(r);
        detail::PushLine line{s, normal, home, {}, {}};
        for (int k = steps; k >= 0; --k)
          line.depths.push_back(home + scene.depth_at(s, cosine, sine) * std::pow(10.0, -k / 4.0));
        return line;
      };
      if (straight) {
        for (const double angle : {0.04, 0.79, 1.54})
          lines_.push_back(toward(std::cos(angle), std::sin(angle), 8));
        continue;
      }
      const Compliance c = compliance([&](double cosine, double sine) {
        detail::PushLine shallow = toward(cosine, sine, 8);
        shallow.depths.resize(1);
        model.reset();
        return (shallow.depths[0] - shallow.home) / shallow.go(model, 0).force;
      });
      for (int side = 0; side < 8; ++side) {
        const double angle = 0.04 + side * 0.785, m1 = std::cos(angle), m2 = std::sin(angle);
        const double n1 = (c.c22 + c.root) * m1 - c.c12 * m2, n2 = (c.c11 + c.root) * m2 - c.c12 * m1,
                     size = std::hypot(n1, n2);
        lines_.push_back(toward(n1 / size, n2 / size, 12));
      }
    }
  }

  /// C across the rod, in the axes d1 and d2.
  struct Compliance {
    double c11 = 1, c12 = 0, c22 = 1;  // [m/N]
    double root = 1;                   // of its determinant
  };
  /// @param along  (cosine, sine) -> nᵀC n, where small pushes are answered   @return the same to all sides where they are not
  template <class Along>
  static Compliance compliance(Along&& along) {
    const double half = 0.5, root3 = std::sqrt(3.0);
    const double c0 = along(1, 0), c1 = along(half, root3 / 2), c2 = along(-half, root3 / 2);
    const double c22 = (2 * (c1 + c2) - c0) / 3, c12 = (c1 - c2) / root3, determinant = c0 * c22 - c12 * c12;
    if (!(c0 > 0 && determinant > 0 && std::isfinite(determinant))) return {};
    return {c0, c12, c22, std::sqrt(determinant)};
  }
};

/// @param costs  what presses cost on the machine that will run them
/// @throws std::invalid_argument for a scene that makes no sense
inline Choice choose(const RodScene& scene, const TickCosts& costs = TickCosts::typical()) {
  scene.check();
  using Vector = VectorOf<double, 3>;
  const auto first_mode = [&scene](auto element) {
    const double s = (scene.s_min + scene.s_max) / 2;
    return detail::first_mode<decltype(element)>(scene.rod, [s](auto& model, double by) {
      const Centreline<double, 3> rest = model.shape();
      const Vector d1 = rest[rest.segment_at(s)].director,
                   d2 = detail::cross3<double>(rest.at(s).tangent, d1);
      const Vector normal = (d1 + d2 / 2).normalized();
      return model.push({s, normal.dot(rest.at(s).r) + by, normal});
    });
  };
  const double hertz = scene.twists() ? first_mode(TwistedRod{}) : first_mode(RoundRod{});
  detail::Chooser<RodScene, RodPilot> chooser(scene, costs);
  // Two or three elements of a bent rod turn by so much each that they are accurate to one side alone, by chance.
  for (const Kinematics kinematics : {Kinematics::round_rod, Kinematics::twisted_rod})
    chooser.elements(kinematics, scene.rod.straight() ? 2 : 4);
  Choice choice = chooser.decide();
  choice.first_mode = hertz;
  return choice;
}

}  // namespace hapbeam
