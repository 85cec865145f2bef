// The whole loop: a servo, and the simulated device and hand that run it in simulated time.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <pybind11/stl.h>
#include <string>

#include "arrays.hpp"
#include "enums.hpp"
#include "locked.hpp"
#include "module.hpp"
#include <hapbeam/haptics/device/known_devices.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/held/grip.hpp>

namespace hapbeam::python {
namespace {

using py::arg;

/// One tick of a simulated loop.
struct Tick {
  double time, position[3], hand[3], avatar[3], force[3], torque[3];
  std::int8_t status, model;
  bool pressing;
};

/// A servo as the device calls it, which writes down what it did.
template <bool oriented>
struct Written {
  AnyServo& servo;
  Tick* tick;

  void write() noexcept {
    const ServoRecord& r = servo.record();
    tick->time = r.time;
    for (int k = 0; k < 3; ++k) {
      tick->position[k] = r.position[k], tick->hand[k] = r.hand[k], tick->avatar[k] = r.avatar[k];
      tick->force[k] = r.force[k], tick->torque[k] = r.torque[k];
    }
    tick->status = static_cast<std::int8_t>(r.status), tick->model = static_cast<std::int8_t>(r.model);
    tick->pressing = r.pressing;
    ++tick;
  }
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    const Eigen::Vector3d force = servo.tick(state);
    write();
    return force;
  }
  template <class State, std::enable_if_t<oriented && std::is_same_v<State, OrientedState>, int> = 0>
  Wrench operator()(const State& state) noexcept {
    const Wrench wrench = servo.tick(state);
    write();
    return wrench;
  }
};

using Phantom = VirtualPhantom<>;

py::array run(Phantom& device, AnyServo& servo, double duration) {
  const double period = device.options().arm.period;
  if (!(duration >= 0 && duration <= 1e7 * period))
    detail::reject("duration", duration, "s", "0 to ten million periods");
  const auto n = static_cast<py::ssize_t>(std::llround(duration / period));
  py::array_t<Tick> log(n);
  Tick* const first = log.mutable_data();
  unlocked(*servo.mutex, [&] {
    Written<false> flat{servo, first};
    Written<true> spatial{servo, first};
    for (py::ssize_t i = 0; i < n; ++i) {
      if (servo.dimension() == 3) device.step(spatial);
      else device.step(flat);
    }
  });
  return std::move(log);
}

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

void add_devices(py::module_& m) {
  py::class_<DeviceInfo>(m, "DeviceInfo", "What a device can do.")
      .def_readonly("name", &DeviceInfo::name)
      .def_readwrite("period", &DeviceInfo::period, "[s] of the servo loop")
      .def_readonly("peak_force", &DeviceInfo::peak_force, "[N]")
      .def_readonly("continuous_force", &DeviceInfo::continuous_force, "[N]")
      .def_readonly("max_stiffness", &DeviceInfo::max_stiffness, "[N/m]");
  m.def("known_device", &known_device, arg("name"), "Published figures of a device.");
  py::class_<HandPath>(m, "HandPath", "A script for a hand; methods append a motion and return the path.")
      .def(py::init([](const Numbers& place) { return HandPath(vector_of<2>(place, "place")); }),
           arg("place"), "Begins at (x, y) [m], in the device's axes.")
      .def(
          "move_to",
          [](HandPath& path, const Numbers& place, double duration) -> HandPath& {
            return path.move_to(vector_of<2>(place, "place"), duration);
          },
          arg("place"), arg("duration"), py::return_value_policy::reference_internal, "[m], [s]")
      .def("press", &HandPath::press, arg("depth"), arg("duration"),
           py::return_value_policy::reference_internal, "Down by [m] in [s].")
      .def("release", &HandPath::release, arg("height"), arg("duration"),
           py::return_value_policy::reference_internal, "Up by [m] in [s].")
      .def("slide", &HandPath::slide, arg("distance"), arg("duration"),
           py::return_value_policy::reference_internal, "To the right by [m] in [s].")
      .def("rest", &HandPath::rest, arg("duration"), py::return_value_policy::reference_internal, "[s]")
      .def(
          "turn",
          [](HandPath& path, const Numbers& by, double duration) -> HandPath& {
            return path.turn(vector_of<3>(by, "by"), duration);
          },
          arg("by"), arg("duration"), py::return_value_policy::reference_internal,
          "Turns the stylus by yaw, pitch and roll [rad] in [s].")
      .def_property_readonly("duration", &HandPath::duration, "[s]");
  PYBIND11_NUMPY_DTYPE(Tick, time, position, hand, avatar, force, torque, status, model, pressing);
  py::class_<Phantom>(m, "VirtualPhantom", "A simulated Phantom Premium and the hand that holds it.")
      .def(py::init([](const HandPath& path, double period, double hand_stiffness, double hand_damping,
                       bool gimbal) {
             VirtualPhantomOptions options;
             options.arm.period = period;
             options.hand.stiffness = hand_stiffness;
             options.hand.damping = hand_damping;
             options.gimbal.present = gimbal;
             return std::make_unique<Phantom>(path, options);
           }),
           arg("path"), arg("period") = ArmOptions().period, arg("hand_stiffness") = HandOptions().stiffness,
           arg("hand_damping") = HandOptions().damping, arg("gimbal") = false,
           "period [s], stiffness [N/m] and damping [N·s/m] of the hand, gimbal: whether it turns.")
      .def_property_readonly("info", &Phantom::info, py::return_value_policy::copy)
      .def("run", &run, arg("servo"), arg("duration"),
           "Runs a servo over a simulated duration [s], as fast as the machine can, with the same bits every "
           "time.  Returns an array with a row for each tick: time [s], position, hand, avatar [m], force "
           "[N], "
           "torque [N·m], status (LoopStatus), model (Status), pressing.")
      .def("reset", &Phantom::reset, "Back to the beginning of the path.");
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
  add_devices(m);
  add_record(m);
  add_grip(m);
  add_servo_class(m);
}

}  // namespace hapbeam::python
