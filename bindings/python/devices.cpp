// SPDX-License-Identifier: MIT
// Devices: figures of known ones, and a simulated one with the hand that holds it, which runs a servo in simulated time.
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "arrays.hpp"
#include "locked.hpp"
#include "module.hpp"
#include <hapbeam/haptics/device/known_devices.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>

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

}  // namespace

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

}  // namespace hapbeam::python
