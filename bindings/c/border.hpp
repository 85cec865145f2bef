// SPDX-License-Identifier: MIT
// What every function at the border to C shares: messages in place of exceptions.
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "hapbeam.h"
#include <hapbeam/friction.hpp>

namespace hapbeam::border {

inline const char* text(const char* name, const char* value) {
  if (!value) throw std::invalid_argument(std::string(name) + " = null: must be a string");
  return value;
}

/// What act() returns, or 0 or null and the message of what it throws.
template <class Act>
auto guarded(char* message, Act act) noexcept -> decltype(act()) {
  const auto say = [&](const char* why) {
    if (message) std::snprintf(message, HAPBEAM_MESSAGE, "%s", why);
  };
  try {
    say("");
    return act();
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("unknown error");
  }
  return {};
}

/// The object that make() returns, for C to destroy.
template <class Make>
auto created(char* message, Make make) noexcept {
  return guarded(message, make).release();
}

inline Friction friction_of(const hapbeam_friction* f) {
  return f ? Friction(f->sticking, f->sliding) : Friction();
}

}  // namespace hapbeam::border
