// SPDX-License-Identifier: MIT
// Checks of input values, made where a value enters the library, and words for values of enumerations.
//
// Offline: each check throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace hapbeam::detail {

/// In a message: six digits, however small.
[[gnu::cold]] inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// @param format, ...  as printf's   @throws Error
template <class Error = std::invalid_argument>
[[noreturn, gnu::cold, gnu::format(printf, 1, 2)]] void refuse(const char* format, ...) {
  char text[400];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw Error(text);
}
[[gnu::cold]] [[noreturn]] inline void reject(const char* field, double value, const char* unit,
                                              const char* allowed) {
  refuse("%s = %g%s%s: must be %s", field, value, *unit ? " " : "", unit, allowed);
}

[[gnu::cold]] inline double positive(const char* field, double value, const char* unit) {
  if (!(std::isfinite(value) && value > 0)) reject(field, value, unit, "positive and finite");
  return value;
}

[[gnu::cold]] inline double not_negative(const char* field, double value, const char* unit) {
  if (!(std::isfinite(value) && value >= 0)) reject(field, value, unit, "finite and not negative");
  return value;
}

[[gnu::cold]] inline double finite(const char* field, double value, const char* unit) {
  if (!std::isfinite(value)) reject(field, value, unit, "finite");
  return value;
}
/// Of each component of a vector.
template <class Vector>
[[gnu::cold]] const Vector& all_finite(const char* field, const Vector& values, const char* unit) {
  for (int k = 0; k < values.size(); ++k) finite(field, values[k], unit);
  return values;
}

/// The word for a value of an enumeration, which counts from 0 to Last; "unknown" for any other number.  noexcept, O(1).
template <auto Last, std::size_t Size>
constexpr const char* word_for(decltype(Last) value, const char* const (&words)[Size]) noexcept {
  static_assert(Size == static_cast<std::size_t>(Last) + 1, "each value has a word");
  return static_cast<std::size_t>(value) < Size ? words[static_cast<std::size_t>(value)] : "unknown";
}

}  // namespace hapbeam::detail
