// SPDX-License-Identifier: MIT
// Two numbers that are computed side by side, in one register where the compiler has vectors.
//
// Written on the compiler's own vectors and not on Eigen's arrays, whose expressions g++ -O2 leaves half in memory.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace hapbeam::detail {

#if defined(__GNUC__)
template <typename Scalar>
struct PairOf;
template <>
struct PairOf<float> {
  typedef float type __attribute__((vector_size(8)));
};
template <>
struct PairOf<double> {
  typedef double type __attribute__((vector_size(16)));
};
#endif

/// Entry by entry arithmetic on (left, right).
template <typename Scalar, typename = void>
class Lanes {
 public:
  Lanes() = default;
  Lanes(Scalar left, Scalar right) noexcept : left_(left), right_(right) {}

  static Lanes both(Scalar a) noexcept { return {a, a}; }
  Scalar operator[](int i) const noexcept { return i == 0 ? left_ : right_; }
  Lanes swapped() const noexcept { return {right_, left_}; }

  Lanes operator-() const noexcept { return {-left_, -right_}; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    return {a.left_ + b.left_, a.right_ + b.right_};
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept { return a + -b; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    return {a.left_ * b.left_, a.right_ * b.right_};
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    return {a.left_ / b.left_, a.right_ / b.right_};
  }
  friend Lanes add_product(const Lanes& a, const Lanes& b, const Lanes& c) noexcept { return a + b * c; }
  friend Lanes subtract_product(const Lanes& a, const Lanes& b, const Lanes& c) noexcept { return a - b * c; }

  friend Lanes abs(const Lanes& a) noexcept { return {std::abs(a.left_), std::abs(a.right_)}; }
  /// b where it is less.
  friend Lanes lesser(const Lanes& a, const Lanes& b) noexcept {
    return {b.left_ < a.left_ ? b.left_ : a.left_, b.right_ < a.right_ ? b.right_ : a.right_};
  }
  /// 1 where a number is negative, else 0.
  friend Lanes negatives(const Lanes& a) noexcept { return {Scalar(a.left_ < 0), Scalar(a.right_ < 0)}; }

  static Lanes load(const Scalar* from) noexcept { return {from[0], from[1]}; }
  void store(Scalar* to) const noexcept { to[0] = left_, to[1] = right_; }

 private:
  Scalar left_, right_;
};

#if defined(__GNUC__)
template <typename Scalar>
class Lanes<Scalar, std::void_t<typename PairOf<Scalar>::type>> {
  using Pair = typename PairOf<Scalar>::type;

 public:
  Lanes() = default;
  [[gnu::always_inline]] Lanes(Scalar left, Scalar right) noexcept : pair_{left, right} {}
  [[gnu::always_inline]] explicit Lanes(const Pair& pair) noexcept : pair_(pair) {}

  [[gnu::always_inline]] static Lanes both(Scalar a) noexcept { return {a, a}; }
  [[gnu::always_inline]] Scalar operator[](int i) const noexcept { return pair_[i]; }
  [[gnu::always_inline]] Lanes swapped() const noexcept { return {pair_[1], pair_[0]}; }
  [[gnu::always_inline]] const Pair& pair() const noexcept { return pair_; }

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    return Lanes(a.pair_ + b.pair_);
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
    return Lanes(a.pair_ - b.pair_);
  }
  [[gnu::always_inline]] Lanes operator-() const noexcept { return Lanes(-pair_); }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    return Lanes(a.pair_ * b.pair_);
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    return Lanes(a.pair_ / b.pair_);
  }
  /// a + bc, in one expression: clang fuses no other.
  [[gnu::always_inline]] friend Lanes add_product(const Lanes& a, const Lanes& b, const Lanes& c) noexcept {
    return Lanes(a.pair_ + b.pair_ * c.pair_);
  }
  /// a - bc, likewise.
  [[gnu::always_inline]] friend Lanes subtract_product(const Lanes& a, const Lanes& b,
                                                       const Lanes& c) noexcept {
    return Lanes(a.pair_ - b.pair_ * c.pair_);
  }

  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) noexcept {
    // All bits but the sign: one instruction.
    using Bits = decltype(a.pair_ < 0);
    using Word = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
    return Lanes(Pair(Bits(a.pair_) & (std::numeric_limits<Word>::max)()));
  }
  /// b where it is less.
  [[gnu::always_inline]] friend Lanes lesser(const Lanes& a, const Lanes& b) noexcept {
    return Lanes(b.pair_ < a.pair_ ? b.pair_ : a.pair_);
  }
  /// 1 where a number is negative, else 0.
  [[gnu::always_inline]] friend Lanes negatives(const Lanes& a) noexcept {
    return Lanes(a.pair_ < 0 ? Pair{1, 1} : Pair{0, 0});
  }

  /// Of two numbers that stand at a multiple of their size.
  [[gnu::always_inline]] static Lanes load(const Scalar* from) noexcept {
    Lanes lanes;
    std::memcpy(&lanes.pair_, __builtin_assume_aligned(from, sizeof(Pair)), sizeof(Pair));
    return lanes;
  }
  [[gnu::always_inline]] void store(Scalar* to) const noexcept {
    std::memcpy(__builtin_assume_aligned(to, sizeof(Pair)), &pair_, sizeof(Pair));
  }

 private:
  Pair pair_;
};
#endif

