// The nonlinear equations of one beam: mesh, supports, dead loads and one prescribed contact displacement.
//
//   ∂V/∂x = λ f,   w(contact) = d        unknown x: u, w, θ of every node
//
// One Newton step assembles residual and tangent element by element, enters supports and contact as known
// increments, solves and adds.  Nodes carry their arc positions, so a mesh that follows the contact changes
// element lengths and nothing else.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <cmath>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/block_tridiagonal.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/newton_raphson.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements,
          template <typename, int, int> class Assembler>
class BeamSystem {
 public:
  using Scalar = ScalarType;
  using Node = CentrelineNode<Scalar>;
  static_assert(
      is_element<Element, Scalar>,
      "an Element needs static noexcept energy(p, d), residual(p, d, r), tangent(p, d, r, K) and name(): "
      "see hapbeam/element/element.hpp");

  /// @throws std::invalid_argument where a load is not finite somewhere on the beam, or elements does not fit the type
  BeamSystem(const Beam& beam, int elements)
      : nodes_(elements),
        saved_(elements),
        properties_(elements),
        assembler_(elements),
        forces_(point_forces<Scalar>(beam, elements)),
        length_(static_cast<Scalar>(beam.length())),
        mesh_(elements, length_),
        axial_stiffness_(static_cast<Scalar>(beam.axial_stiffness())),
        bending_stiffness_(static_cast<Scalar>(beam.bending_stiffness())),
        left_(beam.left()),
        right_(beam.right()),
        unit_(std::sqrt(bending_stiffness_ / length_)) {
    for (int i = 0; i <= elements; ++i) nodes_[i] = {mesh_.position(i), 0, 0, 0};
    take(mesh_);
  }

