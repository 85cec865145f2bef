// SPDX-License-Identifier: MIT
// What a chain's system has of one node: its block and right-hand side, and what couples it with its neighbours.
//
// Unknowns of a node are exchanged for others, or prescribed, after all elements are in.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// Block and right-hand side.   @tparam Stride  from entry to entry: rows of both chains lie side by side
template <typename Scalar, int Block, int Stride>
struct NodeBlock {
  Scalar *block, *x;

  [[gnu::always_inline]] Scalar& operator()(int i, int j) const noexcept {
    return block[Stride * triangle<Block>((std::max)(i, j), (std::min)(i, j))];
  }
  [[gnu::always_inline]] Scalar& operator[](int i) const noexcept { return x[Stride * i]; }
};
/// What couples a node with a neighbour: its own unknown, that of the neighbour.
/// @tparam Rows  ChainRows
template <typename Scalar, class Rows>
struct NodeCoupling {
  Scalar* entries;
  bool inward;

  [[gnu::always_inline]] Scalar& operator()(int i, int j) const noexcept {
    return entries[2 * (inward ? Rows::to_coupling(i, j) : Rows::to_coupling(j, i))];
  }
};

/// @tparam EachNeighbour  calls a function with each neighbour's block, the coupling with it, and whether it is the left one
template <typename Scalar, int Block, int Stride, class EachNeighbour>
struct ChainNode {
  NodeBlock<Scalar, Block, Stride> own;
  EachNeighbour each_neighbour;

  /// Three unknowns from At on become those along other axes:  old = Q new.
  template <int At, class Matrix>
  [[gnu::always_inline]] void turn(const Matrix& Q) const noexcept {
    const auto times = [&Q](Scalar& a, Scalar& b, Scalar& c) {
      const Scalar x = a, y = b, z = c;
      a = x * Q(0, 0) + y * Q(1, 0) + z * Q(2, 0);
      b = x * Q(0, 1) + y * Q(1, 1) + z * Q(2, 1);
      c = x * Q(0, 2) + y * Q(1, 2) + z * Q(2, 2);
    };
    times(own[At], own[At + 1], own[At + 2]);
    each_neighbour([&](const auto&, const auto& c, bool) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) times(c(At, k), c(At + 1, k), c(At + 2, k));
    });
    Scalar square[3][3];
    HAPBEAM_UNROLL
    for (int i = 0; i < 3; ++i) {
      HAPBEAM_UNROLL
      for (int j = 0; j < 3; ++j) square[i][j] = own(At + i, At + j);
      times(square[i][0], square[i][1], square[i][2]);
    }
    HAPBEAM_UNROLL
    for (int j = 0; j < 3; ++j) {
      times(square[0][j], square[1][j], square[2][j]);
      HAPBEAM_UNROLL
      for (int i = j; i < 3; ++i) own(At + i, At + j) = square[i][j];
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k)
      if (k < At || k >= At + 3) times(own(k, At), own(k, At + 1), own(k, At + 2));
  }

  /// An unknown is from now on its old self and a part of three others:  old = new - part · (unknowns from Others on).
  template <int Unknown, int Others, class Part>
  [[gnu::always_inline]] void lean(const Part& part) const noexcept {
    each_neighbour([&](const auto&, const auto& c, bool) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) {
        const Scalar by = c(Unknown, k);
        HAPBEAM_UNROLL
        for (int j = 0; j < 3; ++j) c(Others + j, k) -= part[j] * by;
      }
    });
    HAPBEAM_UNROLL
    for (int j = 0; j < 3; ++j) {
      const int other = Others + j;
      own[other] -= part[j] * own[Unknown];
      own(other, other) += part[j] * (part[j] * own(Unknown, Unknown) - 2 * own(Unknown, other));
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k)
        if (k != other) own(k, other) -= part[j] * own(k, Unknown);
    }
  }

  /// Prescribes all but the length of r', unknowns 3 to 5, which grows along u: that is unknown 5 from now on.
  /// @param by  the increment of all unknowns but for that
  template <class Vector3, class Increment>
  [[gnu::always_inline]] void clamp(const Vector3& u, const Increment& by) const noexcept {
    const auto along = [&u](Scalar x, Scalar y, Scalar z) { return u[0] * x + u[1] * y + u[2] * z; };
    bool moves = false;
    for (int k = 0; k < Block; ++k) moves = moves || by[k] != 0;
    Scalar rhs = along(own[3], own[4], own[5]);
    if (moves)
      for (int k = 0; k < Block; ++k) rhs -= by[k] * along(own(3, k), own(4, k), own(5, k));
    const Scalar diagonal =
        along(along(own(3, 3), own(3, 4), own(3, 5)), along(own(4, 3), own(4, 4), own(4, 5)),
              along(own(5, 3), own(5, 4), own(5, 5)));
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      own[j] = j == 5 ? rhs : Scalar(0);
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) own(i, j) = i != j ? Scalar(0) : j == 5 ? diagonal : Scalar(1);
    }
    each_neighbour([&](const auto& other, const auto& c, bool) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) {
        if (moves)
          for (int j = 0; j < Block; ++j) other[k] -= by[j] * c(j, k);
        const Scalar free = along(c(3, k), c(4, k), c(5, k));
        HAPBEAM_UNROLL
        for (int j = 0; j < Block; ++j) c(j, k) = j == 5 ? free : Scalar(0);
      }
    });
  }

  /// Prescribes the increment of one unknown: its column goes to the right-hand side, its row answers 0.  Inlined by intent: the caller
  /// knows the component.
  [[gnu::always_inline]] void prescribe(int component, Scalar increment) const noexcept {
    const bool moves = increment != 0;  // an end at rest does not
    const auto take = [=](Scalar& rhs, Scalar& entry) {
      if (moves) rhs -= increment * entry;
      entry = 0;
    };
    for (int k = 0; k < component; ++k) take(own[k], own(component, k));
    for (int k = component + 1; k < Block; ++k) take(own[k], own(k, component));
    own(component, component) = 1;  // not the old entry, whose sign would count as a pivot's
    own[component] = 0;
    each_neighbour([&](const auto& other, const auto& c, bool) {
      for (int k = 0; k < Block; ++k) take(other[k], c(component, k));
    });
  }
};
template <typename Scalar, int Block, int Stride, class EachNeighbour>
ChainNode(NodeBlock<Scalar, Block, Stride>, EachNeighbour) -> ChainNode<Scalar, Block, Stride, EachNeighbour>;

}  // namespace hapbeam::detail
