// Members of a JSON object, written by name and unit: the other side of json_reader.hpp.
//
// Members stand in the order of the calls, so that the same model gives the same text.
// Offline: allocates, throws.  Needs jansson 2.8 or later, which keeps that order.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include <hapbeam/rom/json.hpp>

namespace hapbeam::detail {

/// Makes an object of the same members.   @throws ModelFileError where a real is not finite or a word is not UTF-8
class JsonWriter {
 public:
  explicit JsonWriter(const std::string& source) : at_(source), root_(json_object()), object_(root_.get()) {}

  void units() {
    units_ = json_object();
    set("units", units_);
  }

  template <class Body>
  void object(const char* name, Body&& body) {
    json_t* const child = json_object();
    set(name, child);
    walk(name, child, body);
  }
  template <class Entry, class Each>
  void list(const char* name, std::vector<Entry>& entries, Each&& each) {
    json_t* const array = json_array();
    set(name, array);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      json_t* const child = json_object();
      if (json_array_append_new(array, child)) at_.reject(name, ": out of memory");
      walk(std::string(name) + "[" + std::to_string(k) + "]", child, [&] { each(entries[k]); });
    }
  }

  template <typename Scalar>
  void real(const char* name, const char* unit, Scalar& value) {
    add_unit(name, unit);
    set(name, finite(name, unit, static_cast<double>(value)));
  }
  template <typename Scalar>
  void table(const char* name, const char* unit, std::vector<Scalar>& values) {
    add_unit(name, unit);
    json_t* const array = json_array();
    set(name, array);
    for (const Scalar value : values)
      if (json_array_append_new(array, finite(name, unit, static_cast<double>(value))))
        at_.reject(name, ": out of memory");
  }
  void count(const char* name, int& value) { set(name, json_integer(value)); }
  void flag(const char* name, bool& value) { set(name, json_boolean(value)); }
  void word(const char* name, std::string& value) { constant(name, value); }
  void constant(const char* name, const std::string& value) {
    json_t* const text = json_stringn(value.data(), value.size());
    if (!text || value.find('\0') != std::string::npos) {
      json_decref(text);
      at_.reject(name, ": must be UTF-8 without a zero");
    }
    set(name, text);
  }
  template <class Value>
  void choice(const char* name_of_field, Value& value, std::initializer_list<Value>) {
    constant(name_of_field, name(value));
  }
  void finish() {}

  /// On one line.   @param digits  of a real: 17 for double, 9 for float, which bring back every bit
  std::string text(int digits) const {
    return dump_json(root_.get(), JSON_COMPACT | JSON_REAL_PRECISION(static_cast<unsigned>(digits)));
  }

 private:
  void set(const char* name, json_t* value) {
    if (json_object_set_new(object_, name, value)) at_.reject(name, ": out of memory");
  }
  void add_unit(const char* name, const char* unit) {
    if (json_object_set_new(units_, at_.unit_name(name).c_str(), json_string(unit)))
      at_.reject(name, ": out of memory");
  }
  json_t* finite(const char* name, const char* unit, double value) const {
    if (!std::isfinite(value)) at_.reject(name, std::to_string(value), unit, "finite");
    return json_real(value);
  }
  template <class Body>
  void walk(const std::string& name, json_t* child, Body&& body) {
    json_t* const parent = object_;
    object_ = child;
    at_.enter(name);
    body();
    at_.leave();
    object_ = parent;
  }

  JsonPath at_;
  Json root_;
  json_t* object_;
  json_t* units_ = nullptr;
};

}  // namespace hapbeam::detail
