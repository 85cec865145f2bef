// Counts the locks that a piece of code takes on this thread.
//
//   CHECK(locks_taken([&] { servo.tick(state); }) == 0);
//
// The program's own pthread functions take the place of the C library's, which std::mutex and its kin call, and pass on
// to them (lock_watch.cpp).
#pragma once

namespace hapbeam::testing {

/// Begins and ends the counting on this thread.  They do not nest.
void begin_lock_watch() noexcept;
long end_lock_watch() noexcept;

/// Runs f and tells how many mutexes, readers' and writers' locks, condition variables and semaphores it asked for.
template <typename F>
long locks_taken(F&& f) {
  begin_lock_watch();
  f();
  return end_lock_watch();
}

}  // namespace hapbeam::testing
