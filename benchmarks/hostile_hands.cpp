// What a contact says whatever a hand does: it rushes about a beam at random, from 10⁻⁵ to 3·10⁻³ of its length a tick, leaps to another place
// in one of 20 ways, and names a place that is none in one of 10 000 ticks.
//
//   hostile_hands [TICKS]   so many for each row, 10⁶ unless given.  A line of CSV for each: what is touched, by what, ticks, ticks without
//                           an answer and the most of them in a row, forces that are not finite, that pull, and that leave the cone of
//                           friction; and how often of a hundred and more a hand that has gone and comes back feels what it does on a new beam
//
// Nothing here is timed; the same numbers on every machine with the same compiler.  Table: benchmarks/run.sh --stability.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "rod/rods.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A hand that goes where nobody would.
template <int D>
class HostileHand {
 public:
  using Vector = VectorOf<double, D>;
  /// @param from, to  corners of its room [m]
  HostileHand(const Vector& from, const Vector& to, std::uint64_t seed)
      : random_(seed), from_(from), to_(to), at_(to), goal_(to) {}

  Vector next() {
    const Vector way = goal_ - at_;
    if (way.norm() > speed_) return at_ += way * (speed_ / way.norm());
    at_ = goal_;
    for (int i = 0; i < D; ++i) goal_[i] = random_(from_[i], to_[i]);
    speed_ = std::pow(10, random_(-5, -2.5)) * (to_ - from_)[0];
    if (random_.integer(1, 20) == 1) at_ = goal_;
    return at_;
  }
  /// One in ten thousand is no place.
  Vector next_or_none() {
    constexpr double none[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), -1e300};
    Vector at = next();
    if (random_.integer(1, 10000) == 1) at[random_.integer(0, D - 1)] = none[random_.integer(0, 2)];
    return at;
  }
  void leap(const Vector& at) { at_ = goal_ = at; }

 private:
  Random random_;
  Vector from_, to_, at_, goal_;
  double speed_ = 0;
};

struct Count {
  long ticks = 0, unanswered = 0, row = 0, longest = 0, not_finite = 0, pulls = 0, beyond_cone = 0;
  int returns = 0, as_new = 0;

  /// Of one contact.
  template <class Vector>
  void force(const Vector& across, const Vector& along, const Vector& normal, double friction) {
    const double size = across.norm();
    not_finite += !(across.allFinite() && along.allFinite());
    pulls += across.dot(normal) < -1e-12 * size;
    beyond_cone += along.norm() > friction * size * (1 + 1e-12);
  }
  void answer(Status status) {
    ++ticks;
    if (status == Status::invalid_request) return;
    row = is_answer(status) ? 0 : row + 1;
    unanswered += row > 0;
    longest = std::max(longest, row);
  }
  void print(const char* what, const char* by) const {
    std::printf("%s,%s,%ld,%ld,%ld,%ld,%ld,%ld,%d,%d\n", what, by, ticks, unanswered, longest, not_finite,
                pulls, beyond_cone, returns, as_new);
    std::fflush(stdout);
  }
};

constexpr long ways = 100;  // between which a hand goes and comes back

/// Past the left end, from where it comes back on the side where it began.
template <class Vector>
Vector around(Vector place) {
  place[0] -= 3;
  return place;
}

/// One avatar.  @param home  where it comes back to [m], @param away  and from where
template <class Model, int D = dimension_of<Model>>
void one(const char* what, const char* by, Model model, double radius, const Friction& friction,
         HostileHand<D> hand, const VectorOf<double, D>& home, const VectorOf<double, D>& away,
         const VectorOf<double, D>& shaft, long ticks) {
  using Vector = VectorOf<double, D>;
  Touch<Model> touch(model, radius, friction);
  const auto tick = [&](Touch<Model>& with, const Vector& at) {
    if constexpr (D == 2) return static_cast<void>(shaft), with.tick(at);
    else return with.tick(at, shaft);
  };
  const auto come = [&](Touch<Model>& with) {
    for (int k = 0; k < 60; ++k) (void)tick(with, around(away));
    Vector force = Vector::Zero();
    for (int k = 0; k <= 100; ++k) force = tick(with, away + (home - away) * (k / 100.0)).force;
    return force;
  };
  const Vector wanted = come(touch);
  Count count;
  for (long way = 0; way < ways; ++way) {
    hand.leap(away);
    for (long k = 0; k < ticks / ways; ++k) {
      const auto felt = tick(touch, hand.next_or_none());
      count.answer(felt.status);
      count.force(Vector(felt.force - felt.friction), felt.friction, felt.contact.normal, friction.sticking);
    }
    ++count.returns;
    count.as_new += (come(touch) - wanted).norm() <= 1e-5 * wanted.norm();
  }
  count.print(what, by);
}

