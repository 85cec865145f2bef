// SPDX-License-Identifier: MIT
// A few numbers computed side by side, in one register where the compiler has vectors. It is a scalar type for
// elements, which are templates of their scalar.
//
// Two numbers of 8 bytes, four with AVX and eight with AVX-512; four of 4 bytes.  Functions that a processor has no instruction for are called one by one.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include <Eigen/Core>

#include <hapbeam/angle.hpp>

/// Before a function that has more numbers side by side than registers.  clang puts the others on the stack as a caller has aligned it, to 16 bytes,
/// where they stand across two lines of the cache.
#if defined(__clang__) && defined(__AVX__)
#define HAPBEAM_ALIGNED_STACK [[gnu::force_align_arg_pointer]]
#else
#define HAPBEAM_ALIGNED_STACK
#endif

namespace hapbeam::detail {

#if defined(__AVX512F__)
inline constexpr int wide_bytes = 64;
#elif defined(__AVX__)
inline constexpr int wide_bytes = 32;
#else
inline constexpr int wide_bytes = 16;
#endif

/// How many of them stand side by side.
template <typename T>
inline constexpr int pack_size = sizeof(T) == 4   ? 4
                                 : sizeof(T) == 8 ? wide_bytes / 8
                                                  : 1;

/// a + bc, in one expression: clang fuses no other.
template <typename S>
[[gnu::always_inline]] inline S add_product(const S& a, const S& b, const S& c) noexcept {
  return a + b * c;
}

template <typename T, int Size>
struct PackRows;
template <typename T>
struct Columns;

template <typename T, int Size = pack_size<T>>
class Pack {
  friend struct PackRows<T, Size>;
  friend struct Columns<T>;

 public:
  static constexpr int size = Size;

  Pack() = default;
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  [[gnu::always_inline]] Pack(Number a) noexcept {
#if defined(__GNUC__)
    v_ = static_cast<T>(a) - Vector{};  // a loop would hide from a compiler how short this is
#else
    for (int i = 0; i < size; ++i) v_[i] = static_cast<T>(a);
#endif
  }
  /// @param f  i -> the i-th number
  template <class F>
  [[gnu::always_inline]] static Pack of(F&& f) noexcept {
    Pack pack(0);
    for (int i = 0; i < size; ++i) pack.v_[i] = f(i);
    return pack;
  }

  [[gnu::always_inline]] static Pack load(const T* from) noexcept {
    Pack pack;
    std::memcpy(&pack.v_, from, sizeof pack.v_);
    return pack;
  }
  [[gnu::always_inline]] void store(T* to) const noexcept { std::memcpy(to, &v_, sizeof v_); }
#if defined(__GNUC__)
  /// Where they stand at a multiple of their size.
  [[gnu::always_inline]] static Pack load_aligned(const T* from) noexcept {
    return load(static_cast<const T*>(__builtin_assume_aligned(from, sizeof(Vector))));
  }
  [[gnu::always_inline]] void store_aligned(T* to) const noexcept {
    store(static_cast<T*>(__builtin_assume_aligned(to, sizeof(Vector))));
  }
#else
  static Pack load_aligned(const T* from) noexcept { return load(from); }
  void store_aligned(T* to) const noexcept { store(to); }
#endif

  [[gnu::always_inline]] T operator[](int i) const noexcept { return v_[i]; }
  [[gnu::always_inline]] void set(int i, T a) noexcept { v_[i] = a; }

#if defined(__clang__)
#define HAPBEAM_FUSED \
  _Pragma("clang fp contract(fast)")  // as g++ does, whichever function a product comes from
#else
#define HAPBEAM_FUSED
#endif
#if defined(__GNUC__)
#define HAPBEAM_LANEWISE(op)                                            \
  [[gnu::always_inline]] Pack& operator op##=(const Pack& b) noexcept { \
    HAPBEAM_FUSED                                                       \
    return v_ op## = b.v_, *this;                                       \
  }
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
#undef HAPBEAM_FUSED

  /// Sum of all of them.
  friend T total(const Pack& a) noexcept {
    T sum = a[0];
    for (int i = 1; i < size; ++i) sum += a[i];
    return sum;
  }
  /// Every other number is one of b.
  [[gnu::always_inline]] friend Pack in_turn(const Pack& a, const Pack& b) noexcept {
    Pack both;
#if defined(__GNUC__)
    Mask mask;
    for (int i = 0; i < size; ++i) mask[i] = i % 2 == 0 ? -1 : 0;
    both.v_ = mask ? a.v_ : b.v_;
#else
    for (int i = 0; i < size; ++i) both.v_[i] = i % 2 == 0 ? a[i] : b[i];
#endif
    return both;
  }

