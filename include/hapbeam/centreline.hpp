// SPDX-License-Identifier: MIT
// The deformed centreline of a beam: nodes joined by cubics.
//
// A view: it owns nothing and is valid until the model that gave it is called again.  Each piece is a plane cubic, so
// contact and drawing see one kind of curve.  Which cubic depends on the kinematics of the model:
//   moderate rotation   u is linear, w takes both nodes' displacement and slope (thesis eq. 3.17): exactly the curve
//                       that the elements compute with
//   finite rotation     the ends' tangents are (cos θ, -sin θ) and a third as long as the piece is now, stretched and bent:
//                       its direction is continuous at nodes.  Its error is of fourth order in the length l of a piece that
//                       stretches evenly; where the strain varies along it, by ε', l² ε'/8 along the beam is added
// No allocation, noexcept, O(1) but for the search of the piece, which is O(log n).
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/angle.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

/// One node: where it was and how it moved.  theta = -dw/dx.
template <typename Scalar>
struct CentrelineNode {
  Scalar s;      ///< [m] arc position along the undeformed beam
  Scalar u;      ///< [m] axial displacement
  Scalar w;      ///< [m] transverse displacement
  Scalar theta;  ///< [rad] rotation, -dw/dx

  Vector2<Scalar> position() const noexcept { return {s + u, w}; }  ///< [m] where it is, (x, w)
};

namespace detail {

template <class M, typename = void>
struct Dimension : std::integral_constant<int, 2> {};
template <class M>
struct Dimension<M, std::void_t<decltype(M::dimension)>> : std::integral_constant<int, M::dimension> {};

/// Nodes in a row, of a centreline in the plane or in space.
template <class NodeType, typename Scalar>
class NodeView {
 public:
  using Node = NodeType;

  NodeView(const Node* nodes, int size) noexcept : nodes_(nodes), size_(size) {}

  int size() const noexcept { return size_; }
  int segments() const noexcept { return size_ - 1; }
  const Node& operator[](int i) const noexcept { return nodes_[i]; }
  const Node* begin() const noexcept { return nodes_; }
  const Node* end() const noexcept { return nodes_ + size_; }
  Scalar length() const noexcept { return nodes_[size_ - 1].s; }

  /// Index of the piece that holds arc position s; the first or last one where s lies off the beam.
  int segment_at(Scalar s) const noexcept {
    int low = 0, high = segments() - 1;
    while (low < high) {
      const int middle = (low + high + 1) / 2;
      if (nodes_[middle].s <= s) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  /// Index of the node that is nearest to arc position s.
  int node_near(Scalar s) const noexcept {
    const int i = segment_at(s);
    return 2 * s > nodes_[i].s + nodes_[i + 1].s ? i + 1 : i;
  }

 protected:
  /// Mean of f(piece) over both pieces of node i, or of the one that there is.
  template <class F>
  auto mean_beside(int i, F&& f) const noexcept {
    if (i == 0 || i == segments()) return f(i == 0 ? 0 : i - 1);
    return decltype(f(i))((f(i - 1) + f(i)) / 2);
  }
  const Node* nodes_;
  int size_;
};

/// Whether no point at most √reach from a middle is within d.   @param middle  [m] from there   @param reach  squared [m²]
template <class Vector, typename Scalar>
bool is_far(const Vector& middle, Scalar reach, Scalar d) noexcept {
  const Scalar square = d * d, more = middle.squaredNorm() - square - reach;
  // Farther than d and the reach together, without a root.
  return more > 0 && more * more > 4 * square * reach;
}

}  // namespace detail

/// Dimension of the space in which M, a model or an element, bends: M::dimension, or 2.
template <class M>
inline constexpr int dimension_of = detail::Dimension<M>::value;

/// Whether all numbers of a node are finite.
template <typename Scalar>
bool is_finite(const CentrelineNode<Scalar>& node) noexcept {
  return std::isfinite(node.s) && std::isfinite(node.u) && std::isfinite(node.w) && std::isfinite(node.theta);
}

/// Control points of one piece, b0 … b3: the curve is sum of b_k B_k(t), t in [0, 1], in Bernstein form.
template <typename Scalar, int D = 2>
using CubicSegment = Eigen::Matrix<Scalar, D, 4>;
/// Control point k of it [m].
template <typename Scalar, int D>
[[gnu::always_inline]] inline VectorOf<Scalar, D> control_point(const Eigen::Matrix<Scalar, D, 4>& b,
                                                                int k) noexcept {
  return detail::vector_of<Scalar, D>([&](int i) { return b(i, k); });
}

/// Displacements at one arc position.
template <typename Scalar>
struct Displacement {
  Scalar u;      ///< [m]
  Scalar w;      ///< [m]
  Scalar theta;  ///< [rad]
};

/// @tparam D  2 | 3, which rod_centreline.hpp has
template <typename Scalar, int D = 2>
class Centreline : public detail::NodeView<CentrelineNode<Scalar>, Scalar> {
  static_assert(D == 2, "#include <hapbeam/rod_centreline.hpp> for centrelines in space");
  using Base = detail::NodeView<CentrelineNode<Scalar>, Scalar>;
  using Base::nodes_, Base::mean_beside;

