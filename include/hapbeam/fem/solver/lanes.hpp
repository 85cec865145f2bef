// SPDX-License-Identifier: MIT
// What both chains of a system compute side by side: a number of each, and columns of those.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <type_traits>

#include <hapbeam/element/pack.hpp>

namespace hapbeam::detail {

/// A number of the left chain, and one of the right chain.
template <typename Scalar>
using Lanes = Pack<Scalar, 2>;

template <typename Scalar>
[[gnu::always_inline]] inline Lanes<Scalar> lanes(Scalar left, Scalar right) noexcept {
  return Lanes<Scalar>::of([=](int i) { return i == 0 ? left : right; });
}

/// How many columns of a block stand side by side, in a register for four numbers.
template <typename Scalar>
#if defined(__AVX__) && defined(__GNUC__)
inline constexpr int columns_abreast = std::is_same_v<Scalar, double> ? 2 : 1;
#else
inline constexpr int columns_abreast = 1;
#endif

/// Columns of both chains that are computed side by side: (left, right) of one, or of two.
template <typename Scalar>
struct Columns {
  static constexpr int abreast = columns_abreast<Scalar>;
  using Pair = Lanes<Scalar>;
  using Wide = Pack<Scalar, 2 * abreast>;

  [[gnu::always_inline]] static Wide of(const Pair& first, [[maybe_unused]] const Pair& second) noexcept {
#if defined(__AVX__) && defined(__GNUC__)
    if constexpr (abreast == 2) {
      Wide wide;
      wide.v_ = _mm256_insertf128_pd(_mm256_castpd128_pd256(first.v_), second.v_, 1);
      return wide;
    }
#endif
    if constexpr (abreast == 1) return first;
  }
  /// The same pair for each column.
  [[gnu::always_inline]] static Wide repeat(const Pair& pair) noexcept { return of(pair, pair); }
  /// One that stands in memory: the instruction that reads it repeats it.
  [[gnu::always_inline]] static Wide repeat(const Scalar* pair) noexcept {
#if defined(__AVX__) && defined(__GNUC__)
    if constexpr (abreast == 2) {
      Wide wide;
      wide.v_ = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(pair));
      return wide;
    }
#endif
    if constexpr (abreast == 1) return Wide::load_aligned(pair);
  }
  [[gnu::always_inline]] static Pair column(const Wide& wide, [[maybe_unused]] int i) noexcept {
#if defined(__AVX__) && defined(__GNUC__)
    if constexpr (abreast == 2) {
      Pair pair;
      pair.v_ = i == 0 ? _mm256_castpd256_pd128(wide.v_) : _mm256_extractf128_pd(wide.v_, 1);
      return pair;
    }
#endif
    if constexpr (abreast == 1) return wide;
  }
};

}  // namespace hapbeam::detail
