// SPDX-License-Identifier: MIT
// Enumerations of hapbeam as enumerations of Python, whose members are named by C++.
//
// A Status is an IntEnum, so that an array of statuses, which holds int8, is compared with its members at the speed of numpy.
#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include <type_traits>

#include "factories.hpp"
#include <hapbeam/haptics/servo/servo_record.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::python {

namespace py = pybind11;

inline constexpr const char* name(RodSide side) noexcept { return side == RodSide::left ? "left" : "right"; }

template <class E>
inline constexpr bool is_listed =
    std::is_same_v<E, Status> || std::is_same_v<E, LoopStatus> || std::is_same_v<E, Support> ||
    std::is_same_v<E, RodSide> || std::is_same_v<E, Element>;

template <class E>
constexpr auto python_name() noexcept {
  if constexpr (std::is_same_v<E, Status>) return py::detail::const_name("Status");
  else if constexpr (std::is_same_v<E, LoopStatus>) return py::detail::const_name("LoopStatus");
  else if constexpr (std::is_same_v<E, Support>) return py::detail::const_name("Support");
  else if constexpr (std::is_same_v<E, RodSide>) return py::detail::const_name("RodSide");
  else return py::detail::const_name("Element");
}

/// The class in Python.  It lives as long as the interpreter.
template <class E>
py::handle& python_class() noexcept {
  static py::handle type;
  return type;
}

/// Makes the class, with the members from `first` on that have a name.
template <class E>
void add_enum(py::module_& m, int first, const char* doc) {
  py::dict members;
  for (int value = first; value < first + 16; ++value) {
    const std::string member = name(static_cast<E>(value));
    if (member == "unknown" || members.contains(member)) break;
    members[py::str(member)] = value;
  }
  const py::object type = py::module_::import("enum").attr("IntEnum")(python_name<E>().text, members,
                                                                      py::arg("module") = "hapbeam");
  type.attr("__doc__") = doc;
  m.attr(python_name<E>().text) = type;
  python_class<E>() = type.inc_ref();
}

}  // namespace hapbeam::python

namespace pybind11::detail {

template <class E>
class type_caster<E, std::enable_if_t<hapbeam::python::is_listed<E>>> {
 public:
  PYBIND11_TYPE_CASTER(E, hapbeam::python::python_name<E>());

  bool load(handle source, bool) {
    if (!isinstance(source, hapbeam::python::python_class<E>())) return false;
    value = static_cast<E>(int_(reinterpret_borrow<object>(source)).cast<int>());
    return true;
  }
  static handle cast(E source, return_value_policy, handle) {
    return hapbeam::python::python_class<E>()(static_cast<int>(source)).release();
  }
};

}  // namespace pybind11::detail