 public:
  using Base::segment_at, Base::segments;
  using typename Base::Node;

  Centreline(const Node* nodes, int size, bool any_rotation = false) noexcept
      : Base(nodes, size), any_rotation_(any_rotation) {}

  /// Which cubic joins the nodes, above.
  bool any_rotation() const noexcept { return any_rotation_; }

  /// The deformed piece between nodes i and i + 1, in the plane (x along the beam, w across) [m].
  CubicSegment<Scalar> segment(int i) const noexcept { return segment(i, direction(i), direction(i + 1)); }

  /// Calls visit(i, segment(i)) for each piece, in order; cheaper than one by one.
  template <class Visitor>
  void visit_segments(Visitor&& visitor) const noexcept {
    Vector2<Scalar> from = direction(0);
    for (int i = 0; i < segments(); ++i) {
      const Vector2<Scalar> to = direction(i + 1);
      visitor(i, segment(i, from, to));
      from = to;
    }
  }

  /// How far q lies ahead of node i, along the beam [m], of a centreline of finite rotation.
  Scalar ahead(int i, const Vector2<Scalar>& q) const noexcept {
    return direction(i).dot(q - nodes_[i].position());
  }
  /// Whether no point of piece i is within d of q, as its nodes alone show.  Of finite rotation: its inner control points are 0.42 chords from its
  /// nodes at most (arc()), hence no point is farther than 3/4 · 0.42 chords from the chord.
  bool excludes(int i, const Vector2<Scalar>& q, Scalar d) const noexcept {
    const Vector2<Scalar> from = nodes_[i].position(), to = nodes_[i + 1].position();
    return detail::is_far((from + to) / 2 - q, Scalar(0.82 * 0.82) * (to - from).squaredNorm(), d);
  }
  /// Whether piece i is as long as its chord, as what turns by less than a radian is.
  bool straight(int i) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const Scalar l = (b.s - a.s) * (b.s - a.s);
    return std::abs((b.position() - a.position()).squaredNorm() - l) < Scalar(0.03) * l;
  }

  /// Curvature at node i of a centreline of finite rotation, to its left [1/m]: the mean of both pieces, as cubics about their chords.
  Scalar curvature(int i) const noexcept {
    return mean_beside(i, [&](int k) {
      const Node &a = nodes_[k], &b = nodes_[k + 1];
      const Scalar x = b.s + b.u - a.s - a.u, y = b.w - a.w;
      const Scalar chord = detail::angle_near(y, x, std::sqrt(x * x + y * y), -(a.theta + b.theta) / 2),
                   p = a.theta + chord, q = b.theta + chord;
      return Scalar((k == i ? 4 * p + 2 * q : -2 * p - 4 * q) / (b.s - a.s));
    });
  }

  /// |dr/ds| at node i of a centreline of finite rotation: the mean of both pieces.
  Scalar stretch(int i) const noexcept {
    return mean_beside(i, [&](int k) { return stretch(k, k + 1, direction(k), direction(k + 1)); });
  }
  /// The same with an error of second order: the mean of each piece is extrapolated by that of the next one on either side.
  Scalar extrapolated_stretch(int i) const noexcept {
    const Vector2<Scalar> from = direction(i);
    Scalar sum = 0, sides = 0;
    for (const int way : {-1, 1}) {
      const int j = i + way, k = j + way;
      if (j < 0 || j > segments()) continue;
      const Vector2<Scalar> to = direction(j);
      const Scalar beside = stretch(i, j, from, to);
      sum += beside;
      ++sides;
      if (k < 0 || k > segments()) continue;
      const Scalar beyond = stretch(j, k, to, direction(k));
      sum += (beside - beyond) * ((nodes_[j].s - nodes_[i].s) / (nodes_[k].s - nodes_[i].s));
    }
    return sum / sides;
  }

  /// Where the point at arc position s is [m], as in a centreline in space.
  Vector2<Scalar> position(Scalar s) const noexcept {
    const Displacement<Scalar> moved = at(s);
    return {s + moved.u, moved.w};
  }
  /// Displacements at arc position s [m].
  Displacement<Scalar> at(Scalar s) const noexcept { return at(segment_at(s), s); }

  /// The same, in a piece that is known to hold s.
  Displacement<Scalar> at(int i, Scalar s) const noexcept {
    const Node& a = nodes_[i];
    const Node& b = nodes_[i + 1];
    const Scalar h = b.s - a.s, t = (s - a.s) / h, r = 1 - t;
    if (any_rotation_) return on_curve(i, s, t);
    const Scalar rise = b.w - a.w;
    // Hermite cubic about the chord, whose end slopes are -theta: exact at both nodes, little cancellation.
    const Scalar p = h * a.theta + rise, q = h * b.theta + rise;
    return {a.u + t * (b.u - a.u), a.w + t * rise - t * r * (r * p - t * q),
            -(rise - (r * r - 2 * t * r) * p + (2 * t * r - t * t) * q) / h};
  }
  /// A node where there is none.
  Node node_at(Scalar s) const noexcept { return node_at(segment_at(s), s); }
  Node node_at(int i, Scalar s) const noexcept {
    const Displacement<Scalar> moved = at(i, s);
    return {s, moved.u, moved.w, moved.theta};
  }

