// SPDX-License-Identifier: MIT
// Where a beam and an avatar touch, and how far their surfaces slip from one such place to another.
//
//   slip = t Δs + R Δn - a Δλ - Δo      s, λ: lengths along beam, as it is stretched, and avatar's axis, t, a: their directions, n: normal
//
// R is the reach, from the avatar's axis to the centreline, or from o off that.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// How a circle or a capsule lies beside a node, as if the curve were straight there.
template <typename Scalar, int D>
struct RoundView {
  VectorOf<Scalar, D> normal;  ///< unit, toward the centre or the axis
  Scalar distance;             ///< of that from the curve, negative: from its other side [m]
  Scalar ahead;                ///< arc length from the node to where they would touch [m]
  bool past_end;               ///< the end point is touched
};

/// On the beam, and on what touches it.
template <typename Scalar, int D>
struct FrictionPlace {
  using Vector = VectorOf<Scalar, D>;
  Scalar s = 0;                                            ///< [m] arc position of a node of the beam
  Scalar ahead = 0;                                        ///< [m] from there, along the stretched beam
  Vector normal = Vector::Zero(), along = Vector::Zero();  ///< unit; along the beam
  Scalar place = 0;                                        ///< [m] on the avatar's axis
  Vector axis = Vector::Zero();                            ///< its direction
  Vector off = Vector::Zero();                             ///< [m] o; in the plane of a beam none

  /// What lies across the normal of another place, turned with it to this one.
  Vector carried(const Vector& v, const FrictionPlace& from) const noexcept {
    if constexpr (D == 2) return v.dot(from.along) * along;
    else return carry<Scalar>(v, from.normal, normal);
  }
  /// Across the normal [m].   @param stretch  |dr/ds| of the beam   @param reach  [m]
  Vector slip(const FrictionPlace& from, Scalar stretch, Scalar reach) const noexcept {
    const Vector &m = from.normal, &n = normal;
    const Scalar moved = stretch * (s - from.s) + ahead - from.ahead, cosine = m.dot(n);
    if (!(cosine > 0)) return Vector::Zero();  // touched from elsewhere
    if constexpr (D == 2) {
      const Scalar turned = std::atan2(m.x() * n.y() - m.y() * n.x(), cosine);
      return moved * along + reach * turned * Vector(-n.y(), n.x());
    } else {
      const Vector turn = n - m, middle = unit<Scalar>(m + n);
      const Scalar half = std::sqrt(turn.squaredNorm()) / 2;
      Vector v = moved / 2 * (from.along + along) - (place - from.place) / 2 * (from.axis + axis) -
                 (off - from.off) +
                 (half > 0 ? reach * std::asin((std::min)(half, Scalar(1))) / half : reach) * turn;
      v -= middle * middle.dot(v);
      return carry<Scalar>(v, middle, n);
    }
  }
};

}  // namespace hapbeam::detail