  int elements() const noexcept { return nodes_.size() - 1; }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return {nodes_.data(), nodes_.size()}; }
  const Node& node(int i) const noexcept { return nodes_[i]; }

  /// Moves to another mesh of as many elements and carries the displacements over.
  void remesh(const ContactMesh<Scalar>& mesh) noexcept {
    if (mesh == mesh_) return;
    save();
    transfer({saved_.data(), saved_.size()}, mesh, nodes_.data());
    take(mesh);
  }

  /// Sets the whole state.  @param nodes those of the given mesh
  void set_state(const ContactMesh<Scalar>& mesh, const Node* nodes) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i];
    take(mesh);
  }

  /// Where the path ends: d = w - lever θ at the contact's node, the displacement at a distance on a straight tip.
  /// @param load factor on all dead loads   @param contact node, -1 for none   @param d [m]
  /// @param lever [m] from the node to the contact, along x; other than 0 only at an end that yields
  void set_goal(Scalar load, int contact, Scalar d, Scalar lever = 0) noexcept {
    start_load_ = load_;
    goal_load_ = load;
    contact_ = contact;
    lever_ = lever;
    start_d_ = contact < 0 ? Scalar(0) : contact_displacement();
    goal_d_ = d;
  }

  // What NewtonRaphson asks of a system.

  void set_target(Scalar t) noexcept {
    load_ = t < 1 ? start_load_ + t * (goal_load_ - start_load_) : goal_load_;
    d_ = t < 1 ? start_d_ + t * (goal_d_ - start_d_) : goal_d_;
  }
  void save() noexcept {
    for (int i = 0; i < nodes_.size(); ++i) saved_[i] = nodes_[i];
    saved_load_ = load_;
  }
  void restore() noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = saved_[i];
    load_ = saved_load_;
  }
  Scalar size() const noexcept { return size_; }
  Scalar unit() const noexcept { return unit_; }

  Iteration<Scalar> iterate() noexcept {
    using std::abs;
    using std::sqrt;
    Matrix6<Scalar> K;
    Vector6<Scalar> r;
    Scalar energy = 0;
    for (int e = 0; e < elements(); ++e) {
      energy += Element::tangent(properties_[e], displacements(e), r, K);
      if (lever_ != 0) take_lever(e, r, K);
      assembler_.add(e, K, r);
    }
    size_ = sqrt(2 * energy);
    if (load_ != 0) add_loads();
    prescribe_supports();
    if (contact_ >= 0) assembler_.prescribe(contact_, 1, d_ - contact_displacement());
    const Status status = assembler_.solve();
    if (status != Status::ok) return {status, 0};
    for (int i = 0; i < nodes_.size(); ++i) {
      const Vector3<Scalar>& x = assembler_.increment(i);
      nodes_[i].u += x[0];
      nodes_[i].w += x[1];
      nodes_[i].theta += x[2];
    }
    if (contact_ >= 0) nodes_[contact_].w = d_ + lever_ * nodes_[contact_].theta;
    return {status, sqrt(abs(assembler_.energy()))};
  }

  /// Transverse force that holds the contact at d, thesis eq. 3.42 [N].
  Scalar reaction() const noexcept {
    Vector6<Scalar> r;
    Scalar force = 0;
    if (contact_ < elements()) {
      Element::residual(properties_[contact_], displacements(contact_), r);
      force += r[1];
    }
    if (contact_ > 0) {
      Element::residual(properties_[contact_ - 1], displacements(contact_ - 1), r);
      force += r[4];
    }
    if (load_ != 0)
      for (const PointForce<Scalar>& load : forces_)
        visit_nodal_forces(load, [&](int node, const Vector3<Scalar>& f) {
          if (node == contact_) force -= load_ * f[1];
        });
    return force;
  }

  /// Strain energy [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = 0;
    for (int e = 0; e < elements(); ++e) energy += Element::energy(properties_[e], displacements(e));
    return energy;
  }

 private:
  Scalar contact_displacement() const noexcept {
    return nodes_[contact_].w - lever_ * nodes_[contact_].theta;
  }

  /// The contact's unknowns become u, w - lever θ, θ: what pairs with θ takes the lever times what pairs with w.
  void take_lever(int e, Vector6<Scalar>& r, Matrix6<Scalar>& K) const noexcept {
    if (e != contact_ && e + 1 != contact_) return;
    const int w = e == contact_ ? 1 : 4, theta = w + 1;
    r[theta] += lever_ * r[w];
    K.col(theta) += lever_ * K.col(w);
    K.row(theta) += lever_ * K.row(w);
  }

  void take(const ContactMesh<Scalar>& mesh) noexcept {
    mesh_ = mesh;
    for (int e = 0; e < elements(); ++e) {
      const Scalar length = nodes_[e + 1].s - nodes_[e].s;
      if (properties_[e].length != length)
        properties_[e] = ElementProperties<Scalar>(length, axial_stiffness_, bending_stiffness_);
    }
  }

  Vector6<Scalar> displacements(int e) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    Vector6<Scalar> d;
    d << a.u, a.w, a.theta, b.u, b.w, b.theta;
    return d;
  }

  template <class Visitor>
  void visit_nodal_forces(const PointForce<Scalar>& load, Visitor&& visit) const noexcept {
    const int e = centreline().segment_at(load.s);
    const Scalar h = properties_[e].length;
    const Vector6<Scalar> f = ShapeFunctions<Scalar>((load.s - nodes_[e].s) / h, h)
                                  .nodal_forces(load.axial, load.transverse, load.moment);
    visit(e, Vector3<Scalar>(f.template head<3>()));
    visit(e + 1, Vector3<Scalar>(f.template tail<3>()));
  }

  void add_loads() noexcept {
    for (const PointForce<Scalar>& load : forces_)
      visit_nodal_forces(load, [this](int node, Vector3<Scalar> f) {
        if (node == contact_) f[2] += lever_ * f[1];
        assembler_.add_force(node, load_ * f);
      });
  }

  void prescribe_supports() noexcept {
    const auto hold = [this](int node, Support support) {
      if (fixes_u(support)) assembler_.prescribe(node, 0, 0);
      if (fixes_w(support)) assembler_.prescribe(node, 1, 0);
      if (fixes_theta(support)) assembler_.prescribe(node, 2, 0);
    };
    hold(0, left_);
    hold(elements(), right_);
  }

  detail::PerNode<Node, Elements, MaxElements> nodes_, saved_;
  detail::PerNode<ElementProperties<Scalar>, Elements, MaxElements> properties_;
  Assembler<Scalar, Elements, MaxElements> assembler_;
  std::vector<PointForce<Scalar>> forces_;
  Scalar length_;
  ContactMesh<Scalar> mesh_;
  Scalar axial_stiffness_, bending_stiffness_;
  Support left_, right_;
  int contact_ = -1;
  Scalar lever_ = 0;
  Scalar load_ = 0, saved_load_ = 0, start_load_ = 0, goal_load_ = 0;
  Scalar d_ = 0, start_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, unit_;
};

}  // namespace hapbeam