 private:
  /// Mean of |dr/ds| between two neighbouring nodes, from their directions.
  Scalar stretch(int i, int k, const Vector2<Scalar>& from, const Vector2<Scalar>& to) const noexcept {
    const Node &a = nodes_[i], &b = nodes_[k];
    return arc({b.s + b.u - a.s - a.u, b.w - a.w}, from, to) / std::abs(b.s - a.s);
  }
  /// Slope or direction of the centreline at a node: dw/dx after (1, dw/dx), or a unit vector.
  [[gnu::always_inline]] Vector2<Scalar> direction(int i) const noexcept {
    const Scalar theta = nodes_[i].theta;
    if (!any_rotation_) return {1, -theta};
    return detail::direction(-theta);
  }

  CubicSegment<Scalar> segment(int i, const Vector2<Scalar>& from, const Vector2<Scalar>& to) const noexcept {
    const Node& a = nodes_[i];
    const Node& b = nodes_[i + 1];
    const Scalar x0 = a.s + a.u, x3 = b.s + b.u, dx = (x3 - x0) / 3;
    const Scalar third = (any_rotation_ ? arc({x3 - x0, b.w - a.w}, from, to) : b.s - a.s) / 3;
    CubicSegment<Scalar> control;
    control.col(0) = Vector2<Scalar>(x0, a.w);
    control.col(1) = Vector2<Scalar>(x0 + (any_rotation_ ? third * from.x() : dx), a.w + third * from.y());
    control.col(2) = Vector2<Scalar>(x3 - (any_rotation_ ? third * to.x() : dx), b.w - third * to.y());
    control.col(3) = Vector2<Scalar>(x3, b.w);
    return control;
  }

  /// Length of a piece, from its chord c and the angles α, β of its ends against it:  c (1 + m + 7m²/10) with m = (2α²
  /// - αβ + 2β²)/30, as in the elements. The last term is that of a circle. sin + sin³/6 approximates an angle.
  static Scalar arc(const Vector2<Scalar>& chord, const Vector2<Scalar>& from,
                    const Vector2<Scalar>& to) noexcept {
    const Scalar c = std::sqrt(chord.squaredNorm()), i = c > 0 ? 1 / c : Scalar(0);
    const auto angle = [&](const Vector2<Scalar>& v) {
      const Scalar sine = (chord.x() * v.y() - chord.y() * v.x()) * i;
      return sine * (1 + sine * sine / 6);
    };
    const Scalar p = angle(from), q = angle(to), m = (2 * (p * p + q * q) - p * q) / 30;
    return c * (1 + m * (1 + Scalar(0.7) * m));
  }

  /// θ is the angle of the tangent, in the turn in which the piece begins.
  Displacement<Scalar> on_curve(int i, Scalar s, Scalar t) const noexcept {
    const Node& a = nodes_[i];
    const Vector2<Scalar> from = direction(i);
    const CubicSegment<Scalar> b = segment(i, from, direction(i + 1));
    const Scalar r = 1 - t;
    const Vector2<Scalar> p1 = control_point(b, 1), p2 = control_point(b, 2), c0 = p1 - control_point(b, 0),
                          c1 = p2 - p1, c2 = control_point(b, 3) - p2;
    const Vector2<Scalar> velocity = r * r * c0 + 2 * r * t * c1 + t * t * c2,
                          way = t * ((1 + r + r * r) * c0 + t * (1 + 2 * r) * c1 + t * t * c2);
    const Scalar turned =
        detail::angle(from.x() * velocity.y() - from.y() * velocity.x(), from.dot(velocity), velocity.norm());
    return {a.u + (way.x() - (s - a.s)), a.w + way.y(), a.theta - turned};
  }

  bool any_rotation_;
};

/// Neighbouring pieces of a centreline.
template <typename Scalar>
struct CentrelinePart {
  Centreline<Scalar> line;  ///< of these pieces alone
  int first;                ///< index of the first one in the whole
  int segments;             ///< of the whole

  bool begins() const noexcept { return first == 0; }                         ///< holds the left end
  bool ends() const noexcept { return first + line.segments() == segments; }  ///< holds the right end
};

/// The pieces that hold arc positions s0 to s1: both pieces of a node at either.   O(log n)
template <typename Scalar>
CentrelinePart<Scalar> part_of(const Centreline<Scalar>& whole, Scalar s0, Scalar s1) noexcept {
  int first = whole.segment_at(s0);
  const int last = (s1 == s0 ? first : whole.segment_at(s1)) + 1;
  if (first > 0 && whole[first].s >= s0) --first;
  return {{whole.begin() + first, last - first + 1, whole.any_rotation()}, first, whole.segments()};
}

}  // namespace hapbeam
