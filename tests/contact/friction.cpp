// Coulomb friction between a round avatar and a beam of finite rotation.
#include <cmath>
#include <limits>
#include <vector>

#include "realtime/counting_element.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/random.hpp"
#include "support/rubbing.hpp"
#include "support/ruler.hpp"
#include "support/sanitized.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Ruler = FemModel<Corotational<>>;
using Felt = TouchResult<double>;

/// What a tick must say whatever the hand does.
void check_law(const Felt& r, const Friction& friction) {
  const double normal = (r.force - r.friction).norm();
  REQUIRE(r.force.allFinite());
  REQUIRE((r.force - r.friction).dot(r.contact.normal) >= 0);
  REQUIRE(r.friction.norm() <= friction.sticking * normal * (1 + 1e-14));
  REQUIRE(std::abs(r.friction.dot(r.contact.normal)) <= 1e-12 * normal);
  if (r.sliding) REQUIRE(r.friction.norm() <= friction.sliding * normal * (1 + 1e-14));
  if (!r.pressing) REQUIRE(r.force.isZero(0));
}

/// Straight from one place to another.   @return what is felt last
template <class Model, class Visit>
Felt move(Touch<Model>& touch, const Vector& from, const Vector& to, int ticks, Visit&& visit) {
  Felt r;
  for (int k = 1; k <= ticks; ++k) visit(r = touch.tick(from + (to - from) * (double(k) / ticks)));
  return r;
}
template <class Model>
Felt move(Touch<Model>& touch, const Vector& from, const Vector& to, int ticks) {
  return move(touch, from, to, ticks, [](const Felt&) {});
}

/// What a hand has given, what friction took of it, and ∫ T · dslip, all by trapezoids.
struct Work {
  double given = 0, taken = 0, rubbed = 0;
};
/// Around a closed path, so often; of the last time.  @param path  t of period 1 -> place [m]   @param visit  what is felt
template <class Path, class Visit>
Work around(Ruler& model, Touch<Ruler>& touch, Path&& path, int ticks, int times, Visit&& visit,
            double reach) {
  const auto rubbing = [&](const Felt& r) {
    return Rubbing{r.contact.s, r.contact.normal, r.friction, stretch_at(model.shape(), r.contact.s)};
  };
  Work work;
  Felt before = touch.tick(path(0.0));
  Rubbing last = rubbing(before);
  double taken = 0;
  for (int k = 1; k <= ticks * times; ++k) {
    const Felt now = touch.tick(path(double(k) / ticks));
    visit(now);
    REQUIRE(now.status == Status::ok);
    REQUIRE(now.pressing);
    REQUIRE(now.dissipated >= before.dissipated);
    if (k > ticks * (times - 1)) {
      work.given -= (now.force + before.force).dot(path(double(k) / ticks) - path(double(k - 1) / ticks)) / 2;
      const Rubbing here = rubbing(now);
      work.rubbed += rubbed(last, here, reach);
      last = here;
    } else {
      taken = now.dissipated, last = rubbing(now);
    }
    before = now;
  }
  work.taken = before.dissipated - taken;
  return work;
}

}  // namespace

TEST_CASE("a finger led down past a ruler slides toward its tip as the elastica with friction says",
          "[friction]") {
  const Csv table("finger_with_friction.csv");
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free);
  for (const int fine : {0, 1}) {
    Ruler model(ruler, 8 << fine);
    double worst = 0, place = 0, y = 0;
    for (std::size_t first = 0; first < table.rows();) {
      const double mu = table.number(first, "mu"), x = table.number(first, "x_c");
      model.reset();
      Touch<Ruler> touch(model, 0.005, mu);
      y = 0.0056;
      for (; first < table.rows() && table.number(first, "mu") == mu && table.number(first, "x_c") == x;
           ++first) {
        const Vector to(x, table.number(first, "y_c"));
        const Felt r = move(touch, {x, y}, to, 40);
        y = to.y();
        REQUIRE(r.status == Status::ok);
        CHECK(r.sliding);
        const Vector force(table.number(first, "force_x"), table.number(first, "force_y")),
            foot(table.number(first, "foot_x"), table.number(first, "foot_y"));
        worst = std::max(worst, (r.force - force).norm() / force.norm());
        place = std::max(place, (r.contact.foot - foot).norm());
      }
    }
    CAPTURE(worst, place);
    CHECK(worst <= (fine == 0 ? 2e-4 : 1e-5));
    CHECK(place <= (fine == 0 ? 1e-6 : 1e-7));
  }
}

