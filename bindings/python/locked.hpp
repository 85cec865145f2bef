// SPDX-License-Identifier: MIT
// A model belongs to one call at a time, from whichever thread of Python it comes.
#pragma once

#include <mutex>
#include <pybind11/pybind11.h>

namespace hapbeam::python {

/// What takes microseconds: Python waits.
template <class Use>
auto locked(std::recursive_mutex& mutex, Use&& use) {
  std::unique_lock<std::recursive_mutex> lock(mutex, std::defer_lock);
  if (!lock.try_lock()) {
    // Another thread computes a long curve without Python's lock; who waits for it must not keep that.
    const pybind11::gil_scoped_release released;
    lock.lock();
  }
  return use();
}

/// What takes long: other threads of Python run meanwhile.  `use` touches nothing of Python.
template <class Use>
auto unlocked(std::recursive_mutex& mutex, Use&& use) {
  const pybind11::gil_scoped_release released;
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  return use();
}

}  // namespace hapbeam::python
