// Members of a JSON object, read by name and unit.
//
// JsonReader and JsonWriter offer the same functions, so that one list of a model's fields, visit() in model_file.hpp, serves
// both.  The units stand in a member of their own, {"beam.length": "m", …}: one for each real number, "1" where it has none.
// Nothing is skipped, guessed or converted: a member that is missing, of another type, in another unit, out of the scalar's
// range, or one that nobody asked for, throws ModelFileError with its path, value, unit and what is allowed.
// Offline: allocates, throws.
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include <hapbeam/rom/json.hpp>

namespace hapbeam::detail {

/// Reads the members of an object.   @throws ModelFileError
class JsonReader {
 public:
  /// @param root  an object, which outlives this   @param source  the file's name, for messages
  JsonReader(const json_t* root, const std::string& source) : at_(source), levels_{{root, {}}} {
    if (!json_is_object(root))
      throw ModelFileError(source + ": is " + show_json(root) + ": must be an object");
  }

  /// Takes the member "units", which the reals that follow are compared with.
  void units() {
    units_ = take("units");
    if (!json_is_object(units_)) at_.reject("units", show_json(units_), "", "an object");
  }

  template <class Body>
  void object(const char* name, Body&& body) {
    const json_t* value = take(name);
    if (!json_is_object(value)) at_.reject(name, show_json(value), "", "an object");
    walk(name, value, body);
  }
  /// A list of objects, each read by each(entry).
  template <class Entry, class Each>
  void list(const char* name, std::vector<Entry>& entries, Each&& each) {
    const json_t* value = take(name);
    if (!json_is_array(value)) at_.reject(name, show_json(value), "", "an array");
    entries.clear();
    for (std::size_t k = 0; k < json_array_size(value); ++k) {
      const json_t* entry = json_array_get(value, k);
      const std::string indexed = std::string(name) + "[" + std::to_string(k) + "]";
      if (!json_is_object(entry)) at_.reject(indexed, show_json(entry), "", "an object");
      entries.push_back({});
      walk(indexed, entry, [&] { each(entries.back()); });
    }
  }

  void real(const char* name, const char* unit, double& value) { value = number<double>(name, unit); }
  void real(const char* name, const char* unit, float& value) { value = number<float>(name, unit); }
  void table(const char* name, const char* unit, std::vector<double>& values) { numbers(name, unit, values); }
  void table(const char* name, const char* unit, std::vector<float>& values) { numbers(name, unit, values); }

  /// A whole number that is not negative.
  void count(const char* name, int& value) {
    const json_t* found = take(name);
    if (!json_is_integer(found) || json_integer_value(found) < 0 ||
        json_integer_value(found) > std::numeric_limits<int>::max())
      at_.reject(name, show_json(found), "", "a whole number from 0 to 2147483647");
    value = static_cast<int>(json_integer_value(found));
  }
  void flag(const char* name, bool& value) {
    const json_t* found = take(name);
    if (!json_is_boolean(found)) at_.reject(name, show_json(found), "", "true or false");
    value = json_is_true(found);
  }
  void word(const char* name, std::string& value) {
    const json_t* found = take(name);
    if (!json_is_string(found)) at_.reject(name, show_json(found), "", "a string");
    value = json_string_value(found);
  }
  /// A word that is known beforehand.
  void constant(const char* name, const std::string& wanted) {
    std::string value;
    word(name, value);
    if (value != wanted) at_.reject(name, show_json(member(name)), "", '"' + wanted + '"');
  }
  /// One of several values, by the word that name(value) gives.
  template <class Value>
  void choice(const char* name_of_field, Value& value, std::initializer_list<Value> allowed) {
    std::string found, words;
    word(name_of_field, found);
    for (const Value candidate : allowed) {
      if (found == name(candidate)) return void(value = candidate);
      words += (words.empty() ? "" : ", ") + std::string(name(candidate));
    }
    at_.reject(name_of_field, show_json(member(name_of_field)), "", "one of " + words);
  }

  /// No member is left that has not been read, nor a unit of none.
  void finish() {
    finish_object();
    if (!units_) return;
    at_.enter("units");
    levels_.push_back({units_, std::move(units_read_)});
    finish_object();
  }

 private:
  struct Level {
    const json_t* object;
    std::vector<std::string> read;
  };

  const json_t* member(const char* name) const { return json_object_get(levels_.back().object, name); }

  const json_t* take(const char* name) {
    const json_t* found = member(name);
    if (!found) at_.reject(name, ": is missing");
    levels_.back().read.push_back(name);
    return found;
  }

  template <class Body>
  void walk(const std::string& name, const json_t* object, Body&& body) {
    at_.enter(name);
    levels_.push_back({object, {}});
    body();
    finish_object();
    levels_.pop_back();
    at_.leave();
  }

  static bool contains(const std::vector<std::string>& names, const std::string& name) {
    for (const std::string& candidate : names)
      if (candidate == name) return true;
    return false;
  }

  void finish_object() {
    const Level& level = levels_.back();
    auto* object =
        const_cast<json_t*>(level.object);  // the iterators of jansson 2.14 do not change it either
    for (void* k = json_object_iter(object); k; k = json_object_iter_next(object, k)) {
      const std::string name = json_object_iter_key(k);
      if (!contains(level.read, name))
        at_.reject(name, ": is no member of a model file of this kind and version");
    }
  }

  void check_unit(const char* name, const char* unit) {
    const std::string full = at_.unit_name(name);
    const json_t* found = json_object_get(units_, full.c_str());
    const std::string quoted = '"' + std::string(unit) + '"';
    if (!found) at_.reject(name, ": its unit is missing in units: must be " + quoted);
    if (!json_is_string(found) || std::string(json_string_value(found)) != unit)
      at_.reject(name, ": its unit is " + show_json(found) + ": must be " + quoted);
    if (!contains(units_read_, full)) units_read_.push_back(full);
  }

  template <typename Scalar>
  Scalar converted(const std::string& name, const char* unit, const json_t* found) const {
    if (!json_is_number(found)) at_.reject(name, show_json(found), unit, "a number");
    const double value = json_number_value(found);
    const double most = static_cast<double>(std::numeric_limits<Scalar>::max());
    if (!(std::abs(value) <= most)) at_.reject(name, show_json(found), unit, "in the range of the scalar");
    return static_cast<Scalar>(value);
  }
  template <typename Scalar>
  Scalar number(const char* name, const char* unit) {
    check_unit(name, unit);
    return converted<Scalar>(name, unit, take(name));
  }
  template <typename Scalar>
  void numbers(const char* name, const char* unit, std::vector<Scalar>& values) {
    check_unit(name, unit);
    const json_t* found = take(name);
    if (!json_is_array(found)) at_.reject(name, show_json(found), "", "an array of numbers");
    const std::size_t size = json_array_size(found);
    values.clear();
    values.reserve(size);
    for (std::size_t k = 0; k < size; ++k) {
      const json_t* entry = json_array_get(found, k);
      // The name is put together only for a message.
      if (!json_is_number(entry) ||
          !(std::abs(json_number_value(entry)) <= double(std::numeric_limits<Scalar>::max())))
        converted<Scalar>(std::string(name) + "[" + std::to_string(k) + "]", unit, entry);
      values.push_back(static_cast<Scalar>(json_number_value(entry)));
    }
  }

  JsonPath at_;
  std::vector<Level> levels_;
  const json_t* units_ = nullptr;
  std::vector<std::string> units_read_;
};

}  // namespace hapbeam::detail