TEST_CASE("friction never exceeds its share of the normal force, and takes energy, whatever the hand does",
          "[friction]") {
  const Friction friction(0.6, 0.4);
  Ruler ruler(steel_ruler(), 8),
      bow(arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), Material{200e9}, Support::pinned), 8);
  const auto strokes = [&](Ruler& model, const Vector& home, double size, std::uint64_t seed) {
    Touch<Ruler> touch(model, 0.005, friction);
    Random random(seed);
    Vector hand = home, to = home;
    int left = 0, sliding = 0, answers = 0;
    Felt before;
    for (int k = 0; k < 20000; ++k) {
      if (left-- <= 0) {
        to = home + size * Vector(random(1), random(1));
        left = random.integer(1, 300);
        if (random.integer(0, 30) == 0) hand = to;
      }
      hand += (to - hand) / (left + 1);
      const Felt r = touch.tick(hand);
      check_law(r, friction);
      if (r.pressing && before.pressing) REQUIRE(r.dissipated >= before.dissipated);
      sliding += r.sliding;
      answers += is_answer(r.status);
      before = r;
    }
    CHECK(sliding > 1000);
    CHECK(answers > 19800);
  };
  strokes(ruler, {0.2, -0.02}, 0.07, 1);
  strokes(bow, {0.1, 0.022}, 0.014, 2);
}

TEST_CASE("work of a closed path is what friction takes, and what sticks gives it back", "[friction]") {
  const auto circle = [](double x, double y, double wide, double high, double reach = 0.0055) {
    return [=](double t) {
      const double in = std::min(1.0, 8 * t), a = 2 * 3.14159265358979323846 * t;
      return Vector(x + wide * std::sin(a) * in, reach - 1e-4 - (reach - y) * in + high * std::cos(a) * in);
    };
  };
  // ∫ T · dslip by trapezoids differs from what the hand gives by the square of the step.
  const auto difference = [](Ruler& model, const Friction& friction, auto&& path, int ticks, double half) {
    model.reset();
    Touch<Ruler> touch(model, 0.005, friction);
    const Work work = around(
        model, touch, path, ticks, 2, [](const Felt&) {}, 0.005 + half);
    CHECK(work.taken > 1e-3);
    CHECK(work.given > 0);
    CHECK(std::abs(work.given - work.taken) <= 1e-10 * work.taken);
    return std::abs(work.rubbed - work.taken) / work.taken;
  };
  for (const double mu : {0.2, 0.8}) {
    Ruler model(steel_ruler(), 16);
    const auto path = circle(0.18, -0.025, 0.01, 0.01);
    CAPTURE(mu);
    CHECK(difference(model, mu, path, 750, 0.0005) <= 2e-5);
    CHECK(difference(model, mu, path, 1500, 0.0005) <= 4e-6);
    CHECK(difference(model, mu, path, 6000, 0.0005) <= 1e-6);
  }
  // A bar between hinges stretches by 0.3 to 0.9 thousandths, and what slides along it goes that much farther.
  Ruler bar(Beam(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned), 16);
  CHECK(difference(bar, 0.3, circle(0.4, -0.005, 0.02, 0.004, 0.01), 6000, 0.005) <= 1e-6);
  // Where the coefficient of sliding is smaller, a beam springs back as it begins to slide.
  Ruler ruler(steel_ruler(), 16);
  CHECK(difference(ruler, {0.5, 0.3}, circle(0.18, -0.025, 0.01, 0.01), 24000, 0.0005) <= 1e-6);
  CHECK(difference(bar, {0.5, 0.3}, circle(0.4, -0.005, 0.02, 0.004, 0.01), 24000, 0.005) <= 2e-6);
  // A soft skin sticks all the way round.
  Ruler model(steel_ruler(), 16);
  Touch<Ruler> touch(model, 0.005, 1);
  touch.soften(500, 0);
  const Work work = around(
      model, touch, circle(0.1, -0.006, 0.0002, 0.0005), 2000, 3, [](const Felt&) {}, 0.0055);
  CAPTURE(work.given, work.taken, model.strain_energy());
  CHECK(work.taken == 0);
  CHECK(std::abs(work.given) <= 1e-6 * model.strain_energy());
}

