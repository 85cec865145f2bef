// SPDX-License-Identifier: MIT
// What is seen of a beam or rod: the nodes of its mesh, and in it the places of its contacts.
//
// It has as many nodes as the mesh and one for each contact that there may be.  Those that are left stand in the middle of other elements.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(elements).
#pragma once

#include <cmath>
#include <utility>

#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts
template <class Node, int Elements, int MaxElements, int Most>
class DrawnMesh {
 public:
  explicit DrawnMesh(int elements) : nodes_(elements + Most) {}

  const Node* data() const noexcept { return nodes_.data(); }
  int size() const noexcept { return nodes_.size(); }
  const Node& operator[](int i) const noexcept { return nodes_[i]; }

  /// @param mesh  (i) -> node of the mesh   @param elements  of it   @param contacts  how many there are   @param place  (k) -> element and s of one
  /// @param mark  (k) -> node there   @param within  (e, s) -> node in an element
  template <class Mesh, class Place, class Mark, class Within>
  void draw(int elements, Mesh&& mesh, int contacts, Place&& place, Mark&& mark, Within&& within) noexcept {
    // Where contacts are that are apart from each other and from nodes, and in which element.
    std::pair<int, Node> marks[Most];
    int count = 0;
    // One that is beside a node of the mesh is drawn instead of it.
    std::pair<int, Node> instead[Most];
    int replaced = 0;
    for (int k = 0; k < contacts; ++k) {
      const auto [e, s] = place(k);
      const auto from = mesh(e).s, to = mesh(e + 1).s, apart = (to - from) / 1000;
      bool is_apart = s - from > apart && to - s > apart;
      for (int j = 0; j < count; ++j) is_apart = is_apart && std::abs(marks[j].second.s - s) > apart;
      const int close_by = s - from < to - s ? e : e + 1;
      if (is_apart) marks[count++] = {e, mark(k)};
      else if (0 < close_by && close_by < elements && std::abs(s - mesh(close_by).s) < (to - from) / 50)
        instead[replaced++] = {close_by, mark(k)};
    }
    for (int e = 0; count < Most; ++e) {
      bool empty = true;
      for (int k = 0; k < count; ++k) empty = empty && marks[k].first != e;
      if (empty) marks[count++] = {e, within(e, (mesh(e).s + mesh(e + 1).s) / 2)};
    }
    for (int k = 1; k < Most; ++k)
      for (int j = k; j > 0 && marks[j].second.s < marks[j - 1].second.s; --j)
        std::swap(marks[j], marks[j - 1]);
    int next = 0;
    for (int k = 0; k < Most; ++k) {
      for (; next <= marks[k].first; ++next) nodes_[next + k] = mesh(next);
      marks_[k] = next + k;
      nodes_[next + k] = marks[k].second;
    }
    for (; next <= elements; ++next) nodes_[next + Most] = mesh(next);
    for (int k = 0; k < replaced; ++k) {
      int to = instead[k].first;
      for (const auto& [e, node] : marks) to += e < instead[k].first;
      nodes_[to] = instead[k].second;
    }
  }
  /// The element of the mesh of which a piece is.
  int element_of(int piece) const noexcept {
    int e = piece;
    for (const int mark : marks_)
      if (mark <= piece) --e;
    return e;
  }

 private:
  static constexpr int with_marks(int size) noexcept { return size == Eigen::Dynamic ? size : size + Most; }

  PerNode<Node, with_marks(Elements), with_marks(MaxElements)> nodes_;
  int marks_[Most] = {};  // those that are not of the mesh
};

}  // namespace hapbeam::detail
