// From the hand's position to the force: on a beam in closed form, and on the finite-element beam.
#include <limits>
#include <random>

#include "../support/catch.hpp"
#include "closed_form_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

namespace {

using Vector = Vector2<double>;
using Model = ClosedFormBeam<double>;
constexpr double radius = 5e-3, reach = radius + 1e-3;

Beam thesis_beam(Support right) {
  return {2.54, Section::rectangle(0.0254, 0.0254), Material{206.8427e9},
          right == Support::free ? Support::clamped : Support::pinned, right};
}

/// Moves in a straight line, calls visit(from, to, result) for each tick.
template <typename M, typename Visit>
void move(Touch<M>& touch, Vector from, Vector to, int ticks, Visit visit) {
  Vector last = from;
  for (int i = 1; i <= ticks; ++i) {
    const Vector next = from + (to - from) * (double(i) / ticks);
    visit(last, next, touch.tick(next));
    last = next;
  }
}

/// What must hold in every tick, whatever the hand does.
template <typename M>
void check_law(const TouchResult<double>& r, const M& model, double rest) {
  REQUIRE(r.force.allFinite());
  REQUIRE(r.force.dot(r.contact.normal) >= 0);  // a beam never pulls
  REQUIRE(std::abs(cross<double>(r.force, r.contact.normal)) <=
          1e-12 * r.force.norm());  // and has no friction
  if (r.pressing) return;
  REQUIRE(r.force.isZero(0));
  for (const auto& node : model.shape()) REQUIRE(std::abs(node.w) <= rest);
}

template <typename M>
int law_over_random_paths(M& model, double length, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  int pressing = 0;
  Touch<M> touch(model, radius);
  for (int path = 0; path < 30; ++path) {
    const double a = unit(random), b = unit(random), c = unit(random), depth = 0.06 * length * unit(random);
    for (int k = 0; k < 500; ++k) {
      const double t = k / 1000.0;
      Vector q(length * (0.5 + 0.6 * std::sin(4 * t * (1 + a) + 6 * b)),
               depth * std::sin(20 * t * (0.2 + c) + 6 * a));
      if (k % 50 == 0) q.x() += 0.3 * length * (unit(random) - 0.5);  // and jumps
      if (k % 70 == 0) q.y() *= -1;
      const auto result = touch.tick(q);
      check_law(result, model, 0);
      pressing += result.pressing;
    }
  }
  return pressing;
}

}  // namespace

TEST_CASE("a resting avatar is met exactly: after a few ticks its depth is zero on the deformed beam") {
  for (const Ends ends : {Ends::simply_supported, Ends::cantilever}) {
    for (const int side : {1, -1}) {
      for (const double x : {0.2, 0.5, 0.83}) {
        for (const double press : {1e-4, 1e-2, 5e-2}) {
          Model model(ends);
          Touch<Model> touch(model, radius);
          REQUIRE_FALSE(touch.tick({x, side * 0.02}).pressing);
          const Vector hand(x, side * (reach - press));
          TouchResult<double> r;
          for (int tick = 0; tick < 8; ++tick) r = touch.tick(hand);
          CHECK(std::abs(r.contact.depth) < 1e-12);
          CHECK(r.contact.side == side);
          const double s = r.press.s, d = r.press.d;
          const double stiffness =
              ends == Ends::cantilever ? 3 / (s * s * s) : 3 / (s * s * (1 - s) * (1 - s));
          CHECK(r.force.y() == Approx(-stiffness * d));
          CHECK(r.force.y() * side > 0);
          // Along the normal of the deformed beam: the axial part is -w' times the transverse one.
          CHECK(r.force.x() == Approx(model.shape().at(s).theta * r.force.y()).margin(1e-9));
        }
      }
    }
  }
}

TEST_CASE("a step through the beam presses it at once, by the whole depth") {
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  CHECK(touch.tick({0.5, 0.02}).force.isZero(0));
  const auto r = touch.tick({0.5, -0.08});
  CHECK(r.pressing);
  CHECK(r.contact.side == 1);
  CHECK(r.press.d == Approx(-0.08 - reach));
  CHECK(r.force.y() == Approx(48 * (0.08 + reach)));
  CHECK(r.force.x() == 0);
}

