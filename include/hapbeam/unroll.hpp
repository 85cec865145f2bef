// SPDX-License-Identifier: MIT
// A loop of known length that is to be written out: HAPBEAM_UNROLL stands before it.
//
// g++ -O2 does not unroll short loops over small matrices, which then go through memory.  clang does not where the length depends on an
// argument of the function: for_each_constant() makes such an argument a constant.
#pragma once

#include <type_traits>

#if defined(__clang__)
#define HAPBEAM_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define HAPBEAM_UNROLL _Pragma("GCC unroll 16")
#else
#define HAPBEAM_UNROLL
#endif

/// Behind the arguments of a lambda that is to be inlined wherever it is called.
#if defined(__GNUC__)
#define HAPBEAM_INLINED __attribute__((always_inline))
#else
#define HAPBEAM_INLINED
#endif

/// A compiler reads memory anew behind this.  In a loop it keeps numbers out of registers where those are too few.
#if defined(__GNUC__)
#define HAPBEAM_KEEP_IN_MEMORY() asm volatile("" : : : "memory")
#else
#define HAPBEAM_KEEP_IN_MEMORY() static_cast<void>(0)
#endif

namespace hapbeam::detail {

template <int K>
inline constexpr std::integral_constant<int, K> constant{};

/// Calls f(constant<k>) for each k from From to End - 1.
template <int From, int End, class F>
[[gnu::always_inline]] inline void for_each_constant(F&& f) noexcept {
  if constexpr (From < End) {
    f(constant<From>);
    for_each_constant<From + 1, End>(f);
  }
}

}  // namespace hapbeam::detail
