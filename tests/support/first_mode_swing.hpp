// A cantilever that is let go at rest with the angle of its first mode, 1.2 rad at its tip.
//
// Its tip for two periods is in swing.csv, of an inextensible rod of length, mass and bending stiffness 1, by an angle p-version, to 4e-5.
#pragma once

#include <cmath>
#include <vector>

#include "csv.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::testing {

/// Nodes of its shape, evenly along it.   @param length [m]
inline std::vector<CentrelineNode<double>> first_mode_shape(double length, int elements) {
  constexpr double beta = 1.8751040687119611, ratio = 0.7340955137589128;
  const auto slope = [](double x) {
    const auto mode = [](double y) {
      return std::sinh(y) + std::sin(y) - ratio * (std::cosh(y) - std::cos(y));
    };
    return 1.2 * mode(beta * x) / mode(beta);
  };
  std::vector<CentrelineNode<double>> nodes;
  Eigen::Vector2d at(0, 0);
  for (int i = 0; i <= elements; ++i) {
    constexpr int parts = 1000;
    for (int k = 0; i > 0 && k < parts; ++k) {
      const double angle = slope((i - 1 + (k + 0.5) / parts) / elements);
      at += Eigen::Vector2d(std::cos(angle), std::sin(angle)) / (elements * parts);
    }
    const double x = double(i) / elements;
    nodes.push_back({length * x, length * (at.x() - x), length * at.y(), -slope(x)});
  }
  return nodes;
}

/// Its first period.
class FirstModeSwing {
 public:
  explicit FirstModeSwing(const Beam& beam)
      : length_(beam.length()),
        unit_(length_ * length_ * std::sqrt(beam.mass_per_length(0) / beam.bending_stiffness())) {}

  /// Instants at which the tip is known.
  std::size_t size() const { return (path_.rows() - 1) / 2; }
  double period() const { return unit_ * path_.number(2 * size(), "t") / 2; }  ///< [s]
  /// By a step of motion.   @param parts  steps between two of those instants   @param step  (dt) -> whether it has gone on   @param tip  () -> place [m]
  /// @return largest distance of the tip from where it should be, over the length; infinite where a step has failed
  template <class Step, class Tip>
  double error(int parts, Step&& step, Tip&& tip) const {
    const double dt = period() / static_cast<double>(size()) / parts;
    double off = 0;
    for (std::size_t row = 1; row <= size(); ++row) {
      for (int k = 0; k < parts; ++k)
        if (!step(dt)) return HUGE_VAL;
      const Vector2<double> exact(path_.number(row, "tip_x"), path_.number(row, "tip_y"));
      off = std::max(off, (tip() / length_ - exact).norm());
    }
    return off;
  }

 private:
  Csv path_{"swing.csv"};
  double length_, unit_;
};

}  // namespace hapbeam::testing
