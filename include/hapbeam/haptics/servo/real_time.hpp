// SPDX-License-Identifier: MIT
// Asks the system to let a thread run when it has to: a priority before all ordinary threads, and memory that is never paged out.
//
//   servo thread   const RealTime priority = set_real_time_priority(80);     // in its first tick, say
//   main, once     const RealTime memory = lock_memory();                    // before the loop starts
//                  if (memory != RealTime::done) std::puts(message(memory));
//
// A loop runs without either, less regularly.  On systems other than Linux nothing is done, and the answer
// says so. An HDAPI scheduler has a priority of its own already.
#pragma once

#include <cstdint>

#if defined(__linux__)
#include <cerrno>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace hapbeam {

enum class RealTime : std::uint8_t {
  done,
  priority_out_of_range,   ///< nothing was changed
  priority_not_permitted,  ///< nothing was changed
  memory_not_permitted,    ///< nothing was locked
  memory_limited,          ///< nothing was locked, because later allocations would have failed
  not_supported,           ///< by this system, or an error without a name
};

/// One plain sentence, with what can be done.
constexpr const char* message(RealTime result) noexcept {
  switch (result) {
    case RealTime::done: return "done";
    case RealTime::priority_out_of_range: return "the real-time priority must be 1 to 99";
    case RealTime::priority_not_permitted:
      return "no real-time priority: not permitted; raise the limit rtprio in /etc/security/limits.conf, or "
             "run as root";
    case RealTime::memory_not_permitted:
      return "memory is not locked: not permitted; raise the limit memlock in /etc/security/limits.conf, or "
             "run as root";
    case RealTime::memory_limited:
      return "memory is not locked: the limit memlock is finite; set it to unlimited in "
             "/etc/security/limits.conf";
    case RealTime::not_supported: break;
  }
  return "this system has no real-time set-up that is known here; the loop runs without";
}

/// The calling thread goes before all ordinary ones (SCHED_FIFO), and is not preempted by a thread of lower priority.
/// @param priority  1 to 99; the kernel's own threads are at 50 and 99
/// noexcept, no allocation; a few system calls, so not in every tick.
[[nodiscard]] inline RealTime set_real_time_priority([[maybe_unused]] int priority) noexcept {
#if defined(__linux__)
  if (priority < sched_get_priority_min(SCHED_FIFO) || priority > sched_get_priority_max(SCHED_FIFO))
    return RealTime::priority_out_of_range;
  sched_param parameter{};
  parameter.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
  if (error == 0) return RealTime::done;
  if (error == EPERM) return RealTime::priority_not_permitted;
#endif
  return RealTime::not_supported;
}

/// All memory of the process, present and future, stays in RAM: a tick never waits for a page.  Where only so
/// much may be locked nothing is, because the first allocation beyond that would fail.
/// noexcept; blocks for as long as it takes to fetch what is paged out.
[[nodiscard]] inline RealTime lock_memory() noexcept {
#if defined(__linux__)
  rlimit limit{};
  if (geteuid() != 0 && (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY))
    return RealTime::memory_limited;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return RealTime::done;
  if (errno == EPERM || errno == ENOMEM) return RealTime::memory_not_permitted;
#endif
  return RealTime::not_supported;
}

}  // namespace hapbeam
