// SPDX-License-Identifier: MIT
// An axis-aligned bounding-volume hierarchy over the pieces of a centreline.
//
// The pieces are ordered along the beam, so neighbours share a parent. The tree is never rebuilt; its boxes are
// refitted. A box holds the control points, hence the curve.
// Allocates in its constructor only.  A refit is O(n), the queries are O(log n) where the curve is not crowded
// around the point and O(n) at worst; all noexcept.
#pragma once

#include <limits>

#include <hapbeam/contact/box.hpp>
#include <hapbeam/contact/closest_point.hpp>

namespace hapbeam {

/// Nearest point of a whole centreline.
template <typename Scalar, int D = 2>
struct NearestPoint {
  int segment = -1;  ///< -1: none, the query or the curve is not finite
  ClosestPoint<Scalar, D> at{0, VectorOf<Scalar, D>::Zero(), std::numeric_limits<Scalar>::infinity()};
  CubicSegment<Scalar, D> piece;  ///< [m] in which it is

  /// Takes the point of a piece that is nearest to q where it is nearer; among equals that with the smaller index.   @return whether it was nearer
  template <class Query>
  [[gnu::always_inline]] bool look(int other, const CubicSegment<Scalar, D>& its, const Query& q) noexcept {
    const ClosestPoint<Scalar, D> candidate = closest_point(its, q);
    const Scalar a = candidate.distance_squared, b = at.distance_squared;
    const bool nearer = a < b || (a == b && other < segment);
    if (nearer) segment = other, at = candidate, piece = its;
    return nearer;
  }
};

namespace detail {

/// A box is skipped only if it is farther than round-off can explain, so that the answer is the same as without boxes.
template <typename Scalar>
inline constexpr Scalar more_than_round_off = 1 + 16 * std::numeric_limits<Scalar>::epsilon();

}  // namespace detail

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class BoundingVolumes {
 public:
  using Line = Centreline<Scalar, D>;

  /// @param segments  how many pieces the centreline has.  More are taken too: a leaf then holds several.
  /// Allocates.
  explicit BoundingVolumes(int segments) : tree_(detail::BoxTree<Scalar, D>::leaves_for(segments)) {}

  /// Takes the boxes from the present shape.  To be called whenever the centreline has changed.
  /// Real-time: noexcept, no allocation, O(n).
  void refit(const Line& centreline) noexcept {
    tree_.resize(centreline.segments());
    int leaf = -1, end = 0;
    centreline.visit_segments([&](int i, const CubicSegment<Scalar, D>& segment) {
      if (i == end) tree_.leaf(++leaf) = {}, end = tree_.first(leaf + 1);
      tree_.leaf(leaf).include(segment);
    });
    tree_.join();
    stale_ = false;
  }
  /// The centreline has changed, and is looked at again where fitted() is asked for.
  void outdate() noexcept { stale_ = true; }
  const BoundingVolumes& fitted(const Line& centreline) noexcept {
    if (stale_) refit(centreline);
    return *this;
  }

  /// Square of the distance from q to the box around the whole centreline [m²]: a lower bound, in O(1).
  /// @param q  a point or, in space, a Shaft
  template <class Query = VectorOf<Scalar, D>>
  [[nodiscard]] Scalar distance_squared(const Query& q) const noexcept {
    return tree_.root().distance_squared(q);
  }

  /// The nearest point of the centreline to q; among equals the one with the smallest index.
  /// @param centreline  the one of the last refit   @param q  a point or, in space, a Shaft
  /// Real-time: noexcept, no allocation, bounded.
  template <class Query = VectorOf<Scalar, D>>
  [[nodiscard]] NearestPoint<Scalar, D> nearest(const Line& centreline, const Query& q) const noexcept {
    NearestPoint<Scalar, D> best;
    tree_.visit([&](const Box& box) { return box.distance_squared(q); },
                [&] { return best.at.distance_squared * detail::more_than_round_off<Scalar>; },
                [&](int i) { return best.look(i, centreline.segment(i), q), true; });
    return best;
  }

  /// In a plane: how often the straight path p0 -> p1 crosses the centreline.
  /// @param centreline  the one of the last refit     Real-time: noexcept, no allocation, bounded.
  [[nodiscard]] Crossings crossings(const Line& centreline, const Vector2<Scalar>& p0,
                                    const Vector2<Scalar>& p1) const noexcept {
    Box path;
    path.include(p0);
    path.include(p1);
    Crossings total;
    tree_.visit([&](const Box& box) { return box.overlaps(path) ? Scalar(0) : Scalar(1); },
                [] { return Scalar(0); },
                [&](int i) { return total += hapbeam::crossings(centreline.segment(i), p0, p1), true; });
    return total;
  }

 private:
  using Box = detail::Box<Scalar, D>;

  detail::BoxTree<Scalar, D> tree_;
  bool stale_ = true;
};

}  // namespace hapbeam
