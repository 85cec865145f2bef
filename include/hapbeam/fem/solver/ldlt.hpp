// SPDX-License-Identifier: MIT
// The small pieces of a block elimination: LDLᵀ of one symmetric block, and what its pivots tell.
//
// Each is done for two blocks side by side, in the two lanes of a register.  Blocks are small and their size is known, so each loop is
// unrolled by intent: g++ -O2 would leave loops, whose entries go through memory.
// Real-time: noexcept, no allocation, O(N³).  Source: Golub and Van Loan, Matrix Computations, 4.1.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

namespace detail {

/// What both chains of a system compute side by side: a number of the left one, and one of the right one.
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

/// Numbers of two chains side by side, one of which can be reached alone.
template <typename S>
struct alignas(2 * sizeof(S)) TwoNumbers {
  S a[2] = {0, 0};

  [[gnu::always_inline]] Lanes<S> get() const noexcept { return Lanes<S>::load_aligned(a); }
  [[gnu::always_inline]] void set(const Lanes<S>& lanes) noexcept { lanes.store_aligned(a); }
};

/// Where the lower triangle of a symmetric N×N matrix has (i, j), i >= j, column by column.
template <int N>
constexpr int triangle(int i, int j) noexcept {
  return j * (2 * N - 1 - j) / 2 + i;
}
template <int N>
inline constexpr int triangle_size = N*(N + 1) / 2;

/// a less bᵀc.  The last component is known last: it is subtracted last.
template <int N, typename S>
[[gnu::always_inline]] inline Lanes<S> less(Lanes<S> a, const Lanes<S>* b, const Lanes<S>* c) noexcept {
  HAPBEAM_UNROLL
  for (int k = 0; k < N; ++k) a = subtract_product(a, b[k], c[k]);
  return a;
}

/// A = L P Lᵀ of a symmetric N×N matrix, L unit lower.
template <typename S, int N>
struct Ldlt {
  using V = Lanes<S>;
  V l[triangle_size<N>];  ///< below its diagonal: L
  V p[N];                 ///< pivots
  V i[N];                 ///< their inverses

  [[gnu::always_inline]] explicit Ldlt(const V* a) noexcept {
    const V one = V(1);
    V c[triangle_size<N>];  // LP
    HAPBEAM_UNROLL
    for (int j = 0; j < N; ++j) {
      HAPBEAM_UNROLL
      for (int row = j; row < N; ++row) {
        V sum = a[triangle<N>(row, j)];
        HAPBEAM_UNROLL
        for (int k = 0; k < j; ++k) sum = subtract_product(sum, l[triangle<N>(row, k)], c[triangle<N>(j, k)]);
        c[triangle<N>(row, j)] = sum;
      }
      p[j] = c[triangle<N>(j, j)];
      i[j] = one / p[j];
      HAPBEAM_UNROLL
      for (int row = j + 1; row < N; ++row) l[triangle<N>(row, j)] = c[triangle<N>(row, j)] * i[j];
    }
  }

  /// b becomes L⁻¹ b.
  [[gnu::always_inline]] void forward(V* b) const noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k + 1 < N; ++k) {
      HAPBEAM_UNROLL
      for (int row = k + 1; row < N; ++row) b[row] = subtract_product(b[row], l[triangle<N>(row, k)], b[k]);
    }
  }
  /// z is P⁻¹ y.
  [[gnu::always_inline]] void scale(const V* y, V* z) const noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k < N; ++k) z[k] = y[k] * i[k];
  }
};

/// What the eliminations of both chains have seen.
template <typename S>
class Pivots {
  using V = Lanes<S>;

 public:
  /// @param assembled  its diagonal entry before elimination
  [[gnu::always_inline]] void see(const V& pivot, const V& assembled) noexcept {
    const V lost = std::numeric_limits<S>::epsilon() * abs(assembled) - abs(pivot);
    most_ = larger(most_, lost), sum_ += lost;
    negative_ += negatives(pivot);
  }
  /// Whether all were numbers, and none of them but round-off of what was assembled.   @return ok | singular | non_finite
  Status status() const noexcept {
    if (most_[0] >= 0 || most_[1] >= 0) return Status::singular;
    return std::isfinite(sum_[0]) && std::isfinite(sum_[1]) ? Status::ok : Status::non_finite;
  }
  int negative() const noexcept { return static_cast<int>(negative_[0] + negative_[1]); }

 private:
  V most_ = V(-(std::numeric_limits<S>::max)());  // eps |its diagonal entry| - |pivot|
  V sum_ = V(0);                                  // of those, no number where one was none or infinite
  V negative_ = V(0);                             // how many
};

}  // namespace detail

}  // namespace hapbeam
