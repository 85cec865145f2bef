// A table of measured forces, as it is first written: force and rotation of even presses, each interpolated on its own,
// linearly, between its four neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/closed_path.hpp"

namespace hapbeam::testing {

class ForceTable {
 public:
  /// @param model  asked for every press of the grid   @param columns, rows  even over s and d, ends included
  template <class Model>
  ForceTable(Model& model, double s_min, double s_max, int columns, double depth, int rows)
      : s_min_(s_min),
        ds_((s_max - s_min) / (columns - 1)),
        dd_(depth / (rows - 1)),
        columns_(columns),
        rows_(rows) {
    const auto feel = feel_of(model);
    for (int i = 0; i < columns; ++i) {
      model.reset();
      for (int j = 0; j < rows; ++j) table_.push_back(feel({s_min + i * ds_, j * dd_}));
    }
  }

  Feel operator()(const Press<double>& press) const {
    const double x = (press.s - s_min_) / ds_, y = press.d / dd_;
    const int i = std::clamp(static_cast<int>(x), 0, columns_ - 2),
              j = std::clamp(static_cast<int>(y), 0, rows_ - 2);
    const double a = x - i, b = y - j;
    const auto between = [&](auto member) {
      return (1 - a) * ((1 - b) * at(i, j).*member + b * at(i, j + 1).*member) +
             a * ((1 - b) * at(i + 1, j).*member + b * at(i + 1, j + 1).*member);
    };
    return {between(&Feel::force), between(&Feel::theta)};
  }

 private:
  const Feel& at(int i, int j) const { return table_[static_cast<std::size_t>(i * rows_ + j)]; }

  double s_min_, ds_, dd_;
  int columns_, rows_;
  std::vector<Feel> table_;
};

}  // namespace hapbeam::testing
