// The shape of a beam while its equations are solved, and the shapes that it had: what of a BeamSystem no equation needs.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/fem/beam_elements.hpp>

namespace hapbeam::detail {

/// Base class of a BeamSystem.
template <class Element, typename Scalar, int Elements, int MaxElements>
class BeamShape {
 protected:
  using Parts = BeamElements<Element, Scalar, Elements, MaxElements>;

 public:
  using Node = CentrelineNode<Scalar>;
  using Nodes = typename Parts::Nodes;
  using State = Nodes;
  using Mesh = typename Parts::Mesh;

  int elements() const noexcept { return beam_.size(); }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return view(beam_.nodes()); }
  /// Other nodes of this beam, seen with its kinematics.
  Centreline<Scalar> view(const Nodes& nodes) const noexcept { return beam_.view(nodes); }
  const Node& node(int i) const noexcept { return beam_.nodes()[i]; }
  const Mesh& mesh() const noexcept { return beam_.mesh(); }
  /// Moves to another mesh of as many elements and carries the displacements over.
  void remesh(const Mesh& mesh) noexcept {
    if (!(mesh == beam_.mesh())) beam_.remesh(mesh, saved_);
  }

  /// The state as it is.  @param state  out
  void keep(State& state) const noexcept {
    for (int i = 0; i <= elements(); ++i) state[i] = node(i);
  }
  /// Gives nodes other arc positions and leaves them where they are.  @param state  in, out
  static void label(const Mesh& mesh, State& state) noexcept {
    for (int i = 0; i <= mesh.elements(); ++i) {
      Node& node = state[i];
      const Scalar s = mesh.position(i);
      node.u -= s - node.s;
      node.s = s;
    }
  }
  /// Goes on as it went from a state before, so many times as far, to a mesh with the same node at the contact: foresight.hpp.
  /// @param before  becomes what the state is now
  void go_on(State& before, const Mesh& mesh, Scalar ratio) noexcept {
    const int n = elements();
    for (int i = 0; i <= n; ++i) {
      const Node &x = node(i), &b = before[i];
      Node& ahead = saved_[i];
      ahead = {mesh.position(i), x.u + ratio * (x.u - b.u), x.w + ratio * (x.w - b.w),
               x.theta + ratio * (x.theta - b.theta)};
      const Scalar along = ahead.s - x.s - ratio * (x.s - b.s);
      if (i == 0 || i == n || along == 0) continue;
      const Vector2<Scalar> tangent = direction(-ahead.theta);
      ahead.u += along * (tangent.x() - 1);
      ahead.w += along * tangent.y();
      ahead.theta += along * (node(i + 1).theta - node(i - 1).theta) / (node(i + 1).s - node(i - 1).s);
    }
    keep(before);
    beam_.set(mesh, saved_.data());
  }
  /// What goes on as from one state to another.  @param from  becomes the state now, less the way from there to `to`
  void carry(State& from, const State& to) const noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Node &x = node(i), &b = to[i];
      Node& a = from[i];
      a = {x.s - (b.s - a.s), x.u - (b.u - a.u), x.w - (b.w - a.w), x.theta - (b.theta - a.theta)};
    }
  }

  /// n · (u, w) of a state at s [m].
  Scalar displacement(const State& state, Scalar s, const Vector2<Scalar>& normal) const noexcept {
    const Displacement<Scalar> at = view(state).at(s);
    return normal.x() * at.u + normal.y() * at.w;
  }
  Scalar displacement(Scalar s, const Vector2<Scalar>& normal) const noexcept {
    return displacement(beam_.nodes(), s, normal);
  }
  /// Where the middle of the beam is, across [m].
  VectorOf<Scalar, 1> middle() const noexcept {
    return VectorOf<Scalar, 1>::Constant(centreline().at(length_ / 2).w);
  }
  /// Whether an element has turned so far in itself that it no longer stands for a beam.
  bool folded() const noexcept {
    for (int i = 0; i < elements(); ++i)
      if (std::abs(node(i + 1).theta - node(i).theta) > 2) return true;
    return false;
  }

 protected:
  /// On the x axis.  @throws std::invalid_argument as BeamElements
  BeamShape(const Beam& beam, int elements)
      : beam_(beam, elements), saved_(elements), length_(static_cast<Scalar>(beam.length())) {}

  void set(const Mesh& mesh, const State& state) noexcept { beam_.set(mesh, state.data()); }
  /// The shape of the same beam in another scalar, on the uniform mesh.
  template <class Other>
  void take(const Other& other) noexcept {
    const Mesh uniform(elements(), length_);
    for (int i = 0; i <= elements(); ++i)
      saved_[i] = {uniform.position(i), static_cast<Scalar>(other.node(i).u),
                   static_cast<Scalar>(other.node(i).w), static_cast<Scalar>(other.node(i).theta)};
    set(uniform, saved_);
  }
  /// Where its mesh is as it was when the shape was kept.
  void take_back() noexcept {
    for (int i = 0; i <= elements(); ++i) beam_.nodes()[i] = saved_[i];
  }

  Parts beam_;
  Nodes saved_;
  Scalar length_;
};

}  // namespace hapbeam::detail
