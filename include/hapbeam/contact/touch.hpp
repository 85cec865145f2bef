// SPDX-License-Identifier: MIT
// The force on the hand for a position of the hand: contact, press and unilateral law, one call a tick, in a plane or
// in space.
//
// It depends on the ForceModel contract alone. Each tick finds the contact on the shape of the last press. It then
// prescribes the displacement that removes the penetration: along the normal if the model can be pushed along any
// direction (push_contact.hpp), else across the beam (press_contact.hpp). Past an end that holds w there is no press
// (support_contact.hpp). The force acts along the normal and never pulls.
// Allocates and throws in its constructor only.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/contact/find_rod_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/contact/push_contact.hpp>
#include <hapbeam/contact/support_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam {

/// The result of a tick.
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D = 2>
struct TouchResult {
  /// [N] on the hand, in a plane (along x, along w); always finite
  VectorOf<Scalar, D> force = VectorOf<Scalar, D>::Zero();
  Status status = Status::ok;  ///< of the press; invalid_request for a position that is not finite
  bool pressing = false;       ///< the hand holds the beam; read this, not contact.touching
  bool sliding = false;        ///< with friction: the contact slides, else it sticks
  Scalar dissipated = 0;       ///< [J] by friction, since the touch began
  VectorOf<Scalar, D> friction = VectorOf<Scalar, D>::Zero();  ///< [N] what of the force is tangential
  Contact<Scalar, D>
      contact;  ///< on the shape before this tick's press; segment -1: out of reach, or not finite
  Press<Scalar> press{0,
                      0};  ///< what was asked of the model, in space along the normal; zero where nothing was
};

/// One avatar on one beam.  Between ticks others may read the model, but only this object presses it.
template <typename Model>
class Touch {
  static_assert(
      is_force_model<Model>,
      "Touch<Model>: Model must offer press(const Press<Scalar>&), shape(), range(), thickness() and reset() "
      "as listed in hapbeam/force_model.hpp, each noexcept");

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static_assert(
      dimension == 2 || takes_push<Model>,
      "Touch<Model>: a Model in space must offer push(const Capsule<Scalar>&) and release(), each noexcept");
  using Vector = VectorOf<Scalar, dimension>;
  using Result = TouchResult<Scalar, dimension>;

