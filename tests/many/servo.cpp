// A servo drives an array through the coupling, the monitor and the guard of one beam.
#include <algorithm>

#include "many/rows.hpp"
#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {
using Model = FemModel<Corotational<>>;
}

TEMPLATE_TEST_CASE("a simulated Phantom strokes a brush: felt, finite, nothing generated", "",
                   VirtualCoupling, Direct) {
  constexpr double radius = 0.005;
  BeamArray<Model> brush(Model(bristle(), 8), row(20, 0.005));
  VirtualPhantom<> device(HandPath({-0.08, 0}).slide(0.16, 1.2).rest(0.1));
  ServoOptions options;
  options.avatar_radius = radius;
  options.placement = Placement::in_plane({0.0475, 0.06 + radius - 0.003});
  ServoLoop<VirtualPhantom<>, BeamArray<Model>, TestType> loop(device, brush, options);
  int seen = 0;
  for (int k = 0; k < 130; ++k) {
    device.run(loop.servo(), 0.01);
    const auto& picture = loop.picture();
    seen = std::max(seen, picture.size());
    for (int i = 0; i < picture.size(); ++i) {
      REQUIRE((picture.beam(i) >= 0 && picture.beam(i) < brush.size()));
      REQUIRE(picture.shape(i).size() == 9);
      REQUIRE(picture.shape(i).any_rotation());
    }
  }
  const ServoRecord& record = loop.servo().record();
  CHECK(seen >= 2);
  CHECK(record.contact_ticks > 400);
  CHECK(record.failed_ticks == 0);
  CHECK(record.max_force > 0.3);
  CHECK(record.max_force < 10);
  CHECK(record.energy_generated < 1e-9);
  CHECK_FALSE(record.pressing);
}
