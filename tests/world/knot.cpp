// A rod tied in an overhand knot: its tension and its friction against the theory of loose knots, tight ones, and random hands.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "knots.hpp"
#include "once_world.hpp"
#include "support/random.hpp"
#include "support/sanitized.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// f(0) of the parabola through three points.
double at_nothing(const std::array<double, 3>& x, const std::array<double, 3>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum += f[i] * x[j] * x[k] / ((x[i] - x[j]) * (x[i] - x[k]));
  }
  return sum;
}

}  // namespace

// Audoly, Clauvelin and Neukirch, Phys. Rev. Lett. 99, 164301 (2007):  T h²/EI = ε⁴/2 ± μ σ ε³,  ε² = h/R,  for the trefoil σ = 0.492.  The energy
// of a circle, πEI/R + 2πRT, is least where T = EI/2R².  Both hold as ε goes to nothing; R is that of all rod that is tied.
TEST_CASE("a loose knot has the tension of its loop and the friction of its braid",
          "[world][friction][verification]") {
  struct Size {
    double thickness, R;
    int elements;
  };
  constexpr double mu = 0.01, by = 5e-5;
  std::array<double, 3> small{}, tension{}, friction{};
  std::size_t k = 0;
  for (const Size& size : {Size{0.0005, 0.055, 144}, Size{0.001, 0.055, 192}, Size{0.001, 0.03, 192}}) {
    KnottedRod<RoundRod> knot(1, size.thickness, 200e9, size.R, size.elements, {mu, mu});
    int answered = 0;
    const auto go = [&](double step) {
      for (int tick = 0; tick < 100; ++tick) answered += is_answer(knot.pull(step));
      return knot.tension();
    };
    const double pulled = go(by), R = knot.radius(), h = size.thickness / 2, EI = knot.stiffness;
    (void)go(by);
    const double let_go = go(-by);
    CHECK(answered >= 295);
    REQUIRE(knot.world.contacts() >= 4);
    REQUIRE(knot.world.contacts() <= 8);
    small[k] = std::sqrt(h / R);
    tension[k] = (pulled + let_go) / 2 * 2 * R * R / EI;
    friction[k] = (pulled - let_go) * h * h / (2 * EI * mu * std::pow(small[k], 3));
    ++k;
  }
  INFO("T 2R²/EI " << tension[0] << " " << tension[1] << " " << tension[2] << ", sigma " << friction[0] << " "
                   << friction[1] << " " << friction[2]);
  // What a parabola leaves is of the order of ε³.
  CHECK(at_nothing(small, tension) == Approx(1).margin(0.02));
  CHECK(at_nothing(small, friction) == Approx(0.492).margin(0.02));
}

TEST_CASE("a knot that is pulled tight stays one", "[world][friction]") {
  KnottedRod<RoundRod> knot(0.6, 0.004, 1e8, 0.04, 160, 0.2);
  REQUIRE(knot.determinant() == 3);
  const double stored = knot.world.strain_energy();
  double work = 0, before = knot.tension(), first = before;
  for (int tick = 1; tick <= 1040; ++tick) {
    REQUIRE(knot.pull(1e-4) == Status::ok);
    work += (before + knot.tension()) * 1e-4;
    before = knot.tension();
    if (tick % 50 == 0) CHECK(knot.closest(0.04) >= 1 - 1e-3);
  }
  CHECK(knot.radius() < 10 * knot.thickness / 2);
  CHECK(before > 10 * first);
  CHECK(knot.determinant() == 3);
  CHECK(work == Approx(knot.world.strain_energy() - stored + knot.world.dissipated()).epsilon(1e-3));
  // All begins anew as it was tied.
  knot.world.reset();
  CHECK(knot.determinant() == 3);
  CHECK(knot.world.strain_energy() == Approx(stored).epsilon(1e-9));
}

// With given normal forces it is not stable: the friction of a place follows what presses there, which makes it so.
TEST_CASE("a rough knot opens as its hands come back, without a leap", "[world][friction]") {
  KnottedRod<RoundRod> knot(0.6, 0.002, 1e8, 0.04, 64, 0.05);
  constexpr double by = 1e-4;
  const double stored = knot.world.strain_energy();
  double work = 0, before = knot.tension();
  const auto go = [&](double step) {
    INFO("hands " << (knot.right.at - knot.left.at).norm() << " m apart");
    REQUIRE(knot.pull(step) == Status::ok);
    work += (before + knot.tension()) * step;
    before = knot.tension();
  };
  for (int tick = 0; tick < 600; ++tick) go(by);
  for (int tick = 0; tick < 600; ++tick) go(-by);
  const double taken = knot.world.dissipated();
  CHECK(work == Approx(knot.world.strain_energy() - stored + taken).margin(1e-3 * taken));
}

