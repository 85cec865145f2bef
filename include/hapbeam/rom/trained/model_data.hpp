// SPDX-License-Identifier: MIT
// What training makes and a file keeps: the numbers of a trained model, and the check that they are one.
//
// Plain data in SI.  The models are constructed from it, and reject what check() rejects.
// Offline: allocates; check() throws std::invalid_argument naming field, value and what is allowed.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>
#include <hapbeam/rom/trained/shape_table.hpp>

namespace hapbeam {

/// Errors over a sample of presses, against the full model.  The force's is relative; the shape's is the largest |Δw| over the largest
/// |w| of the beam.  A press by less than a thousandth of the depth from where dead loads bend the beam, at which the force is zero, is
/// compared with the force of a thousandth.
struct ErrorSummary {
  int presses = 0;
  double force_median = 0;
  double force_p95 = 0;
  double force_max = 0;
  double shape_median = 0;
  double shape_max = 0;
};

/// The same for a part of the range.
struct RegionError {
  double s_min, s_max;          ///< [m]
  double depth_min, depth_max;  ///< [m] of |d|
  ErrorSummary errors;
};

struct ErrorReport {
  std::string reference;  ///< the full model that the model was compared with
  ErrorSummary all;       ///< of all presses of the sample
  std::vector<RegionError> regions;
  /// Bound on the relative error of the force of every press in range(). It is 1.1 times the largest difference to the
  /// full model that a search from the worst presses found, plus reference_error, and at least 1e-8 for round-off.
  /// The search is no proof.  Within a thousandth of the length from an end that is free to move, finite elements are no reference; the
  /// bound is that of the places beside.
  double force_bound = 0;
  /// Largest relative error of the full model's force, by one with twice its elements.
  double reference_error = 0;
};

/// What both kinds of trained models have.
template <typename Scalar>
struct TrainedData {
  BeamData<Scalar> beam;
  Scalar s_min, s_max;  ///< [m] equal where one position was trained
  Scalar depth;         ///< [m] largest |d| in range
  int positions;        ///< of the grid
  ShapeData<Scalar> shape;
  ErrorReport errors;
};

/// Of a PodModel.  Grids run through the positions, and for each through the depths.
template <typename Scalar>
struct PodModelData : TrainedData<Scalar> {
  static constexpr const char* kind = "pod";
  bool symmetric;                 ///< the force is odd in d: no dead load
  int depths;                     ///< of the grid
  Scalar y_low, y_high;           ///< ends of the interval of DepthCoordinate
  std::vector<Scalar> potential;  ///< positions × depths: scale(s) · 2V/e² [N/m], V the work of the press
  std::vector<Scalar> rest;  ///< positions: w of the untouched beam [m], from which e = d - rest is measured

  int others() const noexcept { return depths; }  ///< size of the grid along its other axis
};

/// Of a GalerkinModel.  Grids run through the positions, and for each through the tensions.
template <typename Scalar>
struct GalerkinModelData : TrainedData<Scalar> {
  static constexpr const char* kind = "galerkin";
  int tensions;                       ///< of the grid; one tension where none arises
  Scalar tension;                     ///< [N] largest trained; 0 where none arises
  std::vector<Scalar> log_stiffness;  ///< positions × tensions: ln(scale(s) F/d) of the force in N/m

