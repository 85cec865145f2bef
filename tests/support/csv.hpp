// A table of tests/data: comma-separated, one header line, columns found by name.  Lines that begin with #
// are remarks.
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hapbeam::testing {

class Csv {
  using Row = std::vector<std::string>;

 public:
  /// @throws std::runtime_error where the file cannot be read or a row has another number of fields than the
  /// header
  explicit Csv(const std::string& file) : file_(file) {
    std::ifstream in(std::string(HAPBEAM_TEST_DATA_DIR "/") + file);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    for (std::string line; std::getline(in, line);) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line.front() == '#') continue;
      Row row;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
      if (header_.empty()) header_ = row;
      else if (row.size() == header_.size()) rows_.push_back(row);
      else throw std::runtime_error(file + ": " + line + ": wrong number of fields");
    }
  }

  std::size_t rows() const noexcept { return rows_.size(); }

  /// As it is printed.
  const std::string& text(std::size_t row, const std::string& column) const {
    const auto found = std::find(header_.begin(), header_.end(), column);
    if (found == header_.end()) throw std::runtime_error(file_ + ": no column " + column);
    return rows_.at(row)[static_cast<std::size_t>(found - header_.begin())];
  }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }

  /// Half a unit of the last printed digit: how far a value may lie from what was printed.
  double half_unit(std::size_t row, const std::string& column) const {
    const std::string& digits = text(row, column);
    const std::size_t point = digits.find('.');
    double unit = 1;
    for (std::size_t i = point; i != std::string::npos && i + 1 < digits.size(); ++i) unit /= 10;
    return unit / 2;
  }

 private:
  std::string file_;
  Row header_;
  std::vector<Row> rows_;
};

}  // namespace hapbeam::testing
