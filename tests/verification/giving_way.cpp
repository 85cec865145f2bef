// What a contact takes as it gives way: the coefficient of sliding is the smaller one, and the beam springs back within a tick.
//
// The work of the hands less the energy of beam and skins is what friction took, in the tick of the jump and on closed paths.  And the same
// way is gone slowly beside it.  The hands are held where the slide is about to begin, and the coefficient falls to that of sliding in a
// thousand steps; then all of it is a slide with one coefficient, and ∫T|slip| by trapezoids is what friction takes.  The beam's energy falls by
// as much.
#include <cmath>
#include <limits>

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
using Touching = TouchSeveral<Model>;
using Felt = TouchSeveralResult<double, 2, 2>;

template <class Felt>
double taken(const Felt& felt) {
  double sum = 0;
  for (const auto& place : felt) sum += place.dissipated;
  return sum;
}

/// Of the skins at both contacts, which are as stiff as a scalar allows (docs/contact.md) [J].
template <class Felt>
double sheared(const Felt& felt, const Beam& beam) {
  const double length = beam.length(), stiffness = beam.bending_stiffness() / (length * length * length) /
                                                   std::sqrt(std::numeric_limits<double>::epsilon());
  double sum = 0;
  for (const auto& place : felt) sum += place.friction.squaredNorm() / (2 * stiffness);
  return sum;
}

template <class Felt, class AnyModel>
double stored(const Felt& felt, const AnyModel& model) {
  return model.strain_energy() + sheared(felt, steel_ruler());
}

/// One hand holds a ruler from below, and the other one presses it and is drawn along it.
struct Hands {
  Model model{steel_ruler(), 32};
  Touching touch{model, {{0.005, 1, Friction(0)}, {0.005, 1, Friction(0)}}};
  double drawn = 0;  // [m]
  Hands(const Friction& holding, const Friction& pressing) {
    touch.set_friction(0, holding), touch.set_friction(1, pressing);
    for (int k = 0; k <= 200; ++k) (void)tick(0.066 * (1 - k / 200.0));
  }
  Felt tick(double above = 0) {
    return touch.tick(Vector(0.11, -0.0075), Vector(0.22 + drawn, above - 0.06));
  }
};

}  // namespace

TEST_CASE("what a contact takes as it gives way is what it takes of the same way gone slowly",
          "[friction][several]") {
  const Friction pressing(0.5, 0.3);
  // The other contact sticks, slides, or is frictionless.
  for (const double holding : {1.5, 0.1, 0.0}) {
    const auto to_the_slide = [&](double step, int most) {
      Hands hands(holding, pressing);
      int ticks = 0;
      Felt felt = hands.tick();
      for (bool stuck = false; !(felt.places[1].sliding && stuck) && ticks < most; ++ticks) {
        stuck = !felt.places[1].sliding;
        hands.drawn -= step;
        felt = hands.tick();
      }
      return ticks;
    };
    double coarse = 0;
    for (const double step : {2e-7, 5e-8}) {
      const int begins = to_the_slide(step, 100000);
      REQUIRE(begins < 100000);
      Hands fast(holding, pressing), slow(holding, pressing);
      Felt at = fast.tick(), felt = slow.tick();
      for (int k = 1; k < begins; ++k) {
        fast.drawn -= step, slow.drawn -= step;
        at = fast.tick(), felt = slow.tick();
      }
      REQUIRE_FALSE(at.places[1].sliding);
      const double before = taken(at);
      fast.drawn -= step;
      const Felt gone = fast.tick();
      REQUIRE(gone.places[1].sliding);
      const double at_once = taken(gone) - before;
      const double balance = -(at.places[1].force + gone.places[1].force).x() * -step / 2 +
                             stored(at, slow.model) - stored(gone, fast.model);

      const double energy = stored(felt, slow.model),
                   share = felt.places[1].friction.norm() /
                           (felt.places[1].force - felt.places[1].friction).norm();
      for (int k = 1; k <= 1000; ++k) {
        slow.touch.set_friction(1, share + (pressing.sliding - share) * k / 1000);
        felt = slow.tick();
        REQUIRE(felt.status == Status::ok);
      }
      const double slowly = taken(felt) - before, lost = energy - stored(felt, slow.model),
                   error = std::abs(at_once / slowly - 1);
      CAPTURE(holding, step, begins, at_once, balance, slowly, lost, error);
      CHECK(slowly > 1e-4);
      CHECK(std::abs(at_once / balance - 1) <= 1e-6);
      CHECK(std::abs(lost / slowly - 1) <= 1e-5);
      CHECK(error <= step / 2e-7 * 1e-2);
      CHECK((coarse == 0 || error <= coarse / 2));  // of first order in the step
      coarse = error;
    }
  }
}

