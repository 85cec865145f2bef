// SPDX-License-Identifier: MIT
// A bounding-volume hierarchy over fixed boxes: finds those that a step of the avatar meets.
//
// An implicit complete binary tree in one array, as in contact/bounding_volumes.hpp: node 1 is the root, 2i and 2i+1
// are the children of i. The boxes are halved along the longer side of the box around their centres. A leaf holds four
// to eight successive boxes, so a tree takes 8 to 16 numbers a leaf and no pointers.
// Allocates in its constructor only.  visit() is O(log n + what it finds), noexcept.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <hapbeam/contact/box.hpp>

namespace hapbeam::detail {

/// Step of an avatar from one place to another, in a tick.
template <typename Scalar>
struct Step {
  Vector2<Scalar> from, to;  // [m]
  Scalar radius;             // [m] of the avatar

  /// Whether it can touch what lies in the box: it is there at the end, or has crossed it on the way.
  bool meets(const Box<Scalar>& box) const noexcept {
    return box.distance_squared(to) <= radius * radius || box.meets(from, to);
  }
};

template <typename Scalar>
class BoxTree {
 public:
  using Bounds = Box<Scalar>;

  /// Allocates.  @param boxes  one or more   @param order  out: their indices as the tree has sorted them
  [[gnu::cold]] BoxTree(const std::vector<Bounds>& boxes, std::vector<std::int32_t>& order)
      : size_(boxes.size()) {
    order.resize(size_);
    for (std::size_t i = 0; i < size_; ++i) order[i] = static_cast<std::int32_t>(i);
    while (leaves_ * most_in_leaf < size_) leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    build(boxes, order, 1, 0, leaves_);
  }

  const Bounds& root() const noexcept { return nodes_[1]; }

  /// Calls look(i) for the boxes of each leaf that a step meets, near leaves first, while look(i) returns true. i
  /// counts in the tree's order.   Real-time: noexcept, no allocation.
  template <class Look>
  void visit(const Step<Scalar>& step, Look&& look) const noexcept {
    std::size_t stack[depth];
    int size = 0;
    if (step.meets(nodes_[1])) stack[size++] = 1;
    while (size > 0) {
      const std::size_t node = stack[--size];
      if (node >= leaves_) {
        for (std::size_t i = first(node - leaves_), end = first(node - leaves_ + 1); i < end; ++i)
          if (!look(static_cast<int>(i))) return;
        continue;
      }
      std::size_t nearer = 2 * node, farther = nearer + 1;
      if (nodes_[farther].distance_squared(step.to) < nodes_[nearer].distance_squared(step.to))
        std::swap(nearer, farther);
      if (step.meets(nodes_[farther])) stack[size++] = farther;
      if (step.meets(nodes_[nearer])) stack[size++] = nearer;
    }
  }

  std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Bounds); }

 private:
  static constexpr std::size_t most_in_leaf = 8;
  static constexpr int depth = 32;  // of the stack: one entry a level

  std::size_t first(std::size_t leaf) const noexcept { return leaf * size_ / leaves_; }

  /// @param low, high  its leaves
  void build(const std::vector<Bounds>& boxes, std::vector<std::int32_t>& order, std::size_t node,
             std::size_t low, std::size_t high) {
    const auto at = [&](std::size_t leaf) {
      return order.begin() + static_cast<std::ptrdiff_t>(first(leaf));
    };
    const auto begin = at(low), end = at(high);
    const auto box = [&boxes](std::int32_t i) -> const Bounds& { return boxes[static_cast<std::size_t>(i)]; };
    if (high - low == 1) {
      for (auto i = begin; i != end; ++i) nodes_[node].include(box(*i));
      return;
    }
    Bounds centres;  // twice as far out as they are
    for (auto i = begin; i != end; ++i) centres.include(Vector2<Scalar>(twice_x(box(*i)), twice_y(box(*i))));
    const std::size_t middle = (low + high) / 2;
    const bool along_x = centres.high[0] - centres.low[0] >= centres.high[1] - centres.low[1];
    std::nth_element(begin, at(middle), end, [&](std::int32_t a, std::int32_t b) {
      const Scalar of_a = along_x ? twice_x(box(a)) : twice_y(box(a)),
                   of_b = along_x ? twice_x(box(b)) : twice_y(box(b));
      return of_a < of_b || (of_a == of_b && a < b);
    });
    build(boxes, order, 2 * node, low, middle);
    build(boxes, order, 2 * node + 1, middle, high);
    nodes_[node] = nodes_[2 * node];
    nodes_[node].include(nodes_[2 * node + 1]);
  }
  static Scalar twice_x(const Bounds& b) noexcept { return b.low[0] + b.high[0]; }
  static Scalar twice_y(const Bounds& b) noexcept { return b.low[1] + b.high[1]; }

  std::size_t size_, leaves_ = 1;
  std::vector<Bounds> nodes_;
};

}  // namespace hapbeam::detail
