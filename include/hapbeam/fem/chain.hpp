// SPDX-License-Identifier: MIT
// How large increments are added to a beam that turns: element by element, as a chain.
//
// The displacements that one Newton step finds are those of a linear beam.  Added as they are, they lengthen every
// element that turns by its angle squared, and EA times that drowns the load: Newton then needs small steps, and the
// smaller the more elements there are.  Here each element turns by its angle and keeps the normal force that the tangent
// foresees, and the chain is laid from its left end.  What it then misses of a held right end is shared out along the
// arc.  A cantilever bends into a full circle in one step of two iterations, whatever the number of elements and however
// stiff the beam is against stretching.
// Not for a beam that is held at a contact: its turns are small from tick to tick, and what the chain would miss there
// costs more iterations than the stretch does.
// Real-time: noexcept, no allocation, O(n).
#pragma once

#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/supports.hpp>

namespace hapbeam::detail {

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
