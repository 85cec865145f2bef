// SPDX-License-Identifier: MIT
// Members of a JSON object, written by name and unit: the other side of json_reader.hpp.
//
// Members stand in the order of the calls, so that the same model gives the same text.
// Offline: allocates, throws.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <hapbeam/rom/file/json.hpp>

namespace hapbeam::detail {

/// @throws ModelFileError where a real is not finite or a word is not UTF-8
class JsonWriter {
 public:
  explicit JsonWriter(const std::string& source)
      : source_(source), own_root_(json_object()), root_(own_root_.get()) {}

  void units() { set(root_, "units", units_ = json_object()); }

  template <typename Scalar>
  void real(const char* name, const char* unit, const Scalar& value) {
    add_unit(name, unit);
    add(name, finite(name, unit, static_cast<double>(value)));
  }
  template <typename Scalar>
  void table(const char* name, const char* unit, const std::vector<Scalar>& values) {
    add_unit(name, unit);
    json_t* const array = json_array();
    add(name, array);
    for (const Scalar value : values)
      if (json_array_append_new(array, finite(name, unit, static_cast<double>(value))))
        fail(source_, "%s: out of memory", name);
  }
  void count(const char* name, const int& value) { add(name, json_integer(value)); }
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

  /// On one line.   @param digits  of a real: 17 for double, 9 for float, which bring back every bit
  std::string text(int digits) const {
    char* const text = json_dumps(root_, JSON_COMPACT | JSON_REAL_PRECISION(static_cast<unsigned>(digits)));
    if (!text) fail(source_, "cannot be written as JSON: out of memory");
    std::string copy = text;
    std::free(text);
    return copy;
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
  /// Into the object of its name, which is created if necessary.
  void add(const char* name, json_t* value) {
    json_t* object = root_;
    std::string rest = name;
    for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
      const std::string key = rest.substr(0, dot);
      if (!json_object_get(object, key.c_str())) set(object, key.c_str(), json_object());
      object = json_object_get(object, key.c_str());
      rest.erase(0, dot + 1);
    }
    set(object, rest.c_str(), value);
  }
  void add_unit(const char* name, const char* unit) {
    set(units_, (path_ + name).c_str(), json_string(unit));
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

}  // namespace hapbeam::detail
