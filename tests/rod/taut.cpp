// A round rod that is drawn taut, pressed anywhere on a few elements: a string, and a bar between clamps.
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "rod/touching.hpp"
#include "support/catch.hpp"
#include "support/push_round.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Between clamps that stand apart by so much that it is under a tension.
struct Drawn {
  double length, diameter, tension;
  double young = spring_steel.young;

  double axial() const { return young * pi / 4 * diameter * diameter; }
  double bending() const { return axial() * diameter * diameter / 16; }
  double longer() const { return 1 + tension / axial(); }
  Rod rod() const {
    Rod rod(length, RodSection::circle(diameter), RodMaterial::isotropic(young, 0.3), RodSupport::clamped,
            RodSupport::clamped);
    return rod.place_right({{length * longer(), 0, 0}, {1, 0, 0}, {0, 1, 0}});
  }
  /// Depth under a small force at a, times that [m/N]: EI w'''' - N λ w'' = λ² δ(s - a), λ = 1 + N/EA, s along what is not yet drawn.
  /// On each side w = c0 + c1 s + c2 e^(-k s) + c3 e^(k s), the last two from either end of it.
  struct Bend {
    double depth, curvature;  ///< under 1 N [m], [1/m], the latter of w
  };
  Bend under_force(double a) const {
    const double k = std::sqrt(tension * longer() / bending());
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Zero();
    Eigen::Matrix<double, 8, 1> right = Eigen::Matrix<double, 8, 1>::Zero();
    // The derivative of that order at s, times so much, in units of 1/k.
    const auto put = [&](int row, int side, double s, int order, double times) {
      const double from = side == 0 ? 0 : a, to = side == 0 ? a : length;
      const double fades = std::exp(-k * (s - from)), rises = std::exp(-k * (to - s));
      A(row, 4 * side) += times * (order == 0 ? 1 : 0);
      A(row, 4 * side + 1) += times * (order == 0 ? k * (s - from) : order == 1 ? 1 : 0);
      A(row, 4 * side + 2) += times * (order % 2 == 0 ? fades : -fades);
      A(row, 4 * side + 3) += times * rises;
    };
    put(0, 0, 0, 0, 1), put(1, 0, 0, 1, 1), put(2, 1, length, 0, 1), put(3, 1, length, 1, 1);
    for (int order = 0; order < 4; ++order) put(4 + order, 1, a, order, 1), put(4 + order, 0, a, order, -1);
    right[7] = longer() * longer() / (bending() * k * k * k);
    const Eigen::Matrix<double, 8, 1> c = A.fullPivLu().solve(right);
    const double rises = std::exp(-k * (length - a));
    return {c[4] + c[6] + c[7] * rises, k * k * (c[6] + c[7] * rises)};
  }
};