// Beyond the end the way to the hand points down, and it has come from above all the same.
TEST_CASE("a step through the beam that ends past its end, beneath, presses from above and goes on so") {
  FemModel<> model(thesis_beam(Support::free), 8);
  Touch<FemModel<>> touch(model, radius);
  CHECK_FALSE(touch.tick({2.4, 0.1}).pressing);
  for (const double x : {2.541, 2.5405, 2.53, 2.5, 2.4}) {
    const auto r = touch.tick({x, -0.003});
    CHECK(r.pressing);
    CHECK(r.press.d < 0);
    CHECK(r.force.y() > 0);
  }
}

TEST_CASE("the beam follows a hand that draws back and lets go at its rest shape, not before and not after") {
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  touch.reset();
  move(touch, {0.4, 0.02}, {0.4, -0.03}, 100, [](auto&&...) {});
  REQUIRE(touch.pressing());
  double last = std::numeric_limits<double>::infinity();
  move(touch, {0.4, -0.03}, {0.4, 0.02}, 500,
       [&](const Vector&, const Vector& hand, const TouchResult<double>& r) {
         CHECK(r.pressing == (hand.y() < reach - 1e-9));
         CHECK(r.force.y() <= last);
         last = r.force.y();
         check_law(r, model, 0);
       });
}

TEST_CASE("no press, no reset and little work while the hand is free") {
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  move(touch, {0.1, 0.5}, {0.9, 0.007}, 100, [](const Vector&, const Vector&, const TouchResult<double>& r) {
    CHECK((r.status == Status::ok && !r.pressing && r.force.isZero(0)));
  });
  CHECK(model.presses == 0);
}

TEST_CASE("a beam never pulls, and is at rest where it does not push: closed forms") {
  for (const Ends ends : {Ends::simply_supported, Ends::cantilever}) {
    Model model(ends);
    CHECK(law_over_random_paths(model, 1, 21) > 1500);
  }
}

TEST_CASE("a beam never pulls, and is at rest where it does not push: finite elements") {
  for (const Support right : {Support::pinned, Support::free}) {
    for (const int elements : {2, 8}) {
      FemModel<> model(thesis_beam(right), elements);
      CHECK(law_over_random_paths(model, 2.54, 22) > 1500);
    }
  }
}

TEST_CASE("the hand's work over a closed way of pressing, sliding and letting go tends to zero") {
  // The beam is conservative and the contact has no friction.  Each tick's force belongs to the shape of the
  // tick before, an error of first order in the step, so ten times the ticks leave a tenth of the work.
  const auto work = [](int ticks) {
    Model model(Ends::simply_supported);
    Touch<Model> touch(model, radius);
    const Vector corners[] = {{0.3, 0.01}, {0.3, -0.03}, {0.6, -0.05}, {0.75, -0.02}, {0.6, 0.01}};
    double sum = 0, peak = 0;
    Vector force(0, 0);
    (void)touch.tick(corners[0]);
    for (int i = 0; i < 4; ++i) {
      move(touch, corners[i], corners[i + 1], ticks,
           [&](const Vector& from, const Vector& to, const auto& r) {
             sum -= (force + r.force).dot(to - from) / 2;
             force = r.force;
             peak = std::max(peak, sum);
           });
    }
    CHECK_FALSE(touch.pressing());
    return std::abs(sum) / peak;
  };
  CHECK(work(200) < 1e-2);
  CHECK(work(2000) < 1e-3);
  CHECK(work(20000) < 1e-4);
}

TEST_CASE("off the free end of a deflected cantilever the force fades and nothing is left behind") {
  Model model(Ends::cantilever);
  Touch<Model> touch(model, radius);
  (void)touch.tick({0.9, 0.01});
  move(touch, {0.9, 0.01}, {0.9, -0.04}, 100, [](auto&&...) {});
  double last = 0;
  move(touch, {0.9, -0.04}, {1.05, -0.04}, 3000,
       [&](const Vector&, const Vector& hand, const TouchResult<double>& r) {
         check_law(r, model, 0);
         CHECK(r.force.norm() < 2 * 3 * 0.06 / (0.9 * 0.9 * 0.9));
         last = r.force.norm();
         if (hand.x() > 1 + reach + 1e-4) CHECK_FALSE(r.pressing);
       });
  CHECK(last == 0);
}

