// The bound on what a mesh leaves in the force, against meshes that are six times finer than the one that it compares with.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/force_error.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector3 = VectorOf<double, 3>;
constexpr double steel = 2e11, shear = 7.7e10;

Section strip() { return Section::rectangle(0.02, 0.002); }
Beam ruler(Support right = Support::free) {
  return Beam(1, strip(), Material{steel}, Support::clamped, right);
}
Rod wire(const RodSupport& right) {
  return Rod(1, RodSection::circle(0.01), RodMaterial{steel, shear}, RodSupport::clamped, right);
}

/// How often a bound holds, and how many times too large it is.
struct Tally {
  int presses = 0, held = 0;
  std::vector<double> excess;

  void add(double bound, double error) {
    ++presses, held += bound >= error;
    if (error > 0) excess.push_back(bound / error);
  }
  double median() {
    std::sort(excess.begin(), excess.end());
    return excess[excess.size() / 2];
  }
};

/// @param press  (model) -> whether it has answered, from rest on
template <class Element, class Body, class PressIt>
void compare(Tally& tally, const Body& body, int elements, PressIt&& press) {
  FemModel<Element> model(body, elements), finest(body, 24 * elements);
  ForceError<Element> force_error(body, elements);
  if (!press(model)) return;
  const double bound = force_error(model), error = finest.differ_from(model).difference;
  if (std::isfinite(bound) && std::isfinite(error)) tally.add(bound, error);
}
template <class Element>
void compare_beam(Tally& tally, const Beam& beam, Random& random) {
  const double s = random(0.05, 0.95) * beam.length(), depth = random(0.15);
  compare<Element>(tally, beam, random.integer(4, 16), [&](auto& model) {
    const double w = model.shape().at(s).w;
    Status status = Status::ok;
    for (int k = 1; k <= 10; ++k) status = model.press({s, w + k * depth / 10}).status;
    return status == Status::ok;
  });
}
template <class Element>
void compare_rod(Tally& tally, const Rod& rod, Random& random) {
  const double s = random(0.05, 0.95) * rod.length(), depth = random(0.3) * std::min(s, rod.length() - s);
  const Vector3 normal = Vector3(random(0.2), random(1), random(0.1, 1)).normalized();
  compare<Element>(tally, rod, random.integer(4, 16), [&](auto& model) {
    const double from = normal.dot(model.shape().position(s));
    Status status = Status::ok;
    for (int k = 1; k <= 10; ++k)
      status = model.push(Push<double, 3>{s, from + k * depth / 10, normal}).status;
    return status == Status::ok;
  });
}

}  // namespace

TEST_CASE("the bound holds in 99 of 100 presses, and is 10 times too large in the middle", "[force_error]") {
  Random random(3);
  Tally tally;
  for (int k = 0; k < 32; ++k) {
    compare_beam<Corotational<>>(tally, ruler(k % 2 ? Support::free : Support::pinned), random);
    compare_beam<Corotational<>>(
        tally, arch(1, random(0.05, 0.25), strip(), Material{steel}, Support::clamped), random);
    compare_beam<VonKarman<>>(tally, ruler(Support::pinned).transverse(random(20)), random);
    compare_rod<RoundRod>(tally, wire(k % 2 ? RodSupport::free : RodSupport::clamped), random);
    Rod hook = wire(RodSupport::free);
    hook.naturally({{0.5, 0, 0, 0}, {1, random(4), random(4), random(2)}});
    compare_rod<TwistedRod>(tally, hook, random);
  }
  INFO(tally.held << " of " << tally.presses);
  CHECK(tally.presses >= 120);
  CHECK(100 * tally.held >= 99 * tally.presses);
  CHECK(tally.median() >= 3);
  CHECK(tally.median() <= 30);
}

TEST_CASE("the bound falls with the fourth power of the elements", "[force_error]") {
  const Beam beam = arch(1, 0.2, strip(), Material{steel}, Support::clamped);
  const auto bound = [&](int elements) {
    FemModel<Corotational<>> model(beam, elements);
    ForceError<Corotational<>> force_error(beam, elements);
    const double s = 0.5 * beam.length();  // a node of all of them
    REQUIRE(model.press({s, model.shape().at(s).w - 0.01}).status == Status::ok);
    return force_error(model);
  };
  const double order = std::log2(bound(8) / bound(16));
  INFO("order " << order);
  CHECK(order > 3.5);
  CHECK(order < 4.5);
}

TEST_CASE("what has no error of a mesh has no bound of one", "[force_error]") {
  const Beam straight = ruler(Support::pinned);
  FemModel<> exact(straight, 4);
  ForceError<VonKarman<>> of_exact(straight, 4);
  REQUIRE(exact.press({0.3, 0.05}).status == Status::ok);
  CHECK(of_exact(exact) == 0);

  FemModel<Corotational<>> untouched(straight, 4);
  ForceError<Corotational<>> of_untouched(straight, 4);
  CHECK(of_untouched(untouched) == 0);
}

