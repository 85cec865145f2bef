// What where_methods_fail writes: a table of all failures, and the series of its charts.
//
// The table is docs/data/where_methods_fail.csv: failure,measured,naive,hapbeam, as text with units, which the page shows
// as it is.  A row whose `measured` is "begins" says where a failure begins.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

namespace hapbeam::benchmarks {

/// Two significant digits, as short as can be: 0.013, 27, 1200, 4e-9.
inline std::string number(double x, int digits = 2) {
  char text[40];
  const double size = std::abs(x);
  if (x == 0) return "0";
  if (!std::isfinite(x)) return "∞";
  if (size >= 1e-3 && size < 1e6) {
    const double unit = std::pow(10.0, std::floor(std::log10(size)) - digits + 1);
    std::snprintf(text, sizeof text, "%.15g", size < 1 ? x : std::round(x / unit) * unit);
    if (size < 1) std::snprintf(text, sizeof text, "%.*g", digits, x);
    return text;
  }
  std::snprintf(text, sizeof text, "%.*e", size >= 1e6 ? digits - 1 : 0, x);
  std::string found = text;
  const std::size_t e = found.find('e');
  const int power = std::stoi(found.substr(e + 1));
  return found.substr(0, e) + "e" + std::to_string(power);
}
inline std::string percent(double x) { return number(100 * x) + " %"; }

/// Lines of numbers under a header.
class Series {
 public:
  Series(const std::string& file, const char* header) : out_(file) { out_ << header << '\n'; }
  template <typename... Values>
  void add(const Values&... values) {
    const char* separator = "";
    ((out_ << separator, put(values), separator = ","), ...);
    out_ << '\n';
  }

 private:
  void put(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    out_ << text;
  }
  std::ofstream out_;
};

class Report {
 public:
  /// @param folder  of the files
  explicit Report(const std::string& folder) : folder_(folder), table_(folder + "/where_methods_fail.csv") {
    table_ << "failure,measured,naive,hapbeam\n";
  }

  /// The failure that the next rows are about, by the anchor of its section on the page, and where it begins.
  void failure(const std::string& name, const std::string& begins) {
    failure_ = name;
    row("begins", begins, "");
  }
  void row(const std::string& measured, const std::string& naive, const std::string& library) {
    table_ << failure_ << ",\"" << measured << "\",\"" << naive << "\",\"" << library << "\"\n";
  }
  Series series(const std::string& name, const char* header) const {
    return {folder_ + "/fail_" + name + ".csv", header};
  }
  bool good() const { return table_.good(); }

 private:
  std::string folder_, failure_;
  std::ofstream table_;
};

/// Where a measure first exceeds a limit, between low and high, by bisection of its logarithm.
template <class Measure>
double first_beyond(Measure&& measure, double limit, double low, double high) {
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    (measure(middle) > limit ? high : low) = middle;
  }
  return low;
}

// The rooms, in the order of the page.
void elements(Report& report);
void newton(Report& report);
void training(Report& report);
void round_off(Report& report);
void contact(Report& report);
void loop(Report& report);
void steps(Report& report);

}  // namespace hapbeam::benchmarks
