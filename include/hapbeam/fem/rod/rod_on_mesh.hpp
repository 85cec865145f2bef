// SPDX-License-Identifier: MIT
// A rod on a mesh that stays: where its nodes are, and what each element is made of.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(elements).
#pragma once

#include <stdexcept>
#include <string>

#include <hapbeam/body/rod_profile.hpp>
#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/fem/laid_mesh.hpp>
#include <hapbeam/fem/rod/natural_rod.hpp>
#include <hapbeam/fem/rod/rod_abreast.hpp>
#include <hapbeam/fem/rod/rod_bed.hpp>
#include <hapbeam/fem/rod/rod_loads.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

/// Base class of RodElements.
template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodOnMesh {
 public:
  using Scalar = ScalarType;
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
  /// What an element is made of.
  const RodProperties<Scalar>& properties(int e) const noexcept { return properties_[e]; }
  static Centreline<Scalar, 3> view(const Nodes& nodes) noexcept { return {nodes.data(), nodes.size()}; }

  /// Sets the whole state.
  void set(const Nodes& nodes, const Twists& twists) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i], twists_[i] = twists[i];
  }
  /// The same, and what is given may become anything.
  void take(Nodes& nodes, Twists& twists) noexcept {
    nodes_.take(nodes);
    twists_.take(twists);
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
    lay_mesh<Scalar>(rod, rod.forces(), elements, [this](int i, Scalar s) { nodes_[i] = natural_.at(s); });
    for (int e = 0; e < elements; ++e) make(e);
    if (!loads_.empty()) loads_.take(view(nodes_));
  }

  Nodes nodes_;
  Twists twists_;
  PerNode<RodProperties<Scalar>, Elements, MaxElements> properties_;
  RodAbreast<Scalar, Elements, MaxElements> abreast_;
  NaturalRod<Scalar> natural_;
  RodProfile<Scalar> profile_;
  RodLoads<Scalar, Elements, MaxElements> loads_;
  RodBed<Scalar> bed_;

 private:
  void make(int e) noexcept {
    const Scalar from = nodes_[e].s, to = nodes_[e + 1].s;
    RodProperties<Scalar>& p = properties_[e];
    p.number = has_inner() ? 2 : 3, p.round = round_;
    p.length = to - from;
    p.inverse_length = 1 / p.length;
    profile_.apply(from, to, p);
    if constexpr (has_twist)
      if (!round_) {
        twists_[e] = Element::twist_to(p, nodes_[e], nodes_[e + 1], natural_.at((from + to) / 2).director);
        if (!natural_.straight()) Element::take_natural(nodes_[e], nodes_[e + 1], twists_[e], p);
      }
    abreast_.take(e, p);
    if (!bed_.empty()) bed_.take(e, from, to, natural_);
  }

  bool round_ = false;  // section, and straight by nature
};

}  // namespace hapbeam::detail
