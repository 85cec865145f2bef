// Several contacts on one beam: forces, which of them touch, props, and one avatar that touches twice.
#include <cmath>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
template <int Contacts>
using Model = FemModel<Several<Corotational<>, Contacts>>;

Beam pinned_bar() {
  return {1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned};
}
Beam rolling_bar() {
  return {1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::roller};
}
Beam steel_ruler() {
  return {0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free};
}

/// A place that goes no farther than d along w, toward d.
Obstacle<double> stop(double s, double d) {
  const double n = d < 0 ? 1 : -1;
  Obstacle<double> obstacle;
  obstacle.kind = ObstacleKind::stop;
  obstacle.place = {s, n * d, {0, n}};
  obstacle.valid = obstacle.touching = true;
  return obstacle;
}

/// Worst error of the forces of a row.  Where one would pull it lets go, and the other one is alone.
double error(const Csv& table, std::size_t row, int elements) {
  const std::string name = table.text(row, "case");
  const bool ruler = name == "ruler_s_bend";
  const double s1 = ruler                     ? 0.15
                    : name == "bar_same_side" ? 0.3
                    : name == "bar_opposite"  ? 0.35
                                              : 0.48,
               s2 = ruler                     ? 0.28
                    : name == "bar_same_side" ? 0.6
                    : name == "bar_opposite"  ? 0.5
                                              : 0.52;
  const Beam beam = ruler ? steel_ruler() : pinned_bar();
  Model<2> model(beam, elements);
  const double d[2] = {table.number(row, "depth1"), table.number(row, "depth2")},
               f[2] = {table.number(row, "force1"), table.number(row, "force2")};
  Obstacle<double> both[2] = {stop(s1, d[0]), stop(s2, d[1])};
  REQUIRE(model.push(both, 2) == Status::ok);
  if (f[1] * d[1] < 0) {
    CHECK_FALSE(both[1].touching);
    FemModel<Corotational<>> alone(beam, elements);
    const double one = alone.press({s1, d[0]}).force;
    return std::abs(std::copysign(both[0].pushed.force, one) / one - 1);
  }
  double worst = 0;
  for (int k = 0; k < 2; ++k) worst = std::max(worst, std::abs(-both[k].pushed.force / std::abs(f[k]) - 1));
  return worst;
}

/// A hand or two led along straight ways.
template <class Touching>
struct Hands {
  Touching& touch;
  Vector at[2];
  Vector force[2] = {{0, 0}, {0, 0}};
  double work = 0, largest = 0;  // done by the hands
  int pulls = 0, failures = 0;
  void go(const Vector& a, const Vector& b, int ticks) {
    const Vector from[2] = {at[0], at[1]}, to[2] = {a, b};
    for (int t = 1; t <= ticks; ++t) {
      const double part = double(t) / ticks;
      const Vector next[2] = {from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])};
      const auto felt = touch.tick(next, 2);
      failures += !is_answer(felt.status);
      for (const auto& place : felt) pulls += place.touching && place.force.dot(place.normal) < 0;
      for (int k = 0; k < 2; ++k) {
        work -= (felt.force(k) + force[k]).dot(next[k] - at[k]) / 2;
        force[k] = felt.force(k), at[k] = next[k];
      }
      largest = std::max(largest, std::abs(work));
    }
  }
};

}  // namespace

// The bar that is bent two ways, with 12 mm between places 150 mm apart, is the stiffest: 3e-5 with 8 elements.  The ruler turns by 50 degrees.
TEST_CASE("two contacts take the forces of the reference, with the fourth power of the element's length",
          "[several]") {
  const Csv table("contacts.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    INFO(table.text(row, "case") << " " << table.text(row, "depth1"));
    const double of16 = error(table, row, 16), of32 = error(table, row, 32);
    const double of8 = error(table, row, 8);
    const bool bar = table.text(row, "case") != "ruler_s_bend";
    CHECK(of8 <= (bar ? 5e-5 : 1e-3));
    CHECK(of16 <= (bar ? 5e-6 : 4e-5));
    CHECK(of32 <= (bar ? 5e-7 : 2e-6));
    CHECK(of32 <= std::max(of16 / 8, 1e-8));
  }
}

TEST_CASE("supports that are led along are no snap, and what they give is in the beam", "[several]") {
  // The ruler, held at two places and bent into an S by both, as in the reference: what leads them is stored.
  const double depth[] = {0.03, -0.06};
  for (const int ticks : {60, 600}) {
    Model<2> model(steel_ruler(), 16);
    Obstacle<double> both[2];
    double work = 0;
    for (int k = 1; k <= ticks; ++k) {
      const double before[2] = {both[0].pushed.force, both[1].pushed.force};
      for (int i = 0; i < 2; ++i) {
        both[i].kind = ObstacleKind::support;
        both[i].place = {i == 0 ? 0.15 : 0.28, depth[i] * k / ticks, Vector(0, 1)};
        both[i].valid = true;
      }
      REQUIRE(model.push(both, 2) == Status::ok);
      for (int i = 0; i < 2; ++i) work += (before[i] + both[i].pushed.force) / 2 * depth[i] / ticks;
    }
    INFO("work " << work << " J, stored " << model.strain_energy());
    CHECK(std::abs(work / model.strain_energy() - 1) <= 0.4 / (ticks * ticks) + 1e-6);
  }
}