/// Columns of both chains that are computed side by side: (left, right) of one, or of two where registers hold four numbers.
template <typename Scalar, int Columns>
class Strip {
 public:
  Strip() = default;
#if defined(__AVX__) && defined(__GNUC__)
  [[gnu::always_inline]] Strip(const Lanes<Scalar>& first, const Lanes<Scalar>& second) noexcept
      : v_(_mm256_insertf128_pd(_mm256_castpd128_pd256(first.pair()), second.pair(), 1)) {}
  /// The same pair for each column.
  [[gnu::always_inline]] static Strip repeat(const Lanes<Scalar>& pair) noexcept { return {pair, pair}; }
  /// One that stands in memory: the instruction that reads it repeats it.
  [[gnu::always_inline]] static Strip repeat(const Scalar* pair) noexcept {
    Strip strip;
    return strip.v_ = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(pair)), strip;
  }
  /// Columns that stand side by side.
  [[gnu::always_inline]] static Strip load(const Scalar* from) noexcept {
    Strip strip;
    return strip.v_ = _mm256_load_pd(from), strip;
  }
  [[gnu::always_inline]] void store(Scalar* to) const noexcept { _mm256_store_pd(to, v_); }
  [[gnu::always_inline]] Lanes<Scalar> column(int i) const noexcept {
    return Lanes<Scalar>(i == 0 ? _mm256_castpd256_pd128(v_) : _mm256_extractf128_pd(v_, 1));
  }
  [[gnu::always_inline]] friend Strip operator*(const Strip& a, const Strip& b) noexcept {
    Strip c;
    c.v_ = a.v_ * b.v_;
    return c;
  }
  /// a - bc, in one expression: clang fuses no other.
  [[gnu::always_inline]] friend Strip subtract_product(const Strip& a, const Strip& b,
                                                       const Strip& c) noexcept {
    Strip d;
    d.v_ = a.v_ - b.v_ * c.v_;
    return d;
  }

 private:
  static_assert(Columns == 2 && std::is_same_v<Scalar, double>, "one column is a pair of lanes");
  __m256d v_;
#endif
};
template <typename Scalar>
class Strip<Scalar, 1> {
 public:
  Strip() = default;
  [[gnu::always_inline]] Strip(const Lanes<Scalar>& a) noexcept : v_(a) {}
  [[gnu::always_inline]] Strip(const Lanes<Scalar>& a, const Lanes<Scalar>&) noexcept : v_(a) {}
  [[gnu::always_inline]] static Strip repeat(const Lanes<Scalar>& pair) noexcept { return pair; }
  [[gnu::always_inline]] static Strip repeat(const Scalar* pair) noexcept {
    return Lanes<Scalar>::load(pair);
  }
  [[gnu::always_inline]] static Strip load(const Scalar* from) noexcept { return Lanes<Scalar>::load(from); }
  [[gnu::always_inline]] void store(Scalar* to) const noexcept { v_.store(to); }
  [[gnu::always_inline]] Lanes<Scalar> column(int) const noexcept { return v_; }
  [[gnu::always_inline]] friend Strip operator*(const Strip& a, const Strip& b) noexcept {
    return a.v_ * b.v_;
  }
  [[gnu::always_inline]] friend Strip subtract_product(const Strip& a, const Strip& b,
                                                       const Strip& c) noexcept {
    return Strip(subtract_product(a.v_, b.v_, c.v_));
  }

 private:
  Lanes<Scalar> v_;
};

/// How many columns of blocks of so many unknowns stand side by side.  A block of 3 has too few of them.
template <typename Scalar, int Block>
#if defined(__AVX__) && defined(__GNUC__)
inline constexpr int columns_abreast = Block > 3 && std::is_same_v<Scalar, double> ? 2 : 1;
#else
inline constexpr int columns_abreast = 1;
#endif

}  // namespace hapbeam::detail
