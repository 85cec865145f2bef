// SPDX-License-Identifier: MIT
// The force on the hand of a beam with mass, which goes on moving whether it is touched or not.
//
// A tick is a step of the model, in which hand and beam are coupled.  The hand is sought beside the beam, as by Touch: the side on which it
// is stays while they touch, so that neither is tunnelled through.  Past an end it touches what is round there, or nothing.
// Where the model has no answer it stops: the force is zero, and the next step begins from there at rest.  If that has none either, the beam
// goes on without the hand.
// Allocates and throws in its constructor only.
#pragma once

#include <type_traits>

#include <hapbeam/contact/touch.hpp>

namespace hapbeam {

/// One avatar on one beam with mass.  Between ticks others may read the model, but only this object steps it.
template <typename Model>
class Touch<Model, std::enable_if_t<has_mass<Model>>> {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  using Vector = VectorOf<Scalar, dimension>;
  using Result = TouchResult<Scalar, dimension>;

  /// @param model  kept by reference   @param avatar_radius  [m]   @param friction  none unless it is given
  /// Allocates.   @throws std::invalid_argument unless avatar_radius is 0 to a thousand lengths of the beam, and the friction makes sense
  Touch(Model& model, Scalar avatar_radius, const Friction& friction = {})
      : model_(model), avatar_radius_(avatar_radius), volumes_(model.shape().segments()) {
    detail::check_radius("avatar_radius", avatar_radius, model.shape().length());
    friction.check();
    friction_.take(friction);
    reset();
  }

  /// Stops the beam, at rest, and discards the place of the hand.
  void reset() noexcept {
    model_.reset();
    memory_ = {};
    friction_.begin();
    off_.setZero();
    pressing_ = false;
    rest_ = model_.energy().sum();
  }

  /// One tick.
  /// @param hand [m] centre of the avatar without the beam   @param dt [s] since the tick before; the model may go on by less
  /// @param stiffness K [N/m]   @param damping B [N·s/m], of the coupling
  /// @param shaft [m] in space, from the tip of a capsule's axis, which is at the hand, to its other end
  /// Real-time: noexcept, no allocation, bounded as the step.
  [[nodiscard]] Result tick(const Vector& hand, Scalar dt, Scalar stiffness, Scalar damping,
                            const Vector& shaft = Vector::Zero()) noexcept {
    Result result;
    const Scalar reach = avatar_radius_ + model_.thickness() / 2;
    volumes_.outdate();
    // One that holds the beam cannot have gone round its end.
    memory_.touching = memory_.through = pressing_;
    memory_.side = side_;
    const auto avatar = detail::avatar_at(hand, avatar_radius_, shaft);
    result.contact =
        find_contact(avatar, model_.shape(), volumes_.fitted(model_.shape()), model_.thickness(), memory_);
    if (result.contact.segment < 0) {
      result.status = Status::invalid_request;
      result.pressing = pressing_;
      return result;
    }
    side_ = result.contact.side;
    if (!pressing_) friction_.dissipated = 0;
    Coupled<Scalar, dimension> coupled{};
    auto there = result.contact;
    if (pressing_) there.normal = normal_;
    coupled.hand = detail::LastingContact<Model>::round(avatar, there.s, reach, there);
    coupled.stiffness = stiffness, coupled.damping = damping;
    if (rough()) coupled.friction = &friction_;
    const auto pushed = model_.step(dt, coupled);
    result.status = pushed.status;
    // Of one that is stopped while it is pressed the side is known still.
    if (is_answer(pushed.status)) pressing_ = pushed.force < 0;
    result.pressing = pressing_;
    off_.setZero();
    if (!(pushed.force < 0)) return result;
    result.force = -pushed.force * pushed.normal;
    if (rough()) {
      friction_.rub(-pushed.force, result);
      result.dissipated = friction_.dissipated;
    }
    result.press = {pushed.s, dimension == 2 ? pushed.point.y() : pushed.normal.dot(pushed.point)};
    normal_ = pushed.normal;
    off_ = pushed.point + reach * pushed.normal - hand;
    return result;
  }

  [[nodiscard]] bool pressing() const noexcept { return pressing_; }
  /// Whether there is friction.
  [[nodiscard]] bool rough() const noexcept { return friction_.rough(); }
  /// From the hand to the avatar [m].
  const Vector& off() const noexcept { return off_; }
  /// What the beam has more than at rest [J].
  Scalar stored() const noexcept { return model_.energy().sum() - rest_; }

 private:
  Model& model_;
  Scalar avatar_radius_;
  BoundingVolumes<Scalar, dimension> volumes_;
  ContactMemory<Scalar, dimension> memory_;
  FrictionState<Scalar, dimension> friction_;
  Vector off_ = Vector::Zero(), normal_ = Vector::Zero();  // the last: out of the beam, while it is pressed
  Scalar rest_ = 0;                                        // energy at rest [J]
  int side_ = 1;                                           // from which it is touched
  bool pressing_ = false;
};

}  // namespace hapbeam
