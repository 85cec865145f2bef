// SPDX-License-Identifier: MIT
// Members of a JSON object, written by name and unit; and what reading and writing a file share: the error, the ownership of a
// JSON value, how a value looks in a message, the checksum.
//
// It compiles fast, for programs that only load a model. Messages are composed by printf and names compared as C
// strings: optimising string arithmetic would take the compiler longer than all of Eigen/Core. [[gnu::cold]] functions
// are compiled for size, in two thirds of the time.
// Offline: allocates, throws.  Needs jansson 2.10 or later.
#pragma once

#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <jansson.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

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

struct ReleaseJson {
  void operator()(json_t* value) const noexcept { json_decref(value); }
};
using Json = std::unique_ptr<json_t, ReleaseJson>;

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

/// Members stand in the order of the calls, so that the same model gives the same text.
/// @throws ModelFileError where a real is not finite or a word is not UTF-8
class JsonWriter {
 public:
  explicit JsonWriter(const std::string& source)
      : source_(source), own_root_(json_object()), root_(own_root_.get()) {}

  void units() { set(root_, "units", units_ = json_object()); }

  /// What follows are the limits of the value, which a reader checks.
  template <typename Scalar, typename... Limits>
  void real(const char* name, const char* unit, const Scalar& value, Limits...) {
    add_unit(name, unit);
    add(name, finite(name, unit, value));
  }
  template <typename Scalar>
  void table(const char* name, const char* unit, const std::vector<Scalar>& values) {
    add_unit(name, unit);
    json_t* const array = json_array();
    add(name, array);
    for (const Scalar value : values)
      if (json_array_append_new(array, finite(name, unit, value))) fail(source_, "%s: out of memory", name);
  }
  template <typename... Limits>
  void count(const char* name, json_int_t value, Limits...) {
    add(name, json_integer(value));
  }
  void flag(const char* name, const bool& value) { add(name, json_boolean(value)); }
  void word(const char* name, const std::string& value) {
    json_t* const text = json_stringn(value.data(), value.size());
    if (!text || value.find('\0') != std::string::npos) {
      json_decref(text);
      fail(source_, "%s%s: must be UTF-8 without a zero", path_.c_str(), name);
    }
    add(name, text);
  }
  void constant(const char* name, const char* value) { word(name, value); }
  template <class Value>
  void choice(const char* field, const Value& value, Value) {
    constant(field, name(value));
  }
  template <class Value, class Each>
  void object(const char* name, Value& value, Each each) {
    JsonWriter writer(*this, name);
    each(writer, value);
    add(name, json_incref(writer.root_));
  }
  template <class Entry, class Each>
  void list(const char* name, std::vector<Entry>& entries, Each each) {
    json_t* const array = json_array();
    add(name, array);
    for (Entry& entry : entries) {
      JsonWriter writer(*this, name);
      each(writer, entry);
      if (json_array_append(array, writer.root_)) fail(source_, "%s: out of memory", name);
    }
  }
  void finish() {}

  enum class Layout { line, indented };
  /// @param digits  of a real: 17 for double, 9 for float, which bring back every bit
  std::string text(int digits, Layout layout = Layout::line) const {
    const std::size_t flags = layout == Layout::line ? JSON_COMPACT : JSON_INDENT(2);
    char* const text = json_dumps(root_, flags | JSON_REAL_PRECISION(static_cast<unsigned>(digits)));
    if (!text) fail(source_, "cannot be written as JSON: out of memory");
    std::string copy = text;
    std::free(text);
    return copy;
  }
  /// For people: indented, with the fewest digits, 15 to 17, that bring back every bit.
  std::string readable() const {
    for (int digits = 15;; ++digits) {
      const std::string text = this->text(digits, Layout::indented) + "\n";
      const Json again(json_loadb(text.data(), text.size(), 0, nullptr));
      if (digits == 17 || json_equal(root_, again.get())) return text;
    }
  }

 private:
  /// For an object within another.
  JsonWriter(const JsonWriter& parent, const char* name) : JsonWriter(parent.source_) {
    units_ = parent.units_;
    path_ = std::string(name) + ".";
  }

  void set(json_t* object, const char* key, json_t* value) const {
    if (json_object_set_new(object, key, value)) fail(source_, "%s: out of memory", key);
  }
  /// "key.name" into the object of that key, which is created if necessary.
  void add(const char* name, json_t* value) {
    const char* const dot = std::strchr(name, '.');
    if (!dot) return set(root_, name, value);
    const std::string key(name, dot);
    if (!json_object_get(root_, key.c_str())) set(root_, key.c_str(), json_object());
    set(json_object_get(root_, key.c_str()), dot + 1, value);
  }
  void add_unit(const char* name, const char* unit) {
    if (units_) set(units_, (path_ + name).c_str(), json_string(unit));
  }
  json_t* finite(const char* name, const char* unit, double value) const {
    if (!std::isfinite(value))
      fail(source_, "%s%s = %g%s%s: must be finite", path_.c_str(), name, value, *unit == '1' ? "" : " ",
           *unit == '1' ? "" : unit);
    return json_real(value);
  }

  const std::string& source_;
  Json own_root_;
  json_t* root_;
  json_t* units_ = nullptr;
  std::string path_;  // of an object within another
};

}  // namespace detail

}  // namespace hapbeam
