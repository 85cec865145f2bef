// Ball joints between rods and to bodies: a bow against a shooting solution of its own, laws, falls, and what is no joint.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double limb_length = 0.3, apart = 0.2, string_length = 0.19;
const RodSection limb_section = RodSection::circle(0.002), string_section = RodSection::circle(0.0005);

/// The force that draws the middle of a bow's string back by so much [m]: limb and half a string, by Runge and Kutta from the clamp and from the tip, and
/// Newton's method.  Of both  r' = (1 + N/EA) t,  EI φ' = M,  M' = -r' × F.
double draw_force(double draw) {
  using Unknown = Eigen::Vector4d;  // moment of the clamp, force in the string, its angle where it begins
  struct End {
    double x, z, angle, moment;
  };
  const auto along = [](End at, const RodSection& section, double length, double fx, double fz) {
    const double EA = spring_steel.young * section.area, EI = spring_steel.young * section.inertia1;
    const auto rate = [&](const End& y) {
      const double c = std::cos(y.angle), s = std::sin(y.angle), stretch = 1 + (fx * c + fz * s) / EA;
      return End{stretch * c, stretch * s, y.moment / EI, -stretch * (c * fz - s * fx)};
    };
    const auto moved = [](const End& y, const End& k, double t) {
      return End{y.x + t * k.x, y.z + t * k.z, y.angle + t * k.angle, y.moment + t * k.moment};
    };
    const int steps = 1000;
    const double h = length / steps;
    for (int k = 0; k < steps; ++k) {
      const End a = rate(at), b = rate(moved(at, a, h / 2)), c = rate(moved(at, b, h / 2)),
                d = rate(moved(at, c, h));
      at = moved(moved(moved(moved(at, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return at;
  };
  const auto off = [&](const Unknown& u) -> Unknown {
    const double right_angle = std::acos(0.0);
    const End tip = along({0, 0, right_angle, u[0]}, limb_section, limb_length, u[1], u[2]);
    const End middle = along({tip.x, tip.z, u[3], 0}, string_section, string_length / 2, u[1], u[2]);
    return {tip.moment, middle.x - apart / 2, middle.z - limb_length - draw, middle.angle};
  };
  // From where the string is straight on, in steps of the draw.
  const double EI = spring_steel.young * limb_section.inertia1;
  Unknown u(0.087 * limb_length, 0.087, 1e-3 * EI, 0.05);
  for (int k = 0; k < 40; ++k) {
    const Unknown r = off(u);
    Eigen::Matrix4d J;
    for (int c = 0; c < 4; ++c) {
      const double by = 1e-6 * (c == 3 ? 1 : 0.1);
      Unknown more = u, less = u;
      more[c] += by, less[c] -= by;
      J.col(c) = (off(more) - off(less)) / (2 * by);
    }
    Unknown step = J.partialPivLu().solve(r);
    if (std::abs(step[3]) > 0.1) step *= 0.1 / std::abs(step[3]);
    u -= step;
  }
  REQUIRE(off(u).norm() < 1e-11);
  return 2 * u[2];
}

Rod limb(double x) {
  Rod rod(limb_length, limb_section, spring_steel, RodSupport::clamped, RodSupport::free);
  return rod.place_left({{x, 0, 0}, {0, 0, 1}, {0, 1, 0}});
}
/// Two limbs, a string that is tied to their tips and is too short, and a ball that holds its middle.  Rods 0 to 2: limb, string, limb.
World<RoundRod> bow(int elements, const NewtonRaphson& solver = {}) {
  Rod string(string_length, string_section, spring_steel, RodSupport::free, RodSupport::free);
  string.place_left({{0.005, 0, limb_length}, {1, 0, 0}, {0, 1, 0}});
  return World<RoundRod>(
      {{limb(0), elements}, {string, elements}, {limb(apart), elements}},
      {RigidBody::sphere({apart / 2, 0, limb_length}, 0.001)},
      {{{0, 1}, {limb_length, 0}}, {{1, 2}, {string_length, limb_length}}, {{1, 3}, {string_length / 2, 0}}},
      solver);
}
Status draw(World<RoundRod>& world, double by) {
  const Status placed = world.place(0, {{0, 0, by}, {1, 0, 0}, {0, 1, 0}});
  return placed == Status::ok ? world.tick() : placed;
}

/// A strut from a hinge, which no end holds but there.
Rod strut(const Point& from, const Point& to) {
  Rod rod((to - from).norm(), limb_section, spring_steel, RodSupport::hinged, RodSupport::free);
  const Point along = (to - from).normalized();
  return rod.place_left({from, along, {0, 1, 0}});
}

}  // namespace

TEST_CASE("a bow draws as its limbs and string do, to fourth order", "[world][joint]") {
  std::array<double, 3> error{};
  int solves = 0;
  const double exact[] = {draw_force(0.005), draw_force(0.02)};
  int at = 0;
  for (const int elements : {8, 16, 32}) {
    World<RoundRod> world = bow(elements);
    for (int k = 1; k <= 200; ++k) {
      CHECK(draw(world, 1e-4 * k) == Status::ok);
      solves += world.solves();
      if (k != 50 && k != 200) continue;
      const double felt = world.joint_force(2).z();
      error[std::size_t(at)] = std::max(error[std::size_t(at)], std::abs(felt / exact[k == 200] - 1));
    }
    ++at;
  }
  INFO(error[0] << " " << error[1] << " " << error[2]);
  CHECK(error[0] <= 1e-4);
  CHECK(error[1] <= 1e-5);
  CHECK(error[2] <= 1e-6);
  CHECK(solves <= 3 * 200 * 2 + 10);
}

TEST_CASE("forces of joints are those that hold the ends, and their work is stored", "[world][joint]") {
  NewtonRaphson exact;
  exact.relative_tolerance = 1e-10;
  const auto left = [&](int ticks) {
    World<RoundRod> world = bow(8, exact);
    double work = 0, before = world.joint_force(2).z();
    const double rest = world.strain_energy();
    for (int k = 1; k <= ticks; ++k) {
      CHECK(draw(world, 0.02 * k / ticks) == Status::ok);
      const double now = world.joint_force(2).z();
      work += (before + now) / 2 * 0.02 / ticks, before = now;
      // What the limbs are held by, and what the ball pulls.
      const Point sum =
          world.held(0, RodSide::left).force + world.held(2, RodSide::left).force + world.joint_force(2);
      CHECK(sum.norm() <= 1e-10);
      for (const auto& [rod, s, other, t] :
           {std::tuple(0, limb_length, 1, 0.0), std::tuple(1, string_length, 2, limb_length)})
        CHECK((world.shape(rod).at(s).r - world.shape(other).at(t).r).norm() <= 1e-12);
    }
    const double stored = world.strain_energy() - rest;
    return std::abs(work / stored - 1);
  };
  const double coarse = left(50), fine = left(100);
  INFO(coarse << " " << fine);
  CHECK(fine <= 1e-4);
  CHECK(coarse / fine >= 3.9);  // the trapezoid's
}

TEST_CASE("two struts on hinges carry as a truss does, and snap through its flat shape", "[world][joint]") {
  const double half = 0.2, height = 0.02;
  const Point left(-half, 0, 0), right(half, 0, 0), apex(0, 0, height);
  World<RoundRod> world({{strut(left, apex), 4}, {strut(right, apex), 4}}, {RigidBody::sphere(apex, 0.0005)},
                        {{{0, 1}, {std::hypot(half, height), std::hypot(half, height)}},
                         {{0, 2}, {std::hypot(half, height), 0}}});
  const double EA = spring_steel.young * limb_section.area, length = std::hypot(half, height);
  bool fell = false;
  for (int k = 1; k <= 3000; ++k) {
    const double z = height - 2e-5 * k;
    const Status status = world.place(0, {{0, 0, z - height}, {1, 0, 0}, {0, 1, 0}}) == Status::ok
                              ? world.tick()
                              : Status::singular;
    CHECK((status == Status::ok || status == Status::snapped));
    fell = fell || status == Status::snapped;
    // Straight until the struts buckle: N = EA (l/L - 1) each.
    const double now = std::hypot(half, z), N = EA * (now / length - 1),
                 euler = std::pow(std::acos(-1.0) / length, 2) * spring_steel.young * limb_section.inertia1;
    if (-N < 0.9 * euler && k < 100) CHECK(world.joint_force(1).z() == Approx(2 * N * z / now).epsilon(1e-6));
    if (z < -height - 1e-4 && N > 0) {
      CHECK(world.joint_force(1).z() == Approx(2 * N * z / now).epsilon(1e-6));
      break;
    }
  }
  CHECK(world.shape(0).at(length).r.z() < -height);
}

TEST_CASE("a chain of loose rods hangs as their weight says", "[world][joint]") {
  // Three links of which none holds itself but by joints, between two stiff posts.
  const RodSection thin = RodSection::circle(0.001);
  const double link = 0.1, density = 7850, g = 9.81, weight = density * thin.area * link * g;
  std::vector<WorldRod> rods;
  for (const double x : {0., 0.28}) {
    Rod post(0.05, RodSection::circle(0.01), spring_steel, RodSupport::clamped, RodSupport::free);
    rods.push_back({post.place_left({{x, 0, 0}, {0, 0, 1}, {0, 1, 0}}), 4});
  }
  for (int k = 0; k < 3; ++k) {
    Rod rod(link, thin, spring_steel, RodSupport::free, RodSupport::free);
    rod.place_left({{-0.01 + k * link, 0, 0.05}, {1, 0, 0}, {0, 1, 0}}).weight(density, {0, 0, -g});
    rods.push_back({rod, 8});
  }
  const World<RoundRod> world(
      rods, {}, {{{0, 2}, {0.05, 0}}, {{2, 3}, {link, 0}}, {{3, 4}, {link, 0}}, {{4, 1}, {link, 0.05}}});
  // Of four joints the outer ones carry one and a half links each, the inner ones half of one.
  CHECK(world.joint_force(0).z() == Approx(-1.5 * weight).epsilon(1e-4));
  CHECK(world.joint_force(3).z() == Approx(1.5 * weight).epsilon(1e-4));
  CHECK(std::abs(world.joint_force(1).z()) == Approx(0.5 * weight).epsilon(1e-4));
  CHECK(world.joint_force(1).x() == Approx(world.joint_force(2).x()).epsilon(1e-9));
  // Moments of one of its ends about the other.
  const Point a = world.shape(2).at(0).r, b = world.shape(2).at(link).r;
  CHECK(std::abs(world.joint_force(0).x()) * (a.z() - b.z()) ==
        Approx(weight * (b.x() - a.x())).epsilon(1e-3));
}

TEST_CASE("which rod of a joint is the first is only a name", "[world][joint]") {
  const auto felt = [](bool exchanged) {
    Rod string(string_length, string_section, spring_steel, RodSupport::free, RodSupport::free);
    string.place_left({{0.005, 0, limb_length}, {1, 0, 0}, {0, 1, 0}});
    const RigidBody ball = RigidBody::sphere({apart / 2, 0, limb_length}, 0.001);
    NewtonRaphson exact;
    exact.relative_tolerance = 1e-11;
    World<RoundRod> world = exchanged ? World<RoundRod>({{limb(apart), 8}, {limb(0), 8}, {string, 8}}, {ball},
                                                        {{{0, 2}, {limb_length, string_length}},
                                                         {{2, 1}, {0, limb_length}},
                                                         {{2, 3}, {string_length / 2, 0}}},
                                                        exact)
                                      : bow(8, exact);
    for (int k = 1; k <= 50; ++k) CHECK(draw(world, 2e-4 * k) == Status::ok);
    return world.joint_force(2).z();
  };
  CHECK(felt(true) == Approx(felt(false)).epsilon(1e-9));
}

TEST_CASE("a string on limbs that hardly yield is touched as one between hinges", "[world][joint]") {
  const auto pressed = [](bool tied) {
    const RodSection stiff = RodSection::circle(0.06);
    Rod tool(0.1, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
    const RodPose above{{0.06, -0.05, 0.05 + 0.0015}, {0, 1, 0}, {0, 0, 1}};
    tool.place_left(above);
    Rod string(0.2, RodSection::circle(0.001), spring_steel, tied ? RodSupport::free : RodSupport::hinged,
               tied ? RodSupport::free : RodSupport::hinged);
    string.place_left({{0, 0, 0.05}, {1, 0, 0}, {0, 1, 0}});
    std::vector<WorldRod> rods{{tool, 8}, {string, 8}};
    std::vector<Joint> joints;
    for (const double x : {0., 0.2}) {
      Rod post(0.05, stiff, spring_steel, RodSupport::clamped, RodSupport::free);
      if (tied) rods.push_back({post.place_left({{x, 0, 0}, {0, 0, 1}, {0, 1, 0}}), 4});
    }
    if (tied) joints = {{{2, 1}, {0.05, 0}}, {{3, 1}, {0.05, 0.2}}};
    World<RoundRod> world(rods, {}, joints);
    double force = 0;
    for (int k = 1; k <= 150; ++k) {
      RodPose hand = above;
      hand.at.z() -= 2e-5 * k;
      CHECK(world.hold(0, RodSide::left, hand) == Status::ok);
      CHECK(world.tick() == Status::ok);
      force = world.contacts() == 1 ? world.contact(0).force.norm() : 0;
    }
    world.reset();
    CHECK(world.contacts() == 0);
    return force;
  };
  const double tied = pressed(true), hinged = pressed(false);
  CHECK(hinged > 0.5);
  CHECK(tied == Approx(hinged).epsilon(2e-3));
}

TEST_CASE("a reset brings joints back to where construction has drawn them", "[world][joint]") {
  World<RoundRod> world = bow(8);
  const double tip = world.shape(0).at(limb_length).r.x();
  const Point strung = world.joint_force(0);
  CHECK(tip == Approx(0.005).epsilon(1e-3));
  for (int k = 1; k <= 30; ++k) CHECK(draw(world, 5e-4 * k) == Status::ok);
  world.reset();
  CHECK(world.tick() == Status::ok);
  CHECK(world.shape(0).at(limb_length).r.x() == Approx(tip).epsilon(1e-9));
  CHECK((world.joint_force(0) - strung).norm() <= 1e-6 * strung.norm());
}

TEST_CASE("joints draw rods together around what is in their way", "[world][joint]") {
  const double shorter = 0.15;
  Rod string(shorter, string_section, spring_steel, RodSupport::free, RodSupport::free);
  string.place_left({{0.025, 0, limb_length}, {1, 0, 0}, {0, 1, 0}});
  Rod bar(0.1, RodSection::circle(0.004), spring_steel, RodSupport::clamped, RodSupport::clamped);
  bar.place_left({{0.01, -0.05, 0.2}, {0, 1, 0}, {1, 0, 0}});
  World<RoundRod> world({{limb(0), 8}, {string, 8}, {limb(apart), 8}, {bar, 8}}, {},
                        {{{0, 1}, {limb_length, 0}}, {{1, 2}, {shorter, limb_length}}});
  CHECK(world.tick() == Status::ok);
  REQUIRE(world.contacts() == 1);
  CHECK(world.contact(0).rod == std::array<int, 2>{0, 3});
  CHECK(world.contact(0).force.x() < -0.1);
  CHECK(world.shape(0).at(0.2).r.x() < 0.008);
}

TEST_CASE("a rod that one joint holds hangs from it", "[world][joint]") {
  Rod pendulum(0.1, limb_section, spring_steel, RodSupport::free, RodSupport::free);
  pendulum.place_left({{0, 0, limb_length}, {1, 0, 0}, {0, 1, 0}}).weight(7850, {0, 0, -9.81});
  const World<RoundRod> world({{limb(0), 8}, {pendulum, 8}}, {}, {{{0, 1}, {limb_length, 0}}});
  const Point way = world.shape(1).at(0.1).r - world.shape(0).at(limb_length).r;
  CHECK(way.z() == Approx(-0.1).epsilon(1e-6));
  CHECK(world.joint_force(0).z() == Approx(-7850 * 9.81 * limb_section.area * 0.1).epsilon(1e-6));
}

TEST_CASE("a loose rod goes along with two balls, and takes no force", "[world][joint]") {
  const Point home(0, 0, 0), end(0.1, 0, 0);
  Rod loose(0.1, limb_section, spring_steel, RodSupport::free, RodSupport::free);
  World<RoundRod> world({{loose, 8}}, {RigidBody::sphere(home, 0.001), RigidBody::sphere(end, 0.001)},
                        {{{0, 1}, {0, 0}}, {{0, 2}, {0.1, 0}}});
  for (const double side : {1., -1., 2.}) {
    for (const int ball : {0, 1})
      CHECK(world.place(ball, {{0, 2e-3 * side, 1e-3 * side}, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
    CHECK(world.tick() == Status::ok);
    CHECK(world.joint_force(0).norm() + world.joint_force(1).norm() <= 1e-9);
    CHECK((world.shape(0).at(0.1).r - end - Point(0, 2e-3 * side, 1e-3 * side)).norm() <= 1e-12);
  }
}

TEST_CASE("rods of two principal axes are joined, too", "[world][joint]") {
  // Tips of two flat strips, one upright on the other, that a ball leads down: stiffnesses add.
  const RodSection flat = RodSection::rectangle(0.006, 0.001);
  Rod first(0.15, flat, spring_steel, RodSupport::clamped, RodSupport::free), second = first;
  second.place_left({{0.15, -0.15, 0}, {0, 1, 0}, {0, 0, 1}});
  World<TwistedRod> world({{first, 8}, {second, 8}}, {RigidBody::sphere({0.15, 0, 0}, 0.0002)},
                          {{{0, 1}, {0.15, 0.15}}, {{0, 2}, {0.15, 0}}});
  const double d = 1e-5;
  CHECK(world.place(0, {{0, 0, -d}, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
  CHECK(world.tick() == Status::ok);
  const double k = 3 * spring_steel.young / std::pow(0.15, 3);
  CHECK(-world.joint_force(1).z() / d == Approx(k * (flat.inertia1 + flat.inertia2)).epsilon(1e-3));
  CHECK(world.joint_force(0).norm() / d ==
        Approx(k * std::min(flat.inertia1, flat.inertia2)).epsilon(0.5).margin(k * flat.inertia2));
}

TEST_CASE("what cannot be joined is refused by name", "[world][joint]") {
  const WorldRod a{limb(0), 8}, b{limb(apart), 8};
  const RigidBody ball = RigidBody::sphere({1, 1, 1}, 0.001), plane = RigidBody::plane({0, 0, -1}, {0, 0, 1});
  const auto refuses = [&](const std::vector<WorldRod>& rods, const Joint& joint, const char* why) {
    INFO(why);
    CHECK_THROWS_WITH(World<RoundRod>(rods, {ball, plane}, {joint}), ContainsSubstring(why));
  };
  refuses({a, b}, {{0, 4}, {0, 0}}, "joint rod = 4");
  refuses({a, b}, {{2, 1}, {0, 0}}, "joint rod = 2");
  refuses({a, b}, {{0, 0}, {0, 0.1}}, "joint rod = 0");
  refuses({a, b}, {{0, 3}, {0, 0}}, "joint body = 1");
  refuses({a, b}, {{0, 1}, {0.1, 0.4}}, "joint s = 0.4 m");
  refuses({a, b}, {{0, 1}, {std::nan(""), 0.1}}, "joint s = nan m");
  refuses({a, b}, {{0, 2}, {0.1, 0.1}}, "joint s = 0.1 m");
  Rod loose(0.1, limb_section, spring_steel, RodSupport::free, RodSupport::free);
  CHECK_THROWS_WITH(FemModel<RoundRod>(loose, 8), ContainsSubstring("mechanism"));
  CHECK_THROWS_WITH(World<RoundRod>({{loose, 8}}), ContainsSubstring("mechanism"));
  CHECK_THROWS_WITH(World<RoundRod>({a, b}, {}, std::vector<Joint>(17, {{0, 1}, {0.1, 0.1}})),
                    ContainsSubstring("joints = 17"));
}

TEST_CASE("a joint takes back in the same solve what it has lent", "[world][joint]") {
  Rod loose(0.1, limb_section, spring_steel, RodSupport::free, RodSupport::free);
  loose.place_left({{0.02, 0, limb_length}, {1, 0, 0}, {0, 1, 0}});
  World<RoundRod> world({{limb(0.02), 8}, {loose, 8}}, {RigidBody::sphere({0.12, 0, limb_length}, 0.001)},
                        {{{0, 1}, {limb_length, 0}}, {{1, 2}, {0.1, 0}}});
  const double stiffness = 3 * spring_steel.young * limb_section.inertia1 / std::pow(limb_length, 3);
  int solves = 0;
  for (int k = 1; k <= 20; ++k) {
    const double x = 1e-9 * k * k;  // no way that goes on evenly
    CHECK(world.place(0, {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
    CHECK(world.tick() == Status::ok);
    solves += world.solves();
    // What is lent to the loose rod is none of the forces at its ends.
    const double force = world.joint_force(0).x();
    CHECK(force == Approx(stiffness * x).epsilon(1e-3));
    CHECK(std::abs(world.joint_force(1).x() - force) <= 1e-12 * force);
  }
  CHECK(solves <= 24);
}
