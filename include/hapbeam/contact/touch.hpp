// From the hand's position to the force on the hand: contact, press and unilateral law, one call a tick.
//
// Knows the ForceModel contract and no particular model.  Each tick finds the contact on the shape of the
// last press and asks the model for the displacement that would just end the penetration: along the normal where the
// model can be pushed along any direction (push_contact.hpp), across the beam where it cannot (press_contact.hpp).  The
// force acts along the normal and never pulls.
// Allocates and throws in its constructor only.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/contact/push_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What one tick says.
template <typename Scalar>
struct TouchResult {
  Vector2<Scalar> force = Vector2<Scalar>::Zero();  ///< [N] on the hand, (along x, along w); always finite
  Status status = Status::ok;  ///< of the press; invalid_request for a position that is not finite
  bool pressing = false;       ///< the hand holds the beam; read this, not contact.touching
  Contact<Scalar>
      contact;  ///< on the shape before this tick's press; segment -1: out of reach, or not finite
  Press<Scalar> press{0, 0};  ///< what was asked of the model; zero where nothing was
};

/// One avatar on one beam.  Between ticks the model may be read by others but pressed by nobody else.
template <typename Model>
class Touch {
  static_assert(
      is_force_model<Model>,
      "Touch<Model>: Model must offer press(const Press<Scalar>&), shape(), range(), thickness() and reset() "
      "as listed in hapbeam/force_model.hpp, each noexcept");

 public:
  using Scalar = typename Model::Scalar;

  /// @param model   kept by reference   @param avatar_radius  [m]
  /// Allocates.   @throws std::invalid_argument unless avatar_radius is 0 to most_radius lengths of the beam
  Touch(Model& model, Scalar avatar_radius)
      : model_(model), avatar_radius_(avatar_radius), volumes_(model.shape().segments()) {
    const double radius = static_cast<double>(avatar_radius);
    const double largest = most_radius * static_cast<double>(model.shape().length());
    if (!(radius >= 0 && radius <= largest)) {
      char text[128];
      std::snprintf(text, sizeof text,
                    "avatar_radius = %g m: must be 0 to %g m, a thousand lengths of the beam", radius,
                    largest);
      throw std::invalid_argument(text);
    }
    reset();
  }

  /// Lets go of the beam and forgets where the hand was.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    memory_ = {};
    model_.reset();
    falling_ = false;
    let_go();
  }

  /// One tick.
  /// @param position  [m] centre of the avatar
  /// Real-time: noexcept, no allocation, bounded: at most one press or four pushes, which share the work of one, and one
  /// release; nothing without contact but for a beam that falls to rest.  With FemModel that is 96 linear solves, and two looks
  /// more for each of the five: with 64 elements at 0.1 µs an element and solve 0.68 ms.
  [[nodiscard]] TouchResult<Scalar> tick(const Vector2<Scalar>& position) noexcept {
    TouchResult<Scalar> result;
    Contact<Scalar>& contact = result.contact;
    const Avatar<Scalar> avatar{position, avatar_radius_};
    if (!pressing_ && !falling_ && out_of_reach(avatar, volumes_, model_.thickness(), memory_)) return result;
    // A pressed beam moves with the hand, which cannot have gone round its end.  Only a beam that has stopped at the
    // end of its range can be passed, and that must not turn the press into one from the other side.
    if (pressing_) memory_.touching = memory_.through = true, memory_.side = side_;
    contact = find_contact(avatar, model_.shape(), volumes_, model_.thickness(), memory_);
    if (contact.segment < 0) {
      result.status = Status::invalid_request;
      result.pressing = pressing_;
      return result;
    }
    // A pressed beam follows a hand that draws back, until it would have to pull.
    if (!contact.touching && !pressing_) {
      if (falling_) release(result);
      return result;
    }

    if (!pressing_) side_ = contact.side, unanswered_ = 0, holder_.begin(contact);
    const Scalar reach = avatar_radius_ + model_.thickness() / 2;
    const detail::Held<Scalar> held = holder_.hold(model_, contact, position, reach, pressing_, result.press);
    result.status = held.status;
    if (is_answer(held.status)) unanswered_ = 0;
    else if (!(held.force > 0)) ++unanswered_;
    if (held.hold == detail::Hold::released) {
      release(result);
      return result;
    }
    if (held.hold == detail::Hold::lost || unanswered_ > patience) {
      lose(avatar, result);
      return result;
    }
    volumes_.refit(model_.shape());
    pressing_ = true;
    falling_ = false;
    result.pressing = true;
    if (std::isfinite(held.force)) result.force = contact.normal * held.force;
    else result.status = Status::non_finite;
    return result;
  }

  [[nodiscard]] bool pressing() const noexcept { return pressing_; }

  /// Whether the beam as it lies now would be touched on the straight way from the last tick's position to this one.
  /// Real-time: noexcept, no allocation, bounded; no press.
  [[nodiscard]] bool meets(const Vector2<Scalar>& position) const noexcept {
    ContactMemory<Scalar> memory = memory_;
    return find_contact({position, avatar_radius_}, model_.shape(), volumes_, model_.thickness(), memory)
        .touching;
  }

  /// Of the avatar's radius, in lengths of the beam.  Seen from the beam a larger disc is a plane, and in `float` the depth
  /// of a bend is lost in the round-off of its radius.
  static constexpr double most_radius = 1000;
  /// Ticks since the last answer in which the model may have no force either.  After them the touch is over.
  static constexpr int patience = 20;

 private:
  using Holder =
      std::conditional_t<takes_push<Model>, detail::PushContact<Scalar>, detail::PressContact<Scalar>>;

  /// The beam springs back, or falls to where it rests.
  void release(TouchResult<Scalar>& result) noexcept {
    if constexpr (takes_push<Model>) {
      result.status = model_.release();
      falling_ = result.status == Status::iteration_limit;
      // Nobody holds it: that no force is felt is the whole answer, wherever the beam is on its way.
      if (falling_) result.status = Status::ok;
    } else {
      model_.reset();
    }
    let_go();
  }
  /// The beam is let go.  If it comes to rest beneath the avatar it has not slipped off: the touch goes on from there.
  void lose(const Avatar<Scalar>& avatar, TouchResult<Scalar>& result) noexcept {
    release(result);
    ContactMemory<Scalar> nothing;
    const Contact<Scalar> contact =
        find_contact(avatar, model_.shape(), volumes_, model_.thickness(), nothing);
    if (!contact.touching || contact.side != side_) return;
    holder_.begin(contact);
    falling_ = false;
    pressing_ = result.pressing = true;
    result.status = Status::iteration_limit;
  }
  /// What the contact remembers belongs to the touch.  A beam that has sprung back is a new beam: whoever stands behind it
  /// is on its other side.
  void let_go() noexcept {
    volumes_.refit(model_.shape());
    memory_.touching = memory_.through = false;
    pressing_ = false;
  }

  Model& model_;
  Scalar avatar_radius_;
  BoundingVolumes<Scalar> volumes_;
  ContactMemory<Scalar> memory_;
  Holder holder_;
  bool pressing_ = false;
  bool falling_ = false;  // let go, and not yet at rest
  int side_ = 1;          // of the press, as Contact::side
  int unanswered_ = 0;    // ticks without a force since the last answer
};

}  // namespace hapbeam
