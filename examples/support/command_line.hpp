// How the programs read their command line: a list of options, and one line for whoever chose wrongly.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cli {

/// A wrong command line; what() is one line that says what is allowed.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& allowed);

/// As short as %g writes it.
std::string digits(double x);

/// What a value must be to be taken; all throw UsageError.
double number(const std::string& option, const std::string& value, double low, double high,
              const std::string& unit);
int whole_number(const std::string& option, const std::string& value, int low, int high);
std::string file_name(const std::string& option, const std::string& value);

/// One option.  `set` stores its value in a field that it refers to.
struct Entry {
  const char* option;
  const char* argument;  ///< empty: a flag
  std::string text;
  std::function<void(const std::string& value)> set;
  bool first = false;  ///< taken before the others, wherever it stands, so that they change it
};
using Entries = std::vector<Entry>;

/// Of a list of entries: a figure, a whole number, a flag.
Entry figure(const char* option, const char* argument, const std::string& text, double& field, double low,
             double high, const char* unit);
Entry count(const char* option, const std::string& text, int& field, int low, int high);
Entry flag(const char* option, const std::string& text, bool& field);
Entry file(const char* option, const std::string& text, std::string& field);

/// Sets what the arguments choose.   @return the options that were given   @throws UsageError
std::vector<std::string> read(const std::vector<std::string>& arguments, const Entries& entries);

bool contains(const std::vector<std::string>& given, const std::string& option);
/// @throws UsageError where both were given
void exclude(const std::vector<std::string>& given, const std::string& option, const std::string& other,
             const std::string& why);

/// True where help is asked for, whatever else is.
bool wants_help(const std::vector<std::string>& arguments);
/// A line for each option.
std::string describe(const Entries& entries);

/// The one of a list that bears a name, or null.  `name(entry)` is found where the entry's type is.
template <typename T, std::size_t N>
const T* find(const T (&list)[N], const std::string& wanted) {
  for (const T& candidate : list)
    if (wanted == name(candidate)) return &candidate;
  return nullptr;
}

template <typename T, std::size_t N>
std::string names(const T (&list)[N]) {
  std::string text;
  for (const T& entry : list) text += (text.empty() ? "" : ", ") + std::string(name(entry));
  return text;
}

/// @throws UsageError
template <typename T, std::size_t N>
const T& one_of(const T (&list)[N], const std::string& option, const std::string& value) {
  if (const T* found = find(list, value)) return *found;
  refuse(option, value, "one of " + names(list));
}

}  // namespace cli
