// 10⁵ ticks of a hand that keeps to no rule, with a sphere and a stylus: slides, jumps, goes through rods and round their ends.
#include "rod/touching.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Tally {
  int ticks = 0, pressing = 0, refused = 0, longest = 0, missed_again = 0, pinched = 0;
  double widest = 0;  ///< gap of a contact that is ok [m]
};

/// @param step [m] a tick   @param jumps  whether the hand is also elsewhere at times
template <class Model>
Tally wander(Model& model, double radius, double length, double step, bool jumps, int ticks) {
  const double size = model.shape().length(), reach = radius + model.thickness() / 2;
  Touch<Model> touch(model, radius);
  Random random(7);
  // One by one: the order of arguments is the compiler's.
  const auto within = [&](double most) {
    const double z = random(most), y = random(most), x = random(most);
    return Point(x, y, z);
  };
  const auto somewhere = [&] {
    const Point r = model.shape().at(random(0.0, size)).r;
    return Point(r + within(0.1) * size);
  };
  const auto direction = [&] { return detail::unit(within(1.0)); };
  Tally tally;
  Point hand = somewhere(), target = somewhere(), along = direction(), spin = Point::Zero();
  int run = 0;
  bool missed_before = false;
  for (int k = 0; k < ticks; ++k) {
    if (jumps && k % 200 == 0) hand = somewhere(), along = direction();
    if (k % 100 == 0) spin = direction() * (jumps ? 0.01 : 0.001);
    const Point way = target - hand;
    if (way.norm() < 2 * step) target = somewhere();
    else hand += detail::unit(way) * step;
    along = detail::unit(Point(along + detail::cross3(along, spin)));
    const Shaft<double> axis{hand, length * along};
    const Felt r = length > 0 ? touch.tick(hand, axis.way) : touch.tick(hand);
    check_law(r);
    REQUIRE(r.status != Status::invalid_request);
    REQUIRE(r.status != Status::non_finite);
    for (const auto& node : model.shape()) REQUIRE(is_finite(node));
    ++tally.ticks;
    tally.pressing += r.pressing;
    tally.refused += !is_answer(r.status);
    tally.longest = std::max(tally.longest, run = is_answer(r.status) ? 0 : run + 1);
    bool missed = false;
    if (r.status == Status::ok && (r.pressing || k % 7 == 0 || missed_before)) {
      const double inside = penetration(model, axis, reach);
      if (r.pressing) tally.widest = std::max(tally.widest, -inside), tally.pinched += inside > 1e-6;
      else missed = inside > 1e-5;
    }
    tally.missed_again += missed && missed_before;
    missed_before = missed;
  }
  return tally;
}

void check(const Tally& tally, double least_pressing, double most_refused) {
  CAPTURE(tally.ticks, tally.pressing, tally.refused, tally.longest, tally.pinched, tally.widest);
  CHECK(tally.missed_again == 0);
  CHECK(tally.widest <= 1e-6);
  CHECK(tally.pinched <= tally.ticks / 1000);  // touched at two points at a distance
  CHECK(tally.pressing >= least_pressing * tally.ticks);
  CHECK(tally.refused <= most_refused * tally.ticks);
  CHECK(tally.longest <= 2 * Touch<FemModel<RoundRod>>::patience);
}

}  // namespace

TEST_CASE("random ways at the speed of a hand are followed, never a pull and never a miss", "[rod]") {
  FemModel<RoundRod> model(wire(), 8);
  check(wander(model, 0.005, 0, 2e-4, false, 20000), 0.05, 0.002);
  check(wander(model, 0.005, 0.1, 2e-4, false, 10000), 0.1, 0.01);
  FemModel<TwistedRod> hook(pressed_rod("hook").rod, 8);
  check(wander(hook, 0.005, 0, 2e-4, false, 10000), 0.1, 0.01);
  check(wander(hook, 0.005, 0.05, 2e-4, false, 10000), 0.1, 0.02);
}

TEST_CASE("random ticks with jumps: never a pull, never a miss that is not said, and recovered", "[rod]") {
  FemModel<RoundRod> model(wire(), 8), hung(pressed_rod("wire_under_load").rod, 8);
  for (auto* const rod : {&model, &hung}) {
    check(wander(*rod, 0.005, 0, 1e-3, true, 10000), 0.02, 0.03);
    check(wander(*rod, 0.02, 0, 1e-3, true, 5000), 0.05, 0.05);
    check(wander(*rod, 0.005, 0.1, 1e-3, true, 10000), 0.05, 0.05);
  }
  FemModel<TwistedRod> bar(pressed_rod("bar_two_ways").rod, 8);
  check(wander(bar, 0.02, 0.3, 5e-3, true, 10000), 0.02, 0.05);
  // Nothing is left of all that.
  model.reset();
  Touch<FemModel<RoundRod>> touch(model, 0.005);
  const Felt r = touch.tick({0.14, 0, 0.004});
  CHECK(r.status == Status::ok);
  CHECK(r.force.z() > 0);
}
