// SPDX-License-Identifier: MIT
// JSON that is read: files as a whole, in memory that their size bounds, and members of an object by name and unit.
//
// JsonReader and JsonWriter offer the same functions, so that one list of fields serves both.
// A name is a path: "beam.length" is the member length of the object beam. Units are a member of their own,
// {"beam.length": "m", …}: one for each real number, "1" for a number without unit.
// Nothing is skipped, guessed or converted. A member that is missing, unknown, of another type or unit, or out of the
// scalar's range throws ModelFileError with its name, value, unit and permitted values; text that is no JSON, with line and column.
// Offline: allocates, throws.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <hapbeam/rom/file/json.hpp>

namespace hapbeam::detail {

/// Largest file that is read.  As a model it holds more than a million numbers, too many for a tick.
inline constexpr std::size_t largest_json_file = std::size_t(1) << 25;

[[gnu::cold]] inline void check_size(std::size_t size, const std::string& source) {
  if (size > largest_json_file)
    fail(source, "size = %lu bytes: must be at most %lu", static_cast<unsigned long>(size),
         static_cast<unsigned long>(largest_json_file));
}

/// About what the parser may take, by what each part of a text costs it: so many times its size, and what a header takes.
/// A test measures that 20 times and 64 kB are never exceeded.
inline constexpr std::size_t memory_per_byte = 16, memory_to_begin = 1 << 15;

/// Text that would take more memory is rejected before it is parsed: three bytes can make an empty object of 250.
/// What stands in strings counts as well; a model has few.   @param line  of the file, where the text begins
[[gnu::cold]] inline Json parse_json(const char* text, std::size_t size, const std::string& source,
                                     int line) {
  std::size_t needed = 0;
  for (std::size_t k = 0; k < size; ++k) switch (text[k]) {
      case '{':
      case '[': needed += 320; break;
      case ':': needed += 112; break;
      case ',': needed += 48; break;
      case '"': needed += 24; break;
      default: break;
    }
  const std::size_t most = memory_per_byte * size + memory_to_begin;
  if (needed > most)
    fail(source, "line %d takes about %lu bytes of memory to read: must be at most %lu for its size", line,
         static_cast<unsigned long>(needed), static_cast<unsigned long>(most));
  json_error_t error;
  Json root(json_loadb(text, size, JSON_REJECT_DUPLICATES, &error));
  if (!root.get())
    fail(source, "line %d, column %d is no JSON: %s", line + error.line - 1, error.column, error.text);
  return root;
}

[[gnu::cold]] inline std::string read_file(const std::string& path) {
  errno = 0;
  const auto reject = [&path](const char* what) {
    fail(path, "%s: %s", what, errno ? std::strerror(errno) : "unknown reason");
  };
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (!file) reject("cannot be opened");
  std::string text;
  char part[1 << 12];
  // One byte beyond the limit is enough to reject the file.
  for (std::size_t size = 1; size > 0 && text.size() <= largest_json_file; text.append(part, size))
    size = std::fread(part, 1, sizeof part, file);
  const bool failed = std::ferror(file);
  std::fclose(file);
  if (failed) reject("cannot be read");
  return text;
}

/// A member that has been read is removed from the object: what remains at the end is unknown.
class JsonReader {
 public:
  /// @param root  emptied; outlives this   @param source  the file's name, for messages; outlives this
  /// @param path  of an object within another, "errors.regions[2]"   @param unit_path  the same for its units, "errors.regions"
  /// @param units  of the object that it is in
  [[gnu::cold, gnu::noinline]] JsonReader(json_t* root, const std::string& source, const char* path = "",
                                          const char* unit_path = "", json_t* units = nullptr)
      : source_(source), root_(root), units_(units) {
    if (!json_is_object(root))
      fail(source_, "%s%s %s: must be an object", path, *path ? " =" : "is", ShownJson(root).text);
    const char* const dot = *path ? "." : "";
    std::snprintf(path_, sizeof path_, "%s%s", path, dot);
    std::snprintf(unit_path_, sizeof unit_path_, "%s%s", unit_path, dot);
  }

  /// Takes the member "units", which the reals that follow are compared with.
  [[gnu::cold, gnu::noinline]] void units() {
    own_units_ = take("units", JSON_OBJECT, "an object");
    units_ = own_units_.get();
  }

