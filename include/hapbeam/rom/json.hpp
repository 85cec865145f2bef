// What reading and writing a model file share: the error, ownership of a JSON value, and the place of a field in it.
//
// Offline: allocates, throws.  Needs jansson.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <jansson.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hapbeam {

/// A model file that cannot be read or written; what() says which, what is wrong with it, and what is allowed.
struct ModelFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

struct JsonRelease {
  void operator()(json_t* value) const noexcept { json_decref(value); }
};
using Json = std::unique_ptr<json_t, JsonRelease>;

inline std::string dump_json(const json_t* value, std::size_t flags) {
  const std::unique_ptr<char, decltype(&std::free)> text(json_dumps(value, flags), &std::free);
  if (!text) throw ModelFileError("JSON cannot be written: out of memory");
  return text.get();
}

/// A value for a message: as it stands in the file, if it is short.
inline std::string show_json(const json_t* value) {
  if (json_is_object(value)) return "an object";
  if (json_is_array(value)) return "an array of " + std::to_string(json_array_size(value));
  std::string text = dump_json(value, JSON_ENCODE_ANY | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9));
  if (text.size() > 60) text.replace(57, std::string::npos, "...");
  return text;
}

/// Where a walk through the members is, for messages: beam.length, errors.regions[2].s_min.
class JsonPath {
 public:
  explicit JsonPath(std::string source) : source_(std::move(source)) {}

  void enter(const std::string& name) {
    ends_.push_back(path_.size());
    path_ += name + ".";
  }
  void leave() {
    path_.resize(ends_.back());
    ends_.pop_back();
  }
  /// Without the index of a list's entry, as the units are named.
  std::string unit_name(const char* name) const {
    std::string plain;
    bool index = false;
    for (const char c : path_ + name) {
      index = index || c == '[';
      if (!index) plain += c;
      if (c == ']') index = false;
    }
    return plain;
  }

  [[noreturn]] void reject(const std::string& name, const std::string& found, const char* unit,
                           const std::string& allowed) const {
    throw ModelFileError(source_ + ": " + path_ + name + " = " + found + (*unit ? " " : "") + unit +
                         ": must be " + allowed);
  }
  [[noreturn]] void reject(const std::string& name, const std::string& fault) const {
    throw ModelFileError(source_ + ": " + path_ + name + fault);
  }

 private:
  std::string source_, path_;
  std::vector<std::size_t> ends_;
};

}  // namespace detail
}  // namespace hapbeam
