// SPDX-License-Identifier: MIT
// How the nodes of a beam in the plane are laid: its two ends and where they hold it, the shapes from which a search for equilibrium
// begins, a nudge off an equilibrium that gives way, and large increments as a chain.
//
// Increments that are added as vectors lengthen every element that turns by its angle squared, and EA times that exceeds the load.  As a
// chain each element turns by its angle and keeps the predicted normal force; the chain is laid from its left end, and what it misses of a
// held right end is shared out along the arc.  A cantilever bends into a full circle in one step of two iterations, on any mesh.
// Not for a beam that is held at a contact, where turns are small and what the chain would miss costs more iterations.
// Real-time: noexcept, no allocation, O(n).
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>

namespace hapbeam::detail {

/// Which displacements an end holds, and where, on the way to where it belongs.
template <typename Scalar>
struct EndSupport {
  EndSupport(Support support, const EndPlace& place) noexcept
      : held{fixes_u(support), fixes_w(support), fixes_theta(support)},
        goal{static_cast<Scalar>(place.u), static_cast<Scalar>(place.w), static_cast<Scalar>(place.theta)} {}

  /// A path to the goal begins where the end is.
  void begin(const CentrelineNode<Scalar>& node) noexcept {
    start[0] = node.u, start[1] = node.w, start[2] = node.theta;
  }
  void set_target(Scalar t) noexcept {
    for (int k = 0; k < 3; ++k) target[k] = t < 1 ? start[k] + t * (goal[k] - start[k]) : goal[k];
  }
  /// Calls visit(component, displacement, target) for what is held.  @param node const or not
  template <class Node, class Visitor>
  void visit(Node& node, Visitor&& visitor) const noexcept {
    if (held[0]) visitor(0, node.u, target[0]);
    if (held[1]) visitor(1, node.w, target[1]);
    if (held[2]) visitor(2, node.theta, target[2]);
  }

  bool held[3];    ///< u, w, θ
  Scalar goal[3];  ///< [m, m, rad]
  Scalar start[3] = {0, 0, 0}, target[3] = {0, 0, 0};
};

/// Both ends, in the equations.
template <typename Scalar>
class BeamEnds {
 public:
  BeamEnds(const Beam& beam, int last)
      : last_(last), ends_{{beam.left(), beam.left_place()}, {beam.right(), beam.right_place()}} {}

  EndSupport<Scalar>& operator[](std::size_t k) noexcept { return ends_[k]; }
  const EndSupport<Scalar>& operator[](std::size_t k) const noexcept { return ends_[k]; }

  /// A path begins where the ends are.
  template <class Nodes>
  void begin_path(const Nodes& nodes) noexcept {
    for (int k = 0; k < 2; ++k) ends_[k].begin(nodes[node(k)]);
  }
  void set_target(Scalar t) noexcept {
    for (auto& end : ends_) end.set_target(t);
  }
  /// Whether increments lead to where they belong.
  template <class Nodes>
  static constexpr bool follow(const Nodes&) noexcept {
    return true;
  }
  /// After all else is in the assembler's system.
  template <class Nodes, class Rows, class Assembler>
  void hold(const Nodes& nodes, Rows& rows, Assembler& assembler) const noexcept {
    for (int k = 0; k < 2; ++k)
      ends_[k].visit(nodes[node(k)], [&](int component, Scalar now, Scalar target) {
        rows.prescribe(node(k), component, target - now);
        assembler.prescribe(node(k), component, target - now);
      });
  }
  /// What is prescribed answers 0.   @param increments  ChainIncrements: in and out
  template <class Nodes, class Increments>
  void lead(const Nodes& nodes, Increments& increments) const noexcept {
    for (int k = 0; k < 2; ++k)
      ends_[k].visit(nodes[node(k)], [&](int component, Scalar now, Scalar target) {
        if (target == now) return;
        Vector3<Scalar> x = increments[node(k)];
        x[component] = target - now;
        increments.set(node(k), x);
      });
  }
  /// Puts them exactly where they belong.
  template <class Nodes>
  void correct(Nodes& nodes) const noexcept {
    for (int k = 0; k < 2; ++k)
      ends_[k].visit(nodes[node(k)], [](int, Scalar& now, Scalar target) { now = target; });
  }

 private:
  int node(int k) const noexcept { return k == 0 ? 0 : last_; }

