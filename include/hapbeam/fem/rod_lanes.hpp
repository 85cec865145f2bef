// Nodes of a rod side by side in the lanes of a register: what is computed of each alone is computed of a few at a time.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Which nodes or elements stand side by side.
template <typename Scalar>
struct Abreast {
  static constexpr int size = Pack<Scalar>::size;
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

/// @param f  index -> number
template <typename Scalar, class F>
[[gnu::always_inline]] inline Pack<Scalar> gather(const Abreast<Scalar>& abreast, F&& f) noexcept {
  return Pack<Scalar>::of([&](int k) { return f(abreast.of[k]); });
}
/// Nodes; s is left out.   @tparam directors  whether they matter
template <bool directors = true, typename Scalar, class Nodes>
[[gnu::always_inline]] inline RodNode<Pack<Scalar>> gather_nodes(const Abreast<Scalar>& abreast,
                                                                 const Nodes& nodes) noexcept {
  const auto vector = [&](auto member) {
    const auto entry = [&](int c) {
      return gather(abreast, [&](int i) -> Scalar { return (nodes[i].*member)[c]; });
    };
    return VectorOf<Pack<Scalar>, 3>(entry(0), entry(1), entry(2));
  };
  using Node = RodNode<Scalar>;
  if constexpr (!directors)
    return {Pack<Scalar>(0), vector(&Node::r), vector(&Node::tangent), VectorOf<Pack<Scalar>, 3>::Zero()};
  else return {Pack<Scalar>(0), vector(&Node::r), vector(&Node::tangent), vector(&Node::director)};
}
/// @param f  (index, lane)
template <typename Scalar, class F>
[[gnu::always_inline]] inline void scatter(const Abreast<Scalar>& abreast, F&& f) noexcept {
  HAPBEAM_UNROLL
  for (int k = 0; k < Abreast<Scalar>::size; ++k) f(abreast.of[k], k);
}
template <typename Scalar>
[[gnu::always_inline]] inline VectorOf<Scalar, 3> lane(const VectorOf<Pack<Scalar>, 3>& v, int k) noexcept {
  return {v[0][k], v[1][k], v[2][k]};
}

}  // namespace hapbeam::detail
