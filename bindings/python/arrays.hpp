// SPDX-License-Identifier: MIT
// Vectors and tables of numbers between numpy and C++.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>

#include "any_model.hpp"

namespace hapbeam::python {

namespace py = pybind11;

/// What Python may give for numbers: an array, a list, a tuple.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// @throws std::invalid_argument naming the field
[[noreturn]] inline void reject_shape(const char* field, const Numbers& given, const std::string& allowed) {
  std::string shape;
  for (py::ssize_t i = 0; i < given.ndim(); ++i) shape += (i ? ", " : "") + std::to_string(given.shape(i));
  throw std::invalid_argument(std::string(field) + " of shape (" + shape + "): must be " + allowed);
}

template <int D>
VectorOf<double, D> vector_of(const Numbers& numbers, const char* field) {
  if (numbers.ndim() != 1 || numbers.shape(0) != D)
    reject_shape(field, numbers, std::to_string(D) + " numbers");
  return Eigen::Map<const VectorOf<double, D>>(numbers.data());
}

/// In the plane two numbers, in space three.
inline Place place_of(const Numbers& numbers, int dimension, const char* field) {
  if (dimension == 3) return vector_of<3>(numbers, field);
  const Vector2<double> flat = vector_of<2>(numbers, field);
  return {flat.x(), flat.y(), 0};
}

/// A table of n rows.   @return n
inline py::ssize_t rows_of(const Numbers& table, int columns, const char* field) {
  if (table.ndim() != 2 || table.shape(1) != columns)
    reject_shape(field, table, "(n, " + std::to_string(columns) + ")");
  return table.shape(0);
}

inline Place place_in_row(const double* row, int dimension) noexcept {
  return {row[0], row[1], dimension == 3 ? row[2] : 0};
}

/// Of all components, or of those in the plane.
inline py::array_t<double> array_of(const Eigen::Vector3d& v, int dimension = 3) {
  return py::array_t<double>(dimension, v.data());
}
inline py::array_t<double> array_of(const Vector2<double>& v) { return py::array_t<double>(2, v.data()); }

/// Which numbers Python is to see of a structure that lies in the memory of a model: nodes of a beam or a rod.
py::dtype node_type(int dimension);

/// A view of nodes, read-only, that keeps `owner` alive.
py::array view_of(const Nodes& nodes, int dimension, py::handle owner);

/// Places of the nodes, or of `count` points evenly along the unloaded beam, or at arc positions: the one copy that it takes.
/// @param at  Place at(double s)
template <class At>
py::array_t<double> places_of(const Nodes& nodes, int dimension, double length, const py::object& which,
                              const At& at) {
  const auto table = [dimension](py::ssize_t n) { return py::array_t<double>({n, py::ssize_t(dimension)}); };
  const auto write = [dimension](double* row, const Place& place) {
    for (int k = 0; k < dimension; ++k) row[k] = place[k];
  };
  if (which.is_none()) {
    const auto n = static_cast<py::ssize_t>(nodes.size);
    py::array_t<double> all = table(n);
    const auto* flat = static_cast<const CentrelineNode<double>*>(nodes.data);
    const auto* spatial = static_cast<const RodNode<double>*>(nodes.data);
    for (py::ssize_t i = 0; i < n; ++i)
      write(all.mutable_data(i, 0),
            dimension == 3 ? spatial[i].r : Place(flat[i].s + flat[i].u, flat[i].w, 0));
    return all;
  }
  if (PyIndex_Check(which.ptr()) && !py::isinstance<py::array>(which)) {
    const auto n = which.cast<py::ssize_t>();
    if (n < 2) throw std::invalid_argument("points = " + std::to_string(n) + ": must be 2 or more");
    py::array_t<double> all = table(n);
    for (py::ssize_t i = 0; i < n; ++i)
      write(all.mutable_data(i, 0),
            at((std::min)(length * static_cast<double>(i) / static_cast<double>(n - 1), length)));
    return all;
  }
  const Numbers s = which.cast<Numbers>();
  if (s.ndim() != 1) reject_shape("points", s, "a number of points, or arc positions (n,)");
  py::array_t<double> all = table(s.shape(0));
  for (py::ssize_t i = 0; i < s.shape(0); ++i) {
    if (!(s.data()[i] >= 0 && s.data()[i] <= length))
      detail::reject("points", s.data()[i], "m", "on the beam, 0 to its length");
    write(all.mutable_data(i, 0), at(s.data()[i]));
  }
  return all;
}

}  // namespace hapbeam::python
