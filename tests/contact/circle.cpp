// A push by a circle finds where the two touch: wherever it begins, and in few linear solves.
#include <cmath>

#include "realtime/counting_element.hpp"
#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/push_round.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;

}  // namespace

// 1.5e-4 of the length from its node a contact is as exact as at it, to a few 1e-6 of the force.
TEST_CASE("the contact does not depend on where it is sought", "[push]") {
  FemModel<Corotational<>> model(steel_ruler(), 16);
  Random random(1);
  for (const double depth : {0.005, 0.03, 0.08}) {
    const Vector centre(0.2, 0.0055 - depth);
    const auto from = [&](double s) {
      model.reset();
      Pushed<double> pushed{};
      PushRound push(model);
      for (int tick = 1; tick <= 20; ++tick)  // down to there
        pushed = push({s, {0.2, 0.0055 - depth * tick / 20}, 0.0055, 1});
      return pushed;
    };
    Pushed<double> exact = from(0.2);
    PushRound push(model);
    for (int k = 0; k < 3; ++k) exact = push({exact.s, centre, 0.0055, 1});
    REQUIRE(exact.status == Status::ok);
    CHECK((centre - exact.point).norm() == Approx(0.0055).epsilon(1e-9));
    for (const double away : {-0.01, -1e-3, -4e-5, 4e-5, 1e-3, 0.01}) {
      const Pushed<double> pushed = from(exact.s + away);
      CAPTURE(depth, away, name(pushed.status));
      CHECK(pushed.status == Status::ok);
      CHECK(relative_error(pushed.force, exact.force) <= 5e-6);
      CHECK(std::abs(pushed.s - exact.s) <= 1e-6 * 0.3);
      CHECK((pushed.normal - exact.normal).norm() <= 5e-6);
    }
  }
}

// A hand at 0.3 m/s, here and there: two or three iterations of Newton's method a tick, contact included.
TEST_CASE("a tick of a hand on a beam that turns takes three linear solves", "[push]") {
  using Element = CountingElement<Corotational<>>;
  using Model = FemModel<Element>;
  constexpr int elements = 8;
  Model model(steel_ruler(), elements);
  Touch<Model> touch(model, 0.005);
  Random random(2);
  const double reach = 0.005 + model.thickness() / 2;
  for (int k = 0; k <= 200; ++k) (void)touch.tick({0.11, reach - 0.05 * k / 200});
  Vector hand(0.11, reach - 0.05), way(0, 0);
  long pressing = 0, most = 0, all = 0;
  constexpr int ticks = 4000;
  for (int k = 0; k < ticks; ++k) {
    if (k % 40 == 0) way = 3e-4 * Vector(random(1), random(1)).normalized();
    Vector next = hand + way;
    if (std::abs(next.x() - 0.11) > 0.04) next.x() = hand.x(), way.x() = -way.x();
    if (std::abs(next.y() + 0.05) > 0.045) next.y() = hand.y(), way.y() = -way.y();
    hand = next;
    Element::tangents = 0;
    pressing += touch.tick(hand).status == Status::ok;
    most = std::max(most, Element::tangents / elements);
    all += Element::tangents / elements;
  }
  CAPTURE(pressing, most, double(all) / ticks);
  CHECK(pressing == ticks);
  CHECK(double(all) / ticks <= 3.5);
  CHECK(most <= 12);
}
