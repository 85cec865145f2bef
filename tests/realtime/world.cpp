// World::tick() and step(): no heap, finite, a bounded number of linear solves, whatever hands do.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Rod rod_at(const RodPose& pose, const RodSupport& right, double density = 0) {
  RodMaterial material = spring_steel;
  material.density = density;
  Rod rod(0.2, RodSection::circle(0.002), material, RodSupport::clamped, right);
  return rod.place_left(pose);
}

/// A hand that presses, slides, leaps, turns about, and asks for what is none.   @param down  by how much in a tick [m]
std::vector<RodPose> poses(const RodPose& start, double down = 1e-4) {
  Random random(7);
  std::vector<RodPose> path;
  for (int k = 0; k < 400; ++k) {
    RodPose pose = start;
    pose.at += Point(1e-5 * k, 5e-5 * k, -down * k);
    path.push_back(turned(pose, Point(1, 0, 0), -5e-4 * k));
  }
  for (int k = 0; k < 100; ++k) {
    RodPose pose = turned(start, detail::unit(Point(random(1.0), random(1.0), random(1.0))), random(3.0));
    pose.at += Point(random(0.1), random(0.1), random(0.1));
    path.push_back(pose);
  }
  for (const double bad : {std::nan(""), double(INFINITY), 1e300}) {
    RodPose pose = start;
    pose.at.z() = bad;
    path.push_back(pose);
    path.push_back({start.at, Point(0, bad, 0), start.director});
  }
  return path;
}

/// A way through a world, where every tick takes nothing from the heap, is bounded and finite, and most answer.
/// @param lead takes it to a pose  @param finite that all it says is finite
template <class Element, class Lead, class Finite>
void watch(World<Element>& world, const std::vector<RodPose>& path, const Lead& lead, const Finite& finite) {
  int answered = 0, touching = 0, not_finite = 0, most = 0;
  const HeapUse use = heap_use([&]() noexcept {
    for (const RodPose& pose : path) {
      lead(pose);
      answered += is_answer(world.tick());
      touching += world.contacts() > 0;
      most = std::max(most, world.solves());
      not_finite += !finite();
    }
    world.reset();
  });
  INFO(answered << " of " << path.size() << " answered, " << touching << " with contacts, at most " << most
                << " solves");
  CHECK(use == HeapUse{});
  CHECK(not_finite == 0);
  CHECK(most <= 48 + 2);
  CHECK(answered > 390);
  CHECK(touching > 300);
}

