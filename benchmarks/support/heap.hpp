// What a model holds of the heap.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace hapbeam::benchmarks {

/// [bytes] in use; 0 where the C library does not tell.
inline std::size_t heap_in_use() {
#ifdef __GLIBC__
  const auto use = mallinfo2();
  return use.uordblks + use.hblkhd;
#else
  return 0;
#endif
}

/// [bytes] of one instance, its own and those of the heap.  Of several: the allocator's cache of small pieces, which counts
/// as in use, is soon filled and then stays.
/// @param make  () -> std::unique_ptr
template <class Make>
double bytes_of(const Make& make) {
  std::vector<decltype(make())> all;
  all.reserve(96);
  std::size_t before = 0;
  for (int k = 0; k < 96; ++k) {
    if (k == 32) before = heap_in_use();
    all.push_back(make());
  }
  return std::round(static_cast<double>(heap_in_use() - before) / 64);
}

}  // namespace hapbeam::benchmarks
