// SPDX-License-Identifier: MIT
// One tick of the loop: a servo of a model, or of a hand that holds an end of a rod.
#include <array>
#include <memory>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "enums.hpp"
#include "locked.hpp"
#include "module.hpp"
#include <hapbeam/haptics/held/grip.hpp>

namespace hapbeam::python {
namespace {

using py::arg;

ServoOptions options_of(const Placement& placement, double avatar_radius, int delay_ticks, bool dissipate,
                        const Friction& friction, double stylus_length, double stylus_ahead) {
  ServoOptions options;
  options.placement = placement;
  options.avatar_radius = avatar_radius;
  options.delay_ticks = delay_ticks;
  options.dissipate = dissipate;
  options.friction = friction;
  options.stylus = {stylus_length, stylus_ahead};
  return options;
}

void add_record(py::module_& m) {
  using Record = ServoRecord;
  py::class_<Record>(m, "ServoRecord", "The latest tick of a servo, and what has happened since the start.")
      .def_readonly("status", &Record::status)
      .def_readonly("model", &Record::model, "What the beam said.")
      .def_readonly("pressing", &Record::pressing)
      .def_readonly("time", &Record::time, "[s]")
      .def_property_readonly(
          "force", [](const Record& r) { return array_of(r.force); }, "[N] sent, device axes")
      .def_property_readonly(
          "torque", [](const Record& r) { return array_of(r.torque); }, "[N·m] sent")
      .def_property_readonly(
          "hand", [](const Record& r) { return array_of(r.hand); }, "[m] in the scene")
      .def_property_readonly(
          "avatar", [](const Record& r) { return array_of(r.avatar); }, "[m] in the scene")
      .def_readonly("ticks", &Record::ticks)
      .def_readonly("contact_ticks", &Record::contact_ticks)
      .def_readonly("max_force", &Record::max_force, "[N]")
      .def_readonly("energy_generated", &Record::energy_generated, "[J] by the loop")
      .def_readonly("worst", &Record::worst, "Status of the model.");
}

void add_servo_class(py::module_& m) {
  py::class_<Placement>(m, "Placement", "Where the device's workspace lies in the scene.")
      .def(py::init([](const Numbers& origin, double scale) {
             return Placement(Eigen::Matrix3d::Identity(), vector_of<3>(origin, "origin"), scale);
           }),
           arg("origin") = std::array<double, 3>{0, 0, 0}, arg("scale") = 1.0,
           "origin: of the device in the scene [m], scale [m/m].")
      .def_static(
          "in_plane",
          [](const Numbers& origin, double scale) {
            return Placement::in_plane(vector_of<2>(origin, "origin"), scale);
          },
          arg("origin"), arg("scale") = 1.0, "origin: x along the beam and w [m].");
  py::class_<CouplingFigures>(m, "CouplingFigures", "A spring and a damper between hand and beam.")
      .def(py::init([](double stiffness, double damping) {
             return CouplingFigures{stiffness, damping};
           }),
           arg("stiffness"), arg("damping"), "[N/m], [N·s/m]")
      .def_readonly("stiffness", &CouplingFigures::stiffness, "[N/m]")
      .def_readonly("damping", &CouplingFigures::damping, "[N·s/m]");
  m.def("safe_coupling", &safe_coupling, arg("device"), arg("delay_ticks") = 0,
        "The coupling that a device can render.");
  py::class_<AnyServo>(m, "Servo", "One tick of the loop: coupling, touch, energy monitor and force guard.")
      .def(py::init([](AnyModel& model, const DeviceInfo& device, const Placement& placement,
                       double avatar_radius, int delay_ticks, bool dissipate, const Friction& friction,
                       double stylus_length, double stylus_ahead, const CouplingFigures* coupling) {
             const ServoOptions options = options_of(placement, avatar_radius, delay_ticks, dissipate,
                                                     friction, stylus_length, stylus_ahead);
             auto servo = locked(model.mutex, [&] { return model.servo(device, options, coupling); });
             servo->mutex = &model.mutex;
             return servo;
           }),
           arg("model"), arg("device"), arg("placement") = Placement(), arg("avatar_radius") = 0.005,
           arg("delay_ticks") = 0, arg("dissipate") = false, arg("friction") = Friction(),
           arg("stylus_length") = 0.0, arg("stylus_ahead") = 0.0, arg("coupling") = py::none(),
           py::keep_alive<1, 2>(),
           "avatar_radius [m]; stylus [m]: length of its axis, and how far its tip is ahead of the hand; "
           "coupling: None for what the device can render.")
      .def(py::init([](AnyGrip& grip, const DeviceInfo& device, const Placement& placement) {
             ServoOptions options;
             options.placement = placement;
             auto servo = locked(*grip.mutex, [&] { return grip.servo(device, options); });
             servo->mutex = grip.mutex;
             return servo;
           }),
           arg("grip"), arg("device"), arg("placement") = Placement(), py::keep_alive<1, 2>(),
           "Of a hand that holds an end of a rod.")
      .def(
          "tick",
          [](AnyServo& servo, const Numbers& position, const Numbers& velocity, double dt) {
            const Place at = vector_of<3>(position, "position"), moving = vector_of<3>(velocity, "velocity");
            return array_of(locked(*servo.mutex, [&] { return servo.tick(at, moving, dt); }));
          },
          arg("position"), arg("velocity"), arg("dt"),
          "Position [m] and velocity [m/s] of the hand in the device's axes, time [s] since the tick before; "
          "returns the force on the hand [N].")
      .def(
          "reset", [](AnyServo& servo) { locked(*servo.mutex, [&] { return servo.reset(), true; }); },
          "As new.")
      .def_property_readonly(
          "record", [](AnyServo& servo) { return locked(*servo.mutex, [&] { return servo.record(); }); },
          "A copy of what the last tick was.")
      .def_property_readonly("coupling", &AnyServo::coupling);
}

void add_grip(py::module_& m) {
  py::class_<AnyGrip>(m, "Grip", "A hand that holds an end of a rod; a Servo takes it in place of a model.")
      .def(py::init([](AnyFem& model, RodSide side) {
             auto grip = model.grip(side);
             grip->mutex = &model.mutex;
             return grip;
           }),
           arg("model"), arg("side"), py::keep_alive<1, 2>())
      .def(
          "let_go", [](AnyGrip& grip) { grip.hold(false); }, "The end stays where it is.")
      .def(
          "take", [](AnyGrip& grip) { grip.hold(true); }, "The hand takes it again.")
      .def_property_readonly("held", &AnyGrip::held);
  m.def(
      "grip_support",
      [](const DeviceInfo& device, int delay_ticks) {
        return GripCoupling::for_device(device, delay_ticks).support();
      },
      arg("device"), arg("delay_ticks") = 0,
      "The support of an end that a hand holds: springs that the device can render.");
}

}  // namespace

void add_servo(py::module_& m) {
  add_record(m);
  add_grip(m);
  add_servo_class(m);
}

}  // namespace hapbeam::python
