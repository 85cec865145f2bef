// A rod that is pushed into a tube: it buckles to and fro, then winds along the wall as a helix, on a line of contacts.
// Paslay and Bogy 1964; Lubinski, Althouse and Logan 1962: the pitch; Mitchell 1988: the force on the wall.  Both are of small slopes.
// Of any slope α the energy of a helix of radius r, as long as s, is  s (EI sin⁴α/2r² + F cos α), so that with the least of it
//
//   F = 2 EI sin²α cos α/r²,    pitch = 2πr/tan α → 2π√(2EI/F),    w = EI sin⁴α/r³ → r F²/4EI
#include <algorithm>
#include <cmath>
#include <vector>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double diameter = 0.001, r = 0.001;  // of the rod, and of the helix of its centreline
const double EI = 200e9 * pi * 1e-12 / 64;
constexpr double steepest = 0.04;  // slope of the helix under the force to which rods are pushed
const double pitch = 2 * pi * r / steepest;

/// A rod of so many pitches in the middle of a tube, and a hand at its right end.
struct PushedIn {
  PushedIn(double pitches, int elements)
      : length(pitches * pitch),
        hand{{length, 0, 0}, {1, 0, 0}, {0, 0, 1}},
        world({{rod(), elements}}, {RigidBody::tube({-0.1, 0, 0}, {length + 0.1, 0, 0}, r + diameter / 2)}) {}
  Rod rod() const {
    Rod rod(length, RodSection::circle(diameter), RodMaterial::isotropic(200e9, 0.3), RodSupport::clamped,
            RodSupport::clamped);
    rod.place_left({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}).place_right(hand);
    return rod;
  }
  /// A hand that is no better than 10 µm pushes it in.
  Status push(double by, double aside) {
    hand.at = {hand.at.x() - by, 1e-5 * std::sin(aside), 1e-5 * std::cos(aside)};
    REQUIRE(world.hold(0, RodSide::right, hand) == Status::ok);
    return world.tick();
  }
  double force() const { return -world.held(0, RodSide::right).force.x(); }

  double length;
  RodPose hand;
  World<RoundRod> world;
};

struct Helix {
  double pitch, load;  // [m], of the wall [N/m]
};
/// Of the contacts but three at either end, where the rod comes to the wall.
Helix helix_of(const World<RoundRod>& world) {
  std::vector<RodContact> all;
  for (int k = 0; k < world.contacts(); ++k) all.push_back(world.contact(k));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.s[0] < b.s[0]; });
  const std::size_t first = 3, last = all.size() - 4;
  double turned = 0, force = all[first].force.norm();
  for (std::size_t k = first; k < last; ++k) {
    const Point &a = all[k].at[0], &b = all[k + 1].at[0];
    turned += std::atan2(a.y() * b.z() - a.z() * b.y(), a.y() * b.y() + a.z() * b.z());
    force += all[k + 1].force.norm();
  }
  // Each contact carries half of the way to those beside it.
  return {2 * pi * (all[last].at[0].x() - all[first].at[0].x()) / std::abs(turned),
          2 * force / (all[last].s[0] + all[last + 1].s[0] - all[first].s[0] - all[first - 1].s[0])};
}
Helix expected(double force) {
  double square = force * r * r / (2 * EI);  // sin² α
  for (int k = 0; k < 20; ++k) square = force * r * r / (2 * EI) / std::sqrt(1 - square);
  return {2 * pi * r * std::sqrt((1 - square) / square), EI * square * square / (r * r * r)};
}
double farthest(const World<RoundRod>& world, double length) {
  double most = 0;
  for (int i = 0; i <= 2000; ++i) {
    const Point p = world.shape(0).at(length * i / 2000).r;
    most = std::max(most, std::hypot(p.y(), p.z()));
  }
  return most;
}

}  // namespace

TEST_CASE("a rod that is pushed into a tube winds along its wall as a helix", "[world][verification]") {
  PushedIn pushed(3, 18);
  const double force = 2 * EI * steepest * steepest / (r * r), step = pushed.length * 2.2e-6;
  int limits = 0, wound = 0;
  for (int tick = 1; tick <= 400 && pushed.force() < force; ++tick) {
    const Status status = pushed.push(step, tick / 100.0);
    limits += status == Status::iteration_limit;
    // What the ends do to it decays by exp(-2x √(F/2EI)): the middle of a shorter helix has more than 1 % of that.
    if (pushed.force() < 0.7 * force) continue;
    // All along it, there are contacts on the line, and it goes on without a fall.
    REQUIRE(status == Status::ok);
    REQUIRE(pushed.world.contacts() >= 11);
    const Helix is = helix_of(pushed.world),
                small{2 * pi * std::sqrt(2 * EI / pushed.force()),
                      r * pushed.force() * pushed.force() / (4 * EI)},
                exact = expected(pushed.force());
    INFO(pushed.force() << " N: pitch " << is.pitch / small.pitch << ", load " << is.load / small.load << "; "
                        << is.pitch / exact.pitch << ", " << is.load / exact.load << " of any slope");
    CHECK(std::abs(is.pitch / small.pitch - 1) < 0.01);
    CHECK(std::abs(is.load / small.load - 1) < 0.01);
    CHECK(std::abs(is.pitch / exact.pitch - 1) < 0.005);
    CHECK(std::abs(is.load / exact.load - 1) < 0.01);
    CHECK(farthest(pushed.world, pushed.length) < r + 0.02 * diameter);
    ++wound;
  }
  INFO(limits << " ticks without an answer, " << wound << " on the helix");
  CHECK(limits <= 20);
  CHECK(wound > 100);
  CHECK(pushed.force() >= force);
}

TEST_CASE("a helix with no room for more contacts says so, and goes back", "[world]") {
  PushedIn pushed(3, 24);
  const double step = pushed.length * 2.2e-6;
  double last = 0;
  int tick = 0;
  Status status = Status::ok;
  while (status != Status::out_of_range && ++tick < 400) {
    status = pushed.push(step, tick / 100.0);
    if (status == Status::ok) last = pushed.force();
  }
  CHECK(pushed.world.contacts() == World<RoundRod>::most_contacts);
  for (int k = 0; k < 20; ++k) {
    CHECK(pushed.push(step, tick / 100.0) == Status::out_of_range);
    CHECK(pushed.force() == last);
  }
  for (int k = 0; k < 40; ++k) status = pushed.push(-step, tick / 100.0);
  CHECK(status == Status::ok);
  CHECK(pushed.force() < last);
  CHECK(pushed.force() > last / 2);
}