template <class Element>
void check_tick() {
  const RodPose start{{0.1, -0.1, 0.0025}, {0, 1, 0}, {0, 0, 1}};
  World<Element> world({{rod_at(start, RodSupport::free), 8},
                        {rod_at({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, RodSupport::clamped), 8},
                        {rod_at({{0, 0.05, 0}, {1, 0, 0}, {0, 0, 1}}, RodSupport::free), 8}});
  watch(
      world, poses(start), [&](const RodPose& pose) { (void)world.hold(0, RodSide::left, pose); },
      [&] {
        const HeldEnd<double> held = world.held(0, RodSide::left);
        bool finite = held.force.allFinite() && held.moment.allFinite();
        for (int rod = 0; rod < world.rods(); ++rod)
          for (const auto& node : world.shape(rod)) finite = finite && is_finite(node);
        return finite;
      });
  // Recovered.
  CHECK(world.hold(0, RodSide::left, start) == Status::ok);
  CHECK(world.tick() == Status::ok);
  CHECK(world.contacts() == 0);
}

/// The same in steps of a millisecond, with friction.  The hand comes closer by leaps and may be through the rod after one: it begins anew.
template <class Element>
void check_step() {
  const RodPose start{{0.1, -0.1, 0.0025}, {0, 1, 0}, {0, 0, 1}};
  World<Element> world({{rod_at(start, RodSupport::free, 7850), 8, Friction(0.3, 0.3)},
                        {rod_at({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, RodSupport::clamped, 7850), 8},
                        {rod_at({{0, 0.05, 0}, {1, 0, 0}, {0, 0, 1}}, RodSupport::free, 7850), 8}});
  int answered = 0, touching = 0, not_finite = 0, most = 0;
  const std::vector<RodPose> path = poses(start);
  const HeapUse use = heap_use([&]() noexcept {
    for (const RodPose& pose : path) {
      (void)world.hold(0, RodSide::left, pose);
      answered += is_answer(world.step(1e-3));
      touching += world.contacts() > 0;
      most = std::max(most, world.solves());
      not_finite += !std::isfinite(world.energy().sum()) || !world.held(0, RodSide::left).force.allFinite();
    }
    world.throw_rod(2, [](double) { return VectorOf<double, 6>(VectorOf<double, 6>::Ones()); });
    (void)world.step(1e-3);
    world.reset();
  });
  INFO(answered << " of " << path.size() << " answered, " << touching << " with contacts, at most " << most
                << " solves");
  CHECK(use == HeapUse{});
  CHECK(not_finite == 0);
  CHECK(most <= 6 * 48);
  CHECK(answered > 390);
  CHECK(touching > 300);
  CHECK(noexcept(world.step(1e-3)));
  CHECK(noexcept(world.energy()));
  CHECK(world.step(1e-3) == Status::ok);
}

/// A string between two posts, tied to both, that a ball leads and a rod is below.
void check_joints() {
  std::vector<WorldRod> rods;
  for (const double x : {0., 0.2})
    rods.push_back({rod_at({{x, 0, 0}, {0, 0, 1}, {0, 1, 0}}, RodSupport::free), 8});
  Rod string(0.19, RodSection::circle(0.0005), spring_steel, RodSupport::free, RodSupport::free);
  rods.push_back({string.place_left({{0.005, 0, 0.2}, {1, 0, 0}, {0, 1, 0}}), 8});
  rods.push_back({rod_at({{0.08, -0.1, 0.197}, {0, 1, 0}, {0, 0, 1}}, RodSupport::clamped), 8});
  World<RoundRod> world(rods, {RigidBody::sphere({0.1, 0, 0.2}, 0.001)},
                        {{{0, 2}, {0.2, 0}}, {{2, 1}, {0.19, 0.2}}, {{2, 4}, {0.095, 0}}});
  watch(
      world, poses({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
      [&](const RodPose& pose) { (void)world.place(0, pose); },
      [&] {
        bool finite = true;
        for (int k = 0; k < 3; ++k) finite = finite && world.joint_force(k).allFinite();
        return finite;
      });
}

/// A needle whose end stays above a table that tells its own distance, through a tube about an arc.
void check_shapes() {
  const RodPose start{{0, -0.1, 0.0025}, {0, 1, 0}, {0, 0, 1}};
  const RigidBody table = RigidBody::field(
      [](const Point& p) {
        return SurfaceDistance{p.z(), {0, 0, 1}};
      },
      0.1, 1);
  const RigidBody bent =
      RigidBody::tube(ArcSpline({0, -0.05, 0}, {0, 1, 0}).arc(0.03).arc(0.2, {0, 0, 1}), 0.02);
  World<RoundRod> world({{rod_at(start, RodSupport::free), 8, 0.2}}, {table, bent});
  watch(
      world, poses(start, 3e-6), [&](const RodPose& pose) { (void)world.hold(0, RodSide::left, pose); },
      [&] { return world.held(0, RodSide::left).force.allFinite(); });
}

}  // namespace

TEST_CASE("bodies of any shape take nothing from the heap in a tick", "[realtime][world]") { check_shapes(); }

TEST_CASE("joints take nothing from the heap in a tick", "[realtime][world]") { check_joints(); }

TEST_CASE("rods that touch take nothing from the heap in a tick", "[realtime][world]") {
  check_tick<RoundRod>();
  check_tick<TwistedRod>();
}

TEST_CASE("rods with mass that touch take nothing from the heap in a step", "[realtime][world]") {
  check_step<RoundRod>();
  check_step<TwistedRod>();
}