// Flat and tall ways round, either way about, under a hand that presses deep or lightly, with one coefficient and with two.
TEST_CASE("no closed path takes energy out of friction, whatever the path and the coefficients",
          "[friction]") {
  const auto paths = [](const Beam& beam, double half, double most, int count, int ticks, bool two) {
    Random random(7);
    Ruler model(beam, 16);
    double worst = 0;
    for (int n = 0; n < count; ++n) {
      const double L = beam.length(), mu = random(0.05, 1.2), reach = 0.005 + half,
                   deep = most * random(0.2, 1.0), wide = L * random(0.002, 0.03),
                   high = 0.45 * deep * random(0.001, 0.4), phase = random(0.0, 6.283),
                   way = random.integer(0, 1) == 0 ? 1 : -1;
      const Friction friction(mu, two ? mu * random(0.5, 1.0) : mu);
      const Vector home(L * random(0.3, 0.7), reach - deep);
      const auto path = [=](double t) {
        const double a = 2 * 3.14159265358979323846 * t;
        return Vector(home.x() + wide * (std::sin(way * a + phase) - std::sin(phase)),
                      home.y() + high * (1 - std::cos(a)));
      };
      model.reset();
      Touch<Ruler> touch(model, 0.005, friction);
      (void)move(touch, {home.x(), reach + 1e-5}, home, 20, [&](const Felt& r) { check_law(r, friction); });
      const Work work = around(
          model, touch, path, ticks, 2, [&](const Felt& r) { check_law(r, friction); }, reach);
      const double energy = model.strain_energy(), least = std::max(work.taken, 1e-3 * energy);
      CAPTURE(mu, friction.sliding, wide, high, work.given, work.taken, energy);
      CHECK(work.given > 0);
      CHECK(std::abs(work.given - work.taken) <= 1e-9 * least);
      worst = std::max(worst, std::abs(work.rubbed - work.taken) / least);
    }
    return worst;
  };
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  CHECK(paths(steel_ruler(), 0.0005, 0.018, trials(200), 150, true) <= 2e-3);
  CHECK(paths(bar, 0.005, 0.008, trials(200), 150, true) <= 2e-3);
  CHECK(paths(steel_ruler(), 0.0005, 0.018, 5, 6000, false) <= 1e-6);
  CHECK(paths(bar, 0.005, 0.008, 5, 6000, false) <= 1e-6);
  CHECK(paths(steel_ruler(), 0.0005, 0.018, 5, 6000, true) <= 1e-6);
  CHECK(paths(bar, 0.005, 0.008, 5, 6000, true) <= 1e-6);
}

TEST_CASE("a finger on a cantilever begins to slide where its force leaves the cone", "[friction]") {
  for (const double mu : {0.1, 0.3, 0.9}) {
    Ruler model(steel_ruler(), 8);
    Touch<Ruler> touch(model, 0.005, Friction(mu, 0.8 * mu));
    touch.soften(500, 0);
    Felt r = move(touch, {0.15, 0.0056}, {0.15, 0.002}, 40);
    double ratio = 0, x = 0.15;
    int ticks = 0;
    // To the left until it slides there, and back until it slides to the right.
    for (const double way : {-1.0, 1.0}) {
      const double step = way * 5e-5 * (r.force - r.friction).norm() / 500;
      do {
        ratio = r.friction.norm() / (r.force - r.friction).norm();
        r = touch.tick({x += step, 0.002});
      } while (!(r.sliding && r.friction.x() * way < 0) && ticks++ < 100000);
    }
    CAPTURE(mu, ticks);
    CHECK(ratio == Approx(mu).epsilon(1e-4 / mu));
    REQUIRE(r.sliding);
    CHECK(r.friction.norm() / (r.force - r.friction).norm() == Approx(0.8 * mu).epsilon(1e-6));
  }
}

