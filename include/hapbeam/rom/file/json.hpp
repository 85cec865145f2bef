// SPDX-License-Identifier: MIT
// What reading and writing a model file share: the error, the ownership of a JSON value, and how a value looks in a message.
//
// It compiles fast, for programs that only load a model. Messages are composed by printf and names compared as C
// strings: optimising string arithmetic would take the compiler longer than all of Eigen/Core. [[gnu::cold]] functions
// are compiled for size, in two thirds of the time.
// Offline: allocates, throws.  Needs jansson 2.10 or later.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <jansson.h>
#include <stdexcept>
#include <string>
#include <utility>

namespace hapbeam {

/// A model file that cannot be read or written; what() has its name, the fault and the permitted values.
struct ModelFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

/// @param format, ...  as printf's   @throws ModelFileError  "source: …"
[[noreturn, gnu::cold, gnu::format(printf, 2, 3)]] inline void fail(const std::string& source,
                                                                    const char* format, ...) {
  char text[4800];
  const int size = std::snprintf(text, sizeof text, "%.4000s: ", source.c_str());
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text + size, sizeof text - static_cast<std::size_t>(size), format, arguments);
  va_end(arguments);
  throw ModelFileError(text);
}

/// Owns a JSON value.
class Json {
 public:
  explicit Json(json_t* value) noexcept : value_(value) {}
  Json(Json&& other) noexcept : value_(other.value_) { other.value_ = nullptr; }
  Json& operator=(Json&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Json() { json_decref(value_); }

  json_t* get() const noexcept { return value_; }

 private:
  json_t* value_;
};

/// A value as it stands in the file, shortened, for a message.
struct ShownJson {
  char text[64];

  [[gnu::cold, gnu::noinline]] explicit ShownJson(const json_t* value) {
    if (json_is_object(value)) {
      std::snprintf(text, sizeof text, "an object");
    } else if (json_is_array(value)) {
      std::snprintf(text, sizeof text, "an array of %lu", static_cast<unsigned long>(json_array_size(value)));
    } else {
      const std::size_t most = sizeof text - 1,
                        flags = JSON_ENCODE_ANY | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9);
      const std::size_t size = json_dumpb(value, text, most, flags);
      text[size < most ? size : most] = 0;
      if (size > most) text[most - 1] = text[most - 2] = text[most - 3] = '.';
    }
  }
};

}  // namespace detail
}  // namespace hapbeam
