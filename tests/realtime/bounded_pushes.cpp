// push(), release() and Touch::tick on beams of any rotation: no heap, and a bounded number of linear solves.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "realtime/counting_element.hpp"
#include "stability/bistable.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/force_error.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Newton's method, a fall, Newton's method again share max_solves; and a second look before and after the fall.
constexpr int most_solves_of_a_push = 48 + 2;
/// Four pushes share as much, and a release has as much again.
constexpr int most_solves_of_a_tick = 48 + 4 * 2 + 48 + 2;

template <class Element>
using Counted = CountingElement<Element>;

std::vector<std::pair<const char*, Beam>> beams() {
  return {
      {"ruler", Beam(0.3, Section::rectangle(0.025, 0.001), Material{2e11}, Support::clamped, Support::free)},
      {"bar", thesis_beam(Support::pinned, Support::pinned)},
      {"strip", buckled_strip()},
      {"arch", hinged_arch()}};
}

/// Sweeps through the beam from both sides, slides along it, jumps, and positions that are none.
template <typename S>
std::vector<Vector2<S>> hand_path(double length, unsigned seed) {
  Random random(seed);
  std::vector<Vector2<S>> path;
  const auto add = [&](double x, double y) {
    path.emplace_back(static_cast<S>(length * x), static_cast<S>(length * y));
  };
  for (const int side : {1, -1})
    for (int k = 0; k <= 400; ++k) add(0.49, side * (0.25 - k / 800.0));
  for (int k = 0; k <= 300; ++k) add(1.1 * k / 300 - 0.05, 0.02);
  for (int k = 0; k <= 300; ++k) add(0.3 + 0.8 * k / 300, -0.2);
  for (int k = 0; k < 300; ++k) add(random(-0.1, 1.1), random(0.3));
  for (const double bad : {std::nan(""), double(INFINITY), 1e30}) add(bad, 0), add(0.5, -0.1), add(0.5, bad);
  return path;
}

template <typename Model>
struct Ticks {
  int pressing = 0, not_finite = 0, snapped = 0;

  Ticks(Touch<Model>& touch, const std::vector<Vector2<typename Model::Scalar>>& path) noexcept {
    for (const auto& position : path) {
      const auto r = touch.tick(position);
      pressing += r.pressing;
      not_finite += !r.force.allFinite();
      snapped += r.status == Status::snapped;
    }
  }
};

}  // namespace

TEMPLATE_TEST_CASE("Touch on beams of any rotation: no heap, pressed, slipping off, snapping through", "",
                   (FemModel<Corotational<>, double>), (FemModel<Corotational<>, float>),
                   (FemModel<Corotational<>, double, 16>), (FemModel<VonKarman<>, double>)) {
  int pressing = 0, snapped = 0;
  for (const auto& [name, beam] : beams()) {
    TestType model(beam, 16);
    Touch<TestType> touch(model, typename TestType::Scalar(0.005));
    const auto path = hand_path<typename TestType::Scalar>(beam.length(), 3);
    HeapUse use;
    int not_finite = 0;
    use = heap_use([&] {
      const Ticks<TestType> ticks(touch, path);
      pressing += ticks.pressing, not_finite = ticks.not_finite, snapped += ticks.snapped;
      touch.reset();
    });
    INFO(name);
    CHECK(use == HeapUse{});
    CHECK(not_finite == 0);
  }
  CHECK(pressing > 1000);
  if (takes_push<TestType>) CHECK(snapped > 0);
}

TEMPLATE_TEST_CASE("Touch with friction: noexcept, no heap, whatever the hand does", "[friction]",
                   (FemModel<Corotational<>, double>), (FemModel<Corotational<>, float>)) {
  using S = typename TestType::Scalar;
  STATIC_REQUIRE(takes_push<TestType>);
  STATIC_REQUIRE(noexcept(std::declval<Touch<TestType>&>().tick(std::declval<const Vector2<S>&>())));
  int sliding = 0, sticking = 0;
  for (const auto& [name, beam] : beams()) {
    TestType model(beam, 16);
    Touch<TestType> touch(model, S(0.005), Friction(0.6, 0.4));
    const auto path = hand_path<S>(beam.length(), 5);
    int not_finite = 0;
    const HeapUse use = heap_use([&] {
      touch.soften(S(1e6), S(10));
      for (const auto& position : path) {
        const auto r = touch.tick(position);
        not_finite += !r.force.allFinite() || !r.friction.allFinite() || !std::isfinite(r.dissipated);
        sliding += r.sliding;
        sticking += r.pressing && !r.sliding;
      }
      touch.reset();
    });
    INFO(name);
    CHECK(use == HeapUse{});
    CHECK(not_finite == 0);
  }
  CHECK(sliding > 100);
  CHECK(sticking > 0);
}

