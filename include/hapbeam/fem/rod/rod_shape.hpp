// SPDX-License-Identifier: MIT
// The shape of a rod while its equations are solved, and the shapes that it had: what of a RodSystem no equation needs.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/fem/rod/rod_elements.hpp>
#include <hapbeam/fem/rod/rod_motion.hpp>

namespace hapbeam::detail {

/// Base class of a RodSystem.
template <class Element, typename Scalar, int Elements, int MaxElements>
class RodShape {
 protected:
  using Parts = RodElements<Element, Scalar, Elements, MaxElements>;

 public:
  using Node = RodNode<Scalar>;
  using Nodes = typename Parts::Nodes;
  using Twists = typename Parts::Twists;
  using Vector3 = VectorOf<Scalar, 3>;
  static constexpr int unknowns = Element::unknowns;

  int elements() const noexcept { return rod_.size(); }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar, 3> centreline() const noexcept { return view(rod_.nodes()); }
  Centreline<Scalar, 3> view(const Nodes& nodes) const noexcept { return rod_.view(nodes); }
  const Node& node(int i) const noexcept { return rod_.nodes()[i]; }
  const Twists& twists() const noexcept { return rod_.twists(); }
  /// What is an element's own, as of the last tangent.
  typename Parts::Inner inner(int e) const noexcept { return rod_.inner(e); }
  /// What changes as the rod moves.
  struct State {
    explicit State(int elements) : nodes(elements), twists(elements) {}
    Nodes nodes;
    Twists twists;  // ψ of the elements

    /// What the rod has, which may have anything then.
    void take(Parts& rod) noexcept {
      nodes.take(rod.nodes());
      twists.take(rod.twists());
    }
  };
  Centreline<Scalar, 3> view(const State& state) const noexcept { return view(state.nodes); }
  /// The state as it is.  @param state  out
  void keep(State& state) const noexcept {
    for (int i = 0; i <= elements(); ++i) state.nodes[i] = node(i);
    each_inner([&](int e) { state.twists[e] = twists()[e]; });
  }
  /// Keeps the shape for take_back().  What moves it first leaves it behind, and nothing is copied.
  void keep_here() noexcept {
    here_ = true;
    if constexpr (!Nodes::exchanges) settle();
  }
  /// Goes on as it went from a state before, so many times as far.   @param before  becomes what the state is now
  void go_on(State& before, Scalar ratio) noexcept {
    detail::go_on<unknowns == 7>(rod_.nodes(), before.nodes, ratio, saved_.nodes);
    each_inner([&](int e) { saved_.twists[e] = twists()[e] + ratio * (twists()[e] - before.twists[e]); });
    here_ = false;
    before.take(rod_);
    rod_.take(saved_.nodes, saved_.twists);
  }
  /// What goes on as from one state to another.  @param from  becomes the state now, less the way from there to `to`
  void carry(State& from, const State& to) const noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const auto &x = node(i), &b = to.nodes[i];
      auto& a = from.nodes[i];
      a.r = x.r - (b.r - a.r);
      a.tangent = x.tangent - (b.tangent - a.tangent);
      a.director = x.director - (b.director - a.director);
    }
    each_inner([&](int e) { from.twists[e] = twists()[e] - (to.twists[e] - from.twists[e]); });
  }

  /// n · r of a state at s [m].
  Scalar displacement(const State& state, Scalar s, const Vector3& normal) const noexcept {
    return normal.dot(view(state).at(s).r);
  }
  Scalar displacement(Scalar s, const Vector3& normal) const noexcept {
    return normal.dot(centreline().at(s).r);
  }
  /// Where the middle of the rod is [m].
  Vector3 middle() const noexcept { return centreline().at(length_ / 2).r; }
  /// Whether an element has turned so far in itself that it no longer stands for a rod.
  bool folded() const noexcept {
    for (int i = 0; i < elements(); ++i)
      if (unit(node(i).tangent).dot(unit(node(i + 1).tangent)) < Scalar(-0.4)) return true;
    return false;
  }
  /// |Δ| of an increment that is the round-off of places, which stretches the shortest element [√J].
  Scalar round_off() const noexcept {
    const int n = elements();
    const Scalar shortest = (std::min)(node(1).s, length_ - node(n - 1).s),
                 farthest = std::sqrt(node(0).r.squaredNorm()) + length_;
    return std::numeric_limits<Scalar>::epsilon() * farthest *
           std::sqrt(axial_ * static_cast<Scalar>(n) / shortest);
  }

 protected:
  /// In its natural shape.  @throws std::invalid_argument as RodElements
  RodShape(const Rod& rod, int elements)
      : rod_(rod, elements),
        saved_(elements),
        length_(static_cast<Scalar>(rod.length())),
        axial_(static_cast<Scalar>(rod.stiffness().axial)) {}

  void set(const State& state) noexcept {
    settle();
    rod_.set(state.nodes, state.twists);
  }
  /// Adds increments.   @param increments  RodIncrements   @param chords  whether chords turn places
  template <class Increments>
  void move(const Increments& increments, bool chords) noexcept {
    if (chords) {
      settle();
      turn_chords(rod_.nodes(), increments);
    }
    const bool leaves = here_;
    here_ = false;
    if (leaves) each_inner([&](int e) { saved_.twists[e] = twists()[e]; });
    rod_.advance_inners(increments);
    move_nodes<unknowns == 7>(rod_.nodes(), increments, !chords, leaves ? saved_.nodes : rod_.nodes());
    if (leaves) rod_.nodes().exchange(saved_.nodes);
  }
  /// The shape of the same rod in another scalar, on the same mesh.
  template <class Other>
  void take(const Other& other) noexcept {
    const auto vector = [](const auto& x) { return Vector3(x.template cast<Scalar>()); };
    for (int i = 0; i <= elements(); ++i) {
      const auto& n = other.node(i);
      saved_.nodes[i] = {node(i).s, vector(n.r), vector(n.tangent), vector(n.director)};
    }
    each_inner([&](int e) { saved_.twists[e] = static_cast<Scalar>(other.twists()[e]); });
    here_ = false;
    set(saved_);
  }
  /// To the shape that was kept.
  void take_back() noexcept {
    if (here_) return;
    for (int i = 0; i <= elements(); ++i) rod_.nodes()[i] = saved_.nodes[i];
    each_inner([this](int e) { rod_.twists()[e] = saved_.twists[e]; });
  }
  /// Bends the rod a little.
  /// @param e  how far and where to [m]   @param c  where the bow changes its side, of the length; negative: nowhere
  void bow(const Vector3& e, Scalar c) noexcept {
    settle();
    for (Node& node : rod_.nodes()) {
      const Scalar t = node.s / length_, q = 1 - t, f = 16 * t * t * q * q,
                   g = c < 0 ? (3 + t) / Scalar(3.5) : 4 * (t - c),
                   slope = 32 * t * q * (1 - 2 * t) * g + f * (c < 0 ? 1 / Scalar(3.5) : Scalar(4));
      node.r += f * g * e;
      set_tangent<Scalar>(node, node.tangent + slope / length_ * e);
    }
  }

  Parts rod_;
  State saved_;
  Scalar length_, axial_;

 private:
  /// Calls f(element) for those with a twist of their own.
  template <class F>
  void each_inner(F&& f) const noexcept {
    for (int e = 0; rod_.has_inner() && e < elements(); ++e) f(e);
  }
  /// Before something else moves the shape.
  void settle() noexcept {
    if (here_) keep(saved_);
    here_ = false;
  }

  bool here_ = false;  // what was kept is the shape as it is
};

}  // namespace hapbeam::detail
