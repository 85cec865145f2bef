// What the system was asked for is so, or the answer says why not; never both, never neither.
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "support/catch.hpp"
#include <hapbeam/haptics/servo/real_time.hpp>

#if defined(__linux__)
#include <sys/wait.h>
#endif

using namespace hapbeam;

static_assert(noexcept(set_real_time_priority(1)) && noexcept(lock_memory()));

TEST_CASE("each answer is a sentence of its own", "[real_time]") {
  const RealTime all[] = {RealTime::done,
                          RealTime::priority_out_of_range,
                          RealTime::priority_not_permitted,
                          RealTime::memory_not_permitted,
                          RealTime::memory_limited,
                          RealTime::not_supported};
  for (const RealTime a : all)
    for (const RealTime b : all) CHECK((std::strcmp(message(a), message(b)) == 0) == (a == b));
}

#if defined(__linux__)

namespace {

struct Policy {
  int kind = -1, priority = -1;
};
Policy policy() {
  Policy now;
  sched_param parameter{};
  pthread_getschedparam(pthread_self(), &now.kind, &parameter);
  now.priority = parameter.sched_priority;
  return now;
}

/// The answer of a process without rights.
template <typename Ask>
RealTime as_nobody(Ask ask) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit none{0, 0};
    if (setrlimit(RLIMIT_RTPRIO, &none) != 0 || setuid(65534) != 0) _exit(255);
    _exit(static_cast<int>(ask()));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return static_cast<RealTime>(WEXITSTATUS(status));
}

// Sanitizers make locking do nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitized = false;
#endif

}  // namespace

TEST_CASE("a thread has the priority that it was given, or the one it had", "[real_time][thread]") {
  std::thread([] {
    const Policy before = policy();
    CHECK(set_real_time_priority(0) == RealTime::priority_out_of_range);
    CHECK(set_real_time_priority(100) == RealTime::priority_out_of_range);
    CHECK(policy().kind == before.kind);
    const RealTime answer = set_real_time_priority(7);
    INFO(message(answer));
    CHECK(policy().kind == (answer == RealTime::done ? SCHED_FIFO : before.kind));
    CHECK(policy().priority == (answer == RealTime::done ? 7 : before.priority));
  }).join();
  CHECK(policy().kind == SCHED_OTHER);  // no other thread's
}

TEST_CASE("memory is locked, or it is said why not", "[real_time]") {
  const RealTime answer = lock_memory();
  INFO(message(answer));
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line) && line.rfind("VmLck:", 0) != 0) continue;
  munlockall();
  if (!sanitized) CHECK((line.find(" 0 kB") == std::string::npos) == (answer == RealTime::done));
}

TEST_CASE("without rights nothing is changed, and the answer names the right", "[real_time]") {
  if (geteuid() != 0) return;  // cannot give rights up twice
  CHECK(as_nobody([] { return set_real_time_priority(7); }) == RealTime::priority_not_permitted);
  CHECK(as_nobody([] { return lock_memory(); }) == RealTime::memory_limited);
}

#endif
