// How many machine instructions a call takes: counted one by one, in a child process under a debugger's single step.
//
//   CHECK(instructions([&] { model.force(p); }) == instructions([&] { other.force(p); }));
//
// Exact and the same in every run of one program, where a time is neither.  Linux alone; -1 where the system does not let
// a process trace its child.
#pragma once

#if defined(__linux__)
#include <csignal>
#include <cstdlib>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace hapbeam::testing {

#if defined(__linux__)

/// @param f  called twice: once to resolve symbols, once to be counted   @return instructions, or -1
template <typename F>
long instructions(F&& f) {
  const pid_t child = fork();
  if (child < 0) return -1;
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    f();
    raise(SIGSTOP);
    f();
    raise(SIGSTOP);
    _exit(0);
  }
  int status = 0;
  const auto stopped_by = [&](int signal) {
    return waitpid(child, &status, 0) == child && WIFSTOPPED(status) && WSTOPSIG(status) == signal;
  };
  long count = -1;
  if (stopped_by(SIGSTOP)) {
    count = 0;
    while (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) == 0 && stopped_by(SIGTRAP)) ++count;
    if (!(WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP)) count = -1;
  }
  if (!WIFEXITED(status) && !WIFSIGNALED(status)) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return count;
}

#else

template <typename F>
long instructions(F&&) {
  return -1;
}

#endif

}  // namespace hapbeam::testing
