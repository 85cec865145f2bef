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

#include <array>
#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/block_tridiagonal.hpp>
#include <hapbeam/fem/chain.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/contact_point.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/natural_shape.hpp>
#include <hapbeam/fem/newton_raphson.hpp>
#include <hapbeam/fem/starting_shapes.hpp>
#include <hapbeam/fem/supports.hpp>

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
        loads_(beam, elements),
        natural_(beam),
        length_(static_cast<Scalar>(beam.length())),
        mesh_(elements, length_),
        axial_stiffness_(static_cast<Scalar>(beam.axial_stiffness())),
        bending_stiffness_(static_cast<Scalar>(beam.bending_stiffness())),
        ends_{detail::EndSupport<Scalar>(beam.left(), beam.left_place()),
              detail::EndSupport<Scalar>(beam.right(), beam.right_place())},
        unit_(std::sqrt(bending_stiffness_ / length_)) {
    detail::lay(natural_, ends_[0], ends_[1], mesh_, nodes_);
    if (natural_.straight()) detail::bow(ends_[0], ends_[1], nodes_);
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
    contact_ = {};
    begin_path();
  }
  /// The same with a contact: d = n · (u, w) at its node or, beside an end that yields, at a distance on a straight tip.
  /// @param contact node   @param d [m]   @param lever [m] from the node to the contact, along the beam
  /// @param normal n, a unit vector; other than (0, 1) where the element is right at any rotation
  void set_goal(int contact, Scalar d, Scalar lever = 0, const Vector2<Scalar>& normal = {0, 1}) noexcept {
    contact_ = {contact, lever, normal};
    start_d_ = contact_.displacement(nodes_[contact]);
    goal_d_ = d;
    begin_path();
  }

  // What NewtonRaphson asks of a system.

  void set_target(Scalar t) noexcept {
    const auto between = [t](Scalar start, Scalar goal) { return t < 1 ? start + t * (goal - start) : goal; };
    load_ = between(start_load_, 1);
    d_ = between(start_d_, goal_d_);
    for (auto& end : ends_) end.set_target(t);
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
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    advance();
    return {status, increment()};
  }

  // What Descent asks beyond that: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each displacement and EI/L on each rotation,
  ///               shared out over the nodes   @return ok | singular | non_finite
  Status factor(Scalar shift) noexcept { return assemble_and_solve<false>(shift); }
  /// Adds the increment to the state.
  void advance() noexcept {
    const auto change = [this](int i) { return increment(i); };
    if (any_rotation<Element> && contact_.node() < 0) {
      if constexpr (any_rotation<Element>) detail::lay_chain<Element, Scalar>(nodes_, properties_, change);
      detail::close_chain(nodes_, ends_[0], ends_[1]);
      place_ends();
    } else {
      move(change);
    }
  }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept { return std::sqrt(std::abs(assembler_.energy())); }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  /// How many directions there are along which the tangent of the last increment is not stiff but gives way.
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  /// Bends the beam a little where nothing makes it leave an equilibrium.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const int c = contact_.node();
    detail::nudge(nodes_, c < 0 ? Scalar(-1) : nodes_[c].s, size);
  }

  // What ArcLength asks beyond that.

  /// Lets go of the contact, places the ends and sets the factor λ on all dead loads, which goes where it likes.
  void set_load(Scalar factor) noexcept {
    contact_ = {};
    for (auto& end : ends_) end.set_target(1);
    load_ = factor;
  }
  Scalar load() const noexcept { return load_; }
  /// As factor(0), but for the rate of the state with λ, K⁻¹f.
  Status load_rate() noexcept { return assemble_and_solve<true>(0); }
  /// Of node i after factor() or load_rate() [u, w, θ].
  Vector3<Scalar> increment(int i) const noexcept {
    return contact_.holds(i) ? contact_.back(assembler_.increment(i)) : assembler_.increment(i);
  }
  /// Adds to the state.  @param change  i -> [u, w, θ]
  template <class Change>
  void move(Change&& change) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) {
      const Vector3<Scalar> x = change(i);
      nodes_[i].u += x[0];
      nodes_[i].w += x[1];
      nodes_[i].theta += x[2];
    }
    place_ends();
  }

  /// Force along n that holds the contact at d, thesis eq. 3.42 [N].
  Scalar reaction() const noexcept {
    const int c = contact_.node();
    Vector6<Scalar> r;
    Vector2<Scalar> force = Vector2<Scalar>::Zero();
    if (c < elements()) {
      residual(c, r);
      force += r.template head<2>();
    }
    if (c > 0) {
      residual(c - 1, r);
      force += r.template segment<2>(3);
    }
    return contact_.normal().dot(force);
  }

  /// Strain energy [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = 0;
    for (int e = 0; e < elements(); ++e) energy += Element::energy(properties_[e], displacements(e));
    return energy;
  }

 private:
  int end(std::size_t k) const noexcept { return k == 0 ? 0 : elements(); }

  void begin_path() noexcept {
    start_load_ = load_;
    for (const std::size_t k : {0, 1}) ends_[k].begin(nodes_[end(k)]);
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

  /// @tparam Rate  whether the right-hand side is that of load_rate()
  template <bool Rate>
  Status assemble_and_solve(Scalar shift) noexcept {
    Matrix6<Scalar> K;
    Vector6<Scalar> r;
    Scalar energy = 0, work = 0;
    for (int e = 0; e < elements(); ++e) {
      const Vector6<Scalar> d = displacements(e);
      energy += Element::tangent(properties_[e], d, r, K);
      work += subtract_loads(e, load_, d, r, &K);
      if (Rate) {
        r.setZero();
        subtract_loads(e, 1, d, r, nullptr);
      }
      if (contact_.holds(e)) contact_.transform(nodes_[e], true, r, K);
      if (contact_.holds(e + 1)) contact_.transform(nodes_[e + 1], false, r, K);
      assembler_.add(e, K, r);
    }
    size_ = std::sqrt(2 * energy);
    potential_ = energy - work;
    if (shift != 0) add_shift(shift);
    for (const std::size_t k : {0, 1})
      ends_[k].visit(nodes_[end(k)], [&](int component, Scalar now, Scalar target) {
        assembler_.prescribe(end(k), component, target - now);
      });
    const int c = contact_.node();
    if (c >= 0) assembler_.prescribe(c, 1, d_ - contact_.displacement(nodes_[c]));
    return assembler_.solve();
  }

  /// Puts the ends and the contact exactly where they belong.
  void place_ends() noexcept {
    for (const std::size_t k : {0, 1})
      ends_[k].visit(nodes_[end(k)], [](int, Scalar& now, Scalar target) { now = target; });
    if (contact_.node() >= 0) contact_.correct(nodes_[contact_.node()], d_);
  }

  /// Residual of one element under its loads.
  void residual(int e, Vector6<Scalar>& r) const noexcept {
    const Vector6<Scalar> d = displacements(e);
    Element::residual(properties_[e], d, r);
    subtract_loads(e, load_, d, r, nullptr);
  }
  /// Takes λ times the loads of an element from its residual and, unless null, its tangent.  @return their work [J]
  Scalar subtract_loads(int e, Scalar lambda, const Vector6<Scalar>& d, Vector6<Scalar>& r,
                        Matrix6<Scalar>* K) const noexcept {
    if (lambda == 0 || loads_.empty()) return 0;
    return loads_.template subtract<any_rotation<Element>>(nodes_[e].s, nodes_[e + 1].s, e + 1 == elements(),
                                                           lambda, properties_[e], d, r, K);
  }

  void add_shift(Scalar shift) noexcept {
    const Scalar across = shift * unit_ * unit_ / (length_ * length_), about = shift * unit_ * unit_;
    for (int e = 0; e < elements(); ++e) {
      const Scalar share = properties_[e].length / (2 * length_);
      const Vector3<Scalar> diagonal(share * across, share * across, share * about);
      assembler_.add_diagonal(e, diagonal);
      assembler_.add_diagonal(e + 1, diagonal);
    }
  }

  Nodes nodes_, saved_;
  detail::PerNode<ElementProperties<Scalar>, Elements, MaxElements> properties_;
  Assembler<Scalar, Elements, MaxElements> assembler_;
  DeadLoads<Scalar> loads_;
  NaturalShape<Scalar> natural_;
  Scalar length_;
  ContactMesh<Scalar> mesh_;
  Scalar axial_stiffness_, bending_stiffness_;
  std::array<detail::EndSupport<Scalar>, 2> ends_;
  detail::ContactPoint<Scalar, any_rotation<Element>> contact_;
  Scalar load_ = 0, saved_load_ = 0, start_load_ = 0;
  Scalar d_ = 0, start_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, potential_ = 0, unit_;
};

}  // namespace hapbeam
