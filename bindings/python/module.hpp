// SPDX-License-Identifier: MIT
// The parts of the module, in the order in which they name each other.
#pragma once

#include <pybind11/pybind11.h>

namespace hapbeam::python {

void add_beams(pybind11::module_& m);
void add_rods(pybind11::module_& m);
void add_models(pybind11::module_& m);
void add_touch(pybind11::module_& m);
void add_several(pybind11::module_& m);
void add_devices(pybind11::module_& m);
void add_servo(pybind11::module_& m);

}  // namespace hapbeam::python
