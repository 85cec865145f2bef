// Two numbers that are computed side by side, in one register where the compiler has vectors.
//
// Written on the compiler's own vectors and not on Eigen's arrays, whose expressions g++ -O2 leaves half in memory.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cstring>
#include <type_traits>

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

  [[gnu::always_inline]] static Lanes both(Scalar a) noexcept { return {a, a}; }
  [[gnu::always_inline]] Scalar operator[](int i) const noexcept { return pair_[i]; }
  [[gnu::always_inline]] Lanes swapped() const noexcept { return {pair_[1], pair_[0]}; }

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
  [[gnu::always_inline]] explicit Lanes(const Pair& pair) noexcept : pair_(pair) {}

  Pair pair_;
};
#endif

}  // namespace hapbeam::detail
