// How a node of a rod moves by an increment: what turns keeps its length, and its director goes along.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/rod_centreline.hpp>

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
  const Scalar length = sqrt(v.squaredNorm());
  const Vector3 u = v / length;
  const Scalar extends = u.dot(change);
  const Vector3 aside = change - extends * u;
  const Scalar size = sqrt(aside.squaredNorm()), angle = size / length;
  if (size == 0) return v + change;
  return (length + extends) * (cos(angle) * u + (sin(angle) / size) * aside);
}
/// Adds an increment of r' and, where there is one, φ.   @param x  r, r', φ
template <typename Scalar, int N>
void move_tangent(RodNode<Scalar>& node, const Eigen::Matrix<Scalar, N, 1>& x) noexcept {
  const VectorOf<Scalar, 3> change = x.template segment<3>(3);
  set_tangent(node, turned(node.tangent, change));
  if constexpr (N == 7) node.director = turn(node.director, unit(node.tangent), x[6]);
}

}  // namespace hapbeam::detail
