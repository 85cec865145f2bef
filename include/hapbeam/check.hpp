// SPDX-License-Identifier: MIT
// Checks of input values, made where a value enters the library.
//
// Offline: each check throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>
#include <cstdarg>
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

}  // namespace hapbeam::detail
