// SPDX-License-Identifier: MIT
// A curve of straight lines and circular arcs, each of which begins along the end of the one before: the axis of a bar or of a vessel.
//
// Checks throw std::invalid_argument; all else is noexcept, O(pieces).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

class ArcSpline {
 public:
  using Vector = VectorOf<double, 3>;
  struct Point {
    Vector r, tangent;  ///< [m], unit
    double beyond =
        0;  ///< how far what it is nearest to lies before the start, negative, or behind the end [m]
  };

  /// @param from  [m]   @param along  how it begins; one without pieces is a point
  explicit ArcSpline(const Vector& from, const Vector& along = Vector::UnitX())
      : from_(from), along_(detail::unit(along)) {
    detail::finite("axis place", from_.squaredNorm() + along_.squaredNorm(), "m");
  }
  static ArcSpline line(const Vector& from, const Vector& to) {
    const double length = std::sqrt((to - from).squaredNorm());
    return length == 0 ? ArcSpline(from) : ArcSpline(from, to - from).arc(length);
  }
  /// Goes on.   @param length  [m]   @param curvature  toward the centre, up to one turn; what of it is along the curve does not count [1/m]
  ArcSpline& arc(double length, const Vector& curvature = Vector::Zero()) {
    constexpr double straight = 1e-6;
    detail::positive("axis length", length, "m");
    const Point start = at(this->length());
    const Vector bend = curvature - start.tangent.dot(curvature) * start.tangent;
    const double size = std::sqrt(bend.squaredNorm()), half = length / 2, pi = std::acos(-1.0);
    if (!(size * half <= pi)) detail::reject("axis curvature", size, "1/m", "no more than one turn");
    Piece piece{start.r, start.tangent, Vector::Zero(), this->length() + half, half, 0, 1};
    if (size * length > straight)
      piece.inward = bend / size, piece.curvature = size, piece.end_cosine = std::cos(size * half);
    // Where it begins is known, and the rest is as seen from its middle.
    const Point middle = piece.at(half);
    const Vector about = detail::cross3(piece.tangent, piece.inward);
    piece.inward = detail::cross3(about, middle.tangent), piece.r = middle.r, piece.tangent = middle.tangent;
    pieces_.push_back(piece);
    return *this;
  }

  double length() const noexcept { return pieces_.empty() ? 0 : pieces_.back().s + pieces_.back().half; }
  Point at(double s) const noexcept {
    for (const Piece& piece : pieces_)
      if (s <= piece.s + piece.half || &piece == &pieces_.back()) return piece.at(s - piece.s);
    return {from_, along_};
  }
  Point nearest(const Vector& p) const noexcept {
    Point best{from_, along_};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Point point = pieces_[k].nearest(p);
      const double square = (p - point.r).squaredNorm();
      if (!(square < least)) continue;
      least = square, best = point;
      // Pieces that follow each other end in one plane.
      if (point.beyond < 0 ? k > 0 : k + 1 < pieces_.size()) best.beyond = 0;
    }
    return best;
  }

 private:
  /// As seen from its middle.
  struct Piece {
    Vector r, tangent, inward;
    double s, half, curvature, end_cosine;

    Point at(double x) const noexcept {
      if (curvature == 0) return {r + x * tangent, tangent};
      const double c = std::cos(curvature * x), d = std::sin(curvature * x);
      return round(c, d);
    }
    Point nearest(const Vector& p) const noexcept {
      if (curvature == 0) {
        const double x = tangent.dot(p - r), inside = std::clamp(x, -half, half);
        return {r + inside * tangent, tangent, x - inside};
      }
      const Vector off = p - r - inward / curvature;
      const double x = -off.dot(inward), y = off.dot(tangent), size = std::sqrt(x * x + y * y);
      if (!(size > 0)) return {r, tangent};
      if (x >= end_cosine * size) return round(x / size, y / size);
      Point end = round(end_cosine, std::copysign(std::sqrt(1 - end_cosine * end_cosine), y));
      end.beyond = (p - end.r).dot(end.tangent);
      return end;
    }
    Point round(double cosine, double sine) const noexcept {
      return {r + (sine * tangent + (1 - cosine) * inward) / curvature, cosine * tangent + sine * inward};
    }
  };

  Vector from_, along_;
  std::vector<Piece> pieces_;
};

}  // namespace hapbeam
