// The elements of one beam on a mesh whose nodes move: displacements, strain energy, dead loads, and their derivatives.
//
// Displacements are those from the straight beam, of arches too: an arch is a beam that bends nothing where it is bent,
// between ends that stand closer.  Nodes carry their arc positions, so a mesh that follows the contact changes element
// lengths and natural rotations and nothing else.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <hapbeam/beam.hpp>
#include <hapbeam/element/element.hpp>
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
    take(mesh);
  }
  /// Sets the whole state.  @param nodes those of the given mesh
  void set(const Mesh& mesh, const Node* nodes) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i];
    take(mesh);
  }

  /// Residual and tangent of V in element e.   @return V [J]
  [[gnu::always_inline]] Scalar tangent(int e, Vector6<Scalar>& r, Matrix6<Scalar>& K) const noexcept {
    return Element::tangent(properties_[e], displacements(e), r, K);
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
  /// Its derivative by λ.
  void load_rate(int e, Vector6<Scalar>& r) const noexcept {
    r.setZero();
    subtract_loads(e, 1, displacements(e), r, nullptr);
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
    Scalar energy = 0;
    for (int e = 0; e < size(); ++e) energy += Element::energy(properties_[e], displacements(e));
    return energy;
  }

 private:
  Vector6<Scalar> displacements(int e) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    return {a.u, a.w, a.theta, b.u, b.w, b.theta};
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
