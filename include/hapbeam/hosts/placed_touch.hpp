// SPDX-License-Identifier: MIT
// A beam placed in a host's space, for hosts that request the force at a position, and couple, limit and send it
// themselves: CHAI3D, SOFA, HAPI, HLAPI.
//
//   PlacedTouch<FemModel<>> beam(model, 0.005, Placement::in_plane({0.15, 0.02}));
//   const Eigen::Vector3d force = beam.tick(position);        // haptic thread
//   draw(beam.picture().shape());                             // graphics thread
//
// A rod in space is touched with all of a stylus, too: it takes the pose of the hand and answers with force and torque about its place.
//
//   PlacedTouch<FemModel<RoundRod>> rod(model, 0.002, placement, {0.1, 0.1});   // a shaft of 100 mm behind its tip
//   const Wrench felt = rod.tick(HandPose{position, orientation});
//
// The force is that of Touch, bit by bit if the placement only exchanges axes, and zero where the status is no answer.  A position beyond
// 1e9 or an orientation that is no rotation is invalid_request.  There is no coupling and no guard: use a Servo for a beam stiffer than
// the device can render.
// Real-time: tick() does not allocate and is noexcept, wait-free, and bounded as Touch::tick().
#pragma once

#include <limits>
#include <type_traits>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/haptics/servo/stylus.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

namespace hapbeam {

template <typename Model>
class PlacedTouch {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = Touch<Model>::dimension;
  using Picture = ServoPicture<Scalar, dimension>;

  /// @param model  kept by reference, and pressed by this object alone
  /// @param avatar_radius  [m] in the beam's metres, of the round tool
  /// @param placement  of the host's positions in the plane of the beam or the space of the rod, with axes and scale
  /// @param stylus  what tick(HandPose) brings to a rod in space   @param friction  of a model that has it
  /// Allocates.   @throws std::invalid_argument as Touch, or for a stylus of a planar beam
  PlacedTouch(Model& model, double avatar_radius, const Placement& placement = {},
              const StylusOptions& stylus = {}, const Friction& friction = {})
      : placement_(placement),
        touch_(detail::make_touch(model, static_cast<Scalar>(avatar_radius), friction)),
        stylus_(stylus),
        pictures_(model, touch_) {}

  /// With a round tool.
  /// @param position  in the host's axes and units of length   @return [N] on the hand, host's axes; always finite
  [[nodiscard]] Eigen::Vector3d tick(const Eigen::Vector3d& position) noexcept {
    if (!detail::is_place(position)) return keep_nothing().force;
    const VectorOf<double, dimension> hand = placement_.template position_of<dimension>(position);
    felt_ = touch_.tick(hand.template cast<Scalar>());
    const Eigen::Vector3d avatar = detail::in_scene(hand);
    return keep(position, avatar, {avatar, Eigen::Vector3d::Zero()}, Eigen::Vector3d::Zero()).force;
  }

  /// With the shaft of the stylus, of a rod in space.
  /// @param hand  in the host's axes and units of length; the stylus points from its tip along the hand's z
  /// @return on the hand, about its place, host's axes: [N] and N times the host's unit of length; always finite
  template <typename Pose, int D = dimension,
            std::enable_if_t<D == 3 && std::is_same_v<Pose, HandPose>, int> = 0>
  [[nodiscard]] Wrench tick(const Pose& hand) noexcept {
    if (!(detail::is_place(hand.place) && detail::is_rotation(hand.turn))) return keep_nothing();
    const HandPose there{placement_.scene_position(hand.place), placement_.scene_orientation(hand.turn)};
    const Shaft<double> axis{there.place + stylus_.tip(there), stylus_.shaft(there)};
    felt_ = touch_.tick(axis.tip.template cast<Scalar>(), axis.way.template cast<Scalar>());
    const Eigen::Vector3d arm = detail::in_scene(felt_.contact.foot) - there.place;
    return keep(hand.place, there.place, axis, detail::cross3<double>(arm, detail::in_scene(felt_.force)));
  }

  /// Ends the contact.  Only while no tick runs.
  void reset() noexcept {
    touch_.reset();
    felt_ = {};
  }

  const Placement& placement() const noexcept { return placement_; }

  /// The result of the last tick, in the axes of the beam.  From the haptic thread.
  const TouchResult<Scalar, dimension>& felt() const noexcept { return felt_; }

  /// The newest shape and its record. The record has status, model, position, hand, avatar, force, torque, shaft, press,
  /// pressing, what friction does, and the counts of ticks. One reader, from any thread: wait-free. Both stay until the next call.
  /// A shape that costs more than its force is that of the first tick after the last call.
  const Picture& picture() noexcept { return pictures_.newest(); }

 private:
  LoopStatus status() const noexcept {
    if (!is_answer(felt_.status)) return LoopStatus::no_answer;
    if (!felt_.pressing) return LoopStatus::free;
    return felt_.status == Status::out_of_range ? LoopStatus::out_of_range : LoopStatus::touching;
  }

  /// @param position  of the hand, host   @param hand, avatar, torque  in the scene   @return in the host's axes
  Wrench keep(const Eigen::Vector3d& position, const Eigen::Vector3d& hand, const Shaft<double>& avatar,
              const Eigen::Vector3d& torque) noexcept {
    Wrench felt;
    if (is_answer(felt_.status)) {
      felt = {placement_.device_force(detail::in_scene(felt_.force)), placement_.device_torque(torque)};
      if (!felt.torque.allFinite()) felt = {};
    }
    record_.position = position;
    record_.hand = hand;
    record_.avatar = avatar.tip, record_.shaft = avatar.way;
    keep(felt);
    return felt;
  }
  /// Of a reading that is no place: those of the last one that was stay.
  Wrench keep_nothing() noexcept {
    felt_ = touch_.tick(VectorOf<Scalar, dimension>::Constant(std::numeric_limits<Scalar>::quiet_NaN()));
    const Wrench none;
    keep(none);
    return none;
  }
  void keep(const Wrench& felt) noexcept {
    ServoRecord& r = record_;
    r.status = status();
    r.keep(felt_, felt, felt_.pressing, r.status == LoopStatus::no_answer);
    pictures_.publish(r, true);
  }

  Placement placement_;
  Touch<Model> touch_;
  detail::Stylus<Scalar, dimension> stylus_;
  TouchResult<Scalar, dimension> felt_;
  ServoRecord record_;
  detail::Pictures<Model> pictures_;
};

}  // namespace hapbeam
