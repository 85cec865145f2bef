// Several contacts beside and past an end that holds w: what Touch feels there with one.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

namespace {

using Vector = Vector2<double>;

Beam bar_on(Support right) {
  return {1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, right};
}
Beam clamped_ruler(Support right) {
  return {0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, right};
}

/// A hand alone, the same hand among several contacts, and once more where another one presses the middle by a hundredth of the length.
struct Hands {
  Hands(const Beam& beam, double radius)
      : length(beam.length()),
        reach(radius + beam.thickness() / 2),
        one_model(beam, 16),
        free_model(beam, 16),
        bent_model(beam, 16),
        one(one_model, radius),
        beside_nobody(free_model, {radius, radius}),
        beside_another(bent_model, {radius, radius}) {
    for (int k = 1; k <= 200; ++k) tick({length / 4, 2 * reach}, k / 200.0);
  }
  void tick(const Vector& at, double pressed = 1) {
    const Vector away(length / 2, 1), middle(length / 2, reach - 0.01 * length * pressed);
    const auto felt_alone = one.tick(at);
    const auto felt_free = beside_nobody.tick(at, away), felt_bent = beside_another.tick(at, middle);
    alone = felt_alone.force, free = felt_free.force(0), bent = felt_bent.force(0);
    status = felt_free.status;
    touched = felt_free.touching(0);
  }

  double length, reach;
  FemModel<Corotational<>> one_model;
  FemModel<Several<Corotational<>, 2>> free_model, bent_model;
  Touch<FemModel<Corotational<>>> one;
  TouchSeveral<FemModel<Several<Corotational<>, 2>>> beside_nobody, beside_another;
  Vector alone = Vector::Zero(), free = Vector::Zero(), bent = Vector::Zero();
  Status status = Status::ok;
  bool touched = false;
};

}  // namespace

// Both are held by presses within the range; on the way to it a round push may take a little more in one than in the other.
TEST_CASE("a hand that is pressed beside a rigid end does not fall through, whoever presses elsewhere",
          "[several]") {
  const double radius = GENERATE(0.0, 0.005);
  const int beam = GENERATE(0, 1, 2, 3);
  const bool right = beam % 2 == 1;
  Hands hands(beam < 2 ? bar_on(Support::pinned) : clamped_ruler(Support::clamped), radius);
  for (const double s : {0.0, 1e-4, 3e-4, 1e-3, 2e-3, 3e-3}) {
    INFO("beam " << beam << ", radius " << radius << ", at " << s << " of the length");
    hands.tick({hands.length / 4, 2 * hands.reach});
    double most = 0, most_alone = 0;
    const double deepest = hands.reach, x = (right ? 1 - s : s) * hands.length;
    for (int k = 1; k <= 500; ++k) {
      hands.tick({x, hands.reach - deepest * k / 500});
      REQUIRE(hands.touched);
      REQUIRE(hands.free.y() > 0);
      most = std::max({most, hands.free.norm(), hands.bent.norm()});
      most_alone = std::max(most_alone, hands.alone.norm());
    }
    CHECK(hands.bent.y() > 0);
    CHECK(most <= 2 * most_alone);
  }
}

// The tip of the hand is at 2e-4 of a metre in the beam: the round ends are left at sqrt(2 reach depth) of the end.
TEST_CASE("a stroke across a rigid end and past it feels what one hand feels", "[several]") {
  const bool right = GENERATE(false, true), inward = GENERATE(false, true);
  Hands hands(bar_on(Support::pinned), 0);
  const double depth = 2e-4, from = -0.002, to = 0.02;
  double most = 0, off = 0, jump = 0, before = 0;
  const int steps = 2000;
  for (int k = 0; k <= steps; ++k) {
    const double along = static_cast<double>(inward ? k : steps - k) / steps, s = from + (to - from) * along;
    hands.tick({right ? hands.length - s : s, hands.reach - depth});
    const double force = hands.free.norm();
    most = std::max(most, hands.alone.norm());
    off = std::max(off, (hands.free - hands.alone).norm());
    if (k > 0) jump = std::max(jump, std::abs(force - before));
    before = force;
  }
  INFO("right " << right << ", inward " << inward << ": " << most << " N");
  CHECK(most > 1e5);
  // Bars of one contact and of two differ by the elements between their nodes, and by the tick in which the end takes over.
  CHECK(off <= 0.06 * most);
  CHECK(jump <= 0.06 * most);
}

TEST_CASE("past a rigid end several contacts feel the fixed point that one feels", "[several]") {
  Hands hands(clamped_ruler(Support::free), 0.005);
  for (const double depth : {1e-5, 1e-4, 4e-4}) {
    const Vector way(-0.6, 0.8), at = (hands.reach - depth) * way;
    hands.tick(2 * at);
    for (int k = 0; k < 5; ++k) hands.tick(at);
    INFO("depth " << depth << ": " << hands.alone.norm() << " N");
    CHECK(hands.status == Status::out_of_range);
    CHECK((hands.free - hands.alone).norm() <= 0.05 * hands.alone.norm());
    CHECK(hands.free.dot(way) == Approx(hands.free.norm()).epsilon(1e-9));
    CHECK((hands.bent - hands.free).norm() <= 0.05 * hands.free.norm());
  }
}