  /// @param low, high  limits of the value
  template <typename Scalar>
  [[gnu::cold, gnu::noinline]] void real(const char* name, const char* unit, Scalar& value,
                                         double low = -largest(Scalar()), double high = largest(Scalar())) {
    check_unit(name, unit);
    const Json found = take(name);
    value = static_cast<Scalar>(number(name, alone, unit, found.get(), low, high));
  }
  template <typename Scalar>
  [[gnu::cold, gnu::noinline]] void table(const char* name, const char* unit, std::vector<Scalar>& values) {
    check_unit(name, unit);
    const Json found = take(name, JSON_ARRAY, "an array");
    std::vector<Scalar>(json_array_size(found.get())).swap(values);
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = static_cast<Scalar>(
          number(name, k, unit, json_array_get(found.get(), k), -largest(Scalar()), largest(Scalar())));
  }
  /// A whole number.   @param low, high  limits of the value
  [[gnu::cold, gnu::noinline]] void count(const char* name, int& value, int low = 0,
                                          int high = (std::numeric_limits<int>::max)()) {
    char allowed[64];
    std::snprintf(allowed, sizeof allowed, "a whole number from %d to %d", low, high);
    const Json found = take(name, JSON_INTEGER, allowed);
    const json_int_t number = json_integer_value(found.get());
    if (number < low || number > high) reject(name, found.get(), "", allowed);
    value = static_cast<int>(number);
  }
  [[gnu::cold, gnu::noinline]] void flag(const char* name, bool& value) {
    const Json found = take(name);
    if (!json_is_boolean(found.get())) reject(name, found.get(), "", "true or false");
    value = json_is_true(found.get());
  }
  [[gnu::cold, gnu::noinline]] void word(const char* name, std::string& value) {
    value = json_string_value(take(name, JSON_STRING, "a string").get());
  }
  /// A word that is known beforehand.   @param why  for the message, after the word
  [[gnu::cold, gnu::noinline]] void constant(const char* name, const char* wanted, const char* why = "") {
    const Json found = take(name, JSON_STRING, "a string");
    char allowed[160];
    std::snprintf(allowed, sizeof allowed, "\"%s\"%s", wanted, why);
    if (std::strcmp(json_string_value(found.get()), wanted) != 0) reject(name, found.get(), "", allowed);
  }
  /// A value of an enumeration that runs from 0 to last, by its name(value).
  template <class Value>
  [[gnu::cold, gnu::noinline]] void choice(const char* field, Value& value, Value last) {
    const Json found = take(field, JSON_STRING, "a string");
    char words[200] = "one of";
    for (int k = 0; k <= static_cast<int>(last); ++k) {
      const char* const word = name(static_cast<Value>(k));
      if (std::strcmp(json_string_value(found.get()), word) == 0) return void(value = static_cast<Value>(k));
      const std::size_t size = std::strlen(words);
      std::snprintf(words + size, sizeof words - size, "%s %s", k == 0 ? "" : ",", word);
    }
    reject(field, found.get(), "", words);
  }

  /// An object, read by each(reader, value).
  template <class Value, class Each>
  [[gnu::cold, gnu::noinline]] void object(const char* name, Value& value, Each each) {
    const Json found = take(name);
    JsonReader reader(found.get(), source_, name, name, units_);
    each(reader, value);
    reader.finish();
  }
  /// A list of objects, each read by each(reader, entry).  Their units are compared once.
  template <class Entry, class Each>
  [[gnu::cold, gnu::noinline]] void list(const char* name, std::vector<Entry>& entries, Each each) {
    const Json found = take(name, JSON_ARRAY, "an array");
    entries.clear();
    for (std::size_t k = 0; k < json_array_size(found.get()); ++k) {
      char path[64];
      std::snprintf(path, sizeof path, "%s[%lu]", name, static_cast<unsigned long>(k));
      JsonReader reader(json_array_get(found.get(), k), source_, path, name, k == 0 ? units_ : nullptr);
      entries.emplace_back();  // one by one: of a hostile list none is an object
      each(reader, entries.back());
      reader.finish();
    }
  }

