// The nonlinear equations of one beam: mesh, supports, dead loads and one prescribed contact displacement.
//
//   ∂V/∂x = λ f,   n · (u, w)(contact) = d        unknown x: u, w, θ of every node
//
// One Newton step assembles residual and tangent element by element, enters supports and contact as known
// increments, solves and adds.  Displacements are those from the straight beam, of arches too: an arch is a beam that
// bends nothing where it is bent, between ends that stand closer.  Nodes carry their arc positions, so a mesh that
// follows the contact changes element lengths and natural rotations and nothing else.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/block_tridiagonal.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/natural_shape.hpp>
#include <hapbeam/fem/newton_raphson.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements,
          template <typename, int, int> class Assembler>
class BeamSystem {
 public:
  using Scalar = ScalarType;
  using Node = CentrelineNode<Scalar>;
  using Nodes = detail::PerNode<Node, Elements, MaxElements>;
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
        natural_(beam),
        length_(static_cast<Scalar>(beam.length())),
        mesh_(elements, length_),
        axial_stiffness_(static_cast<Scalar>(beam.axial_stiffness())),
        bending_stiffness_(static_cast<Scalar>(beam.bending_stiffness())),
        ends_{End(beam.left(), beam.left_place()), End(beam.right(), beam.right_place())},
        unit_(std::sqrt(bending_stiffness_ / length_)) {
    take_natural_shape();
    take(mesh_);
  }