  int others() const noexcept { return tensions; }  ///< size of the grid along its other axis
};

namespace detail {

/// At most this many numbers in a table: 128 MB in double.
inline constexpr std::size_t largest_table = std::size_t(1) << 24;

/// @param low, high  that every entry must be above, and not above
template <typename Scalar>
[[gnu::cold]] void check_table(const char* field, const std::vector<Scalar>& values, std::size_t wanted,
                               Scalar low, Scalar high, const char* allowed) {
  if (values.size() != wanted)
    refuse("%s = %g: must be %g numbers", field, double(values.size()), double(wanted));
  for (const Scalar value : values)
    if (!(value > low && value <= high)) reject(field, value, "", allowed);
}
/// What has no unit, or is a length: products of a few of them are finite in float, too.
template <typename Scalar>
[[gnu::cold]] void check_table(const char* field, const std::vector<Scalar>& values, std::size_t wanted) {
  check_table(field, values, wanted, Scalar(-1e9), Scalar(1e9), "within 1e9 in every entry");
}

[[gnu::cold]] inline void check_length(const char* field, double value) {
  if (!(value >= 1e-12 && value <= 1e12))
    reject(field, positive(field, value, "m"), "m", "from 1e-12 to 1e12");
}

[[gnu::cold]] inline std::size_t check_count(const char* field, int value, int low, int high) {
  if (value < low || value > high) refuse("%s = %g: must be %d to %d", field, double(value), low, high);
  return static_cast<std::size_t>(value);
}

template <typename Scalar>
[[gnu::cold]] void check_range(const BeamData<Scalar>& beam, Scalar s_min, Scalar s_max, Scalar depth,
                               int positions) {
  check_length("length", beam.length);
  positive("axial_stiffness", beam.axial_stiffness, "N");
  positive("bending_stiffness", beam.bending_stiffness, "N·m²");
  check_length("thickness", beam.thickness);
  check_supports(beam.left, beam.right);
  check_length("depth", depth);
  // Rounded to another scalar an edge may move by its last digit.
  const Scalar margin = beam.length / 1000 - 4 * std::numeric_limits<Scalar>::epsilon() * beam.length;
  const Scalar low = fixes_w(beam.left) ? margin : Scalar(0);
  const Scalar high = beam.length - (fixes_w(beam.right) ? margin : Scalar(0));
  if (!(s_min >= low && s_min <= high))
    reject("s_min", s_min, "m", "on the beam, a thousandth away from an end that is held");
  if (!(s_max >= s_min && s_max <= high))
    reject("s_max", s_max, "m", "s_min to the end, a thousandth away where it is held");
  if ((s_min == s_max) != (positions == 1))
    reject("positions", positions, "", "1 where s_min = s_max, 2 or more elsewhere");
}

template <typename Scalar>
[[gnu::cold]] void check_shape(const ShapeData<Scalar>& shape, std::size_t grid) {
  const std::size_t segments = check_count("segments", shape.segments, 1, 1 << 14),
                    modes = check_count("modes", shape.modes, 1, 1 << 10);
  check_count("contact_node", shape.contact_node, 0, shape.segments);
  if (grid * modes > largest_table) reject("modes", shape.modes, "", "fewer");
  check_table("basis", shape.basis, 3 * (segments + 1) * modes);
  check_table("coefficients", shape.coefficients, grid * modes);
  check_table("rest_shape", shape.rest, 3 * (segments + 1));
}

template <typename To, typename From>
std::vector<To> cast(const std::vector<From>& values) {
  return {values.begin(), values.end()};
}
template <typename To, typename From>
BeamData<To> cast(const BeamData<From>& b) {
  return {To(b.length), To(b.axial_stiffness), To(b.bending_stiffness), To(b.thickness), b.left, b.right};
}
template <typename To, typename From>
ShapeData<To> cast(const ShapeData<From>& s) {
  return {s.segments, s.contact_node, s.modes, cast<To>(s.basis), cast<To>(s.coefficients), cast<To>(s.rest)};
}

template <typename To, typename From>
TrainedData<To> cast(const TrainedData<From>& d) {
  return {cast<To>(d.beam), To(d.s_min), To(d.s_max), To(d.depth), d.positions, cast<To>(d.shape), d.errors};
}

}  // namespace detail

template <typename Scalar>
[[gnu::cold]] const PodModelData<Scalar>& check(const PodModelData<Scalar>& data) {
  using namespace detail;
  const std::size_t positions = check_count("positions", data.positions, 1, 64),
                    depths = check_count("depths", data.depths, 2, 64);
  check_range(data.beam, data.s_min, data.s_max, data.depth, data.positions);
  finite("y_low", data.y_low, "");
  finite("y_high", data.y_high, "");
  if (!(data.y_low < data.y_high) || (data.symmetric && data.y_low != 0))
    reject("y_low", data.y_low, "", "below y_high, 0 where symmetric");
  check_table("potential", data.potential, positions * depths, Scalar(0),
              (std::numeric_limits<Scalar>::max)(), "positive and finite in every entry");
  check_table("rest", data.rest, positions);
  // A press in range must not be beyond the grid: there a polynomial grows without bound.
  const DepthCoordinate<Scalar> y(data.beam, data.symmetric);
  const Scalar rounding = std::sqrt(std::numeric_limits<Scalar>::epsilon()) * (data.y_high - data.y_low);
  for (const Scalar rest : data.rest) {
    if (data.symmetric && rest != 0) reject("rest", rest, "", "0 where symmetric");
    if (!(y(data.depth - rest) <= data.y_high + rounding && y(-data.depth - rest) >= data.y_low - rounding))
      reject("depth", data.depth, "m", "within the depths of the grid, y_low to y_high");
  }
  check_shape(data.shape, positions * depths);
  return data;
}

template <typename Scalar>
[[gnu::cold]] const GalerkinModelData<Scalar>& check(const GalerkinModelData<Scalar>& data) {
  using namespace detail;
  const std::size_t positions = check_count("positions", data.positions, 1, 64),
                    tensions = check_count("tensions", data.tensions, 1, 64);
  check_range(data.beam, data.s_min, data.s_max, data.depth, data.positions);
  if (!(data.tension >= 0 && std::isfinite(data.tension)) || (data.tension == 0) != (data.tensions == 1))
    reject("tension", data.tension, "N", "positive and finite, 0 where tensions = 1");
  check_table("log_stiffness", data.log_stiffness, positions * tensions);
  check_shape(data.shape, positions * tensions);
  return data;
}

/// The same model in another scalar: cast<float>(data).  The error report stays; measure again if it matters.
template <typename To, typename From>
PodModelData<To> cast(const PodModelData<From>& d) {
  const auto potential = detail::cast<To>(d.potential), rest = detail::cast<To>(d.rest);
  return {detail::cast<To>(d), d.symmetric, d.depths, To(d.y_low), To(d.y_high), potential, rest};
}
template <typename To, typename From>
GalerkinModelData<To> cast(const GalerkinModelData<From>& d) {
  return {detail::cast<To>(d), d.tensions, To(d.tension), detail::cast<To>(d.log_stiffness)};
}

}  // namespace hapbeam