// A hand that draws the ruler over a peg and under another hand lets it spring back by 0.3 mm, too far for the mesh that it had, and tangents turn by
// 1.5 degrees.
TEST_CASE("a jump in which nodes follow their contacts takes what the beam loses", "[friction][several]") {
  for (const double step : {2e-6, 5e-7}) {
    FemModel<Several<Corotational<>, 4>> model(steel_ruler(), 32);
    TouchSeveral touch(model, {{0.005, 1, Friction(0.7, 0.5)}, {0.005, 1, Friction(0.5, 0.35)}},
                       {Prop<>::peg({0.157, -0.007}, 0.005).rough({0.3, 0.2})});
    const auto tick = [&](double above, double drawn) {
      return touch.tick(Vector(0.119, above - 0.024), Vector(0.207 - drawn, above - 0.024));
    };
    for (int k = 0; k <= 300; ++k) (void)tick(0.03 * (1 - k / 300.0), 0);
    auto before = tick(0, 0);
    double energy = stored(before, model);
    int jumps = 0;
    for (int k = 1; k * step < 0.003; ++k) {
      const auto now = tick(0, k * step);
      REQUIRE(now.status == Status::ok);
      const double took = taken(now) - taken(before), left = stored(now, model),
                   balance = (before.force(1) + now.force(1)).x() * step / 2 + energy - left;
      energy = left;
      if (took > 0.01) {
        CAPTURE(step, k, took, balance);
        jumps += std::abs(before.places[1].s - now.places[1].s) > 1e-3 * ruler_length;
        CHECK(std::abs(took / balance - 1) <= 1e-9);
      }
      before = now;
    }
    CHECK(jumps == 1);
  }
}

// One holds a ruler from below and gives way; the other one, which slides with a little friction, turns back at that and slides the other way.
TEST_CASE("two contacts that give way by turns take what a closed path gives", "[friction][several]") {
  const auto path = [](double t, int hand) {
    const double a = 2 * 3.14159265358979323846 * t, up = 1 - std::cos(a);
    return hand == 0 ? Vector(0.1329 - 0.001 * std::cos(a), 0.0049 * up - 0.0055)
                     : Vector(0.2027 + 0.0053 * std::sin(a + 2.56), 0.0017 * up - 0.0123);
  };
  for (const int ticks : {12000, 24000}) {
    Model model(steel_ruler(), 32);
    Touching touch(model, {{0.005, 1, Friction(0.97, 0.68)}, {0.005, 1, Friction(0.147, 0.103)}});
    for (int k = 0; k < 40; ++k)
      (void)touch.tick(Vector(path(0, 0) - Vector(0, 0.001 * (1 - k / 40.0))),
                       Vector(path(0, 1) + Vector(0, 0.018 * (1 - k / 40.0))));
    Felt before = touch.tick(path(0, 0), path(0, 1));
    double given = 0, took = 0;
    int turned = 0;
    for (int k = 1; k <= 2 * ticks; ++k) {
      const double t = double(k) / ticks;
      const Felt now = touch.tick(path(t, 0), path(t, 1));
      REQUIRE(now.status == Status::ok);
      if (k == ticks + 1) given = took = 0;
      for (int i : {0, 1}) {
        const auto &a = before.places[std::size_t(i)], &b = now.places[std::size_t(i)];
        REQUIRE((b.touching && b.dissipated >= a.dissipated));
        given -= (a.force + b.force).dot(path(t, i) - path(t - 1.0 / ticks, i)) / 2;
      }
      took += taken(now) - taken(before);
      turned += !before.places[0].sliding && now.places[0].sliding &&
                before.places[1].friction.x() * now.places[1].friction.x() < 0;
      before = now;
    }
    CAPTURE(ticks, given, took, turned);
    CHECK(turned > 2);
    CHECK(std::abs(given / took - 1) <= 1e-9);
  }
}

// As a hand gives way, so does the other one, which the beam then carries the other way.
TEST_CASE("contacts that give way within one tick share what the beam loses", "[friction][several]") {
  FemModel<Several<Corotational<>, 4>> model(steel_ruler(), 16);
  TouchSeveral touch(model, {{0.005, 1, Friction(0.508, 0.3556)}, {0.005, 1, Friction(0.0532, 0.03724)}},
                     {Prop<>::peg({0.17291, -0.006266}, 0.005).rough({0.1037, 0.07259})});
  const auto path = [](double t, int hand) {
    const double a = 2 * 3.14159265358979323846 * t, up = 1 - std::cos(a);
    return hand == 0
               ? Vector(0.09603 - 0.004067 * (std::sin(a + 0.7889) - std::sin(0.7889)), 8e-4 * up - 0.001016)
               : Vector(0.206433 + 0.001997 * (std::sin(a - 0.863) + std::sin(0.863)),
                        7.35e-4 * up - 0.008979);
  };
  constexpr int ticks = 6000;
  for (int k = 0; k <= 200; ++k) {
    const auto down = [&](int hand) {
      Vector at = path(0, hand);
      at.y() += (0.00551 - at.y()) * (1 - k / 200.0);
      return at;
    };
    (void)touch.tick(down(0), down(1));
  }
  auto before = touch.tick(path(0, 0), path(0, 1));
  double given = 0, took = 0, energy = 0;
  int together = 0;
  for (int k = 1; k <= 2 * ticks; ++k) {
    const double t = double(k) / ticks;
    const auto now = touch.tick(path(t, 0), path(t, 1));
    REQUIRE(now.status == Status::ok);
    int more = 0;
    for (int i : {0, 1, 2}) {
      const auto &a = before.places[std::size_t(i)], &b = now.places[std::size_t(i)];
      REQUIRE((b.touching && b.dissipated >= a.dissipated));
      if (i < 2) given -= (a.force + b.force).dot(path(t, i) - path(t - 1.0 / ticks, i)) / 2;
      more += !a.sliding && b.sliding;
    }
    took += taken(now) - taken(before);
    together += more > 1;
    before = now;
    if (k == ticks) given = took = 0, energy = stored(now, model);
  }
  CAPTURE(given, took, together);
  CHECK(together > 20);
  CHECK(std::abs(given - took - (stored(before, model) - energy)) <= 1e-9 * took);
}
