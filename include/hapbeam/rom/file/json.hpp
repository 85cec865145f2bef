// SPDX-License-Identifier: MIT
// What reading and writing a model file share: the error, the ownership of a JSON value, how a value looks in a message, the checksum.
//
// It compiles fast, for programs that only load a model. Messages are composed by printf and names compared as C
// strings: optimising string arithmetic would take the compiler longer than all of Eigen/Core. [[gnu::cold]] functions
// are compiled for size, in two thirds of the time.
// Offline: allocates, throws.  Needs jansson 2.10 or later.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdint>
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

/// CRC-32, as zlib, gzip and PNG compute it: reflected, polynomial 0xEDB88320.  Finds every error of up to 32 bits in a row, and all but
/// one of 4·10⁹ others.  No protection against intent.   Source: ISO 3309; the check value of "123456789" is 0xCBF43926.
inline std::uint32_t crc32(const char* bytes, std::size_t size) noexcept {
  // Remainders of four bits.
  constexpr std::uint32_t of[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
                                    0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                    0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
  std::uint32_t rest = 0xFFFFFFFFu;
  for (std::size_t k = 0; k < size; ++k) {
    rest ^= std::uint32_t{static_cast<unsigned char>(bytes[k])};
    rest = (rest >> 4) ^ of[rest & 15];
    rest = (rest >> 4) ^ of[rest & 15];
  }
  return ~rest;
}

}  // namespace detail

}  // namespace hapbeam