  int last_;
  EndSupport<Scalar> ends_[2];
};

/// Lays the natural shape from the left end's place, turned toward the right end's place unless the left end is clamped.
/// @param nodes  in and out: where along the beam they are stays
template <typename Scalar, class Nodes>
void lay(const NaturalShape<Scalar>& shape, const EndSupport<Scalar>& left, const EndSupport<Scalar>& right,
         Nodes& nodes) noexcept {
  constexpr Scalar whole_turn = Scalar(6.283185307179586476925);
  const Scalar length = nodes[nodes.size() - 1].s;
  const Displacement<Scalar> end = shape.at(length);
  const Scalar *from = left.goal, *to = right.goal;
  Scalar turn = from[2];
  if (!left.held[2]) {
    const Scalar by_right = to[2] - end.theta;
    turn = right.held[1]
               ? std::atan2(end.w, length + end.u) - std::atan2(to[1] - from[1], length + to[0] - from[0])
               : by_right;
    if (right.held[2]) turn -= whole_turn * std::nearbyint((turn - by_right) / whole_turn);
  }
  const Scalar c = std::cos(turn), s = std::sin(turn);
  for (int i = 0; i < nodes.size(); ++i) {
    const Scalar position = nodes[i].s;
    const Displacement<Scalar> at = shape.at(position);
    const Scalar x = position + at.u;
    nodes[i] = {position, from[0] + c * x + s * at.w - position, from[1] - s * x + c * at.w, at.theta + turn};
  }
}

/// Bends a straight beam whose ends are to stand closer by some slack to one side, as far as its length allows: its search for rest begins
/// on the buckled side.
///   w = a f(s/L),  f = 16 t² (1 - t)²,  u' = -½ w'²,  a² ∫f'² dt = 2 slack L          along and across the beam
/// @param side  1: the upper, -1: the lower   @param nodes  in and out, as lay() lays a straight beam
template <typename Scalar, class Nodes>
void bow(const EndSupport<Scalar>& left, const EndSupport<Scalar>& right, Scalar side,
         Nodes& nodes) noexcept {
  const int last = nodes.size() - 1;
  const Scalar length = nodes[last].s, turn = nodes[0].theta, c = std::cos(turn), s = std::sin(turn);
  const Scalar x = length + right.goal[0] - left.goal[0], y = right.goal[1] - left.goal[1];
  const Scalar slack = length - (c * x - s * y), across = s * x + c * y;
  const Scalar round_off = 64 * std::numeric_limits<Scalar>::epsilon();
  const bool placed_across = left.held[1] && right.held[1] && std::abs(across) > round_off * length,
             facing = !right.held[2] || std::abs(right.goal[2] - turn) <= round_off * (1 + std::abs(turn));
  if (!left.held[0] || !right.held[0] || placed_across || !facing || !(slack > round_off * length)) return;
  const Scalar a = side * std::sqrt(2 * slack * length * Scalar(210. / 1024));
  const auto slope = [a, length](Scalar position) {
    const Scalar t = position / length;
    return 32 * a * t * (1 - t) * (1 - 2 * t) / length;
  };
  Scalar u = 0;
  for (int i = 0; i <= last; ++i) {
    auto& node = nodes[i];
    const Scalar t = node.s / length, w = 16 * a * t * t * (1 - t) * (1 - t);
    if (i > 0) {  // Simpson's rule
      const Scalar from = nodes[i - 1].s, before = slope(from), middle = slope((from + node.s) / 2),
                   after = slope(node.s);
      u -= (node.s - from) * (before * before + 4 * middle * middle + after * after) / 12;
    }
    node.u += c * u + s * w;
    node.w += c * w - s * u;
    node.theta -= slope(node.s);
  }
}

/// Whether loads push a beam to its lower side.  @param up, down  their work as it stands aside there [J]
template <typename Scalar>
bool push_down(Scalar up, Scalar down) noexcept {
  return down - up > std::sqrt(std::numeric_limits<Scalar>::epsilon()) * (std::abs(up) + std::abs(down));
}

/// Bends a beam a little: up, most in the middle and a little more on its right, or with a contact up on its right and
/// down on its left.
/// @param contact  arc position [m], negative where there is none   @param size  [m]   @param nodes  in and out
template <typename Scalar, class Nodes>
void nudge(Nodes& nodes, Scalar contact, Scalar size) noexcept {
  const Scalar length = nodes[nodes.size() - 1].s;
  for (auto& node : nodes) {
    // f = 16 t² (1 - t)² g(t), zero with its slope at both ends, and at the contact
    const Scalar t = node.s / length, r = 1 - t, a = 16 * size * t * r;
    const Scalar g = contact < 0 ? (3 + t) / Scalar(3.5) : 4 * (t - contact / length),
                 slope = contact < 0 ? 1 / Scalar(3.5) : Scalar(4);
    node.u += a * t * r * g * std::sin(node.theta);
    node.w += a * t * r * g * std::cos(node.theta);
    node.theta -= a * (2 * (1 - 2 * t) * g + t * r * slope) / length;
  }
}

/// Lays the chain.  @param increment  i -> [u, w, θ] of node i   @param properties  of each element   @param tensions  where they are unknowns: after it [N]
template <class Element, typename Scalar, class Nodes, class Properties, class Tensions, class Increment>
void lay_chain(Nodes& nodes, const Properties& properties, [[maybe_unused]] const Tensions& tensions,
               Increment&& increment) noexcept {
  CentrelineNode<Scalar> before = nodes[0];
  Vector3<Scalar> x = increment(0);
  Vector2<Scalar> way(x[0], x[1]);  // that the last node has moved
  nodes[0] = {before.s, before.u + x[0], before.w + x[1], before.theta + x[2]};
  for (int i = 1; i < nodes.size(); ++i) {
    const CentrelineNode<Scalar> node = nodes[i];
    const Vector3<Scalar> y = increment(i);
    const Vector6<Scalar> d(before.u, before.w, before.theta, node.u, node.w, node.theta),
        change(x[0], x[1], x[2], y[0], y[1], y[2]);
    if constexpr (has_own_tension<Element>)
      way += Element::chord_change(properties[i - 1], d, change, tensions[i - 1]);
    else way += Element::chord_change(properties[i - 1], d, change);
    nodes[i] = {node.s, node.u + way.x(), node.w + way.y(), node.theta + y[2]};
    before = node;
    x = y;
  }
}

/// Shares out what the chain misses of its right end.  A displacement that the left end does not hold moves all of it.
template <typename Scalar, class Nodes>
void close_chain(Nodes& nodes, const EndSupport<Scalar>& left, const EndSupport<Scalar>& right) noexcept {
  const CentrelineNode<Scalar>& last = nodes[nodes.size() - 1];
  const Scalar miss_u = right.held[0] ? right.target[0] - last.u : Scalar(0),
               miss_w = right.held[1] ? right.target[1] - last.w : Scalar(0), length = last.s;
  for (CentrelineNode<Scalar>& node : nodes) {
    node.u += left.held[0] ? miss_u * (node.s / length) : miss_u;
    node.w += left.held[1] ? miss_w * (node.s / length) : miss_w;
  }
}

}  // namespace hapbeam::detail