/// Two avatars of one radius.
template <class Model, int D = dimension_of<Model>>
void two(const char* what, Model model, double radius, const Friction& friction,
         std::array<HostileHand<D>, 2> hands, const VectorOf<double, D>& home,
         const VectorOf<double, D>& away, long ticks) {
  using Vector = VectorOf<double, D>;
  const RoundAvatar avatar(radius, 1, friction);
  TouchSeveral<Model> touch(model, {avatar, avatar});
  const auto come = [&] {
    for (int k = 0; k < 60; ++k) (void)touch.tick(around(away), around(away));
    Vector force = Vector::Zero();
    for (int k = 0; k <= 100; ++k)
      force = touch.tick(Vector(away + (home - away) * (k / 100.0)), away).force(0);
    return force;
  };
  const Vector wanted = come();
  Count count;
  for (long way = 0; way < ways; ++way) {
    for (auto& hand : hands) hand.leap(away);
    for (long k = 0; k < ticks / ways; ++k) {
      const Vector left = hands[0].next_or_none(), right = hands[1].next_or_none();
      const auto felt = touch.tick(left, right);
      count.answer(felt.status);
      for (const auto& place : felt)
        count.force(Vector(place.force - place.friction), place.friction, place.normal, friction.sticking);
    }
    ++count.returns;
    count.as_new += (come() - wanted).norm() <= 1e-5 * wanted.norm();
  }
  count.print(what, friction.none() ? "two hands" : "two hands with friction");
}

void plane(long ticks) {
  using Alone = FemModel<Corotational<>>;
  using Both = FemModel<Several<Corotational<>, 2>>;
  using Place = Vector2<double>;
  const Material steel{200e9};
  const Beam ruler = steel_ruler(),
             bar(1, Section::rectangle(0.02, 0.01), steel, Support::pinned, Support::pinned),
             bow = arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), steel, Support::pinned);
  const auto hand = [](const Beam& beam, double deep, std::uint64_t seed) {
    const double L = beam.length();
    return HostileHand<2>({-0.05 * L, -deep * L}, {1.05 * L, deep * L}, seed);
  };
  const auto go = [&](const char* name, const Beam& beam, int elements, double deep, double rise,
                      std::uint64_t seed) {
    const double L = beam.length();
    const Place home(0.6 * L, rise), away(0.6 * L, rise + 0.2 * L);
    for (const Friction& friction : {Friction(0), Friction(0.6, 0.4)}) {
      one(name, friction.none() ? "a hand" : "a hand with friction", Alone(beam, elements), 0.005, friction,
          hand(beam, deep, seed), home, away, Place(0, 0), ticks);
      two(name, Both(beam, elements), 0.005, friction,
          {hand(beam, deep, seed + 1), hand(beam, deep, seed + 2)}, home, away, ticks);
    }
  };
  go("ruler", ruler, 16, 0.15, 0.004, 1);
  go("bar", bar, 16, 0.05, 0.008, 4);
  go("arch", bow, 16, 0.1, 0.017, 7);
}

void space(long ticks) {
  using Alone = FemModel<RoundRod>;
  using Twisted = FemModel<TwistedRod>;
  using Both = FemModel<Several<RoundRod, 2>>;
  const Rod needle(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free),
      wire(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  const Rod hook = pressed_rod("hook").rod;
  const Point none(0, 0, 0), shaft(0, 0, 0.04);
  const auto hand = [](double deep, std::uint64_t seed) {
    return HostileHand<3>({-0.01, -deep, -deep}, {0.21, deep, deep}, seed);
  };
  for (const Friction& friction : {Friction(0), Friction(0.6, 0.4)}) {
    const char* by = friction.none() ? "a sphere" : "a sphere with friction";
    one("needle", by, Alone(needle, 8), 0.01, friction, hand(0.03, 11), {0.12, 0.009, 0}, {0.12, 0.05, 0},
        none, ticks);
    one("wire", by, Alone(wire, 8), 0.01, friction, hand(0.02, 12), {0.12, 0.0095, 0}, {0.12, 0.05, 0}, none,
        ticks);
    one("wire that twists", by, Twisted(wire, 8), 0.01, friction, hand(0.02, 12), {0.12, 0.0095, 0},
        {0.12, 0.05, 0}, none, ticks);
    two("needle", Both(needle, 8), 0.01, friction, {hand(0.03, 15), hand(0.03, 16)}, {0.12, 0.009, 0},
        {0.12, 0.05, 0}, ticks);
    two("wire", Both(wire, 8), 0.01, friction, {hand(0.02, 17), hand(0.02, 18)}, {0.12, 0.0095, 0},
        {0.12, 0.05, 0}, ticks);
    one("needle", friction.none() ? "a shaft" : "a shaft with friction", Alone(needle, 8), 0.005, friction,
        hand(0.03, 13), {0.12, 0.003, -0.02}, {0.12, 0.05, -0.02}, shaft, ticks);
  }
  const HostileHand<3> about_hook({-0.01, -0.01, -0.03}, {0.06, 0.11, 0.03}, 14);
  one("hook", "a shaft", Twisted(hook, 16), 0.005, Friction(0), about_hook, {0.045, 0.03, -0.02},
      {0.12, 0.03, -0.02}, shaft, ticks);
}

}  // namespace

int main(int argc, char** argv) {
  const long ticks = argc > 1 ? std::atol(argv[1]) : 1000000;
  if (ticks < ways) return std::fputs("hostile_hands: ticks must be 100 or more\n", stderr), 2;
  std::printf(
      "what,touched_by,ticks,unanswered,most_in_a_row,not_finite,pulls,beyond_the_cone,returns,as_new\n");
  plane(ticks);
  space(ticks);
  return 0;
}
