// How a node of a rod moves by an increment: what turns keeps its length, and its director goes along.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

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
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Scalar square = v.squaredNorm(), share = v.dot(change) / square;
  const Vector3 aside = change - share * v;
  const Scalar q = aside.squaredNorm() / square;  // of the angle
  Scalar cosine, sine;                            // that over the angle
  if (q < Scalar(0.25)) {
    // Taylor's series: the first term that is left out is below 1e-17.
    constexpr double c[] = {1,          -1. / 2,       1. / 24,        -1. / 720,
                            1. / 40320, -1. / 3628800, 1. / 479001600, -1. / 87178291200};
    cosine = Scalar(c[7]), sine = Scalar(c[7] / 15);
    HAPBEAM_UNROLL
    for (int k = 6; k >= 0; --k)
      cosine = Scalar(c[k]) + q * cosine, sine = Scalar(c[k] / (2 * k + 1)) + q * sine;
  } else {
    const Scalar angle = sqrt(q);
    cosine = cos(angle), sine = sin(angle) / angle;
  }
  return (1 + share) * (cosine * v + sine * aside);
}
/// Adds an increment of r' and, where there is one, φ.   @param x  r, r', φ
template <typename Scalar, int N>
void move_tangent(RodNode<Scalar>& node, const Eigen::Matrix<Scalar, N, 1>& x) noexcept {
  const VectorOf<Scalar, 3> change = x.template segment<3>(3);
  set_tangent(node, turned(node.tangent, change));
  if constexpr (N == 7) node.director = turn(node.director, unit(node.tangent), x[6]);
}

/// Where node i will be that goes on as it went, foresight.hpp.   @param now, before  all nodes   @param s  [m] there
/// @param twists  whether its director turns about the tangent
template <class Nodes, typename Scalar>
auto gone_on(const Nodes& now, const Nodes& before, int i, Scalar s, Scalar ratio, bool twists) noexcept {
  using Vector3 = VectorOf<Scalar, 3>;
  const RodNode<Scalar>&x = now[i], &b = before[i];
  const Scalar along = i == 0 || i + 1 == now.size() ? Scalar(0) : s - x.s - ratio * (x.s - b.s);
  const Vector3 u = unit(x.tangent);
  const auto twist = [](const RodNode<Scalar>& from, const RodNode<Scalar>& to, const Vector3& v) {
    return angle_about<Scalar>(v, across<Scalar>(carry<Scalar>(from.director, unit(from.tangent), v), v),
                               to.director);
  };
  RodNode<Scalar> ahead{s, x.r + ratio * (x.r - b.r) + along * x.tangent, x.tangent, x.director};
  Vector3 change = ratio * (x.tangent - b.tangent);
  Scalar angle = twists ? ratio * twist(b, x, u) : Scalar(0);
  if (along != 0) {
    const RodNode<Scalar>&left = now[i - 1], &right = now[i + 1];
    const Scalar share = along / (right.s - left.s);
    change += share * (right.tangent - left.tangent);
    if (twists) angle += share * (twist(left, x, u) - twist(right, x, u));
  }
  set_tangent(ahead, turned<Scalar>(x.tangent, change));
  if (twists) ahead.director = turn<Scalar>(ahead.director, unit(ahead.tangent), angle);
  return ahead;
}

}  // namespace hapbeam::detail
