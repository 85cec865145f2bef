// A rod that touches itself: a planar loop against collocation, and a twisted one that snaps into a plectoneme.
#include <algorithm>
#include <cmath>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// An end at x with its tangent up by an angle in the plane z = 0.
RodPose end_at(double x, double angle) {
  return {{x, 0, 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, 1}};
}
template <class Element>
Status lead(World<Element>& world, const RodPose& left, const RodPose& right) {
  const Status first = world.hold(0, RodSide::left, left), second = world.hold(0, RodSide::right, right);
  return first == Status::ok && second == Status::ok ? world.tick() : Status::invalid_request;
}

}  // namespace

// Against bends out of its plane it is a hundred times as stiff: a round rod leaves the plane before it touches itself.
TEST_CASE("a loop whose legs touch each other is as exact as the elements", "[world][verification]") {
  struct Bound {
    int elements;
    double force, contact;
  };
  const Csv reference("loop_on_itself.csv");
  constexpr double half = 0.15, a = 0.02;
  const double EI = 200e9 * pi * 16e-12 / 64, EA = 200e9 * pi * 1e-6;
  for (const Bound& bound : {Bound{64, 2e-4, 1e-3}, Bound{128, 1.5e-5, 1e-4}}) {
    const Rod rod(2 * half, RodStiffness{EA, EI, 100 * EI, 100 * EI}, 0.002, RodSupport::clamped,
                  RodSupport::clamped);
    Rod placed = rod;
    placed.place_left({{-half, 0, 0}, {1, 0, 0}, {0, 0, 1}})
        .place_right({{half, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    World<TwistedRod> world({{placed, bound.elements}});
    const auto bend = [&](double x, double angle) {
      REQUIRE(lead(world, end_at(-x, angle), end_at(x, -angle)) == Status::ok);
    };
    for (int k = 1; k <= 40; ++k) {
      const double angle = pi / 2 * k / 40;
      bend(half * std::sin(angle) / angle, angle);
    }
    for (int k = 1; k <= 40; ++k) bend(2 * half / pi + (a - 2 * half / pi) * k / 40, pi / 2);
    double force = 0, contact = 0, place = 0, at = 0;
    for (std::size_t row = 0; row < reference.rows(); ++row) {
      const double beta = reference.number(row, "beta_deg");
      if (beta > 90) break;
      const int steps = 1 + static_cast<int>((beta - at) / 0.5);
      for (int k = 1; k <= steps; ++k) bend(a, pi / 2 - (at + (beta - at) * k / steps) * pi / 180);
      at = beta;
      const double F = reference.number(row, "Fx"), P = std::abs(reference.number(row, "P"));
      const HeldEnd<double> hand = world.held(0, RodSide::right);
      force = std::max(force, std::abs(hand.force.x() + F) / F);
      CHECK((hand.force + world.held(0, RodSide::left).force).norm() < 1e-12 * F);
      if (reference.text(row, "mode") == "free") CHECK(world.contacts() == 0);
      if (reference.text(row, "mode") != "touch") continue;
      REQUIRE(world.contacts() == 1);
      const RodContact found = world.contact(0);
      CHECK(found.rod == std::array<int, 2>{0, 0});
      contact = std::max(contact, std::abs(found.force.norm() - P) / P);
      place = std::max({place, std::abs(found.s[0] - reference.number(row, "s_c")),
                        std::abs(2 * half - found.s[1] - reference.number(row, "s_c"))});
    }
    INFO(bound.elements << " elements: force " << force << ", contact " << contact << ", place " << place);
    CHECK(force < bound.force);
    CHECK(contact < bound.contact);
    CHECK(place < 1e-5 * 2 * half);
  }
}

TEST_CASE("a twisted loop snaps where its branch ends, and holds itself off", "[world][verification]") {
  const Csv reference("twisted_loop.csv");
  constexpr double length = 0.3, distance = 0.15, thickness = 0.002;
  constexpr int elements = 32;
  const Rod rod(length, RodSection::circle(thickness), RodMaterial{200e9, 200e9 / 2.6}, RodSupport::clamped,
                RodSupport::clamped);
  World<TwistedRod> world({{rod, elements}});
  const double bow = 0.6, chord = length * std::sin(bow) / bow;
  for (int k = 1; k <= 60; ++k) {
    const double angle = bow * k / 60;
    REQUIRE(lead(world, end_at(0, angle), end_at(length * std::sin(angle) / angle, -angle)) == Status::ok);
  }
  for (int k = 1; k <= 60; ++k)
    REQUIRE(lead(world, end_at(0, bow), end_at(chord + (distance - chord) * k / 60, -bow)) == Status::ok);
  for (int k = 1; k <= 60; ++k)
    REQUIRE(lead(world, end_at(0, bow - bow * k / 60), end_at(distance, bow * k / 60 - bow)) == Status::ok);
  double error = 0, snapped = 0;
  std::size_t row = 1;
  for (int degrees = 1; degrees <= 660; ++degrees) {
    const double angle = degrees * pi / 180;
    RodPose right = end_at(distance, 0);
    right.director = {0, -std::sin(angle), std::cos(angle)};
    const Status status = lead(world, end_at(0, 0), right);
    if (status == Status::snapped) snapped = degrees;
    if (degrees <= 630) REQUIRE(status == Status::ok);
    if (row == reference.rows() || reference.number(row, "Phi_deg") != degrees) continue;
    const HeldEnd<double> hand = world.held(0, RodSide::left);
    const Point n(reference.number(row, "nx"), reference.number(row, "ny"), 0),
        m(reference.number(row, "mx"), reference.number(row, "my"), reference.number(row, "mz"));
    error = std::max({error, std::abs(hand.force.x() + n.x()) / n.norm(),
                      std::abs(hand.force.norm() - n.norm()) / n.norm(),
                      std::abs(hand.moment.norm() - m.norm()) / m.norm()});
    ++row;
  }
  INFO("error " << error << ", snapped at " << snapped);
  CHECK(row == reference.rows());
  CHECK(error < 1e-4);
  CHECK(snapped >= 637);
  CHECK(snapped <= 642);  // and up to three ticks on its way
  REQUIRE(world.contacts() > 0);
  const Centreline<double, 3> line = world.shape(0);
  double least = length;
  for (int i = 0; i < 600; ++i)
    for (int j = i + 8; j <= 600; ++j)
      least = std::min(least, (line.at(length * i / 600).r - line.at(length * j / 600).r).norm());
  CHECK(least > thickness * (1 - 1e-2));
}
