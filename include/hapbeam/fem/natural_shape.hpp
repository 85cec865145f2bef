// The shape that a beam has by nature: a chain of arcs, ready for a mesh whose nodes move.
//
// An element bends against the linear function that is nearest to the natural curvature over its length.  For that it
// needs the integrals of the curvature and of its moment, which are exact for arcs of any length; so an arc shorter
// than an element, a corner, does what it should.
// Allocates at construction; all else is noexcept and allocation-free.
#pragma once

#include <cmath>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>

namespace hapbeam {

template <typename Scalar>
class NaturalShape {
 public:
  explicit NaturalShape(const Beam& beam) {
    for (const Arc& arc : beam.arcs())
      arcs_.push_back({static_cast<Scalar>(arc.end), static_cast<Scalar>(arc.curvature)});
  }

  bool straight() const noexcept { return arcs_.empty(); }

  /// Gives the element from s to s + p.length its natural rotations against the chord.
  /// With κ(x) = I0/l + 12 I1 x/l³ about the middle these are -I0/2 + I1/l and I0/2 + I1/l.
  void apply(Scalar s, ElementProperties<Scalar>& p) const noexcept {
    const Scalar middle = s + p.length / 2;
    Scalar turn = 0, moment = 0;  // ∫κ ds [rad], ∫κ (s - middle) ds [m rad]
    for_each_piece(s, s + p.length, [&](Scalar from, Scalar to, Scalar curvature) {
      turn += curvature * (to - from);
      moment += curvature * (to - from) * ((from + to) / 2 - middle);
    });
    p.natural_a = moment - turn * p.length / 2;
    p.natural_b = moment + turn * p.length / 2;
  }

  /// The point at s of the natural shape that leaves its start with θ = 0.
  Displacement<Scalar> at(Scalar s) const noexcept {
    using std::cos;
    using std::sin;
    Displacement<Scalar> point{0, 0, 0};
    for_each_piece(0, s, [&](Scalar from, Scalar to, Scalar curvature) {
      const Scalar length = to - from, half = curvature * length / 2;
      const Scalar chord = half == 0 ? length : length * sin(half) / half, direction = point.theta + half;
      point.u += chord * cos(direction) - length;
      point.w -= chord * sin(direction);
      point.theta += 2 * half;
    });
    return point;
  }

 private:
  struct Piece {
    Scalar end, curvature;
  };

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

}  // namespace hapbeam
