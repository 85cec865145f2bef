// SPDX-License-Identifier: MIT
// The force on the hand for a position of the hand: contact, press and unilateral law, one call a tick, in a plane or
// in space.
//
// It depends on the ForceModel contract alone. Each tick finds the contact on the shape of the last press. It then
// prescribes the displacement that removes the penetration. A model that can be pushed along any direction is laid on the avatar, a
// circle or in space a capsule: its centreline goes to the distance `reach` from the avatar's centre or axis, and the model returns the
// point of contact. Any other is pressed across the beam, and so is every beam past an end that holds w, and a planar one beside it
// (place_contact.hpp). The force acts along the normal and never pulls.
// A model with mass has another Touch (touch_in_motion.hpp).
// Allocates and throws in its constructor only.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/lasting_contact.hpp>
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
/// @tparam Enabled  for those of other models
template <typename Model, typename Enabled = void>
class Touch {
  static_assert(
      is_force_model<Model>,
      "Touch<Model>: Model must offer press(const Press<Scalar>&), shape(), range(), thickness() and reset() "
      "as listed in hapbeam/force_model.hpp, each noexcept");

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static_assert(dimension == 2 || takes_push<Model>,
                "Touch<Model>: a Model in space must offer push(Obstacle<Scalar, 3>*, int) and release(), "
                "each noexcept");
  using Vector = VectorOf<Scalar, dimension>;
  using Result = TouchResult<Scalar, dimension>;

  /// @param model   kept by reference   @param avatar_radius  [m]   @param friction  none unless it is given
  /// Allocates.   @throws std::invalid_argument unless avatar_radius is 0 to a thousand lengths of the beam, and the
  /// friction one that the model offers
  Touch(Model& model, Scalar avatar_radius, const Friction& friction = {})
      : model_(model), avatar_radius_(avatar_radius), volumes_(model.shape().segments()) {
    detail::check_radius("avatar_radius", avatar_radius, model.shape().length());
    friction.check();
    if (!takes_push<Model> && !friction.none())
      detail::reject("friction", friction.sticking, "",
                     "0 for a model that is pressed across the beam: see docs/contact.md");
    at_.friction.take(friction);
    reset();
  }

  /// Releases the beam and discards the place of the hand.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    at_.memory = {};
    at_.mode = Mode::apart;
    falling_ = false;
    model_.reset();
    volumes_.refit(model_.shape());
  }

  /// One tick.
  /// @param position  [m] centre of the avatar   @param shaft  [m] of a capsule in space, from the tip of its axis, which is there, to its other end
  /// Real-time: noexcept, no allocation, bounded: at most one press or push and one release; nothing without contact but for a
  /// beam that falls to rest.  With FemModel that is 96 linear solves, and two looks more for each of the four meshes of a push and
  /// for the release: with 64 elements at 0.1 µs an element and solve 0.68 ms.
  [[nodiscard]] Result tick(const Vector& position) noexcept { return tick(position, Vector::Zero()); }
  [[nodiscard]] Result tick(const Vector& position, const Vector& shaft) noexcept;

  [[nodiscard]] bool pressing() const noexcept { return at_.mode > Mode::inside; }
  /// Whether there is friction.
  [[nodiscard]] bool rough() const noexcept { return takes_push<Model> && at_.friction.rough(); }
  /// Where there is friction, the avatar's skin yields along the surface: a hand that cannot render what is stiffer.  From then on.
  /// @param stiffness  [N/m] positive   @param damping  [N/m] of a damper, N·s/m over the time of a tick
  void soften(Scalar stiffness, Scalar damping) noexcept { at_.friction.soften(stiffness, damping); }
  /// Ends the touch: the beam is untouched, and the next contact is a new one.
  [[nodiscard]] bool resting() const noexcept { return at_.mode == Mode::apart && !falling_; }

  /// The contact of the beam as it lies now with the avatar, gone straight to a place from that of the last tick.
  /// @param position, shaft [m] as of tick()   Real-time: noexcept, no allocation, bounded; no press.
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(const Vector& position) noexcept {
    return contact_at(position, Vector::Zero());
  }
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(const Vector& position,
                                                               const Vector& shaft) noexcept {
    if (at_.mode == Mode::inside) return {};
    auto memory = at_.memory;
    return find_contact(detail::avatar_at(position, avatar_radius_, shaft), model_.shape(), volumes(),
                        model_.thickness(), memory);
  }

  /// Ticks since the last answer in which the model may have no force either.  After them the touch is over.
  static constexpr int patience = 20;

 private:
  static constexpr bool planar = dimension == 2;
  using Avatar = hapbeam::Avatar<Scalar, dimension>;
  using Contact = hapbeam::Contact<Scalar, dimension>;
  using Mode = detail::Mode;
  using Hold = detail::Hold;

  /// What friction has taken is the touch's, wherever the contact has gone since.
  void press_on(Result& result) const noexcept {
    result.pressing = true;
    if (rough()) result.dissipated = at_.friction.dissipated;
  }

  /// Fitted to the present shape.  A lasting touch seldom requires them.
  const BoundingVolumes<Scalar, dimension>& volumes() noexcept { return volumes_.fitted(model_.shape()); }

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
    volumes_.refit(model_.shape());
    at_.memory.touching = at_.memory.through = false;
    if (pressing()) at_.mode = Mode::apart;
  }
  /// What the contact remembers belongs to the touch.  A beam that has sprung back is a new beam: whoever stands behind it
  /// is on its other side, and whoever is inside it has to leave before touching it.
  /// @param pressed  in the tick before
  void let_go(const Avatar& avatar, Hold why, bool pressed, Result& result) noexcept {
    const Mode before = at_.mode;
    const Status answer = result.status;
    release(result);
    ContactMemory<Scalar, dimension> nothing;
    const Contact contact = find_contact(avatar, model_.shape(), volumes(), model_.thickness(), nothing);
    // On its way, or off the avatar though that did not draw back: the beam has jumped.
    if (pressed && falling_) result.status = Status::iteration_limit;
    else if (pressed && result.status == Status::ok && (why != Hold::released || answer == Status::snapped))
      result.status = Status::snapped;
    if (!contact.touching) return;
    const Range<Scalar> range = model_.range();
    const bool beside = (std::min)(contact.s - range.left_support, range.right_support - contact.s) <
                        2 * avatar.radius + model_.thickness();
    if (why == Hold::slipped || (contact.side != at_.side && beside)) {
      at_.mode = Mode::inside;
      return;
    }
    // A support that is no longer touched says nothing of the beam beside it, which lies elsewhere once it has sprung back.
    if (why == Hold::released && before != Mode::support) return;
    // Lost, and at rest beneath the avatar: it has not slipped off, and the touch goes on from there.
    at_.friction.begin();
    falling_ = false;
    at_.mode = before == Mode::pushed || !planar ? Mode::pushed : Mode::across;
    press_on(result);
    result.status = Status::iteration_limit;
  }

  Model& model_;
  Scalar avatar_radius_;
  BoundingVolumes<Scalar, dimension> volumes_;
  detail::LastingContact<Model> at_;
  bool falling_ = false;  // let go, and not yet at rest
  bool in_range_ =
      false;            // the last contact was: beyond its range a shape of moderate rotation may turn back
  int unanswered_ = 0;  // ticks without a force since the last answer
};

