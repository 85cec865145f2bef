// SPDX-License-Identifier: MIT
// How a node of a rod moves by an increment: what turns keeps its length, and its director goes along.
//
// Real-time: noexcept, no allocation, O(1) a node.
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// Gives a node another tangent; its director is carried along.
template <typename Scalar>
void set_tangent(RodNode<Scalar>& node, const VectorOf<Scalar, 3>& tangent) noexcept {
  using Vector3 = VectorOf<Scalar, 3>;
  const Vector3 u = unit(node.tangent), v = unit(tangent);
  node.tangent = tangent;
  node.director = across<Scalar>(carry(node.director, u, v), v);
}
/// v + change, but as long as the part of the change along v makes it, and turned by the angle that the rest means.
template <typename Scalar>
VectorOf<Scalar, 3> turned(const VectorOf<Scalar, 3>& v, const VectorOf<Scalar, 3>& change) noexcept {
  using Vector3 = VectorOf<Scalar, 3>;
  const Scalar square = v.squaredNorm(), share = v.dot(change) / square;
  const Vector3 aside = change - share * v;
  Scalar cosine, sine;  // of the angle, that over the angle
  cos_and_sin_of_square(Scalar(aside.squaredNorm() / square), cosine, sine);
  return (1 + share) * (cosine * v + sine * aside);
}
/// Adds an increment of r' and φ to a node, as turned() and set_tangent() do, in an order in which a processor waits little.
template <typename S>
[[gnu::always_inline]] inline void move_tangent(RodNode<S>& node, const VectorOf<S, 3>& change,
                                                const S* twist) noexcept {
  using std::sqrt;
  using V = VectorOf<S, 3>;
  const V& t = node.tangent;
  const S square = t.squaredNorm(), inverse = 1 / square, i = sqrt(inverse);
  const S share = t.dot(change) * inverse;
  S cosine, sine;  // of the angle, that over the angle
  cos_and_sin_of_square(S(change.squaredNorm() * inverse - share * share), cosine, sine);
  // Component by component, as in round_twist.hpp.
  const auto each = [](auto&& f) HAPBEAM_INLINED {
    V made;
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) made[k] = f(k);
    return made;
  };
  const V u = i * t;
  const S of_u = cosine - sine * share, of_change = sine * i;
  const V v = each([&](int k) HAPBEAM_INLINED { return add_product(S(of_u * u[k]), of_change, change[k]); });
  // Carried along as carry() does, which leaves what is across u across v.
  const V& d = node.director;
  const S stretch = S(1.5) - S(0.5) * d.squaredNorm(), part = share_of(stretch, S(1 + cosine));
  const S back = v.dot(d) * part;
  V e = each([&](int k) HAPBEAM_INLINED { return S(stretch * d[k] - back * (u[k] + v[k])); });
  if (twist) e = turn<S>(e, v, *twist);
  node.tangent = ((1 + share) * square * i) * v, node.director = e;
}
/// Adds increments to all nodes, a few at a time; to their tangents and directors alone where chords turn their places.
/// @tparam twists  whether there is φ
template <bool twists, class Nodes, class Increments>
[[gnu::flatten]] void move_nodes(Nodes& nodes, const Increments& increments, bool places) noexcept {
  increments.visit([&](const auto& which, const auto& x) {
    using Wide = typename std::decay_t<decltype(which)>::Wide;
    using Vector = VectorOf<Wide, 3>;
    RodNode<Wide> node = gather_nodes(which, nodes);
    const Vector change(x(3), x(4), x(5));
    if constexpr (twists) {
      const Wide twist = x(6);
      move_tangent(node, change, &twist);
    } else {
      move_tangent<Wide>(node, change, nullptr);
    }
    if (places) node.r += Vector(x(0), x(1), x(2));
    scatter_nodes(which, node, nodes);
  });
}
/// Moves places alone: each chord turns as the difference of the increments at its ends says, from the first node on.
template <class Nodes, class Increments>
void turn_chords(Nodes& nodes, const Increments& increments) noexcept {
  using Vector3 = std::decay_t<decltype(nodes[0].r)>;
  Vector3 way = increments[0].template head<3>(),
          r = nodes[0].r;  // that the last node has gone, and where it was
  nodes[0].r += way;
  for (int i = 1; i < nodes.size(); ++i) {
    auto& to = nodes[i];
    const Vector3 chord = to.r - r,
                  change = increments[i].template head<3>() - increments[i - 1].template head<3>();
    way += turned(chord, change) - chord;
    r = to.r;
    to.r += way;
  }
}

/// Extrapolates nodes, times a ratio.   @param then  in: before the last step, out: the present ones
/// @tparam twists  whether their directors turn about the tangents
template <bool twists, class Nodes, typename Scalar>
[[gnu::flatten]] void go_on(Nodes& now, Nodes& then, Scalar ratio) noexcept {
  for_each_abreast<Scalar>(now.size() - 1, [&](const auto& here) {
    using Wide = typename std::decay_t<decltype(here)>::Wide;
    using Vector = VectorOf<Wide, 3>;
    const RodNode<Wide> x = gather_nodes(here, now), before = gather_nodes<twists>(here, then);
    const Wide onward = ratio;
    RodNode<Wide> next = x;
    Vector change;
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      next.r[k] += onward * (x.r[k] - before.r[k]);
      change[k] = onward * (x.tangent[k] - before.tangent[k]);
    }
    if constexpr (twists) {
      const Vector u = unit(x.tangent);
      const Vector from = across(carry(before.director, unit(before.tangent), u), u);
      const Wide angle = onward * angle_about(u, from, x.director);
      move_tangent(next, change, &angle);
    } else {
      move_tangent<Wide>(next, change, nullptr);
    }
    scatter_nodes(here, next, then);
  });
  now.swap(then);
}

}  // namespace hapbeam::detail
