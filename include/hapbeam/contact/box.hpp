// SPDX-License-Identifier: MIT
// Axis-aligned boxes in a plane or in space, and a hierarchy of them.
//
// No allocation but in the constructor of the hierarchy; all else is noexcept.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// Empty until it includes something.
/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
struct Box {
  // Scalars: packets of two would be loaded right after their halves were stored, which stalls.
  Scalar low[D], high[D];

  Box() noexcept {
    for (int k = 0; k < D; ++k)
      low[k] = std::numeric_limits<Scalar>::infinity(), high[k] = -std::numeric_limits<Scalar>::infinity();
  }

  void include(const VectorOf<Scalar, D>& p) noexcept {
    for (int k = 0; k < D; ++k) low[k] = (std::min)(low[k], p[k]), high[k] = (std::max)(high[k], p[k]);
  }
  void include(const CubicSegment<Scalar, D>& b) noexcept {
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < D; ++k)
        low[k] = (std::min)(low[k], b(k, j)), high[k] = (std::max)(high[k], b(k, j));
  }
  void include(const Box& other) noexcept {
    for (int k = 0; k < D; ++k)
      low[k] = (std::min)(low[k], other.low[k]), high[k] = (std::max)(high[k], other.high[k]);
  }
  /// So much larger on all sides [m].
  [[nodiscard]] Box grown(Scalar by) const noexcept {
    Box box;
    for (int k = 0; k < D; ++k) box.low[k] = low[k] - by, box.high[k] = high[k] + by;
    return box;
  }
  [[nodiscard]] Scalar distance_squared(const VectorOf<Scalar, D>& q) const noexcept {
    Scalar sum = 0;
    for (int k = 0; k < D; ++k) {
      const Scalar away = (std::max)((std::max)(low[k] - q[k], q[k] - high[k]), Scalar(0));
      sum += away * away;
    }
    return sum;
  }
  /// In space: a lower bound of that to a shaft, from the box around the shaft and from the ball around this one.
  [[nodiscard]] Scalar distance_squared(const Shaft<Scalar>& shaft) const noexcept {
    if (shaft.way.isZero(0)) return distance_squared(shaft.tip);
    VectorOf<Scalar, D> centre, half;
    Scalar sum = 0;
    for (int k = 0; k < D; ++k) {
      const Scalar end = shaft.tip[k] + shaft.way[k], lowest = (std::min)(shaft.tip[k], end),
                   highest = (std::max)(shaft.tip[k], end),
                   away = (std::max)((std::max)(low[k] - highest, lowest - high[k]), Scalar(0));
      sum += away * away;
      centre[k] = (low[k] + high[k]) / 2, half[k] = (high[k] - low[k]) / 2;
    }
    const Scalar gap =
        std::sqrt((shaft.at(shaft.nearest(centre)) - centre).squaredNorm()) - std::sqrt(half.squaredNorm());
    return gap > 0 ? (std::max)(sum, gap * gap) : sum;
  }
  [[nodiscard]] bool overlaps(const Box& other) const noexcept {
    for (int k = 0; k < D; ++k)
      if (!(low[k] <= other.high[k] && other.low[k] <= high[k])) return false;
    return true;
  }
  /// In a plane: whether the straight way from a to b meets it, no axis of either separates them.
  [[nodiscard]] bool meets(const Vector2<Scalar>& a, const Vector2<Scalar>& b) const noexcept {
    Box way;
    way.include(a);
    way.include(b);
    if (!overlaps(way)) return false;
    const Scalar dx = b.x() - a.x(), dy = b.y() - a.y();
    const Scalar off = dx * (low[1] + high[1] - 2 * a.y()) - dy * (low[0] + high[0] - 2 * a.x());
    // What is too large to be multiplied counts as met.  It is infinite, not NaN, where the compiler fuses product and difference.
    return !(std::isfinite(off) &&
             std::abs(off) > std::abs(dx) * (high[1] - low[1]) + std::abs(dy) * (high[0] - low[0]));
  }
};

/// An implicit complete binary tree of boxes in one array: node 1 is the root, 2i and 2i + 1 are the children of i.  Each leaf
/// holds successive things, so neighbours share a parent.
template <typename Scalar, int D = 2>
class BoxTree {
 public:
  using Bounds = Box<Scalar, D>;

  /// As many leaves as do not hold more than one or two of so many things.
  static int leaves_for(int size) noexcept {
    int leaves = 1;
    while (2 * leaves <= size) leaves *= 2;
    return leaves;
  }
  /// @param most_leaves  a power of two   Allocates.
  explicit BoxTree(int most_leaves) : nodes_(2 * index(most_leaves)), most_leaves_(most_leaves) {}

  /// Of so many things, one or more.  The boxes are filled next: those of the leaves, and join() makes those of the others.
  void resize(int size) noexcept {
    size_ = size;
    for (leaves_ = 1, levels_ = 0; 2 * leaves_ <= (std::min)(size, most_leaves_); leaves_ *= 2) ++levels_;
  }
  int leaves() const noexcept { return leaves_; }
  /// The first thing of a leaf; of the one after the last, how many there are.
  int first(int leaf) const noexcept {
    return static_cast<int>((static_cast<std::int64_t>(leaf) * size_) >> levels_);
  }
  Bounds& leaf(int k) noexcept { return nodes_[index(leaves_ + k)]; }
  void join() noexcept {
    for (int i = leaves_ - 1; i > 0; --i) {
      nodes_[index(i)] = nodes_[index(2 * i)];
      nodes_[index(i)].include(nodes_[index(2 * i + 1)]);
    }
  }
  const Bounds& root() const noexcept { return nodes_[1]; }

  /// Calls look(i) for the things in the leaves of which key(box) <= most(), those of smaller keys first, while look(i) returns true.
  /// @param key  box -> Scalar, not larger for a box around it   @param most  () -> Scalar, which may fall
  /// Real-time: noexcept, no allocation, O(log n + what it finds).
  template <class Key, class Most, class Look>
  void visit(Key&& key, Most&& most, Look&& look) const noexcept {
    struct Entry {
      int node;
      Scalar key;
    };
    Entry stack[32];  // one entry a level, and an int has 31 levels
    int size = 0;
    if (size_ > 0) stack[size++] = {1, key(nodes_[1])};
    while (size > 0) {
      Entry at = stack[--size];
      while (at.key <= most() && at.node < leaves_) {
        const int left = 2 * at.node;
        Entry farther{left + 1, key(nodes_[index(left + 1)])};
        at = {left, key(nodes_[index(left)])};
        if (farther.key < at.key) std::swap(at, farther);
        if (farther.key <= most()) stack[size++] = farther;
      }
      if (!(at.key <= most())) continue;
      for (int i = first(at.node - leaves_), end = first(at.node - leaves_ + 1); i < end; ++i)
        if (!look(i)) return;
    }
  }

  std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Bounds); }

 private:
  static std::size_t index(int node) noexcept { return static_cast<std::size_t>(node); }

  std::vector<Bounds> nodes_;
  int most_leaves_, size_ = 0;
  int leaves_ = 1, levels_ = 0;  // of the present tree: 2^levels_
};

}  // namespace hapbeam::detail
