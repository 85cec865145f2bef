// SPDX-License-Identifier: MIT
// The shape that a beam has by nature, a chain of arcs, and that of a rod.
//
// An element is free of force where its ends stand to each other as those of its piece of the chain do: chord, and end
// rotations against the chord.  The chain is integrated exactly, so an arc shorter than an element, a corner, does what
// it should.
//
// That of a rod is a chain of pieces of constant curvature and twist, which are helices.  In a piece the frame turns about an axis that is fixed in
// space, Ω = κ1 d1 + κ2 d2 + τ d3:
//
//   d(s) = R(Ω s) d(0),   r(s) = r(0) + (Ω·d3/Ω²) Ω s + ...       (Rodrigues, and its integral)
//
// Allocates at construction; all else is noexcept and allocation-free.
#pragma once

#include <cmath>
#include <vector>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

template <typename Scalar>
class NaturalShape {
 public:
  explicit NaturalShape(const Beam& beam) {
    for (const Arc& arc : beam.arcs())
      arcs_.push_back({static_cast<Scalar>(arc.end), static_cast<Scalar>(arc.curvature)});
  }

  bool straight() const noexcept { return arcs_.empty(); }

  /// Whether one arc ends and another, or the straight rest, begins between two places, in order.
  bool changes_within(Scalar a, Scalar b) const noexcept {
    const Piece* const arc = arc_at(a);
    return arc && arc->end < b;
  }

  /// A piece of it, seen along its chord.
  struct Ends {
    Scalar shorter;                   ///< chord over length, less 1
    Scalar a, b;                      ///< rotations of both ends against the chord [rad]
    Scalar curvature_a, curvature_b;  ///< there, within the piece [1/m]
  };
  Ends ends(Scalar from, Scalar to) const noexcept {
    const Scalar l = to - from;
    const Piece* const arc = arc_at(from);
    const Scalar curvature = arc ? arc->curvature : Scalar(0);
    if (!arc || to <= arc->end) {
      const Scalar half = curvature * l / 2;
      return {chord_excess(half), -half, half, curvature, curvature};
    }
    const Displacement<Scalar> end = between(from, to);
    const Scalar x = l + end.u, chord = std::sqrt(x * x + end.w * end.w),
                 angle = detail::angle_near(end.w, x, chord, -end.theta / 2);
    return {(end.u * (l + x) + end.w * end.w) / ((chord + l) * l), angle, end.theta + angle, curvature,
            curvature_before(to)};
  }

  /// Gives the element from s to s + p.length its natural chord and rotations against it.  To first order in the angle
  /// these are those of the linear function nearest to the natural curvature, which the cubic bends against.
  void apply(Scalar s, ElementProperties<Scalar>& p) const noexcept {
    const Scalar l = p.length;
    const Ends natural = ends(s, s + l);
    p.natural_a = l * natural.a, p.natural_b = l * natural.b, p.natural_stretch = l * natural.shorter;
  }

  /// The point at s of the natural shape that leaves its start with θ = 0.
  Displacement<Scalar> at(Scalar s) const noexcept { return between(0, s); }

 private:
  struct Piece {
    Scalar end, curvature;
  };

  /// The arc that goes on from s, null: the straight rest.
  const Piece* arc_at(Scalar s) const noexcept {
    for (const Piece& arc : arcs_)
      if (arc.end > s) return &arc;
    return nullptr;
  }

  /// Of the arc that comes to s [1/m].
  Scalar curvature_before(Scalar s) const noexcept {
    for (const Piece& arc : arcs_)
      if (arc.end >= s) return arc.curvature;
    return 0;
  }

  /// Chord of an arc over its length, less 1:  sin x/x - 1,  x half of its angle.
  static Scalar chord_excess(Scalar x) noexcept {
    if (std::abs(x) > 1) return std::sin(x) / x - 1;
    // Taylor's series
    const Scalar q = x * x, q2 = q * q, q4 = q2 * q2;
    return q *
           ((Scalar(-1. / 6) + q * Scalar(1. / 120)) + q2 * (Scalar(-1. / 5040) + q * Scalar(1. / 362880)) +
            q4 * ((Scalar(-1. / 39916800) + q * Scalar(1. / 6227020800.)) +
                  q2 * (Scalar(-1. / 1307674368000.) + q * Scalar(1. / 355687428096000.))));
  }

