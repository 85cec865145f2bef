// A figure that no device has is rejected wherever a device's figures come in, by one name: fields × doors.
#include <functional>
#include <limits>
#include <string>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

DeviceInfo six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return VirtualPhantom<>(HandPath({0, 0}), options).info();
}

struct Field {
  const char* name;
  double& (*of)(DeviceInfo&);
  bool zero;  // 0 is allowed
};
const Field fields[] = {
    {"device peak_force", [](DeviceInfo& d) -> double& { return d.peak_force; }, false},
    {"device continuous_force", [](DeviceInfo& d) -> double& { return d.continuous_force; }, false},
    {"device max_stiffness", [](DeviceInfo& d) -> double& { return d.max_stiffness; }, false},
    {"device position_resolution", [](DeviceInfo& d) -> double& { return d.position_resolution; }, true},
    {"device friction", [](DeviceInfo& d) -> double& { return d.friction; }, true},
    {"device period", [](DeviceInfo& d) -> double& { return d.period; }, false},
    {"device damping", [](DeviceInfo& d) -> double& { return d.damping; }, true},
    {"device apparent_mass", [](DeviceInfo& d) -> double& { return d.apparent_mass; }, true},
    {"gimbal peak_torque", [](DeviceInfo& d) -> double& { return d.gimbal.peak_torque; }, true},
    {"gimbal continuous_torque", [](DeviceInfo& d) -> double& { return d.gimbal.continuous_torque; }, false},
    {"gimbal max_stiffness", [](DeviceInfo& d) -> double& { return d.gimbal.max_stiffness; }, true},
    {"gimbal resolution", [](DeviceInfo& d) -> double& { return d.gimbal.resolution; }, true},
    {"gimbal friction", [](DeviceInfo& d) -> double& { return d.gimbal.friction; }, true},
    {"gimbal damping", [](DeviceInfo& d) -> double& { return d.gimbal.damping; }, true},
    {"gimbal inertia", [](DeviceInfo& d) -> double& { return d.gimbal.inertia; }, true},
};

struct Door {
  const char* name;
  std::function<void(const DeviceInfo&)> enter;
};

/// With couplings of one's own: what a coupling's default checks, others are to check as well.
std::vector<Door> doors() {
  using Rods = FemModel<TwistedRod>;
  static FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
  static FemModel<RoundRod> rod(
      Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free), 8);
  static Rods held(Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free),
                   8);
  static BeamArray<FemModel<>> many(model, {{{0, 0}, 0, 0}});
  static Grip<Rods> grip(held, RodSide::left);
  static const VirtualCoupling own({100, 0});
  return {
      {"DeviceInfo::check", [](const DeviceInfo& d) { (void)d.check(); }},
      {"safe_coupling", [](const DeviceInfo& d) { (void)safe_coupling(d); }},
      {"safe_turning_coupling", [](const DeviceInfo& d) { (void)safe_turning_coupling(d); }},
      {"Direct", [](const DeviceInfo& d) { (void)Direct::for_device(d, 0); }},
      {"VirtualCoupling", [](const DeviceInfo& d) { (void)VirtualCoupling::for_device(d); }},
      {"GripCoupling", [](const DeviceInfo& d) { (void)GripCoupling::for_device(d); }},
      {"EnergyMonitor", [](const DeviceInfo& d) { EnergyMonitor monitor(d); }},
      {"ForceGuard", [](const DeviceInfo& d) { ForceGuard guard(ForceGuard::for_device(d)); }},
      {"Servo", [](const DeviceInfo& d) { Servo<FemModel<>> servo(model, d, {}, own); }},
      {"Servo, Direct", [](const DeviceInfo& d) { Servo<FemModel<>, Direct> servo(model, d, {}, {}); }},
      {"Servo of a rod", [](const DeviceInfo& d) { Servo<FemModel<RoundRod>> servo(rod, d, {}, own); }},
      {"Servo of many", [](const DeviceInfo& d) { Servo<BeamArray<FemModel<>>> servo(many, d, {}, own); }},
      {"Servo of a grip",
       [](const DeviceInfo& d) {
         Servo<Grip<Rods>> servo(grip, d, {}, {{100, 0}, {0.1, 0}, 1e-3});
       }},
  };
}

}  // namespace

TEST_CASE("a figure that no device has is rejected at every door, by its name", "[device][doors]") {
  for (const Door& door : doors()) {
    CHECK_NOTHROW(door.enter(six_axes()));
    for (const Field& field : fields) {
      CAPTURE(door.name, field.name);
      for (const double bad : {-1.0, -1e-300, not_a_number, infinite, -infinite}) {
        DeviceInfo device = six_axes();
        field.of(device) = bad;
        CHECK_THROWS_WITH(door.enter(device), ContainsSubstring(std::string(field.name) + " = "));
      }
      DeviceInfo device = six_axes();
      field.of(device) = 0;
      if (field.zero) CHECK_NOTHROW(door.enter(device));
      else CHECK_THROWS_WITH(door.enter(device), ContainsSubstring(std::string(field.name) + " = 0"));
    }
  }
}

TEST_CASE("a device without a gimbal, and one whose continuous force is more than its peak, are devices",
          "[device][doors]") {
  DeviceInfo device = six_axes();
  device.gimbal = {};
  for (const Door& door : doors()) CHECK_NOTHROW(door.enter(device));
  device.continuous_force = 2 * device.peak_force;
  for (const Door& door : doors()) CHECK_NOTHROW(door.enter(device));
}
