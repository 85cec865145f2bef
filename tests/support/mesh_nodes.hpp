// The nodes of a model's mesh, out of the shape that it shows, which has one node more for each contact.
#pragma once

#include <cstddef>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/mesh.hpp>

namespace hapbeam::testing {

template <class Model>
auto mesh_nodes(const Model& model) {
  using Scalar = typename Model::Scalar;
  const auto shape = model.shape();
  const ContactMesh<Scalar> mesh(model.elements(), shape.length());
  std::vector<CentrelineNode<Scalar>> nodes;
  for (const auto& node : shape)
    if (node.s == mesh.position(static_cast<int>(nodes.size()))) nodes.push_back(node);
  return nodes;
}
/// Node i of them.
template <class Model>
auto mesh_node(const Model& model, int i) {
  return mesh_nodes(model).at(static_cast<std::size_t>(i));
}

}  // namespace hapbeam::testing
