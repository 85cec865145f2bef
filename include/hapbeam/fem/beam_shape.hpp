// SPDX-License-Identifier: MIT
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
  using Tensions = typename Parts::Tensions;
  /// A shape, and the tensions of its elements.
  struct State {
    explicit State(int elements) : nodes(elements), tensions(elements) {}
    Nodes nodes;
    Tensions tensions;
  };
  int elements() const noexcept { return beam_.size(); }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return view(beam_.nodes()); }
  /// Other nodes of this beam, seen with its kinematics.
  Centreline<Scalar> view(const Nodes& nodes) const noexcept { return beam_.view(nodes); }
  Centreline<Scalar> view(const State& state) const noexcept { return view(state.nodes); }
  const Node& node(int i) const noexcept { return beam_.nodes()[i]; }
  /// N of an element [N].
  Scalar tension(int e) const noexcept { return beam_.tensions()[e]; }
  /// The state as it is.  @param state  out
  void keep(State& state) const noexcept {
    for (int i = 0; i <= elements(); ++i) state.nodes[i] = node(i);
    each_tension([&](int e) { state.tensions[e] = beam_.tensions()[e]; });
  }
  /// Gives each element the tension that belongs to the displacements of its nodes: where those alone were set.
  void find_tensions() noexcept { beam_.find_tensions(); }
  /// Goes on as it went from a state before, so many times as far.   @param before  becomes what the state is now
  void go_on(State& before, Scalar ratio) noexcept {
    const auto on = [ratio](Scalar& now, Scalar& then) {
      const Scalar was = now;
      now += ratio * (now - then);
      then = was;
    };
    for (int i = 0; i <= elements(); ++i) {
      Node &x = beam_.nodes()[i], &b = before.nodes[i];
      on(x.u, b.u), on(x.w, b.w), on(x.theta, b.theta);
    }
    each_tension([&](int e) { on(beam_.tensions()[e], before.tensions[e]); });
  }
  /// What goes on as from one state to another.  @param from  becomes the state now, less the way from there to `to`
  void carry(State& from, const State& to) const noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Node &x = node(i), &b = to.nodes[i];
      Node& a = from.nodes[i];
      a = {x.s, x.u - (b.u - a.u), x.w - (b.w - a.w), x.theta - (b.theta - a.theta)};
    }
    each_tension([&](int e) { from.tensions[e] += beam_.tensions()[e] - to.tensions[e]; });
  }

  /// n · (u, w) of a state at s [m].
  Scalar displacement(const State& state, Scalar s, const Vector2<Scalar>& normal) const noexcept {
    return displacement_of(view(state), s, normal);
  }
  Scalar displacement(Scalar s, const Vector2<Scalar>& normal) const noexcept {
    return displacement_of(centreline(), s, normal);
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
  static Scalar displacement_of(const Centreline<Scalar>& line, Scalar s,
                                const Vector2<Scalar>& normal) noexcept {
    const Displacement<Scalar> at = line.at(s);
    return normal.x() * at.u + normal.y() * at.w;
  }
  /// On the x axis.  @throws std::invalid_argument as BeamElements
  BeamShape(const Beam& beam, int elements)
      : beam_(beam, elements), saved_(elements), length_(static_cast<Scalar>(beam.length())) {}

  void set(const State& state) noexcept { beam_.set(state.nodes, state.tensions); }
  /// The shape of the same beam in another scalar, on the same mesh.
  template <class Other>
  void take(const Other& other) noexcept {
    for (int i = 0; i <= elements(); ++i) {
      Node& to = beam_.nodes()[i];
      to.u = static_cast<Scalar>(other.node(i).u);
      to.w = static_cast<Scalar>(other.node(i).w);
      to.theta = static_cast<Scalar>(other.node(i).theta);
    }
    each_tension([&](int e) { beam_.tensions()[e] = static_cast<Scalar>(other.tension(e)); });
  }
  /// To the shape that was kept.
  void take_back() noexcept {
    for (int i = 0; i <= elements(); ++i) beam_.nodes()[i] = saved_.nodes[i];
    each_tension([&](int e) { beam_.tensions()[e] = saved_.tensions[e]; });
  }

  /// A touched element has one whatever it is made of.
  template <class F>
  void each_tension(F&& f) const noexcept {
    for (int e = 0; e < elements(); ++e) f(e);
  }

  Parts beam_;
  State saved_;
  Scalar length_;
};

}  // namespace hapbeam::detail
