// SPDX-License-Identifier: MIT
// A Servo on an array of beams: what it draws.
//
//   BeamArray<FemModel<>> brush(bristle, places);
//   Servo<BeamArray<FemModel<>>> servo(brush, device_info, options);      // or a ServoLoop
//   for (int i = 0; i < picture.size(); ++i) draw(brush.frame(picture.beam(i)), picture.shape(i));
//
// Coupling, monitor and guard see the sum of the forces and the point from which all are pressed.  The placement maps the device to
// the array's plane.
// Real-time: as Servo.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/many/touch_many.hpp>

namespace hapbeam {

/// What is drawn: the record of a tick, and the beams that were pressed.  The others are at rest.
template <typename Scalar>
class ArrayPicture {
 public:
  template <typename Model>
  explicit ArrayPicture(const Touch<BeamArray<Model>>& touch) {
    const BeamArray<Model>& array = touch.array();
    int room = 0;
    for (int k = 0; k < array.kinds(); ++k) room = (std::max)(room, array.kind(k).model.shape().size());
    beams_.resize(static_cast<std::size_t>(array.most_touched()), {0, detail::KeptShape<Scalar, 2>(room)});
    take(touch);
  }

  ServoRecord record;
  int size() const noexcept { return size_; }
  int beam(int i) const noexcept { return beams_[static_cast<std::size_t>(i)].index; }  ///< in the array
  /// In its own axes.
  Centreline<Scalar> shape(int i) const noexcept { return beams_[static_cast<std::size_t>(i)].kept.shape(); }

  template <typename Model>
  void take(const Touch<BeamArray<Model>>& touch) noexcept {
    size_ = 0;
    for (const BeamTouch<Scalar>& touched : touch.touches()) add(touched.beam, touch.shape(touched.beam));
  }
  void take(const ArrayPicture& other) noexcept {
    size_ = 0;
    for (int i = 0; i < other.size(); ++i) add(other.beam(i), other.shape(i));
  }

 private:
  struct Beam {
    int index;
    detail::KeptShape<Scalar, 2> kept;
  };

  void add(int index, const Centreline<Scalar>& shape) noexcept {
    Beam& beam = beams_[static_cast<std::size_t>(size_++)];
    beam.index = index;
    beam.kept.take(shape);
  }

  std::vector<Beam> beams_;
  int size_ = 0;
};

template <typename Model>
struct Drawn<BeamArray<Model>> {
  using Picture = ArrayPicture<typename Model::Scalar>;
  static constexpr bool for_who_looks = detail::offers<detail::Part, Model>;
  static const auto& of(const BeamArray<Model>&, const Touch<BeamArray<Model>>& touch) noexcept {
    return touch;
  }
};

}  // namespace hapbeam