// q presses the bar onto a stop in its middle, where it would sag 5qL⁴/384EI; a hand at a lifts it there by Fa(3L² - 4a²)/48EI.
TEST_CASE("a bar that is lifted leaves its middle support at the load that beam theory says", "[several]") {
  const double q = -0.2, L = 1, a = 0.25, EI = 200e9 * 0.02 * 1e-6 / 12;
  Beam bar = rolling_bar();
  bar.transverse(q);
  const double sag = 5 * q * std::pow(L, 4) / (384 * EI);
  const double lift_off = -sag * 48 * EI / (a * (3 * L * L - 4 * a * a));
  Model<2> model(bar, 16);
  // The middle is held where the bar would sag to half of that; the rest is taken by the hand.
  const auto force = [&](double d, bool& rests) {
    Obstacle<double> both[2] = {stop(a, d), stop(0.5, -1)};
    both[1].place = {0.5, -sag / 2, {0, -1}};
    both[0].place = {a, -d, {0, -1}};
    REQUIRE(is_answer(model.push(both, 2)));
    rests = both[1].touching;
    return -both[0].pushed.force;
  };
  double low = 0.9 * sag, high = 0;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    bool rests = false;
    (void)force(middle, rests);
    (rests ? low : high) = middle;
  }
  bool rests = false;
  CHECK(force(high, rests) == Approx(lift_off / 2).epsilon(1e-4));
}

// Two equal spans l, a force in the middle of one: the middle support takes 11/16 of it, and the far end is pulled down by 3/32.
TEST_CASE("a support inside the span pushes and pulls", "[several]") {
  Model<2> model(rolling_bar(), 16);
  for (const double d : {-1e-5, 1e-5}) {
    Obstacle<double> both[2] = {stop(0.25, d), stop(0.5, 1)};
    both[1].kind = ObstacleKind::support;
    both[1].place = {0.5, 0, {0, 1}};
    REQUIRE(model.push(both, 2) == Status::ok);
    const double force = std::copysign(both[0].pushed.force, d);
    CHECK(both[1].pushed.force / force == Approx(-11.0 / 16).epsilon(1e-5));
  }
}

TEST_CASE("a bar between two pegs is free until it has closed the gap", "[several]") {
  const double radius = 0.01, reach = radius + 0.005, gap = 0.002;
  Model<4> model(pinned_bar(), 16);
  TouchSeveral touch(model, {radius},
                     {Prop<>::peg({0.6, reach + gap}, radius), Prop<>::peg({0.6, -reach - gap}, radius)});
  FemModel<Corotational<>> free(pinned_bar(), 16);
  Touch<FemModel<Corotational<>>> alone(free, radius);
  for (const int side : {1, -1}) {
    bool closed = false;
    for (int t = 0; t <= 100; ++t) {
      const Vector hand(0.45, side * (reach + 1e-4 - 1e-4 * t));
      const auto felt = touch.tick(hand);
      const auto felt_free = alone.tick(hand);
      REQUIRE(felt.status == Status::ok);
      const double w = free.shape().at(0.6).w;
      if (std::abs(w) < 0.999 * gap) {
        CHECK_FALSE(felt.touching(side > 0 ? 2 : 1));
        CHECK((felt.force(0) - felt_free.force).norm() <= 1e-3 * felt_free.force.norm());
      }
      if (std::abs(w) > 1.001 * gap) {
        CHECK(felt.touching(side > 0 ? 2 : 1));
        CHECK(felt.force(0).norm() > felt_free.force.norm());
        CHECK(std::abs(model.shape().at(0.6).w + side * gap) <= 1e-5);
        closed = true;
      }
      CHECK_FALSE(felt.touching(side > 0 ? 1 : 2));
    }
    CHECK(closed);
    touch.reset(), alone.reset();
  }
}