TEST_CASE("the bound is of the branch on which the beam is", "[force_error]") {
  // Pushed through, an arch answers otherwise than one that comes from rest to the same place.
  const Beam beam = arch(1, 0.1, strip(), Material{steel}, Support::clamped);
  const double s = 0.47 * beam.length();
  FemModel<Corotational<>> model(beam, 16);
  const double top = model.shape().at(s).w;
  ForceError<Corotational<>> force_error(beam, 16);
  double force = 0;
  for (int k = 1; k <= 34; ++k) {
    force = model.press({s, top * (1 - k / 20.0)}).force;
    CHECK(force_error(model) <= 0.01 * std::abs(force) + 0.1);
  }
}

TEST_CASE("the bound is of the worst of several contacts", "[force_error]") {
  using Element = Several<Corotational<>, 2>;
  const Beam beam = ruler();
  const auto pressed = [&](FemModel<Element>& model) {
    Obstacle<double> at[2];
    for (int k = 0; k < 2; ++k) {
      at[k].kind = ObstacleKind::support, at[k].valid = true;
      at[k].place = {k == 0 ? 0.33 : 0.81, k == 0 ? 0.02 : -0.12, {0, 1}};
    }
    REQUIRE(model.push(at, 2) == Status::ok);
    return std::abs(at[0].pushed.force) + std::abs(at[1].pushed.force);
  };
  FemModel<Element> model(beam, 6), finest(beam, 144);
  ForceError<Element> force_error(beam, 6);
  pressed(model);
  const double bound = force_error(model), error = std::abs(pressed(finest) - pressed(model)) / 2;
  CHECK(bound >= error);
  CHECK(bound <= 60 * error);
}

TEST_CASE("the bound after a touch is that of a press with the same force", "[force_error]") {
  // A body pushes where a press would: the same force is as uncertain, from either side.
  for (const double side : {1., -1.}) {
    FemModel<Corotational<>> planar(ruler(), 8);
    ForceError<Corotational<>> of_planar(ruler(), 8);
    FemModel<RoundRod> rod(wire(RodSupport::clamped), 8);
    ForceError<RoundRod> of_rod(wire(RodSupport::clamped), 8);
    Touch<FemModel<Corotational<>>> circle(planar, 0.01);
    Touch<FemModel<RoundRod>> capsule(rod, 0.01);
    TouchResult<double> in_plane;
    TouchResult<double, 3> in_space;
    for (int k = 0; k <= 40; ++k) {
      const double from = side * (0.02 - 0.001 * k);
      in_plane = circle.tick({0.46, from});
      in_space = capsule.tick(VectorOf<double, 3>(0.46, from, -0.1), VectorOf<double, 3>(0, 0, 0.2));
    }
    REQUIRE(in_plane.status == Status::ok);
    REQUIRE(in_space.status == Status::ok);
    const double after_circle = of_planar(planar), after_capsule = of_rod(rod);
    REQUIRE(is_answer(planar.press({in_plane.contact.s, planar.shape().at(in_plane.contact.s).w}).status));
    CAPTURE(side, in_plane.force.norm(), in_space.force.norm());
    CHECK(after_circle == Approx(of_planar(planar)).epsilon(0.5));
    CHECK(after_capsule <= 0.01 * in_space.force.norm());
  }
}

TEST_CASE("a rod whose end is held elsewhere is compared there", "[force_error]") {
  const Rod rod = wire(RodSupport::clamped);
  FemModel<RoundRod> model(rod, 8);
  ForceError<RoundRod> force_error(rod, 8);
  RodPose pose;
  for (int k = 1; k <= 20; ++k) {
    pose.at = {1, 0.002 * k, 0};
    CHECK(model.hold(RodSide::right, pose).status == Status::ok);
  }
  const double from = model.shape().position(0.5).z();
  const auto answer = model.push(Push<double, 3>{0.5, from + 0.01, {0, 0, 1}});
  REQUIRE(answer.status == Status::ok);
  CHECK(force_error(model) <= 0.1 * std::abs(answer.force));
}

TEST_CASE("elements_for: as many as keep the error, and no more than twice that", "[force_error]") {
  const Beam beam = ruler();
  const int coarse = elements_for<Corotational<>>(beam, 0.2, 0.05),
            fine = elements_for<Corotational<>>(beam, 0.2, 1e-3);
  INFO(coarse << ", " << fine);
  CHECK(coarse < fine);
  FemModel<Corotational<>> model(beam, fine), finest(beam, 512);
  for (const double s : {0.35, 0.6, 0.95}) {
    model.reset();
    const double depth = std::min(0.2, 0.3 * s);
    const double force = model.press({s, depth}).force;
    CHECK(finest.differ_from(model).difference <= 1e-3 * std::abs(force));
  }
  CHECK(elements_for<>(ruler(Support::pinned), 0.05, 1e-6) == 4);
}

TEST_CASE("elements_for names what it cannot take", "[force_error]") {
  const Beam beam = ruler();
  CHECK_THROWS_WITH(elements_for<>(beam, 0, 0.01), ContainsSubstring("depth = 0 m"));
  CHECK_THROWS_WITH(elements_for<>(beam, 0.1, 0), ContainsSubstring("error = 0"));
  CHECK_THROWS_WITH(elements_for<>(beam, 0.1, 1), ContainsSubstring("error = 1"));
  CHECK_THROWS_WITH(elements_for<Corotational<>>(beam, 0.2, 1e-7), ContainsSubstring("error = 1e-07"));
}
