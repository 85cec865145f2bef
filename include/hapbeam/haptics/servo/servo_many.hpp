// SPDX-License-Identifier: MIT
// A Servo on an array of beams: what it draws.
//
//   BeamArray<FemModel<>> brush(bristle, places);
//   Servo<BeamArray<FemModel<>>> servo(brush, device_info, options);      // or a ServoLoop
//   for (int i = 0; i < picture.size(); ++i) draw(brush.frame(picture.beam(i)), picture.shape(i));
//
// Coupling, monitor and guard are those of one beam: they see the sum of the forces and the point from which all are pressed.
// The placement maps the device to the array's plane.
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
  /// Allocates.
  template <typename Model>
  explicit ArrayPicture(const Touch<BeamArray<Model>>& touch) {
    const BeamArray<Model>& array = touch.array();
    for (int k = 0; k < array.kinds(); ++k) room_ = (std::max)(room_, array.kind(k).model.shape().size());
    const std::size_t most = static_cast<std::size_t>(array.most_touched());
    beams_.resize(most);
    nodes_.resize(most * static_cast<std::size_t>(room_));
    take(touch);
  }

  ServoRecord record;
  int size() const noexcept { return size_; }
  int beam(int i) const noexcept { return beams_[static_cast<std::size_t>(i)].index; }  ///< in the array
  /// In its own axes.
  Centreline<Scalar> shape(int i) const noexcept {
    const Beam& beam = beams_[static_cast<std::size_t>(i)];
    return {nodes(nodes_, i), beam.nodes, beam.any_rotation};
  }

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
    int index, nodes;
    bool any_rotation;
  };

  template <class Nodes>
  auto* nodes(Nodes& all, int i) const noexcept {
    return all.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(room_);
  }
  void add(int index, const Centreline<Scalar>& shape) noexcept {
    const int size = ServoPicture<Scalar>::copy(shape, nodes(nodes_, size_), room_);
    beams_[static_cast<std::size_t>(size_++)] = {index, size, shape.any_rotation()};
  }

  std::vector<Beam> beams_;
  std::vector<CentrelineNode<Scalar>> nodes_;  // beam by beam
  int room_ = 0;                               // nodes of a beam
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