  /// @param model   kept by reference   @param avatar_radius  [m]   @param friction  none unless it is given
  /// Allocates.   @throws std::invalid_argument unless avatar_radius is 0 to most_radius lengths of the beam, and the
  /// friction one that the model offers
  Touch(Model& model, Scalar avatar_radius, const Friction& friction = {})
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
    friction.check();
    if (!takes_friction<Model> && !friction.none())
      detail::reject("friction", friction.sticking, "",
                     "0 for a model that is pressed across the beam: see docs/contact.md");
    pusher_.friction_state().sticking = static_cast<Scalar>(friction.sticking);
    pusher_.friction_state().sliding = static_cast<Scalar>(friction.sliding);
    reset();
  }

  /// Releases the beam and discards the place of the hand.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    memory_ = {};
    model_.reset();
    refit();
    pressing_ = falling_ = on_support_ = inside_ = false;
  }

  /// One tick.
  /// @param position  [m] centre of the avatar
  /// Real-time: noexcept, no allocation, bounded: at most one press or push and one release; nothing without contact but for a
  /// beam that falls to rest.  With FemModel that is 96 linear solves, and two looks more for each of the four meshes of a push and
  /// for the release: with 64 elements at 0.1 µs an element and solve 0.68 ms.
  [[nodiscard]] Result tick(const Vector& position) noexcept {
    return tick(Avatar{position, avatar_radius_});
  }
  /// The same in space, with a capsule.  @param position  [m] of the tip of its axis   @param shaft  [m] from there to the other end
  template <int D = dimension, std::enable_if_t<D == 3, int> = 0>
  [[nodiscard]] Result tick(const Vector& position, const Vector& shaft) noexcept {
    return tick(Avatar{position, avatar_radius_, shaft});
  }

  [[nodiscard]] bool pressing() const noexcept { return pressing_; }
  /// Whether there is friction.
  [[nodiscard]] bool rough() const noexcept {
    return takes_friction<Model> && pusher_.friction_state().sticking > 0;
  }
  /// Where there is friction, the avatar's skin yields along the surface: a hand that cannot render what is stiffer.  From then on.
  /// @param stiffness  [N/m] positive   @param damping  [N/m] of a damper, N·s/m over the time of a tick
  void soften(Scalar stiffness, Scalar damping) noexcept {
    pusher_.friction_state().stiffness = stiffness;
    pusher_.friction_state().damping = damping;
  }
  /// Ends the touch: the beam is untouched, and the next contact is a new one.
  [[nodiscard]] bool resting() const noexcept { return !pressing_ && !falling_ && !inside_; }

  /// The contact of the beam as it lies now with the avatar, gone straight to a place from that of the last tick.
  /// @param position [m]   Real-time: noexcept, no allocation, bounded; no press.
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(const Vector& position) noexcept {
    return contact_at(Avatar{position, avatar_radius_});
  }
  /// The same of a capsule, as tick().
  template <int D = dimension, std::enable_if_t<D == 3, int> = 0>
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(const Vector& position,
                                                               const Vector& shaft) noexcept {
    return contact_at(Avatar{position, avatar_radius_, shaft});
  }

  /// Of the avatar's radius, in lengths of the beam.  Seen from the beam a larger disc is a plane, and in `float` the depth
  /// of a bend is lost in the round-off of its radius.
  static constexpr double most_radius = 1000;
  /// Ticks since the last answer in which the model may have no force either.  After them the touch is over.
  static constexpr int patience = 20;

 private:
  static constexpr bool planar = dimension == 2;
  using Avatar = hapbeam::Avatar<Scalar, dimension>;
  using Contact = hapbeam::Contact<Scalar, dimension>;
  using Memory = ContactMemory<Scalar, dimension>;
  using Volumes = BoundingVolumes<Scalar, dimension>;

  Result tick(const Avatar& avatar) noexcept;

  Contact contact_at(const Avatar& avatar) noexcept {
    if (inside_) return {};
    auto memory = memory_;
    return find_contact(avatar, model_.shape(), volumes(), model_.thickness(), memory);
  }
  /// What friction has taken is the touch's, wherever the contact has gone since.
  void press_on(Result& result) noexcept {
    pressing_ = result.pressing = true;
    if (rough()) result.dissipated = pusher_.friction_state().dissipated;
  }
  void feel_friction(Result& result, Scalar normal_force) const noexcept {
    if (across_ || on_support_ || !std::isfinite(normal_force)) return;
    result.friction = pusher_.friction_state().on_hand(normal_force);
    result.force += result.friction;
    result.sliding = pusher_.friction_state().slides;
  }

  /// Fitted to the present shape.  A lasting touch seldom requires them.
  const Volumes& volumes() noexcept {
    if (moved_) refit();
    return volumes_;
  }
  void refit() noexcept {
    volumes_.refit(model_.shape());
    moved_ = false;
  }

  /// The contact of a touch that goes on, where it was.
  bool find_near(const Avatar& avatar, Contact& contact) noexcept {
    return pressing_ && (!planar || in_range_) &&
           detail::find_contact_near(model_, s_, avatar, memory_, contact);
  }

  detail::Held<Scalar> hold(Contact& contact, const Avatar& avatar, Scalar reach,
                            Press<Scalar>& asked) noexcept {
    const bool was_on_support = on_support_, was_across = across_;
    if constexpr (planar) on_support_ = support_.past(contact, model_);
    else on_support_ = support_.past(contact, model_, avatar, reach);
    if (on_support_) {
      side_ = contact.side;
      return support_.hold(model_, contact, asked);
    }
    // Beside a rigid end, which no push moves, the beam is pressed across, and that ends with its range.
    if constexpr (planar)
      across_ = !takes_push<Model> || support_.over(model_, avatar, reach) ||
                (pressing_ && was_across && contact.depth > reach);
    else across_ = false;
    if (!pressing_ || was_on_support) side_ = contact.side;
    if (!pressing_ || was_on_support || across_ != was_across) begin(contact);
    if constexpr (takes_push<Model>)
      if (!across_) return pusher_.hold(model_, contact, avatar, reach, asked);
    if constexpr (planar) return presser_.hold(model_, contact, avatar.position, reach, pressing_, asked);
    else return {detail::Hold::lost, 0, Status::invalid_request};
  }
  void begin(const Contact& contact) noexcept {
    if constexpr (planar) presser_.begin(contact);
    pusher_.begin(contact);
  }
  /// A pressed beam moves with the hand, which cannot have gone round its end.  Only a beam that has stopped at the
  /// end of its range can be passed, and that must not turn the press into one from the other side.  A rigid end is gone round.
  void remember() noexcept {
    memory_.touching = true;
    if constexpr (planar) memory_.through = !on_support_, memory_.side = side_;
  }
  void forget_touch() noexcept {
    memory_.touching = false;
    if constexpr (planar) memory_.through = false;
  }

  /// The beam springs back, or falls to where it rests.
  Status spring_back() noexcept {
    if constexpr (takes_push<Model>) {
      const Status status = model_.release();
      falling_ = status == Status::iteration_limit;
      return status;
    } else {
      model_.reset();
      return Status::ok;
    }
  }
  void release(Result& result) noexcept {
    const Status status = spring_back();
    // Nobody holds it: that no force is felt is the whole answer, wherever the beam is on its way.
    if (takes_push<Model>) result.status = falling_ ? Status::ok : status;
    refit();
    pressing_ = on_support_ = false;
    forget_touch();
  }
  /// What the contact remembers belongs to the touch.  A beam that has sprung back is a new beam: whoever stands behind it
  /// is on its other side, and whoever is inside it has to leave before touching it.
  void let_go(const Avatar& avatar, detail::Hold why, Result& result) noexcept {
    // A support that is no longer touched says nothing of the beam beside it, which lies elsewhere once it has sprung back.
    const bool off_beam = why == detail::Hold::released && !on_support_;
    release(result);
    Memory nothing;
    const Contact contact = find_contact(avatar, model_.shape(), volumes(), model_.thickness(), nothing);
    const Scalar reach = avatar_radius_ + model_.thickness() / 2;
    inside_ = contact.touching && (why == detail::Hold::slipped ||
                                   (contact.side != side_ && support_.beside(contact, model_, 2 * reach)));
    if (!contact.touching || inside_ || off_beam) return;
    // Lost, and at rest beneath the avatar: it has not slipped off, and the touch goes on from there.
    begin(contact);
    falling_ = false;
    press_on(result);
    result.status = Status::iteration_limit;
  }

  Model& model_;
  Scalar avatar_radius_;
  Volumes volumes_;
  Memory memory_;
  detail::PressContact<Scalar> presser_;
  detail::PushContact<Scalar, dimension> pusher_;
  detail::SupportContact<Scalar, dimension> support_;
  Scalar s_ = 0;           // of the last contact [m]
  bool in_range_ = false;  // there: beyond its range a shape of moderate rotation may turn back
  bool moved_ = false;     // since the volumes were fitted
  bool pressing_ = false;
  bool falling_ = false;     // let go, and not yet at rest
  bool inside_ = false;      // let go, and not yet clear of the beam
  bool on_support_ = false;  // pressing, past an end that holds w
  bool across_ = true;       // pressing, by presser_
  int side_ = 1;             // of the press, as Contact::side
  int unanswered_ = 0;       // ticks without a force since the last answer
};

