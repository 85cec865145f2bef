// Nodes of a rod side by side in the lanes of a register: what is computed of each alone is computed of a few at a time.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/pack.hpp>
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
  /// @param f  index -> index
  template <class F>
  Abreast of_each(F&& f) const noexcept {
    Abreast abreast;
    for (int k = 0; k < size; ++k) abreast.of[k] = f(of[k]);
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
/// One of the vectors of nodes.
template <typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline VectorOf<Pack<Scalar, Size>, 3> gather(
    const Abreast<Scalar, Size>& abreast, const Nodes& nodes,
    VectorOf<Scalar, 3> RodNode<Scalar>::*member) noexcept {
  const auto entry = [&](int c) {
    return gather(abreast, [&](int i) -> Scalar { return (nodes[i].*member)[c]; });
  };
  return {entry(0), entry(1), entry(2)};
}
/// Nodes; s is left out.   @tparam directors  whether they matter
template <bool directors = true, typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline RodNode<Pack<Scalar, Size>> gather_nodes(const Abreast<Scalar, Size>& abreast,
                                                                       const Nodes& nodes) noexcept {
  using Node = RodNode<Scalar>;
  using Wide = Pack<Scalar, Size>;
  RodNode<Wide> node{0, gather(abreast, nodes, &Node::r), gather(abreast, nodes, &Node::tangent),
                     VectorOf<Wide, 3>::Zero()};
  if constexpr (directors) node.director = gather(abreast, nodes, &Node::director);
  return node;
}
/// @param f  (index, lane)
template <typename Scalar, int Size, class F>
[[gnu::always_inline]] inline void scatter(const Abreast<Scalar, Size>& abreast, F&& f) noexcept {
  HAPBEAM_UNROLL
  for (int k = 0; k < Size; ++k) f(abreast.of[k], k);
}
template <typename Scalar, int Size>
[[gnu::always_inline]] inline VectorOf<Scalar, 3> lane(const VectorOf<Pack<Scalar, Size>, 3>& v,
                                                       int k) noexcept {
  return {v[0][k], v[1][k], v[2][k]};
}

}  // namespace hapbeam::detail