  /// Displacement of the end of a piece against its start, which it leaves with θ = 0.
  Displacement<Scalar> between(Scalar start, Scalar end) const noexcept {
    Displacement<Scalar> point{0, 0, 0};
    for_each_piece(start, end, [&](Scalar from, Scalar to, Scalar curvature) {
      const Scalar length = to - from, half = curvature * length / 2, direction = point.theta + half;
      const Scalar excess = chord_excess(half), quarter = std::sin(direction / 2);
      // (1 + excess) cos(direction) - 1, without the cancellation
      point.u += length * (excess * std::cos(direction) - 2 * quarter * quarter);
      point.w -= length * (1 + excess) * std::sin(direction);
      point.theta += 2 * half;
    });
    return point;
  }

  template <class Visit>
  void for_each_piece(Scalar from, Scalar to, Visit&& visit) const noexcept {
    for (const Piece& arc : arcs_) {
      if (arc.end <= from) continue;
      const Scalar end = arc.end < to ? arc.end : to;
      visit(from, end, arc.curvature);
      from = end;
      if (!(from < to)) return;
    }
    visit(from, to, Scalar(0));
  }

  std::vector<Piece> arcs_;
};

template <typename Scalar>
class NaturalRod {
  using Vector3 = VectorOf<Scalar, 3>;

 public:
  /// Laid from the left end's pose.
  explicit NaturalRod(const Rod& rod) {
    const RodPose& pose = rod.left_pose();
    RodNode<double> at{0, pose.at, pose.along, pose.director};
    NaturalRod<double>::lay(
        rod, at, [this](double end, const VectorOf<double, 3>& omega, const RodNode<double>& from) {
          pieces_.push_back({static_cast<Scalar>(end), omega.template cast<Scalar>(), cast(from)});
        });
    for (const RodArc& arc : rod.arcs())
      if (kind_ != Kind::bent)
        kind_ = arc.curvature1 != 0 || arc.curvature2 != 0 ? Kind::bent : Kind::twisted;
  }

  bool straight() const noexcept { return kind_ == Kind::straight; }
  bool bent() const noexcept { return kind_ == Kind::bent; }

  /// The node at s [m]: place, tangent and director.
  RodNode<Scalar> at(Scalar s) const noexcept {
    const Piece& piece = pieces_[detail::part_with(pieces_, s)];
    return along(piece.from, piece.omega, s - piece.from.s);
  }
  /// Goes a way s along a piece that begins at a node.
  static RodNode<Scalar> along(const RodNode<Scalar>& from, const Vector3& omega, Scalar s) noexcept {
    const Scalar square = omega.squaredNorm(), rate = std::sqrt(square), angle = rate * s;
    RodNode<Scalar> to{from.s + s, from.r + s * from.tangent, from.tangent, from.director};
    if (angle == 0) return to;
    // sin x/x, (1 - cos x)/x² and (x - sin x)/x³, without cancellation where x is small
    const Scalar x = angle * angle, half = std::sin(angle / 2);
    const Scalar a = std::sin(angle) / angle, b = 2 * half * half / x,
                 c = x < Scalar(0.01) ? (1 - x / 20 * (1 - x / 42)) / 6 : (1 - a) / x;
    const auto turned = [&](const Vector3& v) -> Vector3 {
      const Vector3 w = s * detail::cross3(omega, v);
      return v + a * w + b * s * detail::cross3(omega, w);
    };
    const Vector3 w = s * detail::cross3(omega, from.tangent);
    to.r += s * (b * w + c * s * detail::cross3(omega, w));
    to.tangent = turned(from.tangent);
    to.director = turned(from.director);
    return to;
  }

  /// Calls add(end, Ω, first node) for each piece, in order.
  template <class Add>
  static void lay(const Rod& rod, RodNode<Scalar> at, Add&& add) {
    const auto go = [&](double end, double k1, double k2, double twist) {
      const Vector3 omega =
          k1 * at.director + k2 * detail::cross3(at.tangent, at.director) + twist * at.tangent;
      add(end, omega, at);
      at = along(at, omega, end - at.s);
    };
    for (const RodArc& arc : rod.arcs()) go(arc.end, arc.curvature1, arc.curvature2, arc.twist);
    if (at.s < rod.length()) go(rod.length(), 0, 0, 0);
  }

 private:
  enum class Kind { straight, twisted, bent };
  struct Piece {
    Scalar end;
    Vector3 omega;
    RodNode<Scalar> from;
  };
  static RodNode<Scalar> cast(const RodNode<double>& n) {
    return {static_cast<Scalar>(n.s), n.r.template cast<Scalar>(), n.tangent.template cast<Scalar>(),
            n.director.template cast<Scalar>()};
  }

  std::vector<Piece> pieces_;
  Kind kind_ = Kind::straight;
};

}  // namespace hapbeam
