// Friction of one avatar that touches at two places, and what is felt where friction has no answer.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Model = FemModel<Several<Corotational<>, 2>>;

/// Whose friction does not settle when it is told so.
struct Unsettled : Model {
  using Model::Model;
  bool unsettled = false;
  Status push(Obstacle<double>* all, int count) noexcept {
    const Status status = Model::push(all, count);
    for (int i = 0; i < count; ++i)
      if (unsettled && all[i].friction) all[i].friction->settled = false;
    return status;
  }
};

}  // namespace

// A string with a weight at its end hangs over a peg, which is moved along and across it.
TEST_CASE("a wide avatar with friction takes at its two places what a closed path gives",
          "[friction][several]") {
  constexpr double length = 0.5, weight = 10, thin = 1e-4, bending = 0.005, radius = 0.05, mu = 0.2;
  Beam string(length, 1e4, weight * bending * bending, thin, Support::clamped, Support::free);
  string.add(PointLoad{length, weight});
  for (const int fine : {1, 2}) {
    Model model(string, 50 * fine);
    TouchSeveral touch(model, {{radius, 2, Friction(mu)}});
    const Vector wound(0.12, radius - 0.16);  // the string turns by 0.8
    (void)touch.tick(Vector(0.2, radius + thin));
    for (int k = 1; k <= 150; ++k)
      (void)touch.tick(Vector(Vector(0.2, radius) + (wound - Vector(0.2, radius)) * (k / 150.0)));
    const int ticks = 300 * fine;
    const auto path = [&](double t) {
      const double a = 2 * 3.14159265358979323846 * t;
      return Vector(wound + Vector(0.01 * std::sin(a), 0.004 * (1 - std::cos(a))));
    };
    double given = 0, taken = 0;
    int sliding = 0;
    auto before = touch.tick(path(0));
    for (int k = 1; k <= 2 * ticks; ++k) {
      const auto now = touch.tick(path(double(k) / ticks));
      REQUIRE(now.status == Status::ok);
      if (k == ticks + 1) given = taken = 0;
      for (std::size_t i : {0u, 1u}) {
        const auto &a = before.places[i], &b = now.places[i];
        REQUIRE(b.touching);
        REQUIRE(b.friction.norm() <= mu * (b.force - b.friction).norm() * (1 + 1e-14));
        REQUIRE(b.dissipated >= a.dissipated);
        taken += b.dissipated - a.dissipated;
        sliding += b.sliding;
      }
      given -=
          (now.force(0) + before.force(0)).dot(path(double(k) / ticks) - path(double(k - 1) / ticks)) / 2;
      before = now;
    }
    CAPTURE(fine, given, taken, sliding);
    CHECK(sliding > ticks);
    CHECK(given > 0);
    CHECK(std::abs(given - taken) <= (fine == 1 ? 3e-3 : 3e-4) * taken);
  }
}

TEST_CASE("where friction has not settled the last answer is felt", "[friction][several]") {
  Unsettled model(steel_ruler(), 16);
  Model other(steel_ruler(), 16);
  TouchSeveral touch(model, {{0.005, 1, 0.4}, {0.005, 1, 0.4}});
  TouchSeveral settled(other, {{0.005, 1, 0.4}, {0.005, 1, 0.4}});
  TouchSeveralResult<double, 2, 2> last;
  for (int k = 0; k < 400; ++k) {
    const Vector left(0.1 + 5e-5 * k, 1e-5 * k - 0.0056), right(0.2 + 5e-5 * k, 0.0056 - 1e-4 * k);
    model.unsettled = k % 50 > 44;
    const auto felt = touch.tick(left, right), answer = settled.tick(left, right);
    CAPTURE(k);
    REQUIRE(answer.status == Status::ok);
    if (!model.unsettled || k == 0) {
      REQUIRE(felt.status == Status::ok);
      for (int i = 0; i < 2; ++i) REQUIRE((felt.force(i) - answer.force(i)).norm() == 0);
      last = felt;
      continue;
    }
    REQUIRE(felt.status == Status::iteration_limit);
    for (std::size_t i : {0u, 1u}) {
      const auto &now = felt.places[i], &then = last.places[i];
      REQUIRE(now.status == Status::iteration_limit);
      REQUIRE((now.force == then.force && now.friction == then.friction && now.point == then.point));
      REQUIRE((now.dissipated == then.dissipated && now.sliding == then.sliding));
    }
  }
  CHECK(last.friction(0).norm() > 0);
  CHECK(last.friction(1).norm() > 0);
}
