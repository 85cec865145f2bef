// The plane that turns: planar models in space, against the rods that they stand for.
#include <functional>

#include "once_training.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/instructions.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/turning_plane.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double length = 0.3;

Rod bar(const RodSupport& left, const RodSupport& right) {
  Rod bar(length, RodSection::circle(0.002), spring_steel, left, right);
  return bar.place_left({{0.1, 0.2, 0.3}, {0.6, 0, 0.8}, {0, 1, 0}});
}
Point across(double angle) {
  return std::cos(angle) * Point(0, 1, 0) + std::sin(angle) * Point(-0.8, 0, 0.6);
}

std::string rejection(const Rod& rod) {
  try {
    (void)beam_in_any_plane(rod);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// Instructions of a push in space over those in the plane.
template <class Model, class Planar>
double cost(const Rod& rod, const Model& model, Planar&& press) {
  TurningPlane<Model> lifted(rod, model);
  Model planar = model;
  const Point n = across(0.3);
  const double home = n.dot(rod.left_pose().at);
  const auto once = [&](double d) { return lifted.push({0.17, home + d, n}); };
  once(0.004), press(planar, 0.004);
  const long in_space = instructions([&] { once(0.0041); }),
             in_plane = instructions([&] { press(planar, 0.0041); });
  return in_plane > 0 ? static_cast<double>(in_space) / static_cast<double>(in_plane) : 0;
}

}  // namespace

TEST_CASE("a planar model that turns gives the answers of the rod in space", "[rod]") {
  const Rod rod = bar(RodSupport::clamped, RodSupport::free);
  TurningPlane<FemModel<Corotational<>>> lifted(rod, {beam_in_any_plane(rod), 32});
  FemModel<TwistedRod> full(rod, 32);
  for (const double angle : {0.0, 1.0, 2.5, 4.0})
    for (const double d : {0.01, 0.05, 0.1}) {
      // Across the axis, and leaning toward it.
      for (const double lean : {0.0, 0.2}) {
        const Point n = std::cos(lean) * across(angle) + std::sin(lean) * rod.left_pose().along;
        const double s = 0.25, home = n.dot(rod.left_pose().at + s * rod.left_pose().along);
        const auto expected = full.push({s, home + d, n}), got = lifted.push({s, home + d, n});
        REQUIRE(expected.status == Status::ok);
        REQUIRE(got.status == Status::ok);
        CHECK(got.force == Approx(expected.force).epsilon(5e-6));
        CHECK((lifted.shape().at(length).r - full.shape().at(length).r).norm() <= 1e-6 * length);
        CHECK((lifted.shape().at(0.123).r - full.shape().at(0.123).r).norm() <= 1e-6 * length);
      }
    }
}

TEST_CASE("after a reset the plane is the one of before", "[rod][reset]") {
  const Rod rod = bar(RodSupport::clamped, RodSupport::free);
  TurningPlane<FemModel<Corotational<>>> lifted(rod, {beam_in_any_plane(rod), 8});
  const VectorOf<double, 3> before = lifted.shape()[8].director;
  const Point n = across(2.5);
  REQUIRE(lifted.push({0.2, n.dot(rod.left_pose().at) + 0.02, n}).status == Status::ok);
  REQUIRE((lifted.shape()[8].director - before).norm() > 0.1);
  lifted.reset();
  CHECK(lifted.shape()[8].director == before);
}

TEST_CASE("a trained model answers in space", "[rod]") {
  const Rod rod = bar(RodSupport::hinged, RodSupport::cardan);
  const Beam beam = beam_in_any_plane(rod);
  const auto full = full_model(beam);
  const auto plan = TrainingPlan::anywhere(beam, 0.006);
  const TurningPlane<PodModel<>> pod(rod, PodModel<>(train_pod(take_snapshots(beam, full, plan))));
  const TurningPlane<GalerkinModel<>> galerkin(
      rod, GalerkinModel<>(train_galerkin(take_snapshots_at_tensions(beam, full, plan))));
  FemModel<TwistedRod> space(rod, 64);
  const auto check = [&](auto model) {
    for (const double angle : {0.4, 3.0})
      for (const double d : {-0.003, 0.005}) {
        const Point n = across(angle);
        const double home = n.dot(rod.left_pose().at);
        const auto got = model.push({0.12, home + d, n});
        REQUIRE(got.status == Status::ok);
        // Moderate rotation: (d/L)² of the force, times about 2.
        CHECK(got.force == Approx(space.push({0.12, home + d, n}).force).epsilon(2e-3));
      }
  };
  check(pod);
  check(galerkin);
  const auto press = [](auto& model, double d) { return model.press({0.17, d}); };
  CHECK(cost(rod, pod.planar(), press) <= 1.15);
  CHECK(cost(rod, galerkin.planar(), press) <= 1.15);
}

TEST_CASE("a model in space costs what it costs in the plane", "[rod]") {
  const Rod rod = bar(RodSupport::clamped, RodSupport::free);
  const Beam beam = beam_in_any_plane(rod);
  CHECK(cost(rod, FemModel<>(beam, 8), [](auto& model, double d) { return model.press({0.17, d}); }) <= 1.15);
  CHECK(cost(rod, FemModel<Corotational<>>(beam, 8), [](auto& model, double d) {
          return model.push(Push<double>{0.17, d, {0, 1}});
        }) <= 1.15);
}

TEST_CASE("a rod that is not the same in each plane is rejected by name", "[rod]") {
  const RodSupport c = RodSupport::clamped, f = RodSupport::free;
  CHECK(rejection(Rod(1, RodSection::rectangle(0.01, 0.02), spring_steel, c, f))
            .find("bending2 stiffness = ") == 0);
  Rod rod = bar(c, f);
  CHECK(rejection(Rod(rod).naturally({{length, 0, 1, 0}})) ==
        "arc curvature2 = 1 1/m: must be 0: straight by nature");
  CHECK(rejection(Rod(rod).load(Point(0, 1, 0))) == "load = 1 N/m: must be along the axis, 0 across it");
  CHECK(rejection(Rod(rod).load(Point(0.6, 0, 0.8))) == "");
  CHECK(rejection(Rod(rod).add(RodForce{0.1, {0, 2, 0}})) ==
        "force = 2 N: must be along the axis, 0 across it");
  CHECK(rejection(Rod(rod).add(RodFoundation{0, 0.1, 1, 1})) == "foundations = 1: must be none");
  CHECK(rejection(Rod(rod).section([](double) { return RodSection::circle(0.001); })) ==
        "parts = 1: must be none: one section for all of the rod");
  CHECK(rejection(bar(c, RodSupport::sliding)) ==
        "right support = sliding: must be free, clamped, hinged, cardan, or a hinge that slides along the "
        "axis");
  CHECK(rejection(bar(c, c).place_right({{0.28, 0.2, 0.54}, {0.6, 0, 0.8}, {-0.8, 0, 0.6}}))
            .find("right pose director = ") == 0);
  // A rod that buckles has one plane.
  Rod buckled = bar(c, c);
  buckled.place_right({{0.1 + 0.6 * 0.29, 0.2, 0.3 + 0.8 * 0.29}, {0.6, 0, 0.8}, {0, 1, 0}});
  CHECK_THROWS_AS(TurningPlane<FemModel<Corotational<>>>(buckled, {beam_in_any_plane(buckled), 8}),
                  std::invalid_argument);
}
