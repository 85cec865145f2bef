// SPDX-License-Identifier: MIT
// A beam that is alike on both sides of the place where it is pressed, by a model of its left half.
//
// The half ends in a plane of symmetry (Support::guided), where it is pressed with half of the force.
// Offline: construction allocates and throws.  Servo: as the half, and O(nodes) for the other side of the shape.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// The left half of a beam whose right half is its mirror image: no loads, ends alike, perhaps pulled apart.
inline Beam half_of(const Beam& beam) {
  Beam half(beam.length() / 2, beam.axial_stiffness(), beam.bending_stiffness(), beam.thickness(),
            beam.left(), Support::guided);
  return half.place({}, {beam.right_place().u / 2, 0, 0});
}

/// @tparam Half  a ForceModel of half_of(beam)
template <class Half>
class Mirrored {
 public:
  using Scalar = typename Half::Scalar;

  /// @param apart  [m] how far the whole beam's ends are pulled apart
  explicit Mirrored(Half half, Scalar apart = 0) : half_(std::move(half)), apart_(apart) {
    nodes_.resize(static_cast<std::size_t>(2 * half_.shape().segments() + 1));
    mirror();
  }

  /// As the half's, in the middle alone: elsewhere out_of_range.
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    const Scalar middle = half_.shape().length();
    const bool on_beam = request.s >= 0 && request.s <= 2 * middle;
    const Response<Scalar> half = half_.press({on_beam ? middle : request.s, request.d});
    if (is_answer(half.status)) mirror();
    using std::abs;
    const bool off = abs(request.s - middle) > Scalar(1e-6) * middle;
    return {2 * half.force, half.status == Status::ok && off ? Status::out_of_range : half.status};
  }

  Centreline<Scalar> shape() const noexcept {
    return {nodes_.data(), static_cast<int>(nodes_.size()), half_.shape().any_rotation()};
  }
  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar middle = half_.shape().length();
    return {middle, middle, half_.range().depth_at(middle), Scalar(1), -infinity, infinity};
  }
  Scalar thickness() const noexcept { return half_.thickness(); }
  void reset() noexcept {
    half_.reset();
    mirror();
  }

  const Half& half() const noexcept { return half_; }

 private:
  void mirror() noexcept {
    const Centreline<Scalar> left = half_.shape();
    const Scalar length = 2 * left.length();
    for (std::size_t i = 0, last = nodes_.size() - 1; i <= last / 2; ++i) {
      const CentrelineNode<Scalar>& node = left[static_cast<int>(i)];
      nodes_[last - i] = {length - node.s, apart_ - node.u, node.w, -node.theta};
      nodes_[i] = node;
    }
  }

  Half half_;
  Scalar apart_;
  std::vector<CentrelineNode<Scalar>> nodes_;
};

}  // namespace hapbeam
