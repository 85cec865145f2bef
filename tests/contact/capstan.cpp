// A string that is wrapped around a rough peg is a capstan: the tensions on both sides have the ratio e^{μφ}.
//
// The peg touches it at k places.  At each of them the string turns by its share of φ, and the ratio is that of a peg that is touched at one point
// (tests/contact/friction.cpp) by φ/k, to the k-th power.  What that lacks to e^{μφ} falls with 1/k².
//
// The string is clamped at its left end, and a weight pulls the right one to the right.  The peg goes round the clamp, so that the string is
// wrapped around it from below, and slides to the clamp.
#include <algorithm>
#include <array>
#include <cmath>

#include "realtime/counting_element.hpp"
#include "support/catch.hpp"
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double weight = 10, clear = 0.2;   // [N], [m] from the clamp
constexpr double length = 0.5, thin = 1e-4;  // [m]
constexpr double stretching = 1e4;           // EA [N]

/// Of the tensions on both sides of k places that share the angle φ.
double ratio_of_points(double mu, double angle, int places) {
  const double alpha = std::atan(mu), turn = angle / places,
               off = alpha - std::asin(std::sin(alpha) * std::cos(turn / 2));
  return std::pow(std::sin(turn / 4 + off / 2) / std::sin(turn / 4 - off / 2), 2 * places);
}

/// Where the peg has gone round by so much [rad].   @param above  [m] from there to the string
Vector2<double> round_the_clamp(double angle, double above) {
  return {clear * std::cos(angle), above - clear * std::sin(angle)};
}

struct Wound {
  double angle = 0, ratio = 0;  // [rad] by which the string turns; of the tensions
  int touching = 0, sliding = 0;
};
/// @param slope  of the string at s [rad]   @param tension  at s [N]   @param bending  length √(EI/T) of its bends [m]
template <class Felt, class Slope, class Tension>
Wound wound(const Felt& felt, Slope&& slope, Tension&& tension, double bending) {
  Wound now;
  double first = length, last = 0;
  for (const auto& place : felt) {
    if (!place.touching) continue;
    first = std::min(first, place.s), last = std::max(last, place.s);
    ++now.touching, now.sliding += place.sliding;
  }
  const double left = first - 10 * bending, right = last + 10 * bending;
  now.angle = slope(right) - slope(left);
  if (now.angle < 0) now.angle += 2 * 3.14159265358979323846;
  now.ratio = tension(left) / tension(right);
  return now;
}

Rod rod_string(double bending) {
  const double stiffness = weight * bending * bending;
  Rod string(length, RodStiffness{stretching, stiffness, stiffness, stiffness}, thin, RodSupport::clamped,
             RodSupport::free);
  string.add(RodForce{length, {weight, 0, 0}});
  return string;
}
template <class Model, class Felt>
Wound wound_in_space(const Model& model, const Felt& felt, double bending) {
  const auto slope = [&](double s) {
    const auto along = model.shape().at(s).tangent;
    return std::atan2(along.y(), along.x());
  };
  const auto tension = [&](double s) {
    const auto carried = model.internal_forces(s);
    return std::hypot(carried.normal, std::hypot(carried.shear1, carried.shear2));
  };
  return wound(felt, slope, tension, bending);
}

}  // namespace

TEST_CASE("a string that is wrapped around a rough peg is held by it as by a capstan",
          "[friction][several]") {
  using Element = CountingElement<Corotational<>>;
  constexpr int places = 4, elements = 100, ticks = 200;
  constexpr double radius = 0.05, bending = 0.005;
  struct Case {
    double mu, round, least;  // [rad] that the peg goes round, and that the string turns at least
  };
  for (const auto& [mu, round, least] : {Case{0.3, 1.75, 2.0}, Case{0.6, 1.3, 1.5}}) {
    Beam string(length, stretching, weight * bending * bending, thin, Support::clamped, Support::free);
    string.add(PointLoad{length, weight});
    FemModel<Several<Element, places>> model(string, elements);
    TouchSeveral touch(model, {{radius, places, Friction(mu)}});
    const double above = radius + thin / 2;
    auto felt = touch.tick(round_the_clamp(0, above + 1e-4));
    Element::tangents = 0;
    for (int k = 1; k <= ticks; ++k) {
      felt = touch.tick(round_the_clamp(round * k / ticks, above - 2e-4));
      REQUIRE(felt.status == Status::ok);
    }
    const auto line = model.shape();
    const auto now = wound(
        felt,
        [&](double s) {
          const auto a = line.at(s - 1e-3), b = line.at(s + 1e-3);
          return std::atan2(b.w - a.w, 2e-3 + b.u - a.u);
        },
        [&](double s) {
          const auto carried = model.internal_forces(s);
          return std::hypot(carried.normal, carried.shear);
        },
        bending);
    CAPTURE(mu, now.angle, now.ratio, double(Element::tangents) / elements / ticks);
    CHECK((now.touching == places && now.sliding == places));
    CHECK(now.angle >= least);
    CHECK(std::abs(now.ratio / ratio_of_points(mu, now.angle, places) - 1) <= 2e-3);
    CHECK(std::abs(now.ratio / std::exp(mu * now.angle) - 1) <= 0.01);
    // The string slides the way that the peg goes, and twice as far: no tick takes it to slide the other way.
    CHECK(Element::tangents <= 18L * elements * ticks);
  }
}