// The avatar does not turn: the beam that bends away beneath it rolls along it, and only what is beyond that shears the skin.
TEST_CASE("a contact that sticks rolls", "[friction]") {
  Ruler model(steel_ruler(), 16);
  Touch<Ruler> touch(model, 0.005, 2);
  touch.soften(500, 0);
  Felt r = move(touch, {0.15, 0.0056}, {0.15, 0.004}, 50);
  const auto skin = [](const Felt& felt) {
    return -(felt.friction.x() * felt.contact.normal.y() - felt.friction.y() * felt.contact.normal.x()) / 500;
  };
  const auto lean = [](const Felt& felt) {
    return std::atan2(felt.contact.normal.x(), felt.contact.normal.y());
  };
  const double s = r.contact.s, angle = lean(r), sheared = skin(r);
  double rolled = 0;
  for (int k = 1; k <= 300; ++k) {
    r = touch.tick({0.15, 0.004 - 1e-4 * k});
    REQUIRE(r.status == Status::ok);
    REQUIRE_FALSE(r.sliding);
    rolled = 0.0055 * (lean(r) - angle);
    REQUIRE(std::abs(r.contact.s - s + rolled - (skin(r) - sheared)) <= 1e-9);
  }
  CHECK(std::abs(rolled) > 5e-4);
}