TEMPLATE_TEST_CASE("push and release of a bistable beam: no heap, all the way through and back", "",
                   (FemModel<Corotational<>, double>), (FemModel<Corotational<>, float>)) {
  using S = typename TestType::Scalar;
  TestType model(buckled_strip(), 16);
  const S up = static_cast<S>(middle(model));
  int snapped = 0, not_finite = 0, calls = 0;
  CHECK(heap_use([&] {
          for (const int side : {1, -1}) {
            for (int k = 0; k <= 220; ++k) {
              const S d = S(side) * up * (1 - S(k) / 200);
              const auto response = model.push({S(0.1), d, {0, 1}});
              snapped += response.status == Status::snapped;
              not_finite += !std::isfinite(response.force);
            }
            while (model.release() == Status::iteration_limit && calls < 100) ++calls;
          }
          model.reset();
        }) == HeapUse{});
  CHECK(not_finite == 0);
  CHECK(snapped >= 1);
  CHECK(calls < 40);
}

TEST_CASE(
    "no push takes more than the solver's limit and two looks, the pushes of a tick share it, and a release "
    "has it again") {
  using Element = Counted<Corotational<>>;
  using Model = FemModel<Element>;
  constexpr int elements = 16;
  for (const auto& [name, beam] : beams()) {
    Model model(beam, elements);
    Random random(4);
    int hardest = 0;
    for (int k = 0; k < 1500; ++k) {
      const double angle = random(3.2);
      model.push(
          {beam.length() * random(0, 1), beam.length() * random(0.4), {std::sin(angle), std::cos(angle)}});
      hardest = std::max(hardest, model.report().solves);
      if (k % 5 == 0) {
        model.release();
        CHECK(model.report().solves <= most_solves_of_a_push);
      }
    }
    INFO(name << ": " << hardest);
    CHECK(hardest <= most_solves_of_a_push);
    CHECK(hardest >= 40);  // mean enough

    Touch<Model> touch(model, 0.005);
    long most = 0;
    for (const auto& position : hand_path<double>(beam.length(), 5)) {
      Element::tangents = 0;
      (void)touch.tick(position);
      most = std::max(most, Element::tangents / elements);
    }
    INFO(name << ": " << most);
    CHECK(most <= most_solves_of_a_tick);
  }
}

// What a tick leaves undone the next ones do: a hand that has raged for a second at 1 m/s and then rests is met, even
// where it holds strip and arch taut and they bend 1.6 times as sharply as the avatar is round.
TEST_CASE(
    "64 elements under a wild hand: each tick bounded, each force finite, and rest when the hand rests") {
  using Element = Counted<Corotational<>>;
  using Model = FemModel<Element>;
  constexpr int elements = 64;
  for (const auto& [name, beam] : beams()) {
    Model model(beam, elements);
    Touch<Model> touch(model, 0.005);
    Random random(11);
    const double length = beam.length(), reach = std::min(0.1 * length, 0.05);
    long most = 0;
    int refused = 0, ticks = 0;
    Vector2<double> hand(0.5 * length, reach), target = hand;
    for (int way = 0; way < 24; ++way) {
      target = {length * random(0.15, 0.85), random(reach)};
      for (int resting = 0; resting < 60; ++ticks) {
        const Vector2<double> go = target - hand;
        if (go.norm() <= 1e-3) hand = target, ++resting;
        else hand += go.normalized() * 1e-3;
        Element::tangents = 0;
        const auto felt = touch.tick(hand);
        most = std::max(most, Element::tangents / elements);
        REQUIRE(felt.force.allFinite());
        if (resting == 60) refused += felt.status == Status::iteration_limit;
      }
    }
    INFO(name << ": " << most << " solves in one of " << ticks << " ticks");
    CHECK(most <= most_solves_of_a_tick);
    CHECK(refused == 0);
  }
}

TEST_CASE("ForceError: no heap, in the plane", "") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  FemModel<Corotational<>> model(beam, 8);
  ForceError<Corotational<>> force_error(beam, 8);
  static_assert(noexcept(force_error(model)));
  double bound = 0;
  CHECK(heap_use([&] {
          for (int k = 0; k < 20; ++k) {
            model.press({1.5, 0.01 * k});
            bound += force_error(model);
          }
        }) == HeapUse{});
  CHECK(bound > 0);
}