template <class Element>
double worst_of_small(const Drawn& of, int elements, int places) {
  FemModel<Element> model(of.rod(), elements);
  REQUIRE(model.rest().status == Status::ok);
  Random random(51);
  double worst = 0;
  for (int k = 0; k < places; ++k) {
    const double s = of.length * random(0.02, 0.98), depth = 1e-7 * of.length;
    const auto response = model.push({s, depth, {0, 1, 0}});
    REQUIRE(response.status == Status::ok);
    worst = std::max(worst, std::abs(response.force * of.under_force(s).depth / depth - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("a string is exact with two elements, wherever it is pressed a little", "[rod]") {
  const Drawn guitar{0.648, 0.254e-3, 72}, suture{0.1, 0.3e-3, 20}, bar{0.5, 0.006, 2000};
  for (const Drawn& of : {guitar, suture, bar})
    for (const int elements : {2, 3, 8}) {
      CAPTURE(of.tension, elements);
      // What the depth stretches is of its square: EA (depth/L)²/2, against the tension.
      CHECK(worst_of_small<RoundRod>(of, elements, 40) <= 1e-8);
      CHECK(worst_of_small<TwistedRod>(of, elements, 10) <= 1e-8);
    }
  // Nearly without tension a press of that depth stretches it by as much as it is stretched.
  CHECK(worst_of_small<RoundRod>(Drawn{0.5, 0.006, 0.01}, 8, 40) <= 1e-6);
}

TEST_CASE("what the section of a string carries under what presses it", "[rod]") {
  const Drawn suture{0.1, 0.3e-3, 20};
  FemModel<RoundRod> model(suture.rod(), 8);
  Random random(52);
  for (int k = 0; k < 20; ++k) {
    const double s = suture.length * random(0.05, 0.95);
    const auto response = model.push({s, 1e-5, {0, 1, 0}});
    REQUIRE(response.status == Status::ok);
    const auto cut = model.internal_forces(s);
    const double kink =
        -response.force * suture.bending() * suture.under_force(s).curvature / suture.longer();
    CAPTURE(s, kink);
    CHECK(std::hypot(cut.moment1, cut.moment2) == Approx(kink).epsilon(1e-3));
    CHECK(cut.normal == Approx(suture.tension).epsilon(1e-3));
  }
}

TEST_CASE("a string and a bar that are pressed deep answer as the planar beam does", "[rod]") {
  struct Case {
    Drawn of;
    double depth, with_16, with_32;
  };
  const Case cases[] = {{{0.648, 0.254e-3, 72}, 0.008, 3e-3, 1e-3},
                        {{0.1, 0.3e-3, 20}, 0.00125, 1e-4, 1e-4},
                        {{1, 0.01, 0}, 0.05, 2e-3, 2e-3}};
  for (const Case& each : cases) {
    const Drawn& of = each.of;
    Beam beam(of.length, Section::circle(of.diameter), Material{spring_steel.young}, Support::clamped,
              Support::clamped);
    beam.place({}, {of.length * (of.longer() - 1), 0, 0});
    FemModel<Corotational<>> planar(beam, 64);
    FemModel<RoundRod> coarse(of.rod(), 16), fine(of.rod(), 32);
    Random random(3);
    for (int k = 0; k < 10; ++k) {
      const double s = of.length * random(0.1, 0.9);
      planar.reset(), coarse.reset(), fine.reset();
      for (int part = 1; part <= 20; ++part) {
        const double d = each.depth * part / 20;
        const Push<double, 3> at{s, d, {0, 1, 0}};
        const auto exact = planar.press({s, d});
        const auto with_16 = coarse.push(at), with_32 = fine.push(at);
        REQUIRE(with_16.status == Status::ok);
        REQUIRE(with_32.status == Status::ok);
        if (part < 20) continue;
        CAPTURE(of.tension, s);
        CHECK(with_16.force == Approx(exact.force).epsilon(each.with_16));
        CHECK(with_32.force == Approx(exact.force).epsilon(each.with_32));
      }
    }
  }
}

namespace {

constexpr double reach = 0.005;
const Drawn soft_suture{0.2, 0.3e-3, 1, 2e9};

/// A capsule across it comes from above and slides along it, askew as far along its own axis.
/// @param tick  (place, shaft) -> force on it [N]
template <class Model, class Tick>
void slide_along_suture(const Model& model, double depth, bool askew, Tick&& tick) {
  const Point shaft(0, 0, 0.1);
  const double begin = askew ? 0.074 : 0.06;
  const auto at = [&](double x, double y) {
    return tick(Point(x, y, askew ? x - begin - 0.03 : -0.03), shaft);
  };
  for (double y = reach; y > -depth; y -= 25e-6) (void)at(begin, y);
  double largest = 0, sharpest = 0;
  Point before = at(begin, -depth);
  for (double x = begin; x < (askew ? 0.095 : 0.14); x += askew ? 12.5e-6 : 25e-6) {
    const Point force = at(x, -depth);
    CAPTURE(x);
    REQUIRE(force.y() > 0);
    largest = std::max(largest, (force - before).norm() / before.norm());
    const double tension = model.internal_forces(0.02).normal;
    sharpest = std::max(sharpest, reach * force.norm() / (2 * std::sqrt(soft_suture.bending() * tension)));
    before = force;
  }
  CHECK(sharpest > (depth > 0.008 ? 1.3 : 1));
  CHECK(largest <= 0.02);
}

}  // namespace

// The radius to which a force F bends a string is 2 √(EI N)/F: here that of the capsule from 0.5 N on.
TEST_CASE("a capsule slides along a string that is bent more sharply than it, over nodes", "[rod]") {
  const double radius = reach - soft_suture.diameter / 2;
  for (const double friction : {0.0, 0.3})
    for (const auto& [depth, askew] :
         {std::pair(0.006, false), std::pair(0.009, false), std::pair(0.009, true)}) {
      CAPTURE(friction, depth, askew);
      FemModel<RoundRod> model(soft_suture.rod(), 8);
      Touch<FemModel<RoundRod>> touch(model, radius, Friction(friction));
      slide_along_suture(model, depth, askew, [&](const Point& at, const Point& shaft) {
        const Felt felt = touch.tick(at, shaft);
        REQUIRE(is_answer(felt.status));
        return felt.force;
      });
      FemModel<Several<RoundRod, 2>> of_two(soft_suture.rod(), 8);
      TouchSeveral several(of_two, {RoundAvatar(radius, 1, Friction(friction))});
      slide_along_suture(of_two, depth, askew, [&](const Point& at, const Point& shaft) {
        const auto felt = several.tick(&at, &shaft, 1);
        REQUIRE(is_answer(felt.status));
        return felt.force(0);
      });
    }
}

namespace {

/// A strip between clamps, half a millimetre high, pressed across its flat side or along it at s, in parts; against the planar beam.
struct Strip {
  double width, drawn, depth, s;
  int elements;
  bool edgewise;

  /// Of the force, and what the model says of that.
  std::pair<double, Status> off() const {
    const double length = 0.2, height = 0.0005;
    Beam beam(length, edgewise ? Section::rectangle(height, width) : Section::rectangle(width, height),
              Material{spring_steel.young}, Support::clamped, Support::clamped);
    beam.place({}, {length * drawn, 0, 0});
    Rod rod(length, RodSection::rectangle(width, height), spring_steel, RodSupport::clamped,
            RodSupport::clamped);
    rod.place_right({{length * (1 + drawn), 0, 0}, {1, 0, 0}, rod.left_pose().director});
    FemModel<Corotational<>> planar(beam, 64);
    FemModel<TwistedRod> model(rod, elements);
    const Point d1 = rod.left_pose().director,
                normal = edgewise ? d1 : Point(detail::cross3<double>(Point(1, 0, 0), d1));
    Response<double> exact{}, strip{};
    for (int part = 1; part <= 20; ++part) {
      exact = planar.press({s, depth * part / 20});
      strip = model.push(Push<double, 3>{s, depth * part / 20, normal});
    }
    REQUIRE(is_answer(strip.status));
    return {std::abs(strip.force / exact.force - 1), strip.status};
  }
};

}  // namespace

TEST_CASE("a flat strip knows its tension where it is bent across its flat side", "[rod]") {
  Random random(11);
  for (int k = 0; k < 24; ++k) {
    const Strip strip{0.01,
                      k % 2 == 0 ? 0 : std::pow(10, random(-5, -3)),
                      0.2 * std::pow(10, random(-3, -1.2)),
                      0.2 * random(0.15, 0.85),
                      random.integer(6, 24),
                      false};
    const auto [off, status] = strip.off();
    CAPTURE(strip.elements, strip.drawn, strip.depth, strip.s, off);
    CHECK(status == Status::ok);
    CHECK(off <= 0.01);
  }
  // By 24 thicknesses, in the middle.
  const auto at = [](int elements) { return Strip{0.01, 0, 0.012, 0.09, elements, false}.off().first; };
  CHECK(at(8) <= 2e-3);
  CHECK(at(32) <= 2e-4);
}

TEST_CASE("a flat strip that is drawn too taut for its elements says so where it is bent edgewise", "[rod]") {
  Random random(11);
  int answered = 0, told = 0;
  for (int k = 0; k < 24; ++k) {
    const Strip strip{0.001,
                      k % 2 == 0 ? 0 : std::pow(10, random(-5, -3)),
                      0.2 * std::pow(10, random(-3, -1.5)),
                      0.2 * random(0.15, 0.85),
                      random.integer(6, 24),
                      true};
    const auto [off, status] = strip.off();
    CAPTURE(strip.elements, strip.drawn, strip.depth, strip.s, off);
    CHECK((status != Status::ok || off <= 0.01));
    ++(status == Status::ok ? answered : told);
  }
  CHECK(answered > 6);
  CHECK(told > 6);
}

TEST_CASE("a flat strip between clamps is followed wherever a bar presses it", "[rod]") {
  const double length = 0.2, radius = 0.005;
  for (const double width : {0.001, 0.004, 0.01})
    for (const double s : {0.03, 0.09, 0.1, 0.115, 0.16}) {
      const Rod strip(length, RodSection::rectangle(width, 0.0005), spring_steel, RodSupport::clamped,
                      RodSupport::clamped);
      FemModel<TwistedRod> model(strip, 8);
      PushRound push(model);
      const Point aside = strip.left_pose().director, flat = detail::cross3<double>(Point(1, 0, 0), aside);
      int lost = 0;
      double force = 0;
      for (int k = 0; k <= 300; ++k) {
        const Point tip = Point(s, 0, 0) - 0.05 * aside + (radius - 0.004 * k / 300) * flat;
        const auto pushed = push({s, {tip, 0.1 * aside}, radius, flat});
        lost += !is_answer(pushed.status) || !(pushed.force <= force + 1e-9);
        force = pushed.force;
      }
      CAPTURE(width, s, force);
      CHECK(lost == 0);
    }
}

// Bent by nature by 3/L and clamped where it then ends, its ends drawn apart.  Half of it: θ'² of a first integral, the chord by quadrature.
TEST_CASE("a rod that is bent by nature and drawn straight is in range where its force is right", "[rod]") {
  constexpr double length = 0.2;
  Rod rod(length, RodSection::circle(0.002), {200e9, 77e9}, RodSupport::clamped, RodSupport::clamped);
  rod.naturally({{length, 0, 3 / length, 0}});
  const auto drawn = [&](int elements) {
    FemModel<TwistedRod> model(rod, elements);
    const RodNode<double> end = model.shape()[model.shape().segments()];
    const double chord = end.r.norm(), farthest = 1.001 * length;
    double worst = 0;
    int in_range = 0;
    for (int k = 1; k <= 360; ++k) {
      const RodPose pose{end.r * ((chord + (farthest - chord) * k / 400) / chord), detail::unit(end.tangent),
                         end.director};
      const HeldEnd<double> held = model.hold(RodSide::right, pose);
      REQUIRE(is_answer(held.status));
      if (held.status != Status::ok) continue;
      ++in_range;
      // At these chords, in lengths: 0.8330, 0.9002, 0.9338, 0.9674.
      const double exact = k == 200   ? 154.455
                           : k == 280 ? 447.982
                           : k == 320 ? 988.278
                           : k == 360 ? 3216.25
                                      : 0;
      if (exact > 0) worst = std::max(worst, std::abs(held.force.norm() / exact - 1));
    }
    CAPTURE(elements, in_range, worst);
    CHECK(worst <= 0.01);
    return in_range;
  };
  const int coarse = drawn(8), fine = drawn(32);
  CHECK(coarse > 100);
  CHECK(coarse < 200);
  CHECK(fine > 300);
  CHECK(fine < 360);
}
