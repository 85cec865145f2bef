// Contact in a servo loop: find_contact and Touch::tick touch no heap and throw nothing, wherever the hand is.
#include <cmath>
#include <limits>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <typename S>
constexpr bool is_noexcept() {
  using Model = FemModel<VonKarman<>, S>;
  static_assert(noexcept(find_contact(std::declval<const Avatar<S>&>(), std::declval<const Centreline<S>&>(),
                                      std::declval<const BoundingVolumes<S>&>(), S(),
                                      std::declval<ContactMemory<S>&>())));
  static_assert(noexcept(std::declval<BoundingVolumes<S>&>().refit(std::declval<const Centreline<S>&>())));
  static_assert(noexcept(std::declval<Touch<Model>&>().tick(std::declval<const Vector2<S>&>())));
  static_assert(noexcept(std::declval<Touch<Model>&>().reset()));
  return true;
}
static_assert(is_noexcept<double>() && is_noexcept<float>());

/// A hand that presses from both sides, slides over the ends, jumps through the beam, and is where no hand can be.
template <typename S>
std::vector<Vector2<S>> hand_path(S length, unsigned seed) {
  using limits = std::numeric_limits<S>;
  Random random(seed);
  const auto uniform = [&random](double low, double high) { return static_cast<S>(random(low, high)); };
  std::vector<Vector2<S>> path;
  for (const S side : {S(1), S(-1)})
    for (int k = 0; k <= 200; ++k)
      path.emplace_back(length / 2, side * S(0.03) * (1 - 2 * std::sin(S(0.0314) * S(k) / 2)));
  for (int k = 0; k <= 200; ++k) path.emplace_back(length * (S(1.1) * S(k) / 200 - S(0.05)), S(0.01));
  for (int k = 0; k < 200; ++k) path.emplace_back(length * uniform(-.1, 1.1), length * uniform(-.05, .05));
  for (const S bad : {limits::quiet_NaN(), limits::infinity(), -limits::infinity(), limits::max(), S(1e9)})
    for (const Vector2<S>& position : {Vector2<S>(bad, 0), Vector2<S>(length / 2, S(-0.01)),
                                       Vector2<S>(length / 2, bad), Vector2<S>(bad, bad)})
      path.push_back(position);
  return path;
}

}  // namespace

TEMPLATE_TEST_CASE("find_contact: no heap, wherever the hand is", "", double, float) {
  FemModel<VonKarman<>, TestType> model(thesis_beam(Support::pinned, Support::pinned), 32);
  model.press({TestType(1.0), TestType(-0.04)});
  const Centreline<TestType> shape = model.shape();
  const auto path = hand_path(shape.length(), 1);
  BoundingVolumes<TestType> volumes(shape.segments());
  ContactMemory<TestType> memory;
  int touching = 0;
  CHECK(heap_use([&] {
          for (const auto& position : path) {
            volumes.refit(shape);
            const Avatar<TestType> avatar{position, TestType(0.01)};
            touching += find_contact(avatar, shape, volumes, model.thickness(), memory).touching;
          }
        }) == HeapUse{});
  CHECK(touching > 100);
}

TEMPLATE_TEST_CASE("Touch: a tick uses no heap, from free air to pressed, on either side and beside the ends",
                   "", double, float) {
  for (const Support right : {Support::pinned, Support::free}) {
    FemModel<VonKarman<>, TestType> model(thesis_beam(Support::clamped, right), 16);
    Touch touch(model, TestType(0.01));
    const auto path = hand_path(model.shape().length(), 2);
    int pressing = 0, not_finite = 0;
    CHECK(heap_use([&] {
            for (const auto& position : path) {
              const TouchResult<TestType> result = touch.tick(position);
              pressing += result.pressing;
              not_finite += !result.force.allFinite();
            }
            touch.reset();
          }) == HeapUse{});
    CHECK(pressing > 100);
    CHECK(pressing < static_cast<int>(path.size()));
    CHECK(not_finite == 0);
  }
}
