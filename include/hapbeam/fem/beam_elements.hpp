// The elements of one beam on a mesh whose nodes move: displacements, strain energy, dead loads, and their derivatives.
//
// Displacements are those from the straight beam, of arches too: an arch is a beam that bends nothing where it is bent,
// between ends that stand closer.  Nodes carry their arc positions, so a mesh that follows the contact changes element
// lengths and natural rotations and nothing else.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/pack.hpp>
#include <hapbeam/fem/beam_forces.hpp>
#include <hapbeam/fem/beam_profile.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/natural_shape.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class BeamElements {
 public:
  using Scalar = ScalarType;
  using Mesh = ContactMesh<Scalar, contacts_of<Element>>;
  using Node = CentrelineNode<Scalar>;
  using Nodes = detail::PerNode<Node, Elements, MaxElements>;
  using Properties = detail::PerNode<ElementProperties<Scalar>, Elements, MaxElements>;
  static_assert(
      is_element<Element, Scalar>,
      "an Element needs static noexcept energy(p, d), residual(p, d, r), tangent(p, d, r, K) and name(): "
      "see hapbeam/element/element.hpp");

  /// At rest on the x axis.  @throws std::invalid_argument where a load is not finite somewhere on the beam, elements
  /// does not fit the type, or the section changes and Element does not take that
  BeamElements(const Beam& beam, int elements)
      : nodes_(elements),
        properties_(elements),
        loads_(beam, elements),
        natural_(beam),
        profile_(beam),
        mesh_(elements, static_cast<Scalar>(beam.length())),
        axial_stiffness_(static_cast<Scalar>(beam.axial_stiffness())),
        bending_stiffness_(static_cast<Scalar>(beam.bending_stiffness())) {
    for (int i = 0; i <= elements; ++i) nodes_[i] = {mesh_.position(i), 0, 0, 0};
    take(mesh_);
  }

  int size() const noexcept { return nodes_.size() - 1; }
  Nodes& nodes() noexcept { return nodes_; }
  const Nodes& nodes() const noexcept { return nodes_; }
  const Properties& properties() const noexcept { return properties_; }
  const NaturalShape<Scalar>& natural_shape() const noexcept { return natural_; }
  const Mesh& mesh() const noexcept { return mesh_; }
  /// Any nodes of this beam, seen with its kinematics.
  static Centreline<Scalar> view(const Nodes& nodes) noexcept {
    return {nodes.data(), nodes.size(), any_rotation<Element>};
  }

  /// Moves to another mesh of as many elements and carries the displacements over.  @param scratch  overwritten
  void remesh(const Mesh& mesh, Nodes& scratch) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) scratch[i] = nodes_[i];
    transfer(view(scratch), mesh, nodes_.data());
    if (!natural_.straight())
      for (Node& node : nodes_) as_natural(scratch, node);
    take(mesh);
  }
  /// Sets the whole state.  @param nodes those of the given mesh
  void set(const Mesh& mesh, const Node* nodes) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i];
    take(mesh);
  }

  /// Elements that are computed side by side, from the one on whose number is a multiple of their size.
  struct Group {
    using Number = std::conditional_t<goes_abreast<Element>, detail::Pack<Scalar>, Scalar>;
    static constexpr int size = goes_abreast<Element> ? detail::pack_size<Scalar> : 1;
    CoreResponse<Number> core;
  };
  /// To be called with each element, in order.
  [[gnu::always_inline]] void respond([[maybe_unused]] int e, [[maybe_unused]] Group& group) const noexcept {
    if constexpr (goes_abreast<Element>)
      if (e % Group::size == 0) respond_abreast(e, group);
  }
  /// Residual and tangent of V in element e.   @param group  with which respond(e, group) was called   @return V [J]
  [[gnu::always_inline]] Scalar tangent(int e, [[maybe_unused]] const Group& group, Vector6<Scalar>& r,
                                        Matrix6<Scalar>& K) const noexcept {
    if constexpr (goes_abreast<Element>) {
      const auto& c = group.core;
      const int i = e % Group::size;
      const CoreResponse<Scalar> core{c.energy[i],
                                      c.s[i],
                                      c.r[i],
                                      c.t1[i],
                                      c.t2[i],
                                      {c.k.ss[i], c.k.sr[i], c.k.s1[i], c.k.s2[i], c.k.rr[i], c.k.r1[i],
                                       c.k.r2[i], c.k.t11[i], c.k.t12[i], c.k.t22[i]}};
      return Element::tangent(properties_[e], core, r, K);
    } else {
      return Element::tangent(properties_[e], displacements(e), r, K);
    }
  }
  /// Whether λ times the loads are any.
  bool loaded(Scalar lambda) const noexcept { return lambda != 0 && !loads_.empty(); }
  /// Takes those of λW off residual and tangent.   @return work of λ times the loads on element e [J]
  Scalar subtract_loads(int e, Scalar lambda, Vector6<Scalar>& r, Matrix6<Scalar>& K) const noexcept {
    return subtract_loads(e, lambda, displacements(e), r, &K);
  }
  /// The residual alone.
  void residual(int e, Scalar lambda, Vector6<Scalar>& r) const noexcept {
    const Vector6<Scalar> d = displacements(e);
    Element::residual(properties_[e], d, r);
    subtract_loads(e, lambda, d, r, nullptr);
  }
  /// What the section at s carries, in element e, which holds s.   @param thickness [m]
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar lambda, Scalar thickness) const noexcept {
    Vector6<Scalar> r;
    residual(e, lambda, r);
    const auto cut =
        detail::cut_beam<Element>(view(nodes_), e, s, r, loaded(lambda) ? &loads_ : nullptr, lambda);
    if constexpr (detail::Tapers<Element>::value) {
      const auto [EA, EI] = profile_.at(s);
      return cut.in_section(EA, EI, thickness);
    } else {
      return cut.in_section(axial_stiffness_, bending_stiffness_, thickness);
    }
  }
  /// [J]
  Scalar strain_energy() const noexcept {
    Scalar sum = 0;
    if constexpr (goes_abreast<Element>) {
      for (int first = 0; first < size(); first += Group::size) {
        const auto energy = gather(first, [](const auto& p, const auto& d) { return Element::energy(p, d); });
        for (int e = first; e < (std::min)(first + Group::size, size()); ++e) sum += energy[e - first];
      }
    } else {
      for (int e = 0; e < size(); ++e) sum += Element::energy(properties_[e], displacements(e));
    }
    return sum;
  }
  /// Of λ times the loads [J].
  Scalar work(Scalar lambda) const noexcept {
    Scalar work = 0;
    Vector6<Scalar> r = Vector6<Scalar>::Zero();
    for (int e = 0; loaded(lambda) && e < size(); ++e)
      work += subtract_loads(e, lambda, displacements(e), r, nullptr);
    return work;
  }

 private:
  /// Moves a node within an element of other nodes as its natural shape would move from what an element makes of that, a corner of it or
  /// an arc of more than half a radian.
  void as_natural(const Nodes& others, Node& node) const noexcept {
    using std::cos;
    using std::sin;
    const int e = view(others).segment_at(node.s);
    const Scalar a = others[e].s, b = others[e + 1].s;
    const bool bent = std::abs(properties_[e].natural_b - properties_[e].natural_a) > (b - a) / 2;
    if (!(a < node.s && node.s < b) || !(bent || natural_.changes_within(a, b))) return;
    const auto lie = [this](Scalar s) {
      const Displacement<Scalar> at = natural_.at(s);
      return Node{s, at.u, at.w, at.theta};
    };
    const std::array<Node, 2> ends{lie(a), lie(b)};
    const Node there = lie(node.s);
    const Displacement<Scalar> drawn = Centreline<Scalar>(ends.data(), 2, any_rotation<Element>).at(node.s);
    const Scalar u = there.u - drawn.u, w = there.w - drawn.w, turn = node.theta - drawn.theta;
    node.u += cos(turn) * u + sin(turn) * w;
    node.w += cos(turn) * w - sin(turn) * u;
    node.theta += there.theta - drawn.theta;
  }
  Vector6<Scalar> displacements(int e) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    return {a.u, a.w, a.theta, b.u, b.w, b.theta};
  }

  void respond_abreast(int first, Group& group) const noexcept {
    group.core = gather(first, [](const auto& p, const auto& d) { return Element::core(p, d); });
  }
  /// Of a group from its first element on: use(properties, displacements), side by side.
  template <class Use>
  [[gnu::always_inline]] auto gather(int first, Use&& use) const noexcept {
    using Wide = typename Group::Number;
    const auto each = [&](auto&& number) {
      return Wide::of([&](int k) { return number((std::min)(first + k, size() - 1)); });
    };
    const auto property = [&](Scalar ElementProperties<Scalar>::*member) {
      return each([&](int e) { return properties_[e].*member; });
    };
    const auto moved = [&](int by, Scalar Node::*member) {
      return each([&](int e) { return nodes_[e + by].*member; });
    };
    using P = ElementProperties<Scalar>;
    ElementProperties<Wide> p;
    p.length = property(&P::length);
    p.inverse_length = property(&P::inverse_length);
    p.axial_stiffness = property(&P::axial_stiffness);
    p.axial_per_length = property(&P::axial_per_length);
    p.bending_per_length3 = property(&P::bending_per_length3);
    if (!natural_.straight()) {
      p.natural_a = property(&P::natural_a);
      p.natural_b = property(&P::natural_b);
      p.natural_stretch = property(&P::natural_stretch);
    }
    const Vector6<Wide> d(moved(0, &Node::u), moved(0, &Node::w), moved(0, &Node::theta), moved(1, &Node::u),
                          moved(1, &Node::w), moved(1, &Node::theta));
    return use(p, d);
  }
  Scalar subtract_loads(int e, Scalar lambda, const Vector6<Scalar>& d, Vector6<Scalar>& r,
                        Matrix6<Scalar>* K) const noexcept {
    if (!loaded(lambda)) return 0;
    return loads_.template subtract<Element>(nodes_[e].s, nodes_[e + 1].s, e + 1 == size(), lambda,
                                             properties_[e], d, r, K);
  }

  void take(const Mesh& mesh) noexcept {
    mesh_ = mesh;
    for (int e = 0; e < size(); ++e) {
      const Scalar length = nodes_[e + 1].s - nodes_[e].s;
      if (properties_[e].length != length)
        properties_[e] = ElementProperties<Scalar>(length, axial_stiffness_, bending_stiffness_);
      if constexpr (detail::Tapers<Element>::value) profile_.apply(nodes_[e].s, length, properties_[e]);
      if (!natural_.straight()) natural_.apply(nodes_[e].s, properties_[e]);
    }
  }

  Nodes nodes_;
  Properties properties_;
  DeadLoads<Scalar> loads_;
  NaturalShape<Scalar> natural_;
  std::conditional_t<detail::Tapers<Element>::value, BeamProfile<Scalar>, detail::OneSection> profile_;
  Mesh mesh_;
  Scalar axial_stiffness_, bending_stiffness_;
};

}  // namespace hapbeam