  /// No member is left that has not been read, nor a unit of none.
  [[gnu::cold, gnu::noinline]] void finish() {
    if (json_object_size(root_) > 0) reject_left(root_, "is no member of a file of this kind and version");
    if (own_units_.get() && json_object_size(units_) > 0)
      reject_left(units_, "has a unit, but is no real number of a file of this kind");
  }

 private:
  [[gnu::cold, gnu::noinline]] [[noreturn]] void reject(const char* name, const json_t* found,
                                                        const char* unit, const char* allowed) const {
    const bool bare = !*unit || std::strcmp(unit, "1") == 0;
    fail(source_, "%s%s = %s%s%s: must be %s", path_, name, ShownJson(found).text, bare ? "" : " ",
         bare ? "" : unit, allowed);
  }
  [[gnu::cold, gnu::noinline]] [[noreturn]] void reject_left(json_t* object, const char* why) const {
    char name[160] = "";
    const json_t* value = object;
    while (json_object_size(value) > 0) {
      const std::size_t size = std::strlen(name);
      const char* const key = json_object_iter_key(json_object_iter(object));
      std::snprintf(name + size, sizeof name - size, "%s%.60s", size > 0 ? "." : "", key);
      value = object = json_object_get(object, key);
    }
    fail(source_, "%s%s = %s %s", path_, name, ShownJson(value).text, why);
  }

  /// The member of that name, out of its object, and that out of its own if nothing else was in it.
  [[gnu::cold, gnu::noinline]] Json take(const char* name) {
    char outer[64] = "";
    const char* const dot = std::strchr(name, '.');
    if (dot) std::snprintf(outer, sizeof outer, "%.*s", static_cast<int>(dot - name), name);
    json_t* const object = dot ? json_object_get(root_, outer) : root_;
    const char* const inner = dot ? dot + 1 : name;
    Json found(json_incref(json_object_get(object, inner)));
    if (!found.get()) fail(source_, "%s%s is missing", path_, name);
    json_object_del(object, inner);
    if (dot && json_object_size(object) == 0) json_object_del(root_, outer);
    return found;
  }
  [[gnu::cold, gnu::noinline]] Json take(const char* name, json_type type, const char* allowed) {
    Json found = take(name);
    if (json_typeof(found.get()) != type) reject(name, found.get(), "", allowed);
    return found;
  }

  [[gnu::cold, gnu::noinline]] void check_unit(const char* name, const char* unit) {
    if (!units_) return;
    char key[160];
    std::snprintf(key, sizeof key, "%s%s", unit_path_, name);
    const json_t* found = json_object_get(units_, key);
    if (!found) fail(source_, "units has none for %s: must be \"%s\"", key, unit);
    if (!json_is_string(found) || std::strcmp(json_string_value(found), unit) != 0)
      fail(source_, "the unit of %s is %s: must be \"%s\"", key, ShownJson(found).text, unit);
    json_object_del(units_, key);
  }
  /// What still rounds to a finite number of that type, when it is written with all its digits.
  static double largest(double) noexcept { return (std::numeric_limits<double>::max)(); }
  static double largest(float) noexcept { return 3.4028235e38; }

  /// Of a number that is no entry of a table.
  static constexpr std::size_t alone = static_cast<std::size_t>(-1);

  /// @param k  which entry of the table of that name, or alone
  [[gnu::cold, gnu::noinline]] double number(const char* name, std::size_t k, const char* unit,
                                             const json_t* found, double low, double high) const {
    const double value = json_number_value(found);
    if (json_is_number(found) && value >= low && value <= high) return value;
    char entry[24] = "", path[80], allowed[64];
    if (k != alone) std::snprintf(entry, sizeof entry, "[%lu]", static_cast<unsigned long>(k));
    std::snprintf(path, sizeof path, "%s%s", name, entry);
    std::snprintf(allowed, sizeof allowed, "a number from %.8g to %.8g", low, high);
    reject(path, found, unit, allowed);
  }

  const std::string& source_;
  json_t* root_;
  Json own_units_;
  json_t* units_ = nullptr;
  // Of an object within another: "errors.regions[2]." and "errors.regions.".
  char path_[96] = "", unit_path_[96] = "";
};

}  // namespace hapbeam::detail
