// SPDX-License-Identifier: MIT
// What stands in rows in memory, as columns that are computed side by side: number k of all rows in one Pack.
//
// Rows are read and written whole and exchanged in registers, as butterflies do, which takes a third of what it takes number by number.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <utility>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// @tparam Size  rows that stand side by side
template <typename T, int Size>
struct PackRows {
  using Wide = Pack<T, Size>;
  static constexpr bool in_halves = sizeof(T) == 8 && Size == 8;  // where it has instructions for that
  /// A mask of eight numbers.  g++ warns of functions without one: they begin with what is not set.
  static constexpr unsigned char all = 0xff;

  /// As many numbers of each row as there are rows.   @param columns  out
  [[gnu::always_inline]] static void load(const T* const (&rows)[Size], Wide* columns) noexcept {
#if defined(__AVX512F__) && defined(__GNUC__)
    // Half a row at a time: 64 bytes that begin anywhere cost more, and one exchange is done by this.
    if constexpr (in_halves) {
      HAPBEAM_UNROLL
      for (int i = 0; i < Size; ++i) {
        const T *const upper = rows[i % 4] + i / 4 * 4, *const lower = rows[i % 4 + 4] + i / 4 * 4;
        columns[i].v_ = _mm512_maskz_insertf64x4(all, _mm512_castpd256_pd512(_mm256_loadu_pd(upper)),
                                                 _mm256_loadu_pd(lower), 1);
      }
      exchange<1>(columns), exchange<2>(columns);
      return;
    }
#endif
    HAPBEAM_UNROLL
    for (int i = 0; i < Size; ++i) columns[i] = Wide::load(rows[i]);
    exchange<1>(columns), exchange<2>(columns), exchange<4>(columns);
  }
  [[gnu::always_inline]] static void store(const Wide* columns, T* const (&rows)[Size]) noexcept {
    Wide a[Size];
    HAPBEAM_UNROLL
    for (int i = 0; i < Size; ++i) a[i] = columns[i];
    exchange<1>(a), exchange<2>(a);
#if defined(__AVX512F__) && defined(__GNUC__)
    if constexpr (in_halves) {
      HAPBEAM_UNROLL
      for (int i = 0; i < Size; ++i) {
        T *const upper = rows[i % 4] + i / 4 * 4, *const lower = rows[i % 4 + 4] + i / 4 * 4;
        _mm256_storeu_pd(upper, _mm512_maskz_extractf64x4_pd(0xf, a[i].v_, 0));
        _mm256_storeu_pd(lower, _mm512_maskz_extractf64x4_pd(0xf, a[i].v_, 1));
      }
      return;
    }
#endif
    exchange<4>(a);
    HAPBEAM_UNROLL
    for (int i = 0; i < Size; ++i) a[i].store(rows[i]);
  }

  /// Two numbers of each row.   @param first, second  out
  [[gnu::always_inline]] static void load_two(const T* const (&rows)[Size], Wide& first,
                                              Wide& second) noexcept {
#if defined(__AVX512F__) && defined(__GNUC__)
    if constexpr (in_halves) {
      const auto four = [&rows](int i) {
        const auto two = [&rows](int k) {
          return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(rows[k])),
                                      _mm_loadu_pd(rows[k + 2]), 1);
        };
        return _mm512_maskz_insertf64x4(all, _mm512_castpd256_pd512(two(i)), two(i + 4), 1);
      };
      const __m512d even = four(0), odd = four(1);
      first.v_ = _mm512_maskz_unpacklo_pd(all, even, odd),
      second.v_ = _mm512_maskz_unpackhi_pd(all, even, odd);
      return;
    }
#endif
    first = Wide::of([&](int k) { return rows[k][0]; }), second = Wide::of([&](int k) { return rows[k][1]; });
  }
  [[gnu::always_inline]] static void store_two(const Wide& first, const Wide& second,
                                               T* const (&rows)[Size]) noexcept {
#if defined(__AVX512F__) && defined(__GNUC__)
    if constexpr (in_halves) {
      const auto put = [&rows](const __m512d& pairs, int k) {
        const __m256d low = _mm512_maskz_extractf64x4_pd(0xf, pairs, 0),
                      high = _mm512_maskz_extractf64x4_pd(0xf, pairs, 1);
        _mm_storeu_pd(rows[k], _mm256_castpd256_pd128(low));
        _mm_storeu_pd(rows[k + 2], _mm256_extractf128_pd(low, 1));
        _mm_storeu_pd(rows[k + 4], _mm256_castpd256_pd128(high));
        _mm_storeu_pd(rows[k + 6], _mm256_extractf128_pd(high, 1));
      };
      put(_mm512_maskz_unpacklo_pd(all, first.v_, second.v_), 0),
          put(_mm512_maskz_unpackhi_pd(all, first.v_, second.v_), 1);
      return;
    }
#endif
    HAPBEAM_UNROLL
    for (int k = 0; k < Size; ++k) rows[k][0] = first[k], rows[k][1] = second[k];
  }

  /// Pairs of numbers: every other one of a is exchanged with the one before it in b.
  [[gnu::always_inline]] static void cross_pairs(Wide& a, Wide& b) noexcept {
#if defined(__GNUC__)
    constexpr std::make_integer_sequence<int, Size> each{};
    const auto upper = a.v_, lower = b.v_;
    a.v_ = crossed<2, false>(upper, lower, each), b.v_ = crossed<2, true>(upper, lower, each);
#else
    for (int k = 0; k < Size; ++k)
      if (!(k & 2)) std::swap(a.v_[k + 2], b.v_[k]);
#endif
  }

 private:
  /// In blocks of 2 By rows and columns, exchanges what stands above their diagonal with what stands below it.
  template <int By>
  [[gnu::always_inline]] static void exchange(Wide* rows) noexcept {
    if constexpr (By < Size) {
      HAPBEAM_UNROLL
      for (int i = 0; i < Size; ++i) {
        if (i & By) continue;
#if defined(__GNUC__)
        const auto upper = rows[i].v_, lower = rows[i + By].v_;
        constexpr std::make_integer_sequence<int, Size> each{};
        rows[i].v_ = crossed<By, false>(upper, lower, each);
        rows[i + By].v_ = crossed<By, true>(upper, lower, each);
#else
        for (int k = 0; k < Size; ++k)
          if (!(k & By)) std::swap(rows[i].v_[k + By], rows[i + By].v_[k]);
#endif
      }
    }
  }
#if defined(__GNUC__)
  /// Where both rows have number I of the upper or of the lower one.
  static constexpr int from(int i, int by, bool below) noexcept {
    return (i & by) ? Size + (below ? i : i - by) : (below ? i + by : i);
  }
  template <int By, bool Below, class Vector, int... I>
  [[gnu::always_inline]] static Vector crossed(const Vector& a, const Vector& b,
                                               std::integer_sequence<int, I...>) noexcept {
#if defined(__clang__)
    return __builtin_shufflevector(a, b, from(I, By, Below)...);
#else
    return __builtin_shuffle(a, b, typename Wide::Mask{from(I, By, Below)...});
#endif
  }
#endif
};

}  // namespace hapbeam::detail
