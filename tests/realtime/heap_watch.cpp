// The replaced allocator of heap_watch.hpp.
//
// glibc finds its allocator by name, so that the program's own malloc takes its place everywhere, in the C++ library
// too, and offers the original under other names.  Nothing here may allocate.
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <realtime/heap_watch.hpp>

#ifndef __GLIBC__
#error "tests/realtime watches the heap through glibc's allocator; leave this folder out on another C library"
#endif

namespace {

// Plain types: a thread_local with a constructor would be allocated at its first use.
thread_local bool watching = false;
thread_local hapbeam::testing::HeapUse use;

void count_allocation() noexcept {
  if (watching) ++use.allocations;
}
void count_release(const void* memory) noexcept {
  if (watching && memory != nullptr) ++use.releases;
}

}  // namespace

namespace hapbeam::testing {

void begin_watch() noexcept {
  use = {};
  watching = true;
}

HeapUse end_watch() noexcept {
  watching = false;
  return use;
}

}  // namespace hapbeam::testing

extern "C" {

void* __libc_malloc(std::size_t) noexcept;
void* __libc_calloc(std::size_t, std::size_t) noexcept;
void* __libc_realloc(void*, std::size_t) noexcept;
void* __libc_memalign(std::size_t, std::size_t) noexcept;
void __libc_free(void*) noexcept;

void* malloc(std::size_t size) noexcept {
  count_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  count_allocation();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  count_allocation();
  *memory = __libc_memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
void free(void* memory) noexcept {
  count_release(memory);
  __libc_free(memory);
}

}  // extern "C"
