// Contacts close beside an end that is held: what is said to be in range is as exact as the pages say.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include "support/sanitized.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Point = VectorOf<double, 3>;
constexpr double length = 0.2, radius = 0.001;

Rod needle(const RodSupport& right) {
  const auto steel = RodMaterial::isotropic(200e9, 0.3);
  return {length, RodSection::circle(2 * radius), steel, RodSupport::clamped, right};
}

struct Felt {
  Status status;
  double force;
};
struct Errors {
  double worst = 0;
  int number = 0;
};

/// Bars across the rod come down beside its left end.  @param Tick  Touch or TouchSeveral, its tick(tip, shaft) -> Felt
template <class Model, class Tick>
void check_beside_clamp() {
  constexpr int ticks = sanitized ? 20 : 60;
  Errors in_range, beyond;
  for (const RodSupport& right : {RodSupport::free, RodSupport::clamped})
    for (const int elements : {4, 8, 32}) {
      Model coarse(needle(right), elements), fine(needle(right), 256);
      for (const double size : {0.2 * radius, 4 * radius})
        for (const double s : {0.75 * radius, 1.5 * radius, 3 * radius, 8 * radius, 20 * radius}) {
          Tick on_coarse(coarse, size), on_fine(fine, size);
          for (int k = 1; k <= ticks; ++k) {
            const Point tip(s, -0.05, size + radius - 0.6 * k / ticks * s), shaft(0, 0.1, 0);
            const Felt felt = on_coarse.tick(tip, shaft), of = on_fine.tick(tip, shaft);
            if (!is_answer(felt.status) || of.status != Status::ok || !(of.force > 0)) continue;
            Errors& errors = felt.status == Status::ok ? in_range : beyond;
            errors.worst = std::max(errors.worst, std::abs(felt.force / of.force - 1));
            ++errors.number;
          }
        }
    }
  INFO(in_range.number << " in range, worst " << in_range.worst << ", " << beyond.number << " beyond, worst "
                       << beyond.worst);
  CHECK(in_range.number > 8 * ticks);
  CHECK(in_range.worst < 0.02);
  CHECK(beyond.number > 8 * ticks);
  CHECK(beyond.worst > 0.05);
}

using One = FemModel<RoundRod>;
struct TickOne {
  TickOne(One& model, double size) : touch(model, size) {}
  Felt tick(const Point& tip, const Point& shaft) {
    const auto felt = touch.tick(tip, shaft);
    return {felt.status, felt.force.norm()};
  }
  Touch<One> touch;
};

using Two = FemModel<Several<RoundRod, 2>>;
struct TickTwo {
  TickTwo(Two& model, double size) : below(0.15, -0.05, 0.002 - size - radius), touch(model, {size, size}) {}
  Felt tick(const Point& tip, const Point& shaft) {
    const Point tips[] = {tip, below}, shafts[] = {shaft, shaft};
    const auto felt = touch.tick(tips, shafts, 2);
    return {felt.places[0].status, felt.force(0).norm()};
  }
  Point below;
  TouchSeveral<Two> touch;
};

}  // namespace

// The element beside the clamp errs by 0.2 to 0.3 (F s²/EI)², and by as much where s is its radius.
TEST_CASE("a bar close beside a clamp is in range where its force is right", "[rod][touch]") {
  check_beside_clamp<One, TickOne>();
  check_beside_clamp<Two, TickTwo>();
}
