// A rod on a mesh whose nodes move: where its nodes are, and what each element is made of.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(elements).
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include <hapbeam/body/rod_profile.hpp>
#include <hapbeam/element/carried_frame.hpp>
#include <hapbeam/element/rod_properties.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/natural_rod.hpp>
#include <hapbeam/fem/rod_abreast.hpp>
#include <hapbeam/fem/rod_bed.hpp>
#include <hapbeam/fem/rod_loads.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

/// Base class of RodElements.
template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodOnMesh {
 public:
  using Scalar = ScalarType;
  using Mesh = ContactMesh<Scalar, contacts_of<Element>>;
  using Node = RodNode<Scalar>;
  using Nodes = PerNode<Node, Elements, MaxElements>;
  using Twists = PerNode<Scalar, Elements, MaxElements>;
  static constexpr int unknowns = Element::unknowns;

  int size() const noexcept { return nodes_.size() - 1; }
  Nodes& nodes() noexcept { return nodes_; }
  const Nodes& nodes() const noexcept { return nodes_; }
  /// ψ of the elements [rad].
  Twists& twists() noexcept { return twists_; }
  const Twists& twists() const noexcept { return twists_; }
  /// Whether elements have a twist of their own.
  bool has_inner() const noexcept { return has_twist && !round_; }
  const NaturalRod<Scalar>& natural_shape() const noexcept { return natural_; }
  const Mesh& mesh() const noexcept { return mesh_; }
  static Centreline<Scalar, 3> view(const Nodes& nodes) noexcept { return {nodes.data(), nodes.size()}; }

  /// Moves to another mesh of as many elements and carries the shape over.  @param scratch, more  overwritten
  void remesh(const Mesh& mesh, Nodes& scratch, Twists& more) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) scratch[i] = nodes_[i], more[i] = twists_[i];
    int piece = 0;
    const auto look = [&](Scalar s) {
      while (piece + 1 < size() && scratch[piece + 1].s <= s) ++piece;
      if (s == scratch[piece].s) return scratch[piece];
      const Node &a = scratch[piece], &b = scratch[piece + 1];
      Node node = between(a, b, more[piece], s);
      if constexpr (has_twist)
        if (natural_.changes_within(a.s, b.s)) as_natural(a.s, b.s, node);
      return node;
    };
    nodes_[0] = look(0);
    for (int e = 0; e < size(); ++e) {
      VectorOf<Scalar, 3> director = nodes_[e].director;
      if (has_inner()) director = look((mesh.position(e) + mesh.position(e + 1)) / 2).director;
      nodes_[e + 1] = look(mesh.position(e + 1));
      set_length(e, nodes_[e + 1].s - nodes_[e].s);
      find_twist(e, director);
    }
    take(mesh);
  }
  /// Sets the whole state.  @param nodes those of the given mesh
  void set(const Mesh& mesh, const Nodes& nodes, const Twists& twists) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i], twists_[i] = twists[i];
    take(mesh);
  }
  /// The same, and what is given may become anything.
  void take(const Mesh& mesh, Nodes& nodes, Twists& twists) noexcept {
    nodes_.take(nodes);
    twists_.take(twists);
    take(mesh);
  }

 protected:
  static constexpr bool has_twist = unknowns == 7;

  /// In its natural shape.  @throws std::invalid_argument where a load or a section makes no sense somewhere on the rod, or
  /// elements does not fit the type, or the element does not model such a rod
  RodOnMesh(const Rod& rod, int elements)
      : nodes_(elements),
        twists_(elements),
        properties_(elements),
        abreast_(elements),
        natural_(rod),
        mesh_(elements, static_cast<Scalar>(rod.length())),
        profile_(rod),
        loads_(rod, elements),
        bed_(rod, elements) {
    if constexpr (!has_twist)
      if (!rod.arcs().empty() || !profile_.round())
        throw std::invalid_argument(
            "rod: RoundRod takes rods that are straight by nature, with one bending stiffness for all "
            "directions; take "
            "TwistedRod");
    if constexpr (has_twist)
      if (!holds_twist(rod.left()) && !holds_twist(rod.right()))
        throw std::invalid_argument(std::string("supports = ") + name(rod.left()) + ", " + name(rod.right()) +
                                    ": TwistedRod turns about its axis, hold its twist at one end");
    round_ = natural_.straight() && profile_.round() && profile_.smooth();
    for (int e = 0; e < elements; ++e)
      properties_[e].number = has_inner() ? 2 : 3, properties_[e].round = round_;
    for (int i = 0; i <= elements; ++i) nodes_[i] = natural_.at(mesh_.position(i));
    take(mesh_);
    for (int e = 0; e < elements; ++e) find_twist(e, natural_.at(middle(e)).director);
  }

  Nodes nodes_;
  Twists twists_;
  PerNode<RodProperties<Scalar>, Elements, MaxElements> properties_;
  RodAbreast<Scalar, Elements, MaxElements> abreast_;
  NaturalRod<Scalar> natural_;
  Mesh mesh_;
  RodProfile<Scalar> profile_;
  RodLoads<Scalar, Elements, MaxElements> loads_;
  RodBed<Scalar> bed_;

 private:
  /// What an element has at s.
  Node between(const Node& a, const Node& b, [[maybe_unused]] Scalar twist, Scalar s) const noexcept {
    const Node ends[] = {a, b};
    const RodPoint<Scalar> at = Centreline<Scalar, 3>(ends, 2).at(0, s);
    Node node{s, at.r, at.tangent, a.director};
    if constexpr (has_twist) {
      const RodProperties<Scalar> p = of_length(b.s - a.s);
      node.director = Element::director(p, a, b, twist, (s - a.s) * p.inverse_length);
    } else {
      node.director = carry(a.director, unit(a.tangent), unit(at.tangent));
    }
    node.director = across(node.director, unit(node.tangent));
    return node;
  }
  /// Moves a node within an element from a to b as its natural shape would move from what an element makes of that, a corner of it.
  void as_natural(Scalar a, Scalar b, Node& node) const noexcept {
    const Node left = natural_.at(a), right = natural_.at(b), there = natural_.at(node.s);
    const Scalar twist = Element::twist_to(of_length(b - a), left, right, natural_.at((a + b) / 2).director);
    const Node drawn = between(left, right, twist, node.s);
    const auto turn = [from = frame(drawn), to = frame(node)](const VectorOf<Scalar, 3>& v) {
      return (to * (from.transpose() * v)).eval();
    };
    node.r += turn(there.r - drawn.r);
    node.tangent = turn(there.tangent) * std::sqrt(node.tangent.squaredNorm() / drawn.tangent.squaredNorm());
    node.director = turn(there.director);
  }
  static Eigen::Matrix<Scalar, 3, 3> frame(const Node& node) noexcept {
    Eigen::Matrix<Scalar, 3, 3> axes;
    const VectorOf<Scalar, 3> along = unit(node.tangent);
    axes << node.director, cross3(along, node.director), along;
    return axes;
  }
  RodProperties<Scalar> of_length(Scalar length) const noexcept {
    RodProperties<Scalar> p;
    p.length = length, p.inverse_length = 1 / length, p.round = round_;
    return p;
  }

  Scalar middle(int e) const noexcept { return (nodes_[e].s + nodes_[e + 1].s) / 2; }

  void find_twist(int e, const VectorOf<Scalar, 3>& director) noexcept {
    if constexpr (has_twist)
      if (!round_) twists_[e] = Element::twist_to(properties_[e], nodes_[e], nodes_[e + 1], director);
  }

  void set_length(int e, Scalar length) noexcept {
    properties_[e].length = length;
    properties_[e].inverse_length = 1 / length;
  }

  void take(const Mesh& mesh) noexcept {
    if (known_ && mesh == mesh_) return;
    mesh_ = mesh;
    // Where all elements are the same their length alone changes.
    const bool alike = profile_.constant() && natural_.straight() && known_;
    known_ = true;
    for (int e = 0; e < size(); ++e) {
      const Scalar length = nodes_[e + 1].s - nodes_[e].s;
      if (alike) {
        if (length != properties_[e].length) set_length(e, length);
      } else {
        set_length(e, length);
        profile_.apply(nodes_[e].s, nodes_[e + 1].s, properties_[e]);
        if constexpr (has_twist)
          if (!natural_.straight()) take_natural(e);
        abreast_.take(e, properties_[e]);
      }
      if (!bed_.empty()) bed_.take(e, nodes_[e].s, nodes_[e + 1].s, natural_);
    }
    if (alike) abreast_.take_lengths(properties_);
    if (!loads_.empty()) loads_.take(view(nodes_));
  }

  void take_natural(int e) noexcept {
    RodProperties<Scalar>& p = properties_[e];
    const Node a = natural_.at(nodes_[e].s), b = natural_.at(nodes_[e + 1].s);
    Element::take_natural(a, b, Element::twist_to(p, a, b, natural_.at(middle(e)).director), p);
  }

  bool known_ = false;  // what elements are made of
  bool round_ = false;  // section, and straight by nature
};

}  // namespace hapbeam::detail
