// SPDX-License-Identifier: MIT
// The natural shape of a rod: a chain of pieces of constant curvature and twist, which are helices.
//
// In a piece the frame turns about an axis that is fixed in space, Ω = κ1 d1 + κ2 d2 + τ d3:
//
//   d(s) = R(Ω s) d(0),   r(s) = r(0) + (Ω·d3/Ω²) Ω s + ...       (Rodrigues, and its integral)
//
// Allocates at construction; all else is noexcept and allocation-free.
#pragma once

#include <cmath>
#include <vector>

#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

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
    const Piece& piece = pieces_[piece_at(s)];
    return along(piece.from, piece.omega, s - piece.from.s);
  }
  /// Goes a way s along a piece that begins at a node.
  static RodNode<Scalar> along(const RodNode<Scalar>& from, const Vector3& omega, Scalar s) noexcept {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Scalar square = omega.squaredNorm(), rate = sqrt(square), angle = rate * s;
    RodNode<Scalar> to{from.s + s, from.r + s * from.tangent, from.tangent, from.director};
    if (angle == 0) return to;
    // sin x/x, (1 - cos x)/x² and (x - sin x)/x³, without cancellation where x is small
    const Scalar x = angle * angle, half = sin(angle / 2);
    const Scalar a = sin(angle) / angle, b = 2 * half * half / x,
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

  std::size_t piece_at(Scalar s) const noexcept {
    std::size_t k = 0;
    while (k + 1 < pieces_.size() && pieces_[k].end <= s) ++k;
    return k;
  }

  std::vector<Piece> pieces_;
  Kind kind_ = Kind::straight;
};

}  // namespace hapbeam
