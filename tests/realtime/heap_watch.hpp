// Counts what a piece of code does with the heap, by two independent witnesses.
//
//   CHECK(heap_use([&] { model.press(p); }) == HeapUse{});
//
// The first is the C library's allocator itself, replaced in heap_watch.cpp: malloc and its family, hence also
// operator new in all its forms and each exception, whose object lies on the heap.  It counts on the calling thread
// and only while heap_use runs.  The second is Eigen's own guard, which asks at each of Eigen's allocations.
// Both only count: a guard that threw or aborted inside noexcept code would end the test program.
//
// Each source file of a program must see the same Eigen, so this header comes before it: include it in angle brackets,
// which clang-format sorts to the front.
#pragma once

#if defined(EIGEN_CORE_H) || defined(EIGEN_CORE_MODULE_H)
#error "heap_watch.hpp changes Eigen's assertions: it must be included before Eigen"
#endif
#define EIGEN_RUNTIME_NO_MALLOC
// Eigen reports a forbidden allocation by an assertion, and has none where NDEBUG is defined.
#define eigen_assert(condition) ((condition) ? void() : hapbeam::testing::count_eigen_failure())

namespace hapbeam::testing {
void count_eigen_failure() noexcept;
}

#include <ostream>

#include <Eigen/Core>

namespace hapbeam::testing {

/// What was done with the heap.
struct HeapUse {
  long allocations = 0;     ///< calls of malloc, calloc, realloc, aligned_alloc, posix_memalign, memalign
  long releases = 0;        ///< calls of free with something to free
  long eigen_failures = 0;  ///< failed assertions of Eigen, forbidden allocations among them

  friend bool operator==(const HeapUse& a, const HeapUse& b) noexcept {
    return a.allocations == b.allocations && a.releases == b.releases && a.eigen_failures == b.eigen_failures;
  }
  friend std::ostream& operator<<(std::ostream& out, const HeapUse& use) {
    return out << use.allocations << " allocations, " << use.releases << " releases, " << use.eigen_failures
               << " failed assertions of Eigen";
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