  int elements() const noexcept { return nodes_.size() - 1; }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return view(nodes_); }
  /// Other nodes of this beam, seen with its kinematics.
  Centreline<Scalar> view(const Nodes& nodes) const noexcept {
    return {nodes.data(), nodes.size(), any_rotation<Element>};
  }
  const Node& node(int i) const noexcept { return nodes_[i]; }

  /// Moves to another mesh of as many elements and carries the displacements over.
  void remesh(const ContactMesh<Scalar>& mesh) noexcept {
    if (mesh == mesh_) return;
    save();
    transfer(view(saved_), mesh, nodes_.data());
    take(mesh);
  }

  /// Sets the whole state.  @param nodes those of the given mesh
  void set_state(const ContactMesh<Scalar>& mesh, const Node* nodes) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i];
    take(mesh);
  }

  /// Where the path ends: all of the dead loads, the ends where they are placed, and no contact.
  void set_goal() noexcept {
    contact_ = -1;
    lever_ = 0;
    begin_path();
  }
  /// The same with a contact: d = n · (u, w) at its node or, beside an end that yields, at a distance on a straight tip.
  /// @param contact node   @param d [m]   @param lever [m] from the node to the contact, along the beam
  /// @param normal n, a unit vector; other than (0, 1) where the element is right at any rotation
  void set_goal(int contact, Scalar d, Scalar lever = 0, const Vector2<Scalar>& normal = {0, 1}) noexcept {
    contact_ = contact;
    lever_ = lever;
    normal_ = normal;
    start_d_ = contact_displacement();
    goal_d_ = d;
    begin_path();
  }

  // What NewtonRaphson asks of a system.

  void set_target(Scalar t) noexcept {
    const auto between = [t](Scalar start, Scalar goal) { return t < 1 ? start + t * (goal - start) : goal; };
    load_ = between(start_load_, 1);
    d_ = between(start_d_, goal_d_);
    for (End& end : ends_)
      for (int k = 0; k < 3; ++k) end.target[k] = between(end.start[k], end.goal[k]);
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
    std::size_t load = 0;
    for (int e = 0; e < elements(); ++e) {
      const Vector6<Scalar> d = displacements(e);
      energy += Element::tangent(properties_[e], d, r, K);
      load = subtract_loads(e, load, d, r, &K);
      if (e == contact_ || e + 1 == contact_) take_contact_frame(e, r, K);
      assembler_.add(e, K, r);
    }
    size_ = sqrt(2 * energy);
    prescribe_supports();
    if (contact_ >= 0) assembler_.prescribe(contact_, 1, d_ - contact_displacement());
    const Status status = assembler_.solve();
    if (status != Status::ok) return {status, 0};
    for (int i = 0; i < nodes_.size(); ++i) {
      const Vector3<Scalar> x =
          i == contact_ ? from_contact_frame(assembler_.increment(i)) : assembler_.increment(i);
      nodes_[i].u += x[0];
      nodes_[i].w += x[1];
      nodes_[i].theta += x[2];
    }
    place_supports();
    if (contact_ >= 0) correct_contact();
    return {status, sqrt(abs(assembler_.energy()))};
  }

  /// Force along n that holds the contact at d, thesis eq. 3.42 [N].
  Scalar reaction() const noexcept {
    Vector6<Scalar> r;
    Vector2<Scalar> force = Vector2<Scalar>::Zero();
    if (contact_ < elements()) {
      residual(contact_, r);
      force += r.template head<2>();
    }
    if (contact_ > 0) {
      residual(contact_ - 1, r);
      force += r.template segment<2>(3);
    }
    return normal_.dot(force);
  }

  /// Strain energy [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = 0;
    for (int e = 0; e < elements(); ++e) energy += Element::energy(properties_[e], displacements(e));
    return energy;
  }

 private:
  /// How an end is held: which of its displacements, and where.
  struct End {
    End(Support support, const Placement& place) noexcept
        : held{fixes_u(support), fixes_w(support), fixes_theta(support)},
          goal{static_cast<Scalar>(place.u), static_cast<Scalar>(place.w), static_cast<Scalar>(place.theta)} {
    }
    bool held[3];
    Scalar goal[3];
    Scalar start[3] = {0, 0, 0}, target[3] = {0, 0, 0};
  };

  void begin_path() noexcept {
    start_load_ = load_;
    const auto begin = [](End& end, const Node& node) {
      end.start[0] = node.u, end.start[1] = node.w, end.start[2] = node.theta;
    };
    begin(ends_[0], nodes_[0]);
    begin(ends_[1], nodes_[elements()]);
  }

  /// The natural shape, from the left end's place, turned toward the right end's place unless the left end is clamped.
  void take_natural_shape() noexcept {
    using std::atan2;
    using std::cos;
    using std::sin;
    const Scalar *from = ends_[0].goal, *to = ends_[1].goal;
    const Displacement<Scalar> end = natural_.at(length_);
    Scalar turn = from[2];
    if (!ends_[0].held[2] && ends_[1].held[1])
      turn = atan2(end.w, length_ + end.u) - atan2(to[1] - from[1], length_ + to[0] - from[0]);
    else if (!ends_[0].held[2]) turn = to[2] - end.theta;
    const Scalar c = cos(turn), s = sin(turn);
    for (int i = 0; i < nodes_.size(); ++i) {
      const Scalar position = mesh_.position(i);
      const Displacement<Scalar> at = natural_.at(position);
      const Scalar x = position + at.u;
      nodes_[i] = {position, from[0] + c * x + s * at.w - position, from[1] - s * x + c * at.w,
                   at.theta + turn};
    }
  }

  /// n · (u, w) at the contact.  Along a straight tip w is -lever θ beyond its node, or -lever sin θ at any rotation.
  Scalar contact_displacement() const noexcept {
    const Node& node = nodes_[contact_];
    const Scalar at_node = normal_.x() * node.u + normal_.y() * node.w;
    if (lever_ == 0) return at_node;
    if constexpr (any_rotation<Element>) {
      using std::cos;
      using std::sin;
      return at_node + lever_ * (normal_.x() * (cos(node.theta) - 1) - normal_.y() * sin(node.theta));
    }
    return at_node - lever_ * node.theta;
  }

  /// ∂(n · (u, w))/∂θ at the contact, the sign turned [m].
  Scalar lever_arm() const noexcept {
    if constexpr (any_rotation<Element>) {
      using std::cos;
      using std::sin;
      const Scalar theta = nodes_[contact_].theta;
      return lever_ == 0 ? Scalar(0) : lever_ * (normal_.x() * sin(theta) + normal_.y() * cos(theta));
    }
    return lever_;
  }

  /// Puts the contact exactly where it belongs.
  void correct_contact() noexcept {
    const Scalar miss = d_ - contact_displacement();
    nodes_[contact_].u += normal_.x() * miss;
    nodes_[contact_].w += normal_.y() * miss;
  }

  /// The contact's unknowns become the displacement along the surface, that along n and θ:  with n = (0, 1) u and
  /// w - arm θ.  What pairs with θ takes the arm times what pairs with n.
  void take_contact_frame(int e, Vector6<Scalar>& r, Matrix6<Scalar>& K) noexcept {
    const int u = e == contact_ ? 0 : 3, w = u + 1, theta = u + 2;
    if (any_rotation<Element> && normal_.x() != 0) {
      const Scalar c = normal_.y(), s = normal_.x();
      const auto turn = [c, s](auto&& along, auto&& across) {
        const auto before = along.eval();
        along = c * before - s * across;
        across = s * before + c * across;
      };
      const Scalar ru = r[u];
      r[u] = c * ru - s * r[w];
      r[w] = s * ru + c * r[w];
      turn(K.col(u), K.col(w));
      turn(K.row(u), K.row(w));
    }
    if (lever_ != 0) {
      const Scalar arm = lever_arm();
      r[theta] += arm * r[w];
      K.col(theta) += arm * K.col(w);
      K.row(theta) += arm * K.row(w);
    }
  }

  Vector3<Scalar> from_contact_frame(const Vector3<Scalar>& x) const noexcept {
    return {normal_.y() * x[0] + normal_.x() * x[1], normal_.y() * x[1] - normal_.x() * x[0], x[2]};
  }

  void take(const ContactMesh<Scalar>& mesh) noexcept {
    mesh_ = mesh;
    for (int e = 0; e < elements(); ++e) {
      const Scalar length = nodes_[e + 1].s - nodes_[e].s;
      if (properties_[e].length != length)
        properties_[e] = ElementProperties<Scalar>(length, axial_stiffness_, bending_stiffness_);
      if (!natural_.straight()) natural_.apply(nodes_[e].s, properties_[e]);
    }
  }

  Vector6<Scalar> displacements(int e) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    Vector6<Scalar> d;
    d << a.u, a.w, a.theta, b.u, b.w, b.theta;
    return d;
  }

  /// Residual of one element under its loads.
  void residual(int e, Vector6<Scalar>& r) const noexcept {
    const Vector6<Scalar> d = displacements(e);
    Element::residual(properties_[e], d, r);
    const auto first = std::partition_point(
        forces_.begin(), forces_.end(), [&](const PointForce<Scalar>& load) { return load.s < nodes_[e].s; });
    subtract_loads(e, static_cast<std::size_t>(first - forces_.begin()), d, r, nullptr);
  }

  /// Takes the loads of element e, which begin with the given one, from its residual and, unless null, its tangent.
  /// @return the first load of the next element
  std::size_t subtract_loads(int e, std::size_t load, const Vector6<Scalar>& d, Vector6<Scalar>& r,
                             Matrix6<Scalar>* K) const noexcept {
    const Scalar begin = nodes_[e].s, end = nodes_[e + 1].s;
    if (load_ == 0) return load;
    for (; load < forces_.size() && (forces_[load].s < end || e + 1 == elements()); ++load) {
      const PointForce<Scalar>& force = forces_[load];
      const Scalar t = force.s == end ? Scalar(1) : (force.s - begin) / properties_[e].length;
      if constexpr (any_rotation<Element>) subtract_load(force, t, load_, properties_[e], d, r, K);
      else subtract_load(force, t, load_, properties_[e], r);
    }
    return load;
  }

  /// Calls visit(node, component, displacement, where its support holds it).
  template <class Visitor>
  void visit_supports(Visitor&& visit) noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      const int i = k == 0 ? 0 : elements();
      Node& node = nodes_[i];
      Scalar* const displacement[3] = {&node.u, &node.w, &node.theta};
      for (int j = 0; j < 3; ++j)
        if (ends_[k].held[j]) visit(i, j, *displacement[j], ends_[k].target[j]);
    }
  }
  void prescribe_supports() noexcept {
    visit_supports([this](int node, int component, const Scalar& now, Scalar target) {
      assembler_.prescribe(node, component, target - now);
    });
  }
  void place_supports() noexcept {
    visit_supports([](int, int, Scalar& now, Scalar target) { now = target; });
  }

  Nodes nodes_, saved_;
  detail::PerNode<ElementProperties<Scalar>, Elements, MaxElements> properties_;
  Assembler<Scalar, Elements, MaxElements> assembler_;
  std::vector<PointForce<Scalar>> forces_;
  NaturalShape<Scalar> natural_;
  Scalar length_;
  ContactMesh<Scalar> mesh_;
  Scalar axial_stiffness_, bending_stiffness_;
  std::array<End, 2> ends_;
  int contact_ = -1;
  Scalar lever_ = 0;
  Vector2<Scalar> normal_{0, 1};
  Scalar load_ = 0, saved_load_ = 0, start_load_ = 0;
  Scalar d_ = 0, start_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, unit_;
};

}  // namespace hapbeam
