// SPDX-License-Identifier: MIT
// The module hapbeam._core, which the package hapbeam shows as its own: its enumerations and its version.
#include "module.hpp"

#include <string>

#include "enums.hpp"
#include <hapbeam/version.hpp>

PYBIND11_MODULE(_core, m) {
  using namespace hapbeam;
  using namespace hapbeam::python;
  m.doc() = "Force and shape of slender beams that a hand presses.  Units are SI: m, N, rad, s.";
  const auto number = [](int part) { return std::to_string(part); };
  m.attr("__version__") = number(HAPBEAM_VERSION_MAJOR) + "." + number(HAPBEAM_VERSION_MINOR) + "." +
                          number(HAPBEAM_VERSION_PATCH);
  m.attr("has_model_files") = has_model_files;
  add_enum<Status>(m, -4,
                   "How a computation ended.  Negative: the answer is not the requested one.  Positive: it "
                   "holds for a request that was moved into range, or after a snap.");
  add_enum<LoopStatus>(m, 0, "What a tick of a servo was.");
  add_enum<Support>(m, 0, "How an end of a Beam is held.");
  add_enum<RodSide>(m, 0, "An end of a Rod.");
  add_enum<Element>(m, 0,
                    "Of a FemModel.  In the plane: Linear; VonKarman, of moderate rotation and exact under "
                    "tension; AssumedStrain, the same by cubic elements; Corotational, of finite rotation.  "
                    "In space: RoundRod, of straight round rods; TwistedRod, of all others.");
  m.def(
      "is_answer", [](Status status) { return is_answer(status); }, py::arg("status"),
      "True where force and shape may be used: Status.ok, or a positive one.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const NotOffered& error) {
      PyErr_SetString(PyExc_TypeError, error.what());
    }
  });
  add_beams(m);
  add_rods(m);
  add_models(m);
  add_touch(m);
  add_several(m);
  add_devices(m);
  add_servo(m);
}
