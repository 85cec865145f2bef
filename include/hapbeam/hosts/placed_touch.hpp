// A beam placed in a host's space, for hosts that request the force at a position, and couple, limit and send it
// themselves: CHAI3D, SOFA, HAPI, HLAPI.
//
//   PlacedTouch<FemModel<>> beam(model, 0.005, Placement::in_plane({0.15, 0.02}));
//   const Eigen::Vector3d force = beam.tick(position);        // haptic thread
//   draw(beam.picture().shape());                             // graphics thread
//
// The force is that of Touch, bit by bit if the placement only exchanges axes. It is zero where the status is no
// answer. There is no coupling and no guard: use a Servo for a beam stiffer than the device can render.
// Real-time: tick() does not allocate and is noexcept, wait-free, and bounded as Touch::tick(). One other thread may
// call picture(), wait-free.
#pragma once

#include <atomic>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/haptics/stability/in_scene.hpp>

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
  /// Allocates.   @throws std::invalid_argument as Touch
  PlacedTouch(Model& model, double avatar_radius, const Placement& placement = {})
      : model_(model),
        placement_(placement),
        touch_(model, static_cast<Scalar>(avatar_radius)),
        seen_(model.shape()),
        pictures_(seen_) {}

  /// @param position  in the host's axes and units of length   @return [N] on the hand, host's axes; always finite
  [[nodiscard]] Eigen::Vector3d tick(const Eigen::Vector3d& position) noexcept {
    const VectorOf<double, dimension> hand = placement_.template position_of<dimension>(position);
    felt_ = touch_.tick(hand.template cast<Scalar>());
    Eigen::Vector3d force(0, 0, 0);
    if (is_answer(felt_.status)) force = placement_.device_force(detail::in_scene(felt_.force));
    keep(position, hand, force);
    publish();
    return force;
  }

  /// Ends the contact.  Only while no tick runs.
  void reset() noexcept {
    touch_.reset();
    felt_ = {};
  }

  const Placement& placement() const noexcept { return placement_; }

  /// The result of the last tick, in the axes of the beam.  From the haptic thread.
  const TouchResult<Scalar, dimension>& felt() const noexcept { return felt_; }

  /// The newest shape and its record. The record has status, model, position, hand, avatar, force, press, pressing and
  /// the counts of ticks. One reader, from any thread: wait-free. Both stay until the next call.
  /// A shape that costs more than its force is that of the first tick after the last call.
  const Picture& picture() noexcept {
    looked_.store(true, std::memory_order_relaxed);
    pictures_.update();
    return pictures_.value();
  }

 private:
  LoopStatus status() const noexcept {
    if (!is_answer(felt_.status)) return LoopStatus::no_answer;
    if (!felt_.pressing) return LoopStatus::free;
    return felt_.status == Status::out_of_range ? LoopStatus::out_of_range : LoopStatus::touching;
  }

  void keep(const Eigen::Vector3d& position, const VectorOf<double, dimension>& hand,
            const Eigen::Vector3d& force) noexcept {
    ServoRecord& r = record_;
    r.status = status();
    r.model = felt_.status;
    r.position = position;
    r.hand = r.avatar = detail::in_scene(hand);
    r.force = force;
    r.press = {static_cast<double>(felt_.press.s), static_cast<double>(felt_.press.d)};
    r.pressing = felt_.pressing;
    ++r.ticks;
    r.contact_ticks += r.pressing;
    r.failed_ticks += r.status == LoopStatus::no_answer;
  }

  void publish() noexcept {
    Picture& draft = pictures_.draft();
    draft.record = record_;
    if constexpr (Drawn<Model>::for_who_looks) {
      if (looked_.exchange(false, std::memory_order_relaxed)) seen_.take(model_.shape());
      draft.take(seen_);
    } else {
      draft.take(model_.shape());
    }
    pictures_.publish();
  }

  const Model& model_;
  Placement placement_;
  Touch<Model> touch_;
  TouchResult<Scalar, dimension> felt_;
  ServoRecord record_;
  Picture seen_;
  std::atomic<bool> looked_{true};
  Exchange<Picture> pictures_;
};

}  // namespace hapbeam
