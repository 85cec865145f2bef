// SPDX-License-Identifier: MIT
// Files of JSON: read as a whole or rejected, in memory that their size bounds; written as a whole or not at all.
//
// Errors name the file, and of text that is no JSON the line and the column.
// Offline: allocates and throws.  Needs jansson.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

#include <hapbeam/rom/file/json.hpp>
#include <hapbeam/rom/file/replaced_file.hpp>

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

/// Rejects text that would take more memory, before it is parsed: three bytes can make an empty object of 250.
/// What stands in strings counts as well; a model has few.
[[gnu::cold]] inline void check_memory(const char* text, std::size_t size, const std::string& source,
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
}

[[gnu::cold]] inline Json parse_json(const char* text, std::size_t size, const std::string& source,
                                     int line) {
  check_memory(text, size, source, line);
  json_error_t error;
  Json root(json_loadb(text, size, JSON_REJECT_DUPLICATES, &error));
  if (!root.get())
    fail(source, "line %d, column %d is no JSON: %s", line + error.line - 1, error.column, error.text);
  return root;
}

[[gnu::cold]] [[noreturn]] inline void reject_file(const std::string& path, const char* what) {
  fail(path, "%s: %s", what, errno ? std::strerror(errno) : "unknown reason");
}

[[gnu::cold]] inline std::string read_file(const std::string& path) {
  errno = 0;
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (!file) reject_file(path, "cannot be opened");
  std::string text;
  char part[1 << 12];
  // One byte beyond the limit is enough to reject the file.
  for (std::size_t size = 1; size > 0 && text.size() <= largest_json_file; text.append(part, size))
    size = std::fread(part, 1, sizeof part, file);
  const bool failed = std::ferror(file);
  std::fclose(file);
  if (failed) reject_file(path, "cannot be read");
  return text;
}

/// Writes all of the text under that name, or nothing.
[[gnu::cold]] inline void write_file(const std::string& path, const std::string& text) {
  try {
    ReplacedFile file(path);
    file.write(text);
    file.replace();
  } catch (const std::runtime_error& error) {
    throw ModelFileError(error.what());
  }
}

}  // namespace hapbeam::detail