// Outside of the class: only so does "extern template class Touch<…>;" keep a compiler from it.
template <typename Model>
auto Touch<Model>::tick(const Avatar& avatar) noexcept -> Result {
  Result result;
  Contact& contact = result.contact;
  if (!pressing_ && !falling_ && out_of_reach(avatar, volumes_, model_.thickness(), memory_)) return result;
  if (pressing_) remember();
  if (inside_) memory_ = {};
  if (!find_near(avatar, contact))
    contact = find_contact(avatar, model_.shape(), volumes(), model_.thickness(), memory_);
  if (contact.segment < 0) {
    result.status = Status::invalid_request;
    if (pressing_) press_on(result);
    return result;
  }
  // A pressed beam follows a hand that draws back, until it would have to pull.
  inside_ = inside_ && contact.touching;
  if (!pressing_ && (inside_ || !contact.touching)) {
    if (falling_) release(result);
    if (inside_) result.status = Status::out_of_range;
    return result;
  }

  const Scalar reach = avatar_radius_ + model_.thickness() / 2;
  if (!pressing_) {
    unanswered_ = 0, across_ = true, support_.begin(model_);
    pusher_.friction_state().dissipated = 0;
  }
  const detail::Held<Scalar> held = hold(contact, avatar, reach, result.press);
  result.status = held.status;
  if (takes_push<Model> && planar && across_ && held.status == Status::ok)
    result.status = Status::out_of_range;
  if (is_answer(held.status)) unanswered_ = 0;
  else if (!(held.force > 0)) ++unanswered_;
  if (held.hold != detail::Hold::pressing || unanswered_ > patience) {
    let_go(avatar, held.hold, result);
    return result;
  }
  falling_ = false;
  if (on_support_ && support_.slid(contact, model_)) spring_back();
  moved_ = true;
  s_ = contact.s;
  if constexpr (!planar) memory_.s = contact.s, memory_.normal = contact.normal;
  in_range_ = held.status == Status::ok;
  press_on(result);
  if (std::isfinite(held.force)) result.force = contact.normal * held.force;
  else result.status = Status::non_finite;
  if (rough()) feel_friction(result, held.force);
  return result;
}

}  // namespace hapbeam