// Outside of the class: only so does "extern template class Touch<…>;" keep a compiler from it.
template <typename Model, typename Enabled>
auto Touch<Model, Enabled>::tick(const Vector& position, const Vector& shaft) noexcept -> Result {
  const Avatar avatar = detail::avatar_at(position, avatar_radius_, shaft);
  Result result;
  Contact& contact = result.contact;
  if (!pressing() && !falling_ && out_of_reach(avatar, volumes_, model_.thickness(), at_.memory))
    return result;
  if (at_.mode == Mode::inside) at_.memory = {};
  contact = at_.find(model_, avatar, pressing(), pressing() && (!planar || in_range_),
                     [this]() -> decltype(auto) { return volumes(); });
  if (contact.segment < 0) {
    result.status = Status::invalid_request;
    if (pressing()) press_on(result);
    return result;
  }
  // A pressed beam follows a hand that draws back, until it would have to pull.
  if (at_.mode == Mode::inside && !contact.touching) at_.mode = Mode::apart;
  if (at_.mode == Mode::inside || (!pressing() && !contact.touching)) {
    if (falling_) release(result);
    if (at_.mode == Mode::inside) result.status = Status::out_of_range;
    return result;
  }

  const bool pressed = pressing();
  if (!pressed) {
    unanswered_ = 0;
    at_.place.begin(model_);
    at_.friction.dissipated = 0;
  }
  const detail::Held<Scalar> held = at_.hold(model_, contact, avatar, result.press);
  result.status = held.status;
  if (takes_push<Model> && at_.mode == Mode::across && held.status == Status::ok)
    result.status = Status::out_of_range;
  if (is_answer(held.status)) unanswered_ = 0;
  else if (!(held.force > 0)) ++unanswered_;
  if (held.hold != Hold::pressing || unanswered_ > patience) {
    let_go(avatar, held.hold, pressed, result);
    return result;
  }
  falling_ = false;
  if (at_.mode == Mode::support && at_.place.slid(contact, model_, at_.still)) spring_back();
  volumes_.outdate();
  at_.know(contact.s, contact.normal);
  in_range_ = held.status == Status::ok;
  press_on(result);
  if (std::isfinite(held.force)) result.force = contact.normal * held.force;
  else result.status = Status::non_finite;
  if (rough() && at_.mode == Mode::pushed && std::isfinite(held.force)) at_.friction.rub(held.force, result);
  return result;
}

}  // namespace hapbeam