// Without friction next to nothing keeps a knot in its place on the rod.
TEMPLATE_TEST_CASE("a knot without friction slides as it is pulled, and stays one", "[world]", RoundRod,
                   TwistedRod) {
  KnottedRod<TestType> knot(0.6, 0.004, 1e8, 0.04, 64);
  int answered = 0;
  for (int tick = 1; tick <= 600; ++tick) {
    answered += knot.pull(1e-4) == Status::ok;
    if (tick % 100 == 0) CHECK(knot.closest(0.04) > 0.99);
  }
  INFO(answered);
  CHECK(answered >= 570);
  CHECK(knot.determinant() == 3);
}

namespace {

/// Both hands go anywhere, at random; a knot that comes to a hand, over which it would slip, begins anew.
void shake(double step, double mu, int ticks, std::uint64_t seed) {
  KnottedRod<RoundRod> knot(0.6, 0.004, 1e8, 0.04, 64, mu);
  INFO("step " << step << ", mu " << mu << ", seed " << seed);
  Random random(seed);
  const RodPose left = knot.left, right = knot.right;
  Point left_by, right_by;
  const auto turn_back = [](Point& by, const Point& at, const Point& home) {
    for (int c = 0; c < 3; ++c)
      if (std::abs(at[c] - home[c]) > 0.04) by[c] = -std::copysign(by[c], at[c] - home[c]);
  };
  for (int tick = 0; tick < ticks; ++tick) {
    const auto any = [&] { return Point(random(1.0), random(1.0), random(1.0)); };
    if (tick % 40 == 0) left_by = step * any(), right_by = step * any();
    if (tick % 40 == 20) knot.left = turned(knot.left, detail::unit(any()), random(0.02));
    turn_back(left_by, knot.left.at, left.at - Point(0.04, 0, 0));
    turn_back(right_by, knot.right.at, right.at + Point(0.04, 0, 0));
    const Status status = knot.move(left_by, right_by);
    REQUIRE((is_answer(status) || status == Status::iteration_limit));
    REQUIRE(knot.finite());
    bool runs_off = false;
    for (int k = 0; k < knot.world.contacts(); ++k) {
      const RodContact contact = knot.world.contact(k);
      runs_off = runs_off || contact.s[0] < 0.03 || contact.s[1] > knot.length - 0.03;
    }
    if (runs_off) {
      knot.world.reset();
      knot.left = left, knot.right = right, left_by = right_by = Point(0, 0, 0);
    } else if (tick % 100 == 0) {
      INFO("tick " << tick << " " << name(status));
      CHECK(knot.determinant() == 3);
      if (is_answer(status)) CHECK(knot.closest(0.04) > 0.99);
    }
  }
}

}  // namespace

TEST_CASE("no hands pull a knot through itself", "[world][friction]") {
  shake(1e-3, 0.2, trials(1000), 1);
  shake(3e-3, 0, trials(500), 2);
}
TEST_CASE("no hands pull a knot through itself, for long", "[.][world][friction]") {
  shake(1e-4, 0.2, 50000, 3);
  shake(1e-3, 0.2, 30000, 4);
  shake(3e-3, 0, 20000, 5);
}

// A flat strip between clamps that have come together buckles to either side.
TEST_CASE("a rod begins bent to the side through which it is laid", "[world]") {
  const auto bowed = [](double by) {
    Rod strip(0.2, RodSection::rectangle(0.01, 0.0005), spring_steel, RodSupport::clamped,
              RodSupport::clamped);
    strip.place_right({{0.19, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    return World<TwistedRod>(
        {{strip, 16, {}, {{0, 0, 0}, {0.05, 0, by / 2}, {0.095, 0, by}, {0.14, 0, by / 2}, {0.19, 0, 0}}}});
  };
  const World<TwistedRod> up = bowed(0.02), down = bowed(-0.02);
  const Point top = up.shape(0).at(0.1).r, bottom = down.shape(0).at(0.1).r;
  CHECK(top.z() > 0.02);
  CHECK((top - Point(bottom.x(), bottom.y(), -bottom.z())).norm() < 1e-9);
}

TEST_CASE("points through which no rod begins are refused by name", "[world]") {
  using Catch::Matchers::ContainsSubstring;
  const Rod rod(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::clamped);
  const auto begin = [&](const std::vector<Point>& points) { World<RoundRod> world({{rod, 8, {}, points}}); };
  CHECK_THROWS_WITH(begin({{0, 0, 0}, {0.2, 0, 0}}), ContainsSubstring("through = 2"));
  CHECK_THROWS_WITH(begin({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}}),
                    ContainsSubstring("distance of two points = 0"));
}
