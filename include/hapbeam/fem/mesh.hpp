// SPDX-License-Identifier: MIT
// The mesh of a beam or rod, which stays; what is seen of it, its nodes and in it the places of contacts; and the nodes at which a beam in closed
// form is drawn, one at the contact among them.
//
// Nodes lie where an arc of the natural shape or a part with a section of its own ends, and where a point load acts.  With too few elements, what is
// close to another one is left out.  Each further element goes to the part whose elements are the longest.
// Laying a mesh is offline, and DrawnMesh allocates at construction.  Real-time: all else is noexcept and allocation-free, ContactMesh O(1), a
// drawing O(elements).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam {

/// Where a beam in closed form is drawn.
template <typename Scalar>
class ContactMesh {
 public:
  /// Evenly.  @param elements two or more   @param length [m]
  ContactMesh(int elements, Scalar length) noexcept
      : elements_(elements),
        node_(elements / 2),
        length_(length),
        s_(length * Scalar(elements / 2) / Scalar(elements)) {}

  /// With a node at s, the nearest one; the others share the parts on both sides evenly.  Node 0 or n is taken only where s is exactly that end.
  ContactMesh at(Scalar s) const noexcept {
    ContactMesh mesh(elements_, length_);
    mesh.s_ = std::clamp(s, Scalar(0), length_);
    mesh.node_ = s <= 0         ? 0
                 : s >= length_ ? elements_
                                : std::clamp(static_cast<int>(std::lround(s / length_ * Scalar(elements_))),
                                             1, elements_ - 1);
    return mesh;
  }

  int elements() const noexcept { return elements_; }
  int node() const noexcept { return node_; }  ///< the node at s()
  Scalar s() const noexcept { return s_; }     ///< [m]

  /// Arc position of node i [m].
  Scalar position(int i) const noexcept {
    if (i == node_) return s_;
    if (i < node_) return s_ * Scalar(i) / Scalar(node_);
    if (i == elements_) return length_;
    return s_ + (length_ - s_) * Scalar(i - node_) / Scalar(elements_ - node_);
  }

 private:
  int elements_, node_;
  Scalar length_, s_;
};

namespace detail {

/// What is seen of a mesh.  It has as many nodes as that and one for each contact that there may be.  Those that are left stand in the middle of
/// other elements.
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

/// Arc positions at which a mesh is to have nodes, both ends among them [m].   @param apart  least distance of two [m]
template <class Body, class Forces>
std::vector<double> where_it_changes(const Body& body, const Forces& forces, double apart) {
  const double most = body.length() - apart;
  std::vector<double> places{0};
  const auto& arcs = body.arcs();
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const bool goes_on = i + 1 < arcs.size() ? arcs[i].bends_as(arcs[i + 1]) : arcs[i].bends_as({});
    // An arc shorter than an element may be lies in one of its own.
    const double s = (std::max)(arcs[i].end, places.back() + apart);
    if (!goes_on && s <= most) places.push_back(s);
  }
  const auto add = [&](double s) {
    const bool is_apart =
        std::none_of(places.begin(), places.end(), [&](double place) { return std::abs(place - s) < apart; });
    if (is_apart && s <= most) places.insert(std::upper_bound(places.begin(), places.end(), s), s);
  };
  for (const auto& part : body.parts()) add(part.end);
  for (const auto& force : forces) add(force.s);
  places.push_back(body.length());
  return places;
}

}  // namespace detail

/// Calls set(i, s) with each node and its arc position, from 0 to the length [m].  Where nothing changes it takes no memory.
/// @param body  Beam | Rod   @param forces  that act at points of it   @param elements  one or more
template <typename Scalar, class Body, class Forces>
void lay_mesh(const Body& body, const Forces& forces, int elements,
              const std::function<void(int, Scalar)>& set) {
  int next = 0;
  const auto lay = [&](Scalar from, Scalar to, int share) {
    const ContactMesh<Scalar> part(share, to - from);
    for (int i = 0; i < share; ++i) set(next++, from + part.position(i));
  };
  const Scalar length = static_cast<Scalar>(body.length());
  if (body.arcs().empty() && body.parts().empty() && forces.empty()) {
    lay(0, length, elements);
    return set(elements, length);
  }
  std::vector<double> places =
      detail::where_it_changes(body, forces, detail::shortest_element<Scalar>(length));
  const auto size = static_cast<std::size_t>(elements);
  while (places.size() > size + 1) {
    std::size_t least = 1;
    for (std::size_t k = 1; k + 1 < places.size(); ++k)
      if (places[k + 1] - places[k - 1] < places[least + 1] - places[least - 1]) least = k;
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(least));
  }
  std::vector<int> shares(places.size() - 1, 1);
  for (std::size_t left = size - shares.size(); left > 0; --left) {
    const auto longer = [&](std::size_t a, std::size_t b) {
      return (places[a + 1] - places[a]) * shares[b] > (places[b + 1] - places[b]) * shares[a];
    };
    std::size_t longest = 0;
    for (std::size_t k = 1; k < shares.size(); ++k)
      if (longer(k, longest)) longest = k;
    ++shares[longest];
  }
  for (std::size_t k = 0; k < shares.size(); ++k)
    lay(static_cast<Scalar>(places[k]), static_cast<Scalar>(places[k + 1]), shares[k]);
  set(elements, length);
}
/// The same.   @return arc positions [m]
template <typename Scalar, class Body, class Forces>
std::vector<Scalar> lay_mesh(const Body& body, const Forces& forces, int elements) {
  std::vector<Scalar> nodes(static_cast<std::size_t>(elements) + 1);
  lay_mesh<Scalar>(body, forces, elements, [&](int i, Scalar s) { nodes[static_cast<std::size_t>(i)] = s; });
  return nodes;
}

}  // namespace hapbeam