  /// a, moved up by two numbers, after two others; or by one.
  [[gnu::always_inline]] friend Pack after(const T* two, const Pack& a) noexcept {
    return moved<2, true>(two, a);
  }
  [[gnu::always_inline]] friend Pack after(const T& one, const Pack& a) noexcept {
    return moved<1, true>(&one, a);
  }
  /// a, moved down by two numbers, before two others; or by one.
  [[gnu::always_inline]] friend Pack before(const Pack& a, const T* two) noexcept {
    return moved<2, false>(two, a);
  }
  [[gnu::always_inline]] friend Pack before(const Pack& a, const T& one) noexcept {
    return moved<1, false>(&one, a);
  }

  [[gnu::always_inline]] Pack operator-() const noexcept {
#if defined(__GNUC__)
    Pack negative;
    return negative.v_ = -v_, negative;
#else
    return Pack(0) -= *this;
#endif
  }
  [[gnu::always_inline]] friend Pack operator+(Pack a, const Pack& b) noexcept { return a += b; }
  [[gnu::always_inline]] friend Pack operator-(Pack a, const Pack& b) noexcept { return a -= b; }
  [[gnu::always_inline]] friend Pack operator*(Pack a, const Pack& b) noexcept { return a *= b; }
  [[gnu::always_inline]] friend Pack operator/(Pack a, const Pack& b) noexcept { return a /= b; }

  [[gnu::always_inline]] friend Pack add_product(Pack a, const Pack& b, const Pack& c) noexcept {
#if defined(__GNUC__)
    return a.v_ = a.v_ + b.v_ * c.v_, a;
#else
    return a + b * c;
#endif
  }

  [[gnu::always_inline]] friend Pack subtract_product(Pack a, const Pack& b, const Pack& c) noexcept {
#if defined(__GNUC__)
    return a.v_ = a.v_ - b.v_ * c.v_, a;
#else
    return a - b * c;
#endif
  }
  [[gnu::always_inline]] friend Pack abs(Pack a) noexcept {
#if defined(__GNUC__)
    // All bits but the sign: one instruction.
    return a.v_ = Vector(Mask(a.v_) & (std::numeric_limits<Bits>::max)()), a;
#else
    for (int i = 0; i < size; ++i) a.v_[i] = std::abs(a.v_[i]);
    return a;
#endif
  }
  /// 1 where a number is negative, else 0.
  [[gnu::always_inline]] friend Pack negatives(Pack a) noexcept {
#if defined(__GNUC__)
    return a.v_ = a.v_ < 0 ? Pack(1).v_ : Pack(0).v_, a;
#else
    for (int i = 0; i < size; ++i) a.v_[i] = T(a.v_[i] < 0);
    return a;
#endif
  }
  [[gnu::always_inline]] friend Pack sqrt(Pack a) noexcept {
    // std::sqrt sets errno, which keeps a compiler from its instruction.  Eigen has that for up to 32 bytes, through memory; in
    // double it is exact.
#if defined(__AVX512F__) && defined(__GNUC__)
    if constexpr (sizeof(T) == 8 && size == 8) return a.v_ = _mm512_maskz_sqrt_pd(0xff, a.v_), a;
#endif
#if defined(__AVX__) && defined(__GNUC__)
    if constexpr (sizeof(T) == 8 && size == 4) return a.v_ = _mm256_sqrt_pd(a.v_), a;
#endif
    using Part = Eigen::Array<T, (std::min)(size, 4), 1>;
    if constexpr (sizeof(T) == 8) {
      Part part;
      for (int i = 0; i < size; i += static_cast<int>(part.size())) {
        T* const from = reinterpret_cast<T*>(&a.v_) + i;
        std::memcpy(part.data(), from, sizeof part);
        part = part.sqrt().eval();
        std::memcpy(from, part.data(), sizeof part);
      }
    } else {
      for (int i = 0; i < size; ++i) a.v_[i] = std::sqrt(a.v_[i]);
    }
    return a;
  }
  /// Whether each number of a is less than that of b.
  [[gnu::always_inline]] friend bool all_less(const Pack& a, const Pack& b) noexcept {
#if defined(__AVX512F__) && defined(__GNUC__)
    // g++ would store all answers and read them one by one.
    if constexpr (sizeof(T) == 8 && size == 8) return _mm512_cmp_pd_mask(a.v_, b.v_, _CMP_LT_OQ) == 0xff;
#endif
#if defined(__AVX__) && defined(__GNUC__)
    if constexpr (sizeof(T) == 8 && size == 4)
      return _mm256_movemask_pd(_mm256_cmp_pd(a.v_, b.v_, _CMP_LT_OQ)) == 0xf;
#endif
#if defined(__GNUC__)
    constexpr int words = static_cast<int>(sizeof(Mask) / sizeof(std::int64_t));
    const Mask mask = a.v_ < b.v_;
    std::int64_t all[words];
    std::memcpy(all, &mask, sizeof mask);
    for (int i = 1; i < words; ++i) all[0] &= all[i];
    return all[0] == -1;
#else
    for (int i = 0; i < size; ++i)
      if (!(a[i] < b[i])) return false;
    return true;
#endif
  }
  /// The larger of both, of each.
  [[gnu::always_inline]] friend Pack larger(Pack a, const Pack& b) noexcept {
#if defined(__GNUC__)
    return a.v_ = a.v_ < b.v_ ? b.v_ : a.v_, a;
#else
    for (int i = 0; i < size; ++i) a.v_[i] = (std::max)(a.v_[i], b.v_[i]);
    return a;
#endif
  }
  /// atan2(y, x).  @param length  √(x² + y²)
  [[gnu::always_inline]] friend Pack angle(const Pack& y, const Pack& x, const Pack& length) noexcept {
    const Pack whole = length + x;
    return all_less(y * y, whole * whole) && all_less(0, whole) ? twice_atan(y / whole) : one_by_one(y, x);
  }
  [[gnu::always_inline]] friend Pack atan2(const Pack& y, const Pack& x) noexcept {
    return angle(y, x, sqrt(x * x + y * y));
  }
  friend Pack angle_near(const Pack& y, const Pack& x, const Pack& length, const Pack& other) noexcept {
    const Pack whole = length + x;
    Pack angle = twice_atan(y / whole);
    for (int i = 0; i < size; ++i)
      if (!(std::abs(y[i]) < whole[i] && std::abs(angle[i] - other[i]) < T(3)))
        angle.v_[i] = detail::angle_near(y[i], x[i], length[i], other[i]);
    return angle;
  }
  /// part/whole, nothing where the whole is not positive.
  [[gnu::always_inline]] friend Pack share_of(const Pack& part, const Pack& whole) noexcept {
    Pack share = part / whole;
#if defined(__GNUC__)
    share.v_ = whole.v_ > 0 ? share.v_ : Pack(0).v_;
#else
    for (int i = 0; i < size; ++i) share.v_[i] = whole.v_[i] > 0 ? share.v_[i] : T(0);
#endif
    return share;
  }
  /// cos √q and sin √q / √q
  [[gnu::always_inline]] friend void cos_and_sin_of_square(const Pack& q, Pack& cosine, Pack& sine) noexcept {
    if (all_less(q, T(0.25))) small_square_turn(q, cosine, sine);
    else one_by_one([](T a, T& c, T& s) { detail::cos_and_sin_of_square(a, c, s); }, q, cosine, sine);
  }
  /// cos α and sin α
  [[gnu::always_inline]] friend void cos_and_sin(const Pack& a, Pack& cosine, Pack& sine) noexcept {
    if (all_less(a * a, T(0.6241))) small_turn(a, cosine, sine);
    else
      one_by_one(
          [](T x, T& c, T& s) {
            const auto to = direction(x);
            c = to[0], s = to[1];
          },
          a, cosine, sine);
  }

