// One tick of the loop as a whole, device to beam to device: no heap, no exception.
#include <realtime/heap_watch.hpp>

#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Model = FemModel<>;
using Vector = Eigen::Vector3d;

/// The device's axes put onto the beam: its origin at mid-span, on the centreline.
class BeamServo {
 public:
  explicit BeamServo(Model& model) : touch_(model, 0.01), middle_(model.shape().length() / 2) {}

  Vector operator()(const DeviceState& state) noexcept {
    const auto result = touch_.tick({middle_ + state.position.x(), state.position.y()});
    pressing_ticks += result.pressing;
    return {result.force.x(), result.force.y(), 0};
  }

  int pressing_ticks = 0;

 private:
  Touch<Model> touch_;
  double middle_;
};

/// Forces that no servo should ask for.
struct BrokenServo {
  Vector operator()(const DeviceState&) noexcept {
    switch (++tick % 3) {
      case 0: return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
      case 1: return Vector::Constant(std::numeric_limits<double>::max());
      default: return {1e6, -1e6, 0};
    }
  }
  int tick = 0;
};

using Phantom = VirtualPhantom<>;
static_assert(noexcept(std::declval<Phantom&>().step(std::declval<BeamServo&>())));
static_assert(noexcept(std::declval<Phantom&>().run(std::declval<BeamServo&>(), 1.0)));
static_assert(noexcept(std::declval<Phantom&>().reset()));
static_assert(noexcept(std::declval<const Phantom&>().counts()));
static_assert(noexcept(std::declval<const Phantom&>().tip()));
static_assert(is_servo<BeamServo>);

/// Down through the beam's surface, along it, and off again.
HandPath script() { return HandPath({0, 0.04}).press(0.06, 0.4).slide(0.1, 0.5).release(0.06, 0.3); }

}  // namespace

TEST_CASE("a tick of device, contact, beam and force: no heap") {
  Model model(thesis_beam(Support::pinned, Support::pinned), 16);
  BeamServo servo(model);
  Phantom phantom(script());
  CHECK(heap_use([&] {
          phantom.run(servo, 1.3);
          phantom.reset();
        }) == HeapUse{});
  CHECK(servo.pressing_ticks > 500);
}

TEST_CASE("a device that is asked for impossible forces: no heap") {
  BrokenServo servo;
  Phantom phantom(script());
  CHECK(heap_use([&] {
          for (int k = 0; k < 500; ++k) phantom.step(servo);
        }) == HeapUse{});
  CHECK(phantom.counts().force_cut_ticks == 500);
  CHECK(phantom.tip().position.allFinite());
}