// The shaft lies across the string, which bends more sharply than it.
TEST_CASE("a string in space that is wrapped around a rough shaft is held by it as by a capstan",
          "[rod][friction][several]") {
  constexpr int places = 2, elements = 100, ticks = 150;
  constexpr double radius = 0.05, bending = 0.005, mu = 0.3;
  FemModel<Several<RoundRod, places>> model(rod_string(bending), elements);
  TouchSeveral touch(model, {{radius, places, Friction(mu)}});
  const Vector3<double> shaft(0, 0, 0.2);
  int unanswered = 0;
  TouchSeveralResult<double, 3, places> felt;
  for (int k = 0; k <= ticks; ++k) {
    const auto at = round_the_clamp(1.05 * k / ticks, radius + thin / 2 + (k == 0 ? 1e-4 : -2e-4));
    const Vector3<double> tip(at.x(), at.y(), -0.1);
    felt = touch.tick(&tip, &shaft, 1);
    unanswered += !is_answer(felt.status);
  }
  const auto now = wound_in_space(model, felt, bending);
  CAPTURE(now.angle, now.ratio, unanswered);
  CHECK(felt.status == Status::ok);
  CHECK(unanswered <= 2);  // where it begins to touch at two places
  CHECK((now.touching == places && now.sliding == places));
  CHECK(now.angle >= 1.2);
  CHECK(std::abs(now.ratio / ratio_of_points(mu, now.angle, places) - 1) <= 2e-3);
  CHECK(std::abs(now.ratio / std::exp(mu * now.angle) - 1) <= 0.01);
}

// Each is thinner than the string's bends.  They need not share the angle evenly, which takes from the ratio.
TEST_CASE("a string in space that is wrapped around four rough rods is held by them as by a capstan",
          "[rod][friction][several]") {
  constexpr int places = 4, elements = 60, ticks = 150;
  constexpr double radius = 0.08, thickness = 0.004, bending = 0.01, spread = 2.2;
  for (const double mu : {0.2, 0.3}) {
    FemModel<Several<RoundRod, places>> model(rod_string(bending), elements);
    const RoundAvatar rod{thickness, 1, Friction(mu)};
    TouchSeveral touch(model, {rod, rod, rod, rod});
    TouchSeveralResult<double, 3, places> felt;
    for (int k = 0; k <= ticks; ++k) {
      const auto at = round_the_clamp(1.6 * k / ticks, thickness + thin / 2 + (k == 0 ? 1e-4 : -2e-4));
      std::array<Vector3<double>, places> tips, shafts;
      for (std::size_t i = 0; i < places; ++i) {
        const double a = spread * (double(i) + 0.5) / places;
        tips[i] = {at.x() - radius * std::sin(a), at.y() + radius * (1 - std::cos(a)), -0.1};
        shafts[i] = {0, 0, 0.2};
      }
      felt = touch.tick(tips.data(), shafts.data(), places);
      REQUIRE(felt.status == Status::ok);
    }
    const auto now = wound_in_space(model, felt, bending);
    CAPTURE(mu, now.angle, now.ratio);
    CHECK((now.touching == places && now.sliding == places));
    CHECK(now.angle >= 1.8);
    CHECK(std::abs(now.ratio / std::exp(mu * now.angle) - 1) <= 0.01);
  }
}
