// Two hands that wander over a beam, and what a scene after a reset has to be: a new one, to the last bit.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace hapbeam::testing::resets {

inline constexpr double radius = 0.005, surface = radius + ruler_thickness / 2;

using Ruler = FemModel<Several<Corotational<>, 4>>;
using Wire = FemModel<Several<RoundRod, 4>>;

inline Ruler make(const Ruler*) { return Ruler(steel_ruler(), 16); }
inline Wire make(const Wire*) {
  return Wire(Rod(0.3, RodSection::circle(0.001), {200e9, 77e9}, RodSupport::clamped, RodSupport::free), 12);
}

template <class Model>
struct Pair {
  using Held = Touch<Hand<Model>>;
  using Place = typename Held::Vector;

  explicit Pair(std::initializer_list<Prop<dimension_of<Model>>> props, const Friction& friction = {})
      : hands(model, props), touch{{hands[0], radius, friction}, {hands[1], radius, friction}} {}

  auto tick(int hand, const Place& at) noexcept { return touch[hand].tick(at); }
  void reset() noexcept { touch[0].reset(), touch[1].reset(); }

  Model model = make(static_cast<const Model*>(nullptr));
  TwoHands<Model> hands;
  Held touch[2];
};

/// Two hands that go from place to place, with a jump here and there.
template <int D>
class Wander {
 public:
  using Place = VectorOf<double, D>;
  explicit Wander(std::uint64_t seed) : random_(seed) { next(), next(); }

  /// @return of both hands
  const Place* step() {
    if (step_ == steps_) next();
    ++step_;
    for (int h = 0; h < 2; ++h) at_[h] = from_[h] + (to_[h] - from_[h]) * (double(step_) / steps_);
    return at_;
  }

 private:
  void next() {
    steps_ = random_.integer(0, 7) == 0 ? 1 : 30, step_ = 0;
    for (int h = 0; h < 2; ++h) {
      from_[h] = to_[h];
      to_[h][0] = random_(0.2, 1.02) * ruler_length;
      to_[h][1] = random_(0.04);
      if constexpr (D == 3) to_[h][2] = random_(0.004);
    }
  }

  Random random_;
  Place from_[2], to_[2]{Place::Zero(), Place::Zero()}, at_[2];
  int step_ = 0, steps_ = 1;
};

/// Both are led by the same hands.   @return how many of the forces differ in any bit
template <class A, class B>
int differences(A& used, B& fresh, std::uint64_t seed, int ticks, int& pressing) {
  Wander<A::Held::dimension> wander(seed);
  int differ = 0;
  for (int k = 0; k < ticks; ++k) {
    const auto* const at = wander.step();
    for (int h = 0; h < 2; ++h) {
      const auto a = used.tick(h, at[h]), b = fresh.tick(h, at[h]);
      differ += a.force != b.force || a.status != b.status || a.contact.s != b.contact.s ||
                a.dissipated != b.dissipated;
      pressing += b.pressing;
    }
  }
  return differ;
}

template <class Model>
void check_as_new(std::initializer_list<Prop<dimension_of<Model>>> props, const Friction& friction,
                  int histories) {
  Pair<Model> used(props, friction);
  Random random(7);
  int pressing = 0;
  for (int i = 0; i < histories; ++i) {
    Wander<dimension_of<Model>> wander(100 + static_cast<std::uint64_t>(i));
    for (int k = random.integer(1, 200); k > 0; --k) {
      const auto* const at = wander.step();
      for (int h = 0; h < 2; ++h) (void)used.tick(h, at[h]);
    }
    used.reset();
    Pair<Model> fresh(props, friction);
    CAPTURE(i);
    CHECK(differences(used, fresh, 500 + static_cast<std::uint64_t>(i), 120, pressing) == 0);
  }
  CHECK(pressing > 20 * histories);
}

inline void check_several_as_new(int histories) {
  using Place = Vector2<double>;
  const auto peg = Prop<>::peg({0.2, -0.012}, 0.008).rough(0.2);
  Ruler model(steel_ruler(), 16);
  TouchSeveral used(model, {{radius, 2, 0.3}, radius}, {peg});
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(histories); ++i) {
    Wander<2> before(i), after(50 + i);
    for (int k = 0; k < 100; ++k) {
      const Place* const at = before.step();
      (void)used.tick(at[0], at[1]);
    }
    used.reset();
    Ruler other(steel_ruler(), 16);
    TouchSeveral fresh(other, {{radius, 2, 0.3}, radius}, {peg});
    int differ = 0;
    for (int k = 0; k < 100; ++k) {
      const Place* const at = after.step();
      const auto a = used.tick(at[0], at[1]), b = fresh.tick(at[0], at[1]);
      for (const int hand : {0, 1, 2}) differ += a.force(hand) != b.force(hand);
      differ += a.status != b.status;
    }
    CHECK(differ == 0);
  }
}

inline void check_two_hands_as_new() {
  using P = Prop<>;
  SECTION("a ruler") { check_as_new<Ruler>({}, {}, 40); }
  SECTION("with friction") { check_as_new<Ruler>({}, 0.3, 20); }
  SECTION("over a peg and a stop") {
    check_as_new<Ruler>({P::peg({0.2, -0.012}, 0.008), P::stop(0.3, 0.02, {0, 1})}, {}, 40);
  }
  SECTION("over rough pegs") {
    check_as_new<Ruler>({P::peg({0.2, -0.012}, 0.008).rough(0.3), P::peg({0.25, 0.02}, 0.008).rough(0.2)},
                        0.3, 20);
  }
  SECTION("a wire in space, over a bar") {
    check_as_new<Wire>({Prop<3>::bar({0.2, -0.012, -0.1}, {0.2, -0.012, 0.1}, 0.008)}, {}, 20);
  }
  SECTION("a rough wire") { check_as_new<Wire>({}, 0.3, 20); }
}

}  // namespace hapbeam::testing::resets
