// SPDX-License-Identifier: MIT
// The deformed centreline of a rod in space, as the models hand it out: nodes joined by cubics.
//
// A view: it owns nothing and is valid until the model that gave it is called again.  Each piece is the cubic that its
// elements compute with, whose ends have the places r and the tangents dr/ds of both nodes.
// No allocation, noexcept, O(1) but for the search of the piece, which is O(log n).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam {

/// The axis of an avatar in space, from its tip to its other end; a point where `way` is zero.
template <typename Scalar>
struct Shaft {
  VectorOf<Scalar, 3> tip{0, 0, 0};  ///< [m]
  VectorOf<Scalar, 3> way{0, 0, 0};  ///< [m] from the tip to the other end

  /// Where along the way, 0 to 1, it is nearest to a point.
  [[nodiscard]] Scalar nearest(const VectorOf<Scalar, 3>& point) const noexcept {
    const Scalar squared = way.squaredNorm();
    if (!(squared > 0)) return 0;
    return std::clamp(way.dot(point - tip) / squared, Scalar(0), Scalar(1));
  }
  [[nodiscard]] VectorOf<Scalar, 3> at(Scalar t) const noexcept { return tip + t * way; }
};

template <typename Scalar>
struct RodNode {
  Scalar s;                      ///< [m] arc position along the rod when it is not loaded
  VectorOf<Scalar, 3> r;         ///< [m] place
  VectorOf<Scalar, 3> tangent;   ///< dr/ds: 1 + ε long
  VectorOf<Scalar, 3> director;  ///< d1 of the section, a unit vector across the tangent; d2 = tangent × d1

  VectorOf<Scalar, 3> position() const noexcept { return r; }  ///< [m] as of a planar centreline
};

template <typename Scalar>
struct RodPoint {
  VectorOf<Scalar, 3> r;        ///< [m]
  VectorOf<Scalar, 3> tangent;  ///< dr/ds
};

template <typename Scalar>
class Centreline<Scalar, 3> : public detail::NodeView<RodNode<Scalar>, Scalar> {
  using Base = detail::NodeView<RodNode<Scalar>, Scalar>;
  using Base::nodes_, Base::mean_beside;

 public:
  using Base::Base, Base::segment_at, Base::segments;
  using typename Base::Node;

  /// The piece between nodes i and i + 1 [m].
  CubicSegment<Scalar, 3> segment(int i) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const Scalar third = (b.s - a.s) / 3;
    CubicSegment<Scalar, 3> control;
    control.col(0) = a.r;
    control.col(1) = a.r + third * a.tangent;
    control.col(2) = b.r - third * b.tangent;
    control.col(3) = b.r;
    return control;
  }
  /// How far a shaft lies ahead of node i, in units of the node's tangent [m].
  Scalar ahead(int i, const Shaft<Scalar>& shaft) const noexcept {
    const VectorOf<Scalar, 3>& r = nodes_[i].r;
    return nodes_[i].tangent.dot(shaft.at(shaft.nearest(r)) - r);
  }
  /// Whether no point of piece i is within d of a shaft, as its nodes alone show.  Its inner control points are a third of its length times |dr/ds| from
  /// its nodes, hence no point is farther than 3/4 of that from the chord.
  bool excludes(int i, const Shaft<Scalar>& shaft, Scalar d) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const VectorOf<Scalar, 3> middle = (a.r + b.r) / 2;
    // Half a chord and a quarter of its length, with x + y <= √(2x² + 2y²), squared.  2 % for round-off, which may lengthen what is
    // computed of the piece.
    const Scalar least = Scalar(1.02) * ((b.r - a.r).squaredNorm() / 2 + longest(a, b) / 8);
    return detail::is_far(shaft.at(shaft.nearest(middle)) - middle, least, d);
  }
  /// Whether piece i is as long as its chord, as what turns by less than a radian is.
  bool straight(int i) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    return (b.r - a.r).squaredNorm() > Scalar(0.97) * longest(a, b);
  }
  /// Calls visit(i, segment(i)) for each piece, in order.
  template <class Visitor>
  void visit_segments(Visitor&& visitor) const noexcept {
    for (int i = 0; i < segments(); ++i) visitor(i, segment(i));
  }

  /// Curvature at node i, across its tangent and toward the centre of curvature [1/m]: the mean of both pieces.
  VectorOf<Scalar, 3> curvature(int i) const noexcept {
    using Vector = VectorOf<Scalar, 3>;
    const Vector mean = mean_beside(i, [&](int k) {
      const Node &a = nodes_[k], &b = nodes_[k + 1];
      const Scalar l = b.s - a.s;
      const Vector chord = (6 / l) * (b.r - a.r);
      return Vector((k == i ? chord - 4 * a.tangent - 2 * b.tangent : 2 * a.tangent + 4 * b.tangent - chord) /
                    l);
    });
    const Vector& t = nodes_[i].tangent;
    const Scalar squared = t.squaredNorm();
    return (mean - t * (t.dot(mean) / squared)) / squared;
  }

  /// |dr/ds| at node i.
  Scalar stretch(int i) const noexcept { return std::sqrt(nodes_[i].tangent.squaredNorm()); }
  /// The same: a node has its own.
  Scalar extrapolated_stretch(int i) const noexcept { return stretch(i); }

  /// Where the point at arc position s is [m], as in a planar centreline.
  VectorOf<Scalar, 3> position(Scalar s) const noexcept { return at(s).r; }
  RodPoint<Scalar> at(Scalar s) const noexcept { return at(segment_at(s), s); }
  /// The same, in a piece that is known to hold s.
  RodPoint<Scalar> at(int i, Scalar s) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const Scalar l = b.s - a.s, t = (s - a.s) / l, u = 1 - t;
    const VectorOf<Scalar, 3> chord = b.r - a.r;
    return {a.r + t * t * (3 - 2 * t) * chord + l * t * u * (u * a.tangent - t * b.tangent),
            6 * t * u / l * chord + u * (1 - 3 * t) * a.tangent + t * (3 * t - 2) * b.tangent};
  }
  /// A node where there is none, with the director of the one before.
  Node node_at(Scalar s) const noexcept { return node_at(segment_at(s), s); }
  Node node_at(int i, Scalar s) const noexcept {
    const RodPoint<Scalar> point = at(i, s);
    return {s, point.r, point.tangent, nodes_[i].director};
  }

 private:
  /// Square of a length of a piece, at the larger |dr/ds| of its ends [m²].
  static Scalar longest(const Node& a, const Node& b) noexcept {
    const Scalar l = b.s - a.s;
    return l * l * (std::max)(a.tangent.squaredNorm(), b.tangent.squaredNorm());
  }
};