TEST_CASE("an avatar that is wider than the bend settles on two places", "[several]") {
  const double radius = 0.05, top = radius + 0.005;
  Model<2> model(pinned_bar(), 32);
  TouchSeveral touch(model, {{radius, 2}});
  double work = 0, most_work = 0, y = top + 0.001;
  Vector force(0, 0);
  int failures = 0;
  const auto go = [&](double to, int ticks) {
    const double from = y;
    for (int t = 1; t <= ticks; ++t) {
      const double next = from + (to - from) * t / ticks;
      const auto felt = touch.tick(Vector(0.5, next));
      failures += !is_answer(felt.status);
      work -= (felt.force(0) + force).y() / 2 * (next - y);
      most_work = std::max(most_work, work);
      force = felt.force(0), y = next;
    }
  };
  go(top - 0.25, 500);
  const auto held = touch.tick(Vector(0.5, y));
  CHECK(held.status == Status::ok);
  REQUIRE((held.places[0].touching && held.places[1].touching));
  // Symmetric, to what the mesh is off by: 0.49 and 0.51 are between its nodes.
  CHECK(std::abs(held.places[0].s + held.places[1].s - 1) <= 2e-3);
  CHECK(held.places[0].force.norm() / held.places[1].force.norm() == Approx(1).epsilon(0.05));
  for (const auto& place : held)
    CHECK((place.point - Vector(0.5, y)).norm() == Approx(radius + 0.005).epsilon(1e-3));
  go(top + 0.001, 500);
  CHECK(failures <= 5);
  CHECK(work >= -1e-3 * most_work);
  CHECK(touch.tick(Vector(0.5, 1)).status == Status::ok);
}

// Hands go at random about a ruler and a bar, each on its side, and come back: what they have done is not negative but for what the
// trapezoidal rule and the mesh are off by.
TEST_CASE("two hands and a peg gain no work on a closed path, and none pulls", "[several]") {
  Random random(7);
  for (const bool ruler : {true, false}) {
    const Beam beam = ruler ? steel_ruler() : pinned_bar();
    const double L = beam.length(), radius = 0.02 * L, clear = radius + 0.01 * L;
    Model<4> model(beam, 16);
    TouchSeveral touch(model, {radius, radius}, {Prop<>::peg({0.6 * L, -clear - 0.01 * L}, radius)});
    Hands<TouchSeveral<Model<4>>> hands{touch, {{0.4 * L, clear}, {0.8 * L, clear}}};
    for (int way = 0; way < 12; ++way)
      hands.go({random(0.3, 0.5) * L, random(clear - 0.02 * L, clear)},
               {random(0.7, 0.9) * L, random(clear - 0.02 * L, clear)}, 120);
    hands.go({0.4 * L, clear}, {0.8 * L, clear}, 200);
    INFO((ruler ? "ruler" : "bar"));
    CHECK(hands.failures == 0);
    CHECK(hands.pulls == 0);
    CHECK(hands.largest > 0);
    CHECK(hands.work >= -2e-3 * hands.largest);
  }
}

// Where they meet, each is a thousandth of the length beside the other, and the beam would have to be bent by both.
TEST_CASE("two hands on one side pass each other, and one of them always holds the beam", "[several]") {
  const double surface = 0.0055;
  for (const int elements : {6, 16})
    for (const double depth : {0.01, 0.015, 0.02})
      for (const double deeper : {-1e-4, -2e-5, 0.0, 2e-5, 1e-4})
        for (const double step : {6e-5, 2.4e-4}) {
          CAPTURE(elements, depth, deeper, step);
          Model<2> model(steel_ruler(), elements);
          TouchSeveral touch(model, {0.005, 0.005});
          Hands<TouchSeveral<Model<2>>> hands{touch, {{0.15, surface}, {0.21, surface}}};
          hands.go({0.15, surface - depth}, {0.21, surface - depth - deeper}, 300);
          hands.go({0.21, surface - depth}, {0.15, surface - depth - deeper}, static_cast<int>(0.06 / step));
          CHECK(hands.failures == 0);
          CHECK(hands.pulls == 0);
          CHECK(hands.force[0].norm() + hands.force[1].norm() > 1);
        }
}

// The wall is rigid, and so is the hand: below it there is no equilibrium.
TEST_CASE("a hand that jams a ruler onto a wall feels the last answer, and a new touch after it has gone",
          "[several]") {
  Model<2> model(steel_ruler(), 16);
  TouchSeveral touch(model, {0.005}, {Prop<>::wall({0.15, -0.01}, {0, 1})});
  double felt_last = 0;
  int jammed = 0;
  for (int t = 0; t < 120; ++t) {
    const auto felt = touch.tick(Vector(0.25, 0.006 - 1e-4 * t));
    REQUIRE(felt.force(0).allFinite());
    if (is_answer(felt.status)) felt_last = felt.force(0).norm();
    else REQUIRE(felt.force(0).norm() == felt_last);
    jammed += !is_answer(felt.status);
  }
  CHECK(felt_last > 0);
  CHECK(jammed > 0);
  for (int t = 0; t < 30; ++t) (void)touch.tick(Vector(0.25, 0.05));
  const auto again = touch.tick(Vector(0.25, 0.003));
  CHECK(again.status == Status::ok);
  CHECK(again.force(0).y() > 0);
}