TEST_CASE("a position that is not a number gives no force, a status, and does not disturb the touch") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  CHECK(touch.tick({nan, 0}).status == Status::invalid_request);
  (void)touch.tick({0.5, 0.01});
  const auto before = touch.tick({0.5, -0.05});
  const auto bad = touch.tick({0.5, nan});
  CHECK(bad.status == Status::invalid_request);
  CHECK(bad.force.isZero(0));
  CHECK(touch.tick({0.5, -0.05}).force.y() == Approx(before.force.y()));
}

TEST_CASE("a model that fails gives no force and its status, and the side is not lost") {
  for (const Status status : {Status::iteration_limit, Status::singular, Status::non_finite}) {
    Model model(Ends::simply_supported);
    Touch<Model> touch(model, radius);
    (void)touch.tick({0.5, 0.01});
    const auto before = touch.tick({0.5, -0.05});
    model.fail_with = status;
    const auto failed = touch.tick({0.5, -0.06});
    CHECK(failed.status == status);
    CHECK(failed.force.isZero(0));
    model.fail_with = Status::ok;
    const auto after = touch.tick({0.5, -0.05});
    CHECK(after.contact.side == 1);
    CHECK(after.force.y() == Approx(before.force.y()));
  }
}

TEST_CASE("reset lets go and forgets where the hand was") {
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  (void)touch.tick({0.5, 0.02});
  REQUIRE(touch.tick({0.5, -0.05}).pressing);
  touch.reset();
  for (const auto& node : model.shape()) CHECK(node.w == 0);
  CHECK_FALSE(touch.tick({0.5, -0.05}).pressing);
}

TEST_CASE("beyond the model's range the status says so and the force is that of the range") {
  Model model(Ends::simply_supported);
  Touch<Model> touch(model, radius);
  (void)touch.tick({0.5, 0.02});
  const auto r = touch.tick({0.5, -0.3});
  CHECK(r.status == Status::out_of_range);
  CHECK(r.force.y() == Approx(48 * 0.1));
  CHECK(touch.tick({0.5, -0.3}).contact.side == 1);
}

// The tip stops at a tenth of the length, and has drawn back along x by then: the hand passes below and beside it.
TEST_CASE("a tip that has stopped at the end of its range is not let through, nor caught from below") {
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{206.8427e9}, Support::clamped,
                   Support::free);
  FemModel<> model(ruler, 16);
  Touch<FemModel<>> touch(model, radius);
  const double low = -0.045, high = 0.010;
  double before = 0;
  bool held = false, stopped = false;
  move(touch, {0.3, high}, {0.3, low}, 1000, [&](const Vector&, const Vector& at, const auto& r) {
    INFO("y = " << at.y());
    check_law(r, model, 0);
    REQUIRE(r.pressing == (at.y() < radius + 0.0005));
    REQUIRE(r.force.y() >= before * (1 - 1e-6));
    before = r.force.y();
    held = held || r.pressing;
    stopped = stopped || r.status == Status::out_of_range;
  });
  CHECK((held && stopped));
  // Below the stopped beam and in from its tip: still the same press, from above.
  for (const Vector& to : {Vector(0.27, low), Vector(0.3, low)})
    move(touch, {0.57 - to.x(), low}, to, 200, [&](const Vector&, const Vector& at, const auto& r) {
      INFO("x = " << at.x());
      check_law(r, model, 0);
      REQUIRE((r.pressing && r.force.y() > 0 && r.contact.normal.y() > 0));
    });
  move(touch, {0.3, low}, {0.3, high}, 1000, [&](const Vector&, const Vector& at, const auto& r) {
    INFO("back, y = " << at.y());
    check_law(r, model, 0);
    REQUIRE(r.pressing == (at.y() < radius + 0.0005));
    REQUIRE(r.force.y() <= before * (1 + 1e-6));
    before = r.force.y();
  });
  CHECK(before == 0);
}

