// A few numbers computed side by side, in one register where the compiler has vectors. It is a scalar type for
// elements, which are templates of their scalar.
//
// Two numbers of 8 bytes, four with AVX; four of 4 bytes.  Functions that a processor has no instruction for are called one by one.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <type_traits>

#include <Eigen/Core>

#include <hapbeam/angle.hpp>

namespace hapbeam::detail {

#if defined(__AVX__)
inline constexpr int wide_bytes = 32;
#else
inline constexpr int wide_bytes = 16;
#endif

/// How many of them stand side by side.
template <typename T>
inline constexpr int pack_size = sizeof(T) == 4   ? 4
                                 : sizeof(T) == 8 ? wide_bytes / 8
                                                  : 1;

template <typename T>
class Pack {
 public:
  static constexpr int size = pack_size<T>;

  Pack() = default;
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  [[gnu::always_inline]] Pack(Number a) noexcept {
    for (int i = 0; i < size; ++i) v_[i] = static_cast<T>(a);
  }
  /// @param f  i -> the i-th number
  template <class F>
  [[gnu::always_inline]] static Pack of(F&& f) noexcept {
    Pack pack(0);
    for (int i = 0; i < size; ++i) pack.v_[i] = f(i);
    return pack;
  }

  [[gnu::always_inline]] T operator[](int i) const noexcept { return v_[i]; }
  [[gnu::always_inline]] void set(int i, T a) noexcept { v_[i] = a; }

#if defined(__GNUC__)
#define HAPBEAM_LANEWISE(op) \
  [[gnu::always_inline]] Pack& operator op##=(const Pack& b) noexcept { return v_ op## = b.v_, *this; }
#else
#define HAPBEAM_LANEWISE(op)                          \
  Pack& operator op##=(const Pack& b) noexcept {      \
    for (int i = 0; i < size; ++i) v_[i] op## = b[i]; \
    return *this;                                     \
  }
#endif
  HAPBEAM_LANEWISE(+)
  HAPBEAM_LANEWISE(-)
  HAPBEAM_LANEWISE(*)
  HAPBEAM_LANEWISE(/)
#undef HAPBEAM_LANEWISE

  [[gnu::always_inline]] Pack operator-() const noexcept { return Pack(0) -= *this; }
  [[gnu::always_inline]] friend Pack operator+(Pack a, const Pack& b) noexcept { return a += b; }
  [[gnu::always_inline]] friend Pack operator-(Pack a, const Pack& b) noexcept { return a -= b; }
  [[gnu::always_inline]] friend Pack operator*(Pack a, const Pack& b) noexcept { return a *= b; }
  [[gnu::always_inline]] friend Pack operator/(Pack a, const Pack& b) noexcept { return a /= b; }

  friend Pack sqrt(Pack a) noexcept {
    for (int i = 0; i < size; ++i) a.v_[i] = std::sqrt(a.v_[i]);
    return a;
  }
  friend Pack atan2(Pack y, const Pack& x) noexcept {
    const Pack whole = sqrt(x * x + y * y) + x;
    bool small_angles = true;
    for (int i = 0; i < size; ++i) small_angles = small_angles && std::abs(y[i]) < whole[i];
    if (small_angles) return twice_atan(y / whole);
    for (int i = 0; i < size; ++i) y.v_[i] = std::atan2(y.v_[i], x.v_[i]);
    return y;
  }
  /// cos α and sin α
  friend void cos_and_sin(const Pack& a, Pack& cosine, Pack& sine) noexcept {
    bool small_angles = true;
    for (int i = 0; i < size; ++i) small_angles = small_angles && std::abs(a[i]) < T(0.79);
    if (small_angles) return small_turn(a, cosine, sine);
    for (int i = 0; i < size; ++i) cosine.v_[i] = std::cos(a.v_[i]), sine.v_[i] = std::sin(a.v_[i]);
  }

 private:
#if defined(__GNUC__)
  typedef T Vector __attribute__((vector_size(size * sizeof(T))));
  Vector v_;
#else
  T v_[size];
#endif
};

}  // namespace hapbeam::detail

namespace Eigen {

template <typename T>
struct NumTraits<hapbeam::detail::Pack<T>> : NumTraits<T> {
  using Real = hapbeam::detail::Pack<T>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

}  // namespace Eigen