// It touches in one place, where more of the ruler than a point comes to lie.
TEST_CASE("where a ruler is said to touch a wall it does", "[several]") {
  for (const int elements : {16, 32}) {
    Model<2> model(steel_ruler(), elements);
    TouchSeveral touch(model, {0.005}, {Prop<>::wall({0.25, -0.0105}, {0, 1})});
    int answers = 0;
    for (int k = 0; k < 2000; ++k) {
      const auto felt = touch.tick(Vector(0.15, 0.0055 - 5e-6 * k));
      const auto& wall = felt.places[1];
      if (felt.status != Status::ok || !wall.touching) continue;
      ++answers;
      REQUIRE(std::abs(wall.point.y() + 0.01) <= 3e-4);
      REQUIRE(wall.normal.y() < -0.99999);
      REQUIRE(wall.point.x() >= 0);
      REQUIRE(wall.point.x() <= 0.3);
    }
    CHECK(answers > 300);
  }
}

TEST_CASE("one avatar of several is felt as it is alone", "[several]") {
  const double radius = 0.005;
  FemModel<Corotational<>> model(steel_ruler(), 8);
  Touch<FemModel<Corotational<>>> touch(model, radius);
  Model<4> four(steel_ruler(), 8);
  TouchSeveral several(four, {radius});
  for (int t = 0; t < 300; ++t) {
    const Vector hand(0.12 + 2e-4 * t, 0.0058 - 1e-4 * t);
    const auto one = touch.tick(hand);
    const auto felt = several.tick(hand);
    REQUIRE(felt.status == Status::ok);
    REQUIRE(felt.touching(0) == one.pressing);
    REQUIRE((felt.force(0) - one.force).norm() <= 1e-4 * one.force.norm() + 1e-9);
  }
}

TEST_CASE("four contacts share one mesh, and each more costs as much as the one before", "[several]") {
  Model<4> model(pinned_bar(), 24);
  const double radius = 0.01, reach = radius + 0.005;
  TouchSeveral touch(model, {radius, radius},
                     {Prop<>::peg({0.35, -reach}, radius), Prop<>::peg({0.65, -reach}, radius)});
  int solves = 0;
  for (int t = 0; t < 100; ++t) {
    const auto felt = touch.tick(Vector(0.2, reach - 5e-5 * t), Vector(0.5, reach - 5e-5 * t));
    REQUIRE(felt.status == Status::ok);
    if (t > 10) solves += model.report().solves;
    Vector sum(0, 0);
    for (const auto& place : felt) sum += place.force;
    if (t > 10) CHECK((felt.touching(0) && felt.touching(1) && felt.touching(2)));
  }
  // What goes on as it went is foreseen and takes two; one more where a contact passes into the next element.
  CHECK(solves <= 2 * 89 + 1);
}

TEST_CASE("what makes no sense of avatars and props is rejected, and positions that are none change nothing",
          "[several]") {
  Model<2> model(pinned_bar(), 8);
  const Prop<> peg = Prop<>::peg({0.5, -0.1}, 0.01);
  CHECK_THROWS_WITH(TouchSeveral(model, {0.01, 0.01}, {peg}),
                    Catch::Matchers::ContainsSubstring("avatars and props = 3"));
  CHECK_THROWS_WITH(TouchSeveral(model, {-0.01}),
                    Catch::Matchers::ContainsSubstring("avatar radius = -0.01"));
  CHECK_THROWS_WITH(TouchSeveral(model, {{0.01, 0}}),
                    Catch::Matchers::ContainsSubstring("avatar touches = 0"));
  CHECK_THROWS_WITH(TouchSeveral(model, {0.01}, {Prop<>::stop(2, 0, {0, 1})}),
                    Catch::Matchers::ContainsSubstring("prop s = 2 m"));
  CHECK_THROWS_WITH(TouchSeveral(model, {0.01}, {Prop<>::peg({0, 0}, -1)}),
                    Catch::Matchers::ContainsSubstring("prop radius = -1 m"));
  CHECK_THROWS_WITH(Model<4>(pinned_bar(), 4), Catch::Matchers::ContainsSubstring("at least 5"));

  TouchSeveral touch(model, {0.01}, {peg});
  const auto before = touch.tick(Vector(0.4, 0.01));
  CHECK(before.touching(0));
  CHECK(touch.tick(Vector(std::nan(""), 0)).status == Status::invalid_request);
  CHECK(touch.tick(Vector(0.4, 0.01), Vector(0, 0)).status == Status::invalid_request);
  const auto after = touch.tick(Vector(0.4, 0.01));
  CHECK((after.force(0) - before.force(0)).norm() <= 1e-5 * before.force(0).norm());
}
