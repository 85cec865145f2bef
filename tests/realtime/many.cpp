// An array of beams in a servo loop: no heap and no exception, in contact, past the pool's size and for hands that are nowhere.
#include <cmath>
#include <limits>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "many/rows.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>
#include <hapbeam/many/touch_many.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Array = BeamArray<FemModel<>>;

static_assert(noexcept(std::declval<Touch<Array>&>().tick(std::declval<const Vector2<double>&>())) && noexcept(
    std::declval<Touch<Array>&>().contact_at(
        std::declval<const Vector2<
            double>&>())) && noexcept(std::declval<Touch<Array>&>()
                                          .reset()) && noexcept(std::declval<Touch<Array>&>()
                                                                    .shape(
                                                                        0)) && noexcept(std::declval<Servo<Array>&>()
                                                                                            .tick(std::declval<
                                                                                                  const DeviceState&>())));

}  // namespace

TEST_CASE("many beams: strokes, jumps and wild places use no heap") {
  const Array array({FemModel<>(bristle(), 8), FemModel<>(bristle(0.0601), 4)}, row(400, 0.001, 2), 8);
  Random random(4);
  std::vector<Vector2<double>> path;
  for (int k = 0; k < 2000; ++k) path.emplace_back(-0.01 + 2e-4 * k, 0.0645);
  for (int k = 0; k < 2000; ++k) path.emplace_back(random(-0.1, 0.5), random(0.02, 0.07));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e9})
    for (int k = 0; k < 20; ++k) path.emplace_back(k % 2 ? bad : 0.1, k % 3 ? bad : 0.06);
  Touch<Array> touch(array, 0.005);
  int pressing = 0, incomplete = 0, not_finite = 0;
  CHECK(heap_use([&] {
          for (const auto& hand : path) {
            const auto felt = touch.tick(hand);
            pressing += felt.pressing;
            incomplete += !felt.complete;
            not_finite += !felt.force.allFinite();
            (void)touch.contact_at(hand);
          }
          touch.reset();
        }) == HeapUse{});
  CHECK(pressing > 1000);
  CHECK(incomplete > 100);
  CHECK(not_finite == 0);
}

TEST_CASE("many beams: a servo that is looked at uses no heap") {
  Array array(FemModel<>(bristle(), 8), row(50, 0.004));
  VirtualPhantom<> device(HandPath({-0.1, 0}).slide(0.2, 0.6));
  ServoOptions options;
  options.placement = Placement::in_plane({0.1, 0.0648});
  Servo<Array> servo(array, device.info(), options);
  int seen = 0;
  CHECK(heap_use([&] {
          for (int k = 0; k < 60; ++k) {
            device.run(servo, 0.01);
            seen += servo.picture().size();
          }
        }) == HeapUse{});
  CHECK(seen > 0);
}
