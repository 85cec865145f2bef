// SPDX-License-Identifier: MIT
// An axis-aligned bounding-volume hierarchy over the pieces of a centreline.
//
// An implicit complete binary tree in one array: node 1 is the root, 2i and 2i+1 are the children of i. The pieces are
// ordered along the beam, so neighbours share a parent. The tree is never rebuilt; its boxes are refitted. A box holds
// the control points, hence the curve.
// Allocates in its constructor only.  refit is O(n), the queries are O(log n) where the curve is not crowded
// around the point and O(n) at worst; all noexcept.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <hapbeam/contact/box.hpp>
#include <hapbeam/contact/closest_point.hpp>
#include <hapbeam/contact/crossing.hpp>

namespace hapbeam {

/// Nearest point of a whole centreline.
template <typename Scalar, int D = 2>
struct NearestPoint {
  int segment = -1;  ///< -1: none, the query or the curve is not finite
  ClosestPoint<Scalar, D> at{0, VectorOf<Scalar, D>::Zero(), std::numeric_limits<Scalar>::infinity()};
};

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class BoundingVolumes {
 public:
  using Line = Centreline<Scalar, D>;

  /// @param segments  how many pieces the centreline has.  More are taken too: a leaf then holds several.
  /// Allocates.
  explicit BoundingVolumes(int segments) {
    while (capacity_ < segments) capacity_ *= 2;
    boxes_.resize(2 * static_cast<std::size_t>(capacity_));
  }

  /// Takes the boxes from the present shape.  To be called whenever the centreline has changed.
  /// Real-time: noexcept, no allocation, O(n).
  void refit(const Line& centreline) noexcept {
    segments_ = centreline.segments();
    run_ = (segments_ + capacity_ - 1) / capacity_;
    int used = (segments_ + run_ - 1) / run_;
    for (leaves_ = 1; leaves_ < used;) leaves_ *= 2;
    for (int leaf = 0; leaf < used; ++leaf) boxes_[index(leaves_ + leaf)] = Box();
    int leaf = 0, end = run_;
    centreline.visit_segments([&](int i, const CubicSegment<Scalar, D>& segment) {
      if (i == end) ++leaf, end += run_;
      boxes_[index(leaves_ + leaf)].include(segment);
    });
    for (int first = leaves_; first > 1; first /= 2) {
      if (used % 2)
        boxes_[index(first + used++)] = Box();  // the last one's missing sibling: empty, never entered
      used /= 2;
      for (int k = 0; k < used; ++k) {
        Box& parent = boxes_[index(first / 2 + k)];
        parent = boxes_[index(first + 2 * k)];
        parent.include(boxes_[index(first + 2 * k + 1)]);
      }
    }
  }

  /// Square of the distance from q to the box around the whole centreline [m²]: a lower bound, in O(1).
  /// @param q  a point or, in space, a Shaft
  template <class Query = VectorOf<Scalar, D>>
  [[nodiscard]] Scalar distance_squared(const Query& q) const noexcept {
    return boxes_[1].distance_squared(q);
  }

  /// The nearest point of the centreline to q; among equals the one with the smallest index.
  /// @param centreline  the one of the last refit   @param q  a point or, in space, a Shaft
  /// Real-time: noexcept, no allocation, bounded.
  template <class Query = VectorOf<Scalar, D>>
  [[nodiscard]] NearestPoint<Scalar, D> nearest(const Line& centreline, const Query& q) const noexcept {
    // A box is skipped only if it is farther than round-off can explain, so that the answer is the same as
    // without boxes.
    constexpr Scalar slack = 1 + 16 * std::numeric_limits<Scalar>::epsilon();
    struct Entry {
      int node;
      Scalar distance_squared;
    };
    Entry stack[max_depth];
    int size = 0;
    NearestPoint<Scalar, D> best;
    if (segments_ > 0) stack[size++] = {1, 0};
    while (size > 0) {
      Entry entry = stack[--size];
      if (entry.distance_squared > best.at.distance_squared * slack) continue;
      while (entry.node < leaves_) {
        const int left = 2 * entry.node;
        Entry nearer{left, boxes_[index(left)].distance_squared(q)};
        Entry farther{left + 1, boxes_[index(left + 1)].distance_squared(q)};
        if (farther.distance_squared < nearer.distance_squared) std::swap(nearer, farther);
        if (farther.distance_squared <= best.at.distance_squared * slack) stack[size++] = farther;
        entry = nearer;
      }
      const int begin = (entry.node - leaves_) * run_, end = (std::min)(begin + run_, segments_);
      for (int i = begin; i < end; ++i) {
        const ClosestPoint<Scalar, D> candidate = closest_point(centreline.segment(i), q);
        const Scalar a = candidate.distance_squared, b = best.at.distance_squared;
        if (a < b || (a == b && i < best.segment)) best = {i, candidate};
      }
    }
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
    int stack[max_depth];
    int size = 0;
    if (segments_ > 0) stack[size++] = 1;
    while (size > 0) {
      const int node = stack[--size];
      if (!boxes_[index(node)].overlaps(path)) continue;
      if (node < leaves_) {
        stack[size++] = 2 * node + 1;
        stack[size++] = 2 * node;
        continue;
      }
      const int begin = (node - leaves_) * run_, end = (std::min)(begin + run_, segments_);
      for (int i = begin; i < end; ++i) total += hapbeam::crossings(centreline.segment(i), p0, p1);
    }
    return total;
  }

 private:
  static constexpr int max_depth = 32;  // of the stacks: one entry a level, and an int has 31 levels

  using Box = detail::Box<Scalar, D>;

  static std::size_t index(int node) noexcept { return static_cast<std::size_t>(node); }

  std::vector<Box> boxes_;
  int capacity_ = 1;  // leaves at most, a power of two
  int leaves_ = 1;    // leaves of the present tree, a power of two
  int segments_ = 0;
  int run_ = 1;  // pieces in a leaf
};

}  // namespace hapbeam