 private:
  /// Moved by so many numbers, which come in first or last.
  template <int By, bool First>
  [[gnu::always_inline]] static Pack moved(const T* in, const Pack& a) noexcept {
    Pack pack;
#if defined(__GNUC__)
    Vector numbers;
    if constexpr (By == 2) numbers = Vector{in[0], in[1]};
    else numbers = Vector{in[0]};
    constexpr std::make_integer_sequence<int, size> each{};
    if constexpr (First) pack.v_ = from_both<By, true>(numbers, a.v_, each);
    else pack.v_ = from_both<By, false>(a.v_, numbers, each);
#else
    for (int i = 0; i < size; ++i)
      pack.v_[i] =
          First ? (i < By ? in[i] : a.v_[i - By]) : (i + By < size ? a.v_[i + By] : in[i + By - size]);
#endif
    return pack;
  }
  template <class F>
  static void one_by_one(F&& f, const Pack& a, Pack& cosine, Pack& sine) noexcept {
    for (int i = 0; i < size; ++i) {
      T c, s;
      f(a[i], c, s);
      cosine.v_[i] = c, sine.v_[i] = s;
    }
  }
  static Pack one_by_one(Pack y, const Pack& x) noexcept {
    for (int i = 0; i < size; ++i) y.v_[i] = std::atan2(y.v_[i], x.v_[i]);
    return y;
  }

#if defined(__GNUC__)
  using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  typedef T Vector __attribute__((vector_size(size * sizeof(T))));
  typedef Bits Mask __attribute__((vector_size(size * sizeof(T))));
  template <int By, bool First, int... I>
  [[gnu::always_inline]] static Vector from_both(const Vector& a, const Vector& b,
                                                 std::integer_sequence<int, I...>) noexcept {
#if defined(__clang__)
    return __builtin_shufflevector(a, b, (First ? (I < By ? I : size + I - By) : I + By)...);
#else
    return __builtin_shuffle(a, b, Mask{(First ? (I < By ? I : size + I - By) : I + By)...});
#endif
  }
  Vector v_;
#else
  T v_[size];
#endif
};

}  // namespace hapbeam::detail

namespace Eigen {

template <typename T, int Size>
struct NumTraits<hapbeam::detail::Pack<T, Size>> : NumTraits<T> {
  using Real = hapbeam::detail::Pack<T, Size>;
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
