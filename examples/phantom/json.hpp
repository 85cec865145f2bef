// One flat JSON object, written member by member (RFC 8259).
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

namespace phantom {

class JsonObject {
 public:
  JsonObject& add(const std::string& name, const std::string& value) { return member(name, quoted(value)); }
  JsonObject& add(const std::string& name, const char* value) { return add(name, std::string(value)); }
  JsonObject& add(const std::string& name, bool value) { return member(name, value ? "true" : "false"); }
  JsonObject& add(const std::string& name, int value) { return member(name, std::to_string(value)); }
  JsonObject& add(const std::string& name, std::uint64_t value) {
    return member(name, std::to_string(value));
  }
  /// null where it is not finite, which JSON has no word for.
  JsonObject& add(const std::string& name, double value) {
    if (!std::isfinite(value)) return member(name, "null");
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return member(name, text);
  }
  std::string text() const { return "{\n" + members_ + "\n}\n"; }

 private:
  JsonObject& member(const std::string& name, const std::string& value) {
    members_ += (members_.empty() ? "  " : ",\n  ") + quoted(name) + ": " + value;
    return *this;
  }
  static std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
      const auto code = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        result += '\\';
        result += c;
      } else if (code < 0x20) {
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(code));
        result += escaped;
      } else {
        result += c;
      }
    }
    return result + '"';
  }

  std::string members_;
};

}  // namespace phantom
