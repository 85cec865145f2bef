// SPDX-License-Identifier: MIT
// Views of the nodes of a shape.
#include "arrays.hpp"

namespace hapbeam::python {
namespace {

/// Bytes from the beginning of a node to one of its numbers.
template <class Node, class Member>
py::ssize_t offset(const Node& node, const Member& member) noexcept {
  return reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&node);
}

py::dtype structure(const char* const* names, const char* const* formats, const py::ssize_t* offsets,
                    int count, std::size_t size) {
  py::list n, f, o;
  for (int k = 0; k < count; ++k) n.append(names[k]), f.append(formats[k]), o.append(offsets[k]);
  return py::dtype(n, f, o, static_cast<py::ssize_t>(size));
}

}  // namespace

py::dtype node_type(int dimension) {
  if (dimension == 2) {
    const CentrelineNode<double> node{};
    const char *const names[] = {"s", "u", "w", "theta"}, *const formats[] = {"f8", "f8", "f8", "f8"};
    const py::ssize_t offsets[] = {offset(node, node.s), offset(node, node.u), offset(node, node.w),
                                   offset(node, node.theta)};
    return structure(names, formats, offsets, 4, sizeof node);
  }
  const RodNode<double> node{};
  const char *const names[] = {"s", "r", "tangent", "director"}, *const formats[] = {"f8", "(3,)f8", "(3,)f8",
                                                                                     "(3,)f8"};
  const py::ssize_t offsets[] = {offset(node, node.s), offset(node, node.r), offset(node, node.tangent),
                                 offset(node, node.director)};
  return structure(names, formats, offsets, 4, sizeof node);
}

py::array view_of(const Nodes& nodes, int dimension, py::handle owner) {
  py::array view(node_type(dimension), {static_cast<py::ssize_t>(nodes.size)}, {}, nodes.data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

}  // namespace hapbeam::python