// Beyond the lengths √(EI/T) beside the contact, in which a string with some stiffness turns by θ₁ and θ₂, M²/2EI + T cos θ is the same along
// each side.  With the balance at the contact that gives  T₂ - T₁ = μN  and  T₁ (1 - cos θ₁) = T₂ (1 - cos θ₂):  a capstan that is touched
// at one point.  It is e^{μφ} for small angles.
TEST_CASE("the tension of a string falls along a peg that slides on it, as that of a capstan", "[friction]") {
  const Beam string(1, Section::rectangle(0.004, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  const auto slope = [](const auto& line, double s) {
    const auto a = line.at(s - 1e-4), b = line.at(s + 1e-4);
    return std::atan2(b.w - a.w, 2e-4 + b.u - a.u);
  };
  for (const double mu : {0.3, 0.6})
    for (const double depth : {0.1, 0.15, 0.2}) {
      Ruler model(string, 64);
      Touch<Ruler> touch(model, 0.005, mu);
      move(touch, {0.44, 0.0102}, {0.44, 0.01 - depth}, 60);
      const Felt r = move(touch, {0.44, 0.01 - depth}, {0.45, 0.01 - depth}, 40);
      REQUIRE(r.status == Status::ok);
      REQUIRE(r.sliding);
      const auto tension = [&](double s) {
        const auto carried = model.internal_forces(s);
        return std::hypot(carried.normal, carried.shear);
      };
      const auto line = model.shape();
      const double left = r.contact.s - 0.15, right = r.contact.s + 0.15;
      const double angle = slope(line, right) - slope(line, left), ratio = tension(left) / tension(right),
                   difference = std::atan(mu) - std::asin(std::sin(std::atan(mu)) * std::cos(angle / 2)),
                   law = std::pow(std::sin(angle / 4 + difference / 2) / std::sin(angle / 4 - difference / 2),
                                  2);
      CAPTURE(mu, depth, angle, ratio, law);
      CHECK(angle > 0.4);
      CHECK(std::abs(ratio / law - 1) <= 3.5e-3);
      if (mu * angle < 0.37) CHECK(std::abs(ratio / std::exp(mu * angle) - 1) <= 0.01);
    }
}

// The ruler is bent around the finger beside its clamp, and what the finger slides on changes the normal force several times as much as
// friction does.
TEST_CASE("a finger that jams a ruler at its clamp slides there in every tick", "[friction]") {
  struct Case {
    double mu, step;
  };
  for (const auto& [mu, step] : {Case{0.6, 2e-5}, Case{0.6, 1e-4}, Case{1.0, 2e-5}}) {
    Ruler model(steel_ruler(), 16);
    Touch<Ruler> touch(model, 0.005, mu);
    int jammed = 0, lost = 0;
    for (int k = 0; k < 400; ++k) {
      const Felt r = touch.tick({0.01 - 0.3 * step * k, 0.0056 - step * k});
      const double normal = (r.force - r.friction).norm();
      CAPTURE(mu, step, k, normal, r.friction.norm());
      // Where 3 kN rise by a third in a tick of 0.1 mm, one is not answered.
      if (r.status == Status::iteration_limit && step == 1e-4 && ++lost == 1) continue;
      REQUIRE(is_answer(r.status));  // jammed too near to the clamp for its elements
      REQUIRE(r.friction.norm() <= mu * normal * (1 + 1e-14));
      if (normal < 1e4) continue;
      ++jammed;
      REQUIRE(r.sliding);
      REQUIRE(r.friction.norm() >= (1 - 1e-6) * mu * normal);
    }
    CHECK(jammed > 150);
  }
}

TEST_CASE("friction ends with its touch", "[friction]") {
  const Friction friction(0.5, 0.3);
  const auto stroke = [&](Touch<Ruler>& touch, double x) {
    std::vector<Felt> felt;
    const auto visit = [&](const Felt& r) { felt.push_back(r); };
    move(touch, {x, 0.0056}, {x, -0.02}, 60, visit);
    move(touch, {x, -0.02}, {x + 0.03, -0.02}, 60, visit);
    move(touch, {x + 0.03, -0.02}, {x + 0.01, -0.01}, 30, visit);
    move(touch, {x + 0.01, -0.01}, {x, 0.02}, 60, visit);
    return felt;
  };
  Ruler model(steel_ruler(), 8), fresh(steel_ruler(), 8);
  Touch<Ruler> touch(model, 0.005, friction), first(fresh, 0.005, friction);
  stroke(touch, 0.2);
  REQUIRE_FALSE(touch.pressing());
  stroke(touch, 0.1);
  const auto again = stroke(touch, 0.15), once = stroke(first, 0.15);
  double largest = 0;
  for (std::size_t k = 0; k < once.size(); ++k) {
    largest = std::max(largest, once[k].force.norm());
    CHECK((again[k].force - once[k].force).norm() <= 1e-6 * largest);
    CHECK(again[k].pressing == once[k].pressing);
    CHECK(std::abs(again[k].dissipated - once[k].dissipated) <= 1e-6 * 0.03 * largest);
  }
  CHECK(largest > 1);
  CHECK(once.back().dissipated == 0);
}

TEST_CASE("without friction nothing changes, and a place that is none leaves friction alone", "[friction]") {
  Ruler model(steel_ruler(), 8), other(steel_ruler(), 8);
  Touch<Ruler> none(model, 0.005), zero(other, 0.005, Friction(0));
  for (int k = 0; k < 200; ++k) {
    const Vector hand(0.2 - 2e-4 * k, 0.0055 - 2e-4 * k);
    const Felt a = none.tick(hand), b = zero.tick(hand);
    REQUIRE(a.force == b.force);
    REQUIRE(a.friction.isZero(0));
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  Ruler plain(steel_ruler(), 8), troubled(steel_ruler(), 8);
  Touch<Ruler> calm(plain, 0.005, 0.4), touch(troubled, 0.005, 0.4);
  double dissipated = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector hand(0.15 + 1e-4 * k, 0.0055 - 1e-4 * k);
    if (k % 7 == 0)
      for (const double bad : {nan, inf, 1e200}) {
        const Felt r = touch.tick({bad, 0.0});
        REQUIRE(r.force.allFinite());
        REQUIRE(r.status == Status::invalid_request);
        REQUIRE(r.dissipated == dissipated);
      }
    const Felt a = calm.tick(hand), b = touch.tick(hand);
    REQUIRE((a.force - b.force).norm() <= 1e-9 * (1 + a.force.norm()));
    dissipated = b.dissipated;
  }
}

// Work, not time: elements asked for their tangents.
TEST_CASE("a tick with friction takes hardly more linear solves", "[friction]") {
  using Element = CountingElement<Corotational<>>;
  using Model = FemModel<Element>;
  const auto count = [](double mu, double sideways, double skin) {
    Model model(steel_ruler(), 8);
    Touch<Model> touch(model, 0.005, mu);
    touch.soften(skin, 0);
    for (int k = 0; k <= 200; ++k) (void)touch.tick({0.11, 0.0055 - 0.02 * k / 200});
    Vector hand(0.11, 0.0055 - 0.02);
    Element::tangents = 0;
    int slides = 0;
    constexpr int ticks = 2000;
    for (int k = 0; k < ticks; ++k) {
      const double a = 2 * 3.14159265358979323846 * k / 500;
      const Felt r = touch.tick(hand + Vector(sideways * std::sin(a), 5e-4 * std::sin(2 * a)));
      REQUIRE(r.status == Status::ok);
      slides += r.sliding;
    }
    struct {
      double solves, sliding;
    } const result{double(Element::tangents) / 8 / ticks, double(slides) / ticks};
    return result;
  };
  const auto smooth = count(0, 0.02, 1e9), slides = count(0.3, 0.02, 1e9);
  CAPTURE(smooth.solves, slides.solves);
  CHECK(slides.sliding > 0.9);
  CHECK(slides.solves <= 2 * smooth.solves);
  const auto quiet = count(0, 2e-4, 1e3), sticks = count(1, 2e-4, 1e3);
  CAPTURE(quiet.solves, sticks.solves);
  CHECK(sticks.sliding < 0.05);
  CHECK(sticks.solves <= 1.3 * quiet.solves);
}

TEST_CASE(
    "coefficients that make no sense are rejected, and so is friction of models that are pressed across",
    "[friction]") {
  Ruler model(steel_ruler(), 8);
  FemModel<> across(steel_ruler(), 8);
  const auto touch = [&](const Friction& friction) { Touch<Ruler>(model, 0.005, friction); };
  CHECK_NOTHROW(touch({0.3, 0.3}));
  CHECK_THROWS_WITH(touch({-0.1}), "friction sticking = -0.1: must be 0 to 2");
  CHECK_THROWS_WITH(touch({std::numeric_limits<double>::quiet_NaN()}),
                    "friction sticking = nan: must be 0 to 2");
  CHECK_THROWS_WITH(touch({0.3, 0.4}), "friction sliding = 0.4: must be 0 to that of sticking");
  CHECK_THROWS_WITH(Touch<FemModel<>>(across, 0.005, 0.3),
                    "friction = 0.3: must be 0 for a model that is pressed across the beam: see "
                    "docs/contact.md");
  CHECK_NOTHROW(Touch<FemModel<>>(across, 0.005, 0));
}

// What slides with the friction of too large a normal force pulls.  That is no equilibrium of Coulomb's law.
TEST_CASE("a rough hand that pushes the shank of an L along itself keeps it, however long its ticks",
          "[friction]") {
  constexpr double h = 0.2 * 2.36e-3, EA = 2e11 * 0.02 * h, bend = 0.02;
  Beam beam(0.2, EA, EA * h * h / 12, h, Support::clamped, Support::free);
  beam.naturally({{0.0835, 0}, {0.0835 + bend, 1.54 / bend}, {0.2, 0}});
  const Vector from(0.0976, -0.02166), way(-0.0031, -0.0042);
  const auto press = [&](int ticks, std::vector<Vector>& forces, int every) {
    Ruler model(beam, 16);
    Touch<Ruler> touch(model, 1.12e-3, Friction(0.72));
    for (int k = 0; k <= ticks; ++k) {
      const Felt r = touch.tick(from + way * (double(k) / ticks));
      CAPTURE(ticks, k);
      CHECK(r.status == Status::ok);
      CHECK(r.pressing);
      if (k % every == 0) forces.push_back(r.force);
    }
  };
  std::vector<Vector> fine;
  press(400, fine, 50);
  for (const int ticks : {8, 16, 24}) {
    std::vector<Vector> coarse;
    press(ticks, coarse, ticks / 8);
    for (std::size_t k = 1; k < fine.size(); ++k) {
      CAPTURE(ticks, k);
      CHECK((coarse[k] - fine[k]).norm() <= 1e-3 * fine[k].norm());
    }
  }
}
