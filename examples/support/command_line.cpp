#include "command_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {

void refuse(const std::string& option, const std::string& value, const std::string& allowed) {
  throw UsageError(option + " " + value + ": must be " + allowed);
}

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

double number(const std::string& option, const std::string& value, double low, double high,
              const std::string& unit) {
  char* end = nullptr;
  const double parsed = std::strtod(value.c_str(), &end);
  // Not NaN either.
  if (!value.empty() && *end == '\0' && parsed >= low && parsed <= high) return parsed;
  refuse(option, value, digits(low) + " to " + digits(high) + (unit.empty() ? "" : " " + unit));
}

int whole_number(const std::string& option, const std::string& value, int low, int high) {
  const double parsed = number(option, value, low, high, "");
  if (parsed != std::floor(parsed))
    refuse(option, value, "a whole number, " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(parsed);
}

std::string file_name(const std::string& option, const std::string& value) {
  if (value.empty()) refuse(option, "''", "the name of a file");
  return value;
}

Entry figure(const char* option, const char* argument, const std::string& text, double& field, double low,
             double high, const char* unit) {
  return {option, argument, text,
          [=, &field](const std::string& value) { field = number(option, value, low, high, unit); }};
}

Entry count(const char* option, const std::string& text, int& field, int low, int high) {
  return {option, "N", text,
          [=, &field](const std::string& value) { field = whole_number(option, value, low, high); }};
}

Entry flag(const char* option, const std::string& text, bool& field) {
  return {option, "", text, [&field](const std::string&) { field = true; }};
}

Entry file(const char* option, const std::string& text, std::string& field) {
  return {option, "FILE", text,
          [option, &field](const std::string& value) { field = file_name(option, value); }};
}

std::vector<std::string> read(const std::vector<std::string>& arguments, const Entries& entries) {
  std::vector<std::string> given;
  for (const bool first : {true, false})
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Entry* entry = nullptr;
      for (const Entry& candidate : entries)
        if (arguments[i] == candidate.option) entry = &candidate;
      if (!entry) throw UsageError(arguments[i] + ": no such option; --help lists them");
      const bool is_flag = *entry->argument == '\0';
      if (!is_flag && (i + 1 == arguments.size() || arguments[i + 1].rfind("--", 0) == 0))
        throw UsageError(arguments[i] + ": must be followed by " + entry->argument + "; --help says more");
      if (first == entry->first) {
        entry->set(is_flag ? "" : arguments[i + 1]);
        given.push_back(entry->option);
      }
      if (!is_flag) ++i;
    }
  return given;
}

bool contains(const std::vector<std::string>& given, const std::string& option) {
  return std::find(given.begin(), given.end(), option) != given.end();
}

void exclude(const std::vector<std::string>& given, const std::string& option, const std::string& other,
             const std::string& why) {
  if (contains(given, option) && contains(given, other))
    throw UsageError(option + ": must not stand beside " + other + ", " + why);
}

bool wants_help(const std::vector<std::string>& arguments) {
  return contains(arguments, "--help") || contains(arguments, "-h");
}

std::string describe(const Entries& entries) {
  std::string text;
  for (const Entry& entry : entries) {
    std::string left = std::string("  ") + entry.option + " " + entry.argument;
    left.resize(std::max<std::size_t>(left.size() + 2, 22), ' ');
    text += left + entry.text + "\n";
  }
  return text;
}

}  // namespace cli
