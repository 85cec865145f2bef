// SPDX-License-Identifier: MIT
// How the ends of a beam are held.
//
// What a trained model needs to know of a beam.  beam.hpp has the rest: loads, which are functions, and which a program
// that only loads a model would compile for nothing.
// Offline: checks throw std::invalid_argument naming field, value, unit and what is allowed.  Names and predicates are
// noexcept.
#pragma once

#include <hapbeam/check.hpp>

namespace hapbeam {

/// How an end is held.  Each name says which of u, w, theta are zero there.
enum class Support {
  free,     ///< none
  clamped,  ///< u, w, theta
  pinned,   ///< u, w: a hinge that cannot move
  roller,   ///< w: a hinge that slides along the beam's axis
  guided,   ///< u, theta: a symmetry plane
};

constexpr bool fixes_u(Support s) noexcept {
  return s == Support::clamped || s == Support::pinned || s == Support::guided;
}
constexpr bool fixes_w(Support s) noexcept {
  return s == Support::clamped || s == Support::pinned || s == Support::roller;
}
constexpr bool fixes_theta(Support s) noexcept { return s == Support::clamped || s == Support::guided; }

constexpr const char* name(Support support) noexcept {
  switch (support) {
    case Support::free: return "free";
    case Support::clamped: return "clamped";
    case Support::pinned: return "pinned";
    case Support::roller: return "roller";
    case Support::guided: return "guided";
  }
  return "unknown";
}

namespace detail {

/// @throws std::invalid_argument where a beam with these ends is a mechanism
[[gnu::cold]] inline void check_supports(Support left, Support right) {
  const char* why = nullptr;
  const int held_w = fixes_w(left) + fixes_w(right);
  const bool held_theta = fixes_theta(left) || fixes_theta(right);
  if (!fixes_u(left) && !fixes_u(right)) why = "slides along its axis; hold u at one end";
  if (held_w == 0) why = "moves across its axis; hold w at one end";
  if (held_w == 1 && !held_theta) why = "turns about its only hinge; hold theta or the other end";
  if (why) refuse("supports = %s, %s: the beam is a mechanism, it %s", name(left), name(right), why);
}

}  // namespace detail

}  // namespace hapbeam
