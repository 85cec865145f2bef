// Counts what a piece of code does with the heap.
//
//   CHECK(heap_use([&] { model.press(p); }) == HeapUse{});
//
// The witness is the C library's allocator itself, replaced in heap_watch.cpp: malloc and its family, hence also operator
// new in all its forms, what Eigen allocates, and each exception, whose object lies on the heap.  It counts on the
// calling thread and only while heap_use runs, and changes nothing in the code that is watched.
// It only counts: a guard that threw or aborted inside noexcept code would end the test program.
#pragma once

#include <ostream>

namespace hapbeam::testing {

/// What was done with the heap.
struct HeapUse {
  long allocations = 0;  ///< calls of malloc, calloc, realloc, aligned_alloc, posix_memalign, memalign
  long releases = 0;     ///< calls of free with something to free

  friend bool operator==(const HeapUse& a, const HeapUse& b) noexcept {
    return a.allocations == b.allocations && a.releases == b.releases;
  }
  friend std::ostream& operator<<(std::ostream& out, const HeapUse& use) {
    return out << use.allocations << " allocations, " << use.releases << " releases";
  }
};

/// Begins and ends the counting on this thread.  They do not nest.
void begin_watch() noexcept;
HeapUse end_watch() noexcept;

/// Runs f and tells what it did with the heap.
template <typename F>
HeapUse heap_use(F&& f) {
  begin_watch();
  f();
  return end_watch();
}

/// Makes the compiler believe that a value is used: it may leave out an allocation that nobody looks at.
template <typename T>
void keep(T&& value) noexcept {
  asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace hapbeam::testing