TEST_CASE("finite elements: a resting avatar is met, and the force comes to rest") {
  // Axial strain jumps at a node, so the beam has a small kink under the avatar: neither foot nor normal may
  // go to and fro between its flanks.
  for (const Support right : {Support::pinned, Support::roller, Support::free}) {
    for (const double x : {0.3, 0.77, 1.27, 2.1}) {
      for (const double y : {5e-3, -5e-3, -2e-2}) {
        FemModel<> model(thesis_beam(right), 8);
        Touch<FemModel<>> touch(model, radius);
        (void)touch.tick({x, 0.05});
        for (int tick = 0; tick < 12; ++tick) (void)touch.tick({x, y});
        const auto last = touch.tick({x, y}), r = touch.tick({x, y});
        CHECK(r.status == Status::ok);
        CHECK(r.pressing);
        CHECK(std::abs(r.contact.depth) < 1e-12);
        CHECK(r.force.y() > 0);
        CHECK((r.force - last.force).norm() < 1e-9 * r.force.norm());
      }
    }
  }
}

TEST_CASE("Touch in float") {
  ClosedFormBeam<float> model(Ends::simply_supported);
  Touch<ClosedFormBeam<float>> touch(model, 5e-3f);
  (void)touch.tick({0.5f, 0.02f});
  TouchResult<float> r;
  for (int tick = 0; tick < 6; ++tick) r = touch.tick({0.5f, -0.01f});
  CHECK(std::abs(r.contact.depth) < 1e-7f);
  CHECK(r.force.y() == Approx(48 * (0.01 + reach)).epsilon(1e-5));
}

TEST_CASE("an avatar without a size is taken, one with an impossible size is not") {
  Model model(Ends::simply_supported);
  CHECK_NOTHROW(Touch<Model>(model, 0));
  for (const double bad :
       {-1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH(Touch<Model>(model, bad), Catch::Matchers::ContainsSubstring("avatar_radius"));
}

TEST_CASE("an avatar beyond a thousand lengths of the beam is refused, and one of that size stays finite") {
  Model model(Ends::simply_supported);
  ClosedFormBeam<float> single(Ends::simply_supported);
  CHECK_THROWS_WITH(Touch<Model>(model, 1e200),
                    Catch::Matchers::ContainsSubstring("avatar_radius = 1e+200 m: must be 0 to 1000 m"));
  CHECK_THROWS_AS(Touch<ClosedFormBeam<float>>(single, 1e20f), std::invalid_argument);
  const auto press = [](auto touch, auto one) {
    using Scalar = decltype(one);
    for (const double y : {1.5e3, 1e3, 999.5, 0.0, -1e3, 1e18, -1e18})
      for (const double x : {0.5, 0.999, 1e3, -1e18}) {
        const auto r = touch.tick({static_cast<Scalar>(x), static_cast<Scalar>(y)});
        REQUIRE(r.force.allFinite());
        REQUIRE(r.contact.normal.allFinite());
      }
  };
  press(Touch<Model>(model, 1e3), 1.0);
  press(Touch<ClosedFormBeam<float>>(single, 1e3f), 1.0f);
}

TEST_CASE("a tick cannot throw") {
  STATIC_REQUIRE(noexcept(std::declval<Touch<Model>&>().tick(std::declval<const Vector&>())));
  STATIC_REQUIRE(noexcept(std::declval<Touch<Model>&>().reset()));
}

namespace {

/// A beam that pushes with nearly the largest number there is.
struct Overwhelming : Model {
  using Model::Model;
  Response<double> press(const Press<double>& request) noexcept {
    const Response<double> response = Model::press(request);
    return {std::copysign(std::numeric_limits<double>::max(), response.force), response.status};
  }
};

}  // namespace

TEST_CASE("a force that the slope of the contact would make infinite is reported and not given") {
  Overwhelming model(Ends::cantilever);
  Touch<Overwhelming> touch(model, 5e-3);
  int infinite = 0;
  for (int tick = 0; tick <= 400; ++tick) {
    const auto r = touch.tick({0.95, 0.02 - 1e-3 * tick});
    REQUIRE(r.force.allFinite());
    if (r.status == Status::non_finite) {
      ++infinite;
      REQUIRE(r.force.norm() == 0);
    }
  }
  CHECK(infinite > 0);
}
