// SPDX-License-Identifier: MIT
// What every function at the border to C shares: messages in place of exceptions.
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "hapbeam.h"

namespace hapbeam::border {

inline const char* text(const char* name, const char* value) {
  if (!value) throw std::invalid_argument(std::string(name) + " = null: must be a string");
  return value;
}

/// What make() returns, or null and the message of what it throws.
template <class Make>
auto guarded(char* message, Make make) noexcept -> decltype(make().release()) {
  const auto say = [&](const char* why) {
    if (message) std::snprintf(message, HAPBEAM_MESSAGE, "%s", why);
  };
  try {
    say("");
    return make().release();
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("unknown error");
  }
  return nullptr;
}

}  // namespace hapbeam::border
