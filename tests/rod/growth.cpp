// How the work of a tick grows with the number of elements, counted: linear solves, and elements that are asked.
#include <utility>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include <hapbeam/contact/touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A TwistedRod that counts how many elements are computed, side by side or alone.
struct Counted : TwistedRod {
  static inline long elements = 0;

  template <typename S, typename... Rest>
  static S tangent(const RodProperties<S>& p, Rest&&... rest) noexcept {
    elements += static_cast<long>(sizeof(S) / sizeof(double));
    return TwistedRod::tangent(p, std::forward<Rest>(rest)...);
  }
};

Rod strip() {
  return Rod(0.3, RodSection::rectangle(0.01, 0.001), spring_steel, RodSupport::clamped, RodSupport::free);
}

struct Work {
  double solves = 0, elements = 0;  // of a tick
  int unanswered = 0, ticks = 0;
  double force = 0;
};

/// A sphere presses the strip 0.1 mm a tick.   @param lean [rad] of its way from the strip's width
template <class Element>
Work press(int elements, double at, double lean, double depth) {
  const double radius = 0.03, step = 1e-4;
  FemModel<Element> model(strip(), elements);
  Touch<FemModel<Element>> touch(model, radius);
  const double top = radius + model.thickness() / 2;
  Work work;
  int counted = 0;
  for (int tick = -10; tick * step < depth; ++tick, ++work.ticks) {
    const double down = tick * step;
    const Point centre = Point(at, 0, 0) + (top - down) * Point(0, std::cos(lean), std::sin(lean));
    Counted::elements = 0;
    const auto felt = touch.tick(centre);
    REQUIRE(felt.force.allFinite());
    work.unanswered += felt.status != Status::ok;
    work.force = felt.force.norm();
    if (down < depth - 10.5 * step) continue;
    work.solves += model.report().solves, work.elements += static_cast<double>(Counted::elements), ++counted;
  }
  work.solves /= counted, work.elements /= counted;
  return work;
}

}  // namespace

TEST_CASE(
    "the work of a tick grows as the number of elements, up to 1024: two or three linear solves, and each "
    "element once in each",
    "[rod]") {
  for (const int n : {8, 64, 512, 1024}) {
    // Over its flat side, a tenth of a radian askew.
    const Work work = press<Counted>(n, 0.15, pi / 2 - 0.1, 0.004);
    CAPTURE(n, work.solves, work.elements);
    CHECK(work.unanswered == 0);
    CHECK(work.solves <= 3);
    // Up to seven places of a pack are empty.
    CHECK(work.elements >= work.solves * n);
    CHECK(work.elements <= work.solves * (n + 7));
  }
}

// Ticks of 160 in contact that end with iteration_limit, 300 × 10 × 1 mm of steel pressed at 250 mm by a sphere of 30 mm, 0.1 mm a tick:
//
//     hand leans by   8 elements   16   32   64   128   256   512   1024
//     0               3            9    10   12   20    32    157   157
//     0.01 rad        0            0    0    0    0     28    48    158
//     0.1 rad         0            0    0    0    0     0     24    155
//     0.3 rad         0            0    0    0    0     0     4     42
TEST_CASE("a strip that is pressed over its edge buckles to a side, from exactly its plane within 20 ticks",
          "[rod]") {
  for (const int n : {8, 32, 64}) {
    const Work askew = press<TwistedRod>(n, 0.25, 0.1, 0.016),
               straight = press<TwistedRod>(n, 0.25, 0, 0.016);
    CAPTURE(n, straight.unanswered, straight.force, askew.force);
    CHECK(askew.unanswered == 0);
    CHECK(straight.unanswered <= 20);
    // In its plane it would take fifty times that: 3 EI/s³ of its stiff side is 3.2 N/mm.
    CHECK(straight.force < 1.1 * askew.force);
  }
}
