// SPDX-License-Identifier: MIT
// Nodes of a rod side by side in the lanes of a register: what is computed of each alone is computed of a few at a time.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/pack_rows.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Groups of what stands side by side in a rod, for PerNode, which has one more.
template <typename Scalar>
constexpr int groups_of(int elements) noexcept {
  return elements == Eigen::Dynamic ? Eigen::Dynamic : (std::max)(elements / pack_size<Scalar> + 1, 2);
}

/// Which nodes or elements stand side by side.
template <typename Scalar, int Size = pack_size<Scalar>>
struct Abreast {
  using Wide = Pack<Scalar, Size>;
  static constexpr int size = Size;
  int of[size];

  /// From first on.  Beyond the last one that one stands again.
  static Abreast from(int first, int last) noexcept {
    Abreast abreast;
    for (int k = 0; k < size; ++k) abreast.of[k] = (std::min)(first + k, last);
    return abreast;
  }
  /// Those so many nodes further on, none before 0 or behind the last one.
  Abreast next(int by, int last) const noexcept {
    Abreast abreast;
    for (int k = 0; k < size; ++k) abreast.of[k] = std::clamp(of[k] + by, 0, last);
    return abreast;
  }
};

/// Calls f(which) for all nodes from 0 to the last one, as many at a time as registers hold.  One or two that are left take a
/// register for two: that is the last of 8 elements.
template <typename Scalar, class F>
[[gnu::always_inline]] inline void for_each_abreast(int last, F&& f) noexcept {
  int first = 0;
  for (; first + 2 <= last; first += pack_size<Scalar>) f(Abreast<Scalar>::from(first, last));
  if (first <= last) f(Abreast<Scalar, 2>::from(first, last));
}

/// @param f  index -> number
template <typename Scalar, int Size, class F>
[[gnu::always_inline]] inline Pack<Scalar, Size> gather(const Abreast<Scalar, Size>& abreast,
                                                        F&& f) noexcept {
  return Pack<Scalar, Size>::of([&](int k) { return f(abreast.of[k]); });
}
/// Nodes as rows of numbers: s, r, tangent, director.
template <typename Scalar, int Size>
struct NodeRows {
  using Wide = Pack<Scalar, Size>;
  using Rows = PackRows<Scalar, Size>;
  using Node = RodNode<Scalar>;
  static constexpr int numbers = 10, whole = numbers / Size * Size;
  static_assert(sizeof(Node) == numbers * sizeof(Scalar), "nothing stands between the numbers of a node");
  [[gnu::always_inline]] static const Scalar* numbers_of(const Node& node) noexcept {
    return reinterpret_cast<const Scalar*>(&node);
  }
  [[gnu::always_inline]] static Scalar* numbers_of(Node& node) noexcept {
    return reinterpret_cast<Scalar*>(&node);
  }

  /// Reads the first of them.   @param column  out, number by number
  template <int Count, class Nodes>
  [[gnu::always_inline]] static void gather(const Abreast<Scalar, Size>& which, const Nodes& nodes,
                                            Wide (&column)[numbers]) noexcept {
    for (int at = 0; at < (std::min)(Count, whole); at += Size) {
      const Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + at;
      Rows::load(rows, column + at);
    }
    if constexpr (Count > whole) {
      const Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + whole;
      Rows::load_two(rows, column[whole], column[whole + 1]);
    }
  }
  /// Writes them.
  template <class Nodes>
  [[gnu::always_inline]] static void scatter(const Abreast<Scalar, Size>& which,
                                             const Wide (&column)[numbers], Nodes& nodes) noexcept {
    for (int at = 0; at < whole; at += Size) {
      Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + at;
      Rows::store(column + at, rows);
    }
    if constexpr (numbers > whole) {
      Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + whole;
      Rows::store_two(column[whole], column[whole + 1], rows);
    }
  }
};

/// @tparam directors  whether they matter
template <bool directors = true, typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline RodNode<Pack<Scalar, Size>> gather_nodes(const Abreast<Scalar, Size>& abreast,
                                                                       const Nodes& nodes) noexcept {
  using Wide = Pack<Scalar, Size>;
  using Vector = VectorOf<Wide, 3>;
  Wide all[10];
  NodeRows<Scalar, Size>::template gather<directors ? 10 : 7>(abreast, nodes, all);
  RodNode<Wide> node{all[0], Vector(all[1], all[2], all[3]), Vector(all[4], all[5], all[6]), Vector::Zero()};
  if constexpr (directors) node.director = Vector(all[7], all[8], all[9]);
  return node;
}
template <typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline void scatter_nodes(const Abreast<Scalar, Size>& abreast,
                                                 const RodNode<Pack<Scalar, Size>>& node,
                                                 Nodes& nodes) noexcept {
  const auto &r = node.r, &t = node.tangent, &d = node.director;
  const Pack<Scalar, Size> all[10] = {node.s, r[0], r[1], r[2], t[0], t[1], t[2], d[0], d[1], d[2]};
  NodeRows<Scalar, Size>::scatter(abreast, all, nodes);
}

}  // namespace hapbeam::detail
