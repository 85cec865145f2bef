// The shape that a beam has by nature: a chain of arcs, ready for a mesh whose nodes move.
//
// An element bends against the linear function that is nearest to the natural curvature over its length.  For that it
// needs the integrals of the curvature and of its moment, which are exact for arcs of any length; so an arc shorter
// than an element, a corner, does what it should.
// It is also where a beam starts from on its way to rest.
// Allocates at construction; all else is noexcept and allocation-free.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/supports.hpp>

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

/// Lays the natural shape from the left end's place, turned toward the right end's place unless the left end is clamped.
/// @param nodes  out, those of the mesh
template <typename Scalar, class Nodes>
void lay(const NaturalShape<Scalar>& shape, const detail::EndSupport<Scalar>& left,
         const detail::EndSupport<Scalar>& right, const ContactMesh<Scalar>& mesh, Nodes& nodes) noexcept {
  using std::atan2;
  using std::cos;
  using std::sin;
  const Scalar length = mesh.position(mesh.elements());
  const Displacement<Scalar> end = shape.at(length);
  const Scalar *from = left.goal, *to = right.goal;
  Scalar turn = from[2];
  if (!left.held[2])
    turn = right.held[1] ? atan2(end.w, length + end.u) - atan2(to[1] - from[1], length + to[0] - from[0])
                         : to[2] - end.theta;
  const Scalar c = cos(turn), s = sin(turn);
  for (int i = 0; i < nodes.size(); ++i) {
    const Scalar position = mesh.position(i);
    const Displacement<Scalar> at = shape.at(position);
    const Scalar x = position + at.u;
    nodes[i] = {position, from[0] + c * x + s * at.w - position, from[1] - s * x + c * at.w, at.theta + turn};
  }
}

/// Bends a straight beam whose ends are to stand closer, in its own direction and facing each other, by some slack: to its
/// upper side, as far as its length allows, so that its search for rest begins on the buckled side.
///   w = a f(s/L),  f = 16 t² (1 - t)²,  u' = -½ w'²,  a² ∫f'² dt = 2 slack L          along and across the beam
/// @param nodes  in and out, as lay() lays a straight beam
template <typename Scalar, class Nodes>
void bow(const detail::EndSupport<Scalar>& left, const detail::EndSupport<Scalar>& right,
         Nodes& nodes) noexcept {
  using std::abs;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const int last = nodes.size() - 1;
  const Scalar length = nodes[last].s, turn = nodes[0].theta, c = cos(turn), s = sin(turn);
  const Scalar x = length + right.goal[0] - left.goal[0], y = right.goal[1] - left.goal[1];
  const Scalar slack = length - (c * x - s * y), across = s * x + c * y;
  const Scalar round_off = 64 * std::numeric_limits<Scalar>::epsilon();
  const bool placed_across = left.held[1] && right.held[1] && abs(across) > round_off * length,
             facing = !right.held[2] || abs(right.goal[2] - turn) <= round_off * (1 + abs(turn));
  if (!left.held[0] || !right.held[0] || placed_across || !facing || !(slack > round_off * length)) return;
  const Scalar a = sqrt(2 * slack * length * Scalar(210. / 1024));
  const auto slope = [a, length](Scalar position) {
    const Scalar t = position / length;
    return 32 * a * t * (1 - t) * (1 - 2 * t) / length;
  };
  Scalar u = 0;
  for (int i = 0; i <= last; ++i) {
    auto& node = nodes[i];
    const Scalar t = node.s / length, w = 16 * a * t * t * (1 - t) * (1 - t);
    if (i > 0) {  // Simpson's rule
      const Scalar from = nodes[i - 1].s, before = slope(from), middle = slope((from + node.s) / 2),
                   after = slope(node.s);
      u -= (node.s - from) * (before * before + 4 * middle * middle + after * after) / 12;
    }
    node.u += c * u + s * w;
    node.w += c * w - s * u;
    node.theta -= slope(node.s);
  }
}

}  // namespace hapbeam
