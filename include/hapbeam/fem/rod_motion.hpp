// How a node of a rod moves by an increment: what turns keeps its length, and its director goes along.
//
// Real-time: noexcept, no allocation, O(1) a node.
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/fem/rod_lanes.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/unroll.hpp>

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
/// Adds an increment of r' and φ to a node.
template <typename S>
[[gnu::always_inline]] inline void move_tangent(RodNode<S>& node, const VectorOf<S, 3>& change,
                                                const S* twist) noexcept {
  set_tangent(node, turned(node.tangent, change));
  if (twist) node.director = turn<S>(node.director, unit(node.tangent), *twist);
}
/// Adds increments to the tangents of all nodes, a few at a time.
/// @tparam twists  whether there is φ   @param increment  i -> r, r' and φ, of their number and in their order
template <bool twists, class Nodes, class Increment>
void move_tangents(Nodes& nodes, Increment&& increment) noexcept {
  using Scalar = std::decay_t<decltype(nodes[0].s)>;
  using Wide = Pack<Scalar>;
  const int last = nodes.size() - 1;
  for (int first = 0; first <= last; first += Wide::size) {
    const auto abreast = Abreast<Scalar>::from(first, last);
    RodNode<Wide> node = gather_nodes(abreast, nodes);
    VectorOf<Wide, 3> change;
    for (int c = 0; c < 3; ++c) change[c] = gather(abreast, [&](int i) { return increment(i)[3 + c]; });
    if constexpr (twists) {
      const Wide twist = gather(abreast, [&](int i) { return increment(i)[6]; });
      move_tangent(node, change, &twist);
    } else {
      move_tangent<Wide>(node, change, nullptr);
    }
    scatter(abreast, [&](int i, int k) {
      nodes[i].tangent = lane(node.tangent, k), nodes[i].director = lane(node.director, k);
    });
  }
}

/// Where nodes will be that go on as they went, foresight.hpp.   @param now, before, ahead  all nodes; of those ahead, s is known
/// @tparam twists  whether their directors turn about the tangents
template <bool twists, class Nodes, typename Scalar>
void go_on(const Nodes& now, const Nodes& before, Scalar ratio, Nodes& ahead) noexcept {
  using Wide = Pack<Scalar>;
  using Vector = VectorOf<Wide, 3>;
  const int last = now.size() - 1;
  const auto twist = [](const RodNode<Wide>& from, const RodNode<Wide>& to, const Vector& v) -> Wide {
    return angle_about<Wide>(v, across<Wide>(carry<Wide>(from.director, unit(from.tangent), v), v),
                             to.director);
  };
  for (int first = 0; first <= last; first += Wide::size) {
    const auto here = Abreast<Scalar>::from(first, last), on_left = here.next(-1, last),
               on_right = here.next(1, last);
    const RodNode<Wide> x = gather_nodes(here, now), b = gather_nodes(here, before),
                        left = gather_nodes(on_left, now), right = gather_nodes(on_right, now);
    const Wide along = gather(here, [&](int i) {
      return i == 0 || i == last ? Scalar(0) : ahead[i].s - now[i].s - ratio * (now[i].s - before[i].s);
    });
    const Wide share = along / (gather(on_right, [&](int i) { return now[i].s; }) -
                                gather(on_left, [&](int i) { return now[i].s; }));
    const Wide r = ratio;
    RodNode<Wide> next{along, x.r + r * (x.r - b.r) + along * x.tangent, x.tangent, x.director};
    const Vector change = r * (x.tangent - b.tangent) + share * (right.tangent - left.tangent);
    if constexpr (twists) {
      const Vector u = unit(x.tangent);
      const Wide angle = r * twist(b, x, u) + share * (twist(left, x, u) - twist(right, x, u));
      move_tangent(next, change, &angle);
    } else {
      move_tangent<Wide>(next, change, nullptr);
    }
    scatter(here, [&](int i, int k) {
      ahead[i].r = lane(next.r, k);
      ahead[i].tangent = lane(next.tangent, k), ahead[i].director = lane(next.director, k);
    });
  }
}

}  // namespace hapbeam::detail
