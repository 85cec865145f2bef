// Through the loop's coupling over an end that does not yield: a hand led down beside it feels one touch.
#include <cmath>

#include "stability/bistable.hpp"
#include "support/catch.hpp"
#include "support/ruler.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The record of a hand led straight down, or up, through the height of an end.
template <class Model>
ServoRecord stroke(Model& model, double radius, double x, double step, int side) {
  ServoOptions options;
  options.avatar_radius = radius;
  Servo<Model> servo(model, VirtualPhantom<>(HandPath({0, 0})).info(), options);
  const double reach = radius + model.thickness() / 2;
  DeviceState state{};
  state.status = DeviceStatus::running;
  for (double y = 1.5 * reach; y > -1.5 * reach; y -= step, state.time += 1e-3) {
    state.position = {x, side * y, 0};
    (void)servo.tick(state);
  }
  return servo.record();
}

template <class Model>
void check_one_touch(const Beam& beam, int elements) {
  Model model(beam, elements);
  const auto rest = model.shape();
  const double left = rest[0].u, right = rest.length() + rest[rest.segments()].u;
  int touched = 0;
  for (const double radius : {0.002, 0.005, 0.01})
    for (const double step : {2e-5, 1e-4, 3e-4})
      for (const double beside : {0.1, 0.4, 0.8})
        for (const int side : {1, -1})
          for (const double x : {left - beside * radius, right + beside * radius}) {
            model.reset();
            const ServoRecord r = stroke(model, radius, x, step, side);
            CAPTURE(radius, step, beside, side, x);
            CHECK(r.touches <= 1);
            CHECK(r.energy_generated <= 1e-5);
            touched += static_cast<int>(r.touches);
          }
  CHECK(touched == 108);
}

}  // namespace

TEST_CASE("past a rigid end the hand touches it once, whatever holds the beam and bends it", "[ends]") {
  check_one_touch<FemModel<Corotational<>>>(buckled_strip(), 8);
  check_one_touch<FemModel<>>(steel_ruler(Support::pinned, Support::clamped), 8);
  check_one_touch<FemModel<Corotational<>>>(steel_ruler(Support::clamped, Support::pinned), 8);
}
