// What is drawn of a rod: cuts along it, and how much it is bent there.
#pragma once

#include <vector>

#include "solids.hpp"
#include <hapbeam/rod.hpp>

namespace phantom {

class RodLine {
  using Vector = Eigen::Vector3d;

 public:
  using Shape = hapbeam::Centreline<double, 3>;
  struct Sample {
    double s, strain;  ///< [m]; at the surface, of bending from its natural shape
    Ring ring;
  };
  struct Nearest {
    Vector place;     ///< [m] of the centreline
    double distance;  ///< [m]
  };

  explicit RodLine(const hapbeam::Rod& rod);

  /// As it lies now.
  void take(const Shape& shape);
  const std::vector<Sample>& samples() const { return samples_; }
  double largest_strain() const { return largest_strain_; }
  Nearest nearest(const Vector& p) const;
  const hapbeam::Rod& rod() const { return rod_; }

 private:
  std::vector<double> mean_curvatures(
      const Shape& shape) const;  ///< [1/m] of elements, less their natural ones
  double radius(double s) const;  ///< [m]

  hapbeam::Rod rod_;
  std::vector<Sample> samples_;
  double largest_strain_ = 0;
};

}  // namespace phantom