template <typename Scalar>
bool is_finite(const RodNode<Scalar>& node) noexcept {
  return std::isfinite(node.s) && node.r.allFinite() && node.tangent.allFinite() && node.director.allFinite();
}

namespace detail {

/// a × b, without Eigen's geometry, which takes longer to compile than all of the elements.
template <typename S>
[[gnu::always_inline]] inline VectorOf<S, 3> cross3(const VectorOf<S, 3>& a,
                                                    const VectorOf<S, 3>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// part/whole, nothing where the whole is not positive.
template <typename S>
[[gnu::always_inline]] inline S share_of(const S& part, const S& whole) noexcept {
  return whole > 0 ? S(part / whole) : S(0);
}

/// x after the smallest rotation that takes u to v, both unit; x is across u.  Where they are opposite, half a turn about x.
template <typename S>
VectorOf<S, 3> carry(const VectorOf<S, 3>& x, const VectorOf<S, 3>& u, const VectorOf<S, 3>& v) noexcept {
  return x - share_of(S(v.dot(x)), S(1 + u.dot(v))) * (u + v);
}

/// x, which is across the unit vector v, turned about it.
template <typename S>
VectorOf<S, 3> turn(const VectorOf<S, 3>& x, const VectorOf<S, 3>& v, S angle) noexcept {
  S cosine, sine;
  cos_and_sin(angle, cosine, sine);
  return cosine * x + sine * cross3(v, x);
}

/// A unit vector along x, less its part along the unit vector v.
template <typename S>
VectorOf<S, 3> across(const VectorOf<S, 3>& x, const VectorOf<S, 3>& v) noexcept {
  using std::sqrt;
  const VectorOf<S, 3> y = x - v.dot(x) * v;
  return y / sqrt(y.squaredNorm());
}

/// A unit vector across the unit vector v.
template <typename S>
VectorOf<S, 3> beside(const VectorOf<S, 3>& v) noexcept {
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(v[k]) < std::abs(v[least])) least = k;
  return across<S>(VectorOf<S, 3>::Unit(least), v);
}

template <typename S>
VectorOf<S, 3> unit(const VectorOf<S, 3>& x) noexcept {
  using std::sqrt;
  return x / sqrt(x.squaredNorm());
}

/// The angle by which `from` has to be turned about the unit vector v to lie along `to`; all three are perpendicular.
template <typename S>
S angle_about(const VectorOf<S, 3>& v, const VectorOf<S, 3>& from, const VectorOf<S, 3>& to) noexcept {
  using std::atan2;
  using std::sqrt;
  const S y = v.dot(cross3(from, to)), x = from.dot(to);
  if constexpr (sizeof(S) <= sizeof(double)) return angle(y, x, sqrt(x * x + y * y));
  else return atan2(y, x);
}

}  // namespace detail

}  // namespace hapbeam
