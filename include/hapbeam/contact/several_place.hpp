// SPDX-License-Identifier: MIT
// One place at which an avatar or a prop of several may touch a beam: where it lies to the beam from tick to tick, what it remembers, and what is
// felt there.
//
// TouchSeveral (touch_several.hpp) has as many as the model has contacts.  An avatar that may touch at k places has k of them.
// Real-time: noexcept, no allocation.
#pragma once

#include <algorithm>

#include <hapbeam/contact/avatar.hpp>
#include <hapbeam/contact/end_contact.hpp>
#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/contact/find_rod_contact.hpp>
#include <hapbeam/contact/push_contact.hpp>
#include <hapbeam/contact/several_result.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

template <class Model>
struct SeveralPlace {
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static constexpr bool planar = dimension == 2;
  using Avatar = hapbeam::Avatar<Scalar, dimension>;

  hapbeam::Obstacle<Scalar, dimension> obstacle;  // as the model is asked, and has answered
  Avatar avatar{};
  bool prop = false;
  bool away = false;  // lifted
  Scalar depth = 0;
  ContactMemory<Scalar, dimension> memory;
  hapbeam::Contact<Scalar, dimension> contact;  // in this tick, and on the shape before, where it is
  bool at_end = false;                          // held by an end
  EndContact<Scalar, dimension> end;
  FrictionState<Scalar, dimension> friction;
  Status status = Status::ok;  // of what keeps it from being an obstacle in this tick

  void take(const Friction& coefficients) noexcept {
    friction.sticking = static_cast<Scalar>(coefficients.sticking);
    friction.sliding = static_cast<Scalar>(coefficients.sliding);
    // It is not looked at while it has none.
    if (coefficients.none()) friction.let_go();
  }
  bool rough() const noexcept { return friction.sticking > 0; }
  /// Whether it is a place of the beam that is held.
  bool fixed() const noexcept { return obstacle.kind != ObstacleKind::round && !at_end; }

  void forget() noexcept {
    memory = {};
    forget_friction();
    if (at_end) obstacle.kind = ObstacleKind::round, at_end = false;
    obstacle.touching = false;
    obstacle.round = {}, obstacle.pushed = {0, Status::ok};
  }

  /// Where it lies to the beam.   @param volumes  () -> those of the present shape   @param again  the place before is of the same avatar
  /// @param several  that one or the place after it is   @return whether the two touch
  template <class Volumes>
  bool look(Model& model, Volumes&& volumes, bool again, bool several) noexcept {
    const bool touched = obstacle.touching, touches = find(model, volumes, again, several);
    // A contact that begins remembers nothing.
    if (!touched || !touches) friction.begin();
    // It may begin within the push, where another one brings the beam to it.
    if (!touched) friction.dissipated = 0;
    return touches;
  }

  /// Whether the contact is where the two touch, as in Touch, and its friction has settled.
  bool found(const Model& model) const noexcept {
    if (!obstacle.touching || fixed() || at_end) return true;
    // A wall is as flat as any.
    const Scalar reach = (std::min)(avatar.radius + model.thickness() / 2, model.shape().length() / 10);
    return friction.settled && obstacle.pushed.miss <= PushContact<Scalar, dimension>::too_far * reach;
  }
  /// @param pushed  whether there was a push in this tick
  void report(bool pushed, TouchPlace<Scalar, dimension>& to) const noexcept {
    to.body = obstacle.body;
    to.touching = obstacle.touching;
    to.status = !obstacle.valid ? status : pushed ? obstacle.pushed.status : Status::ok;
    if (!obstacle.touching) return;
    to.s = obstacle.pushed.s;
    to.depth = depth;
    to.point = obstacle.pushed.point;
    to.normal = obstacle.pushed.normal;
    to.force = -obstacle.pushed.force * obstacle.pushed.normal;
    if (rough()) rub(to);
    if (!at_end) return;
    if (to.status == Status::ok) to.status = Status::out_of_range;
    to.s = contact.s;
    to.point = contact.foot;
    to.normal = contact.normal;
    to.force = -obstacle.pushed.force * end.factor() * contact.normal;
  }

 private:
  void forget_friction() noexcept {
    FrictionState<Scalar, dimension> fresh;
    fresh.sticking = friction.sticking, fresh.sliding = friction.sliding;
    fresh.stiffness = friction.stiffness, fresh.damping = friction.damping;
    friction = fresh;
  }
  void rub(TouchPlace<Scalar, dimension>& to) const noexcept {
    to.friction = friction.on_hand(-obstacle.pushed.force);
    to.force += to.friction;
    to.sliding = friction.slides;
    to.dissipated = friction.dissipated;
  }

  template <class Volumes>
  bool find(Model& model, Volumes&& volumes, bool again, bool several) noexcept {
    status = Status::ok;
    obstacle.valid = !away;
    if (away) return false;
    if (fixed()) return true;
    remember();
    const Scalar thickness = model.thickness(), reach = avatar.radius + thickness / 2;
    if (!find_near(model)) contact = find_contact(avatar, model.shape(), volumes(), thickness, memory);
    depth = contact.depth;
    const bool lost = contact.depth > reach + model.shape().length();
    obstacle.valid = contact.segment >= 0 && !lost;
    at_end = !again && obstacle.valid && end.holds(model, contact, avatar, reach, obstacle.touching);
    obstacle.kind = at_end ? ObstacleKind::stop : ObstacleKind::round;
    if (at_end) {
      obstacle.valid = end.aim(model, contact, avatar, reach, obstacle.touching, obstacle.place);
      depth = contact.depth;
    }
    if (!obstacle.valid) {
      status = contact.touching ? Status::out_of_range : Status::ok;
      obstacle.touching = false;
      return false;
    }
    // One avatar that touches twice is nearest to the beam at one place alone.
    const bool twice = obstacle.touching && several;
    const Scalar s = twice ? obstacle.pushed.s : contact.s;
    if constexpr (planar) obstacle.round = {s, avatar.position, reach, static_cast<Scalar>(contact.side)};
    else obstacle.round = {s, avatar.place(), reach, twice ? obstacle.pushed.normal : contact.normal};
    // A pressed beam follows a hand that draws back; one that has jumped away is met again, if it is, as the beam springs back.
    if (contact.depth < -model.shape().length() / 50) obstacle.touching = false, forget_friction();
    if (!again) obstacle.touching = obstacle.touching || contact.touching;
    return obstacle.touching;
  }
  /// The contact of a touch that goes on, where it was.
  bool find_near(Model& model) noexcept {
    return obstacle.touching && find_contact_near(model, obstacle.pushed.s, avatar, memory, contact);
  }
  /// As Touch: a pressed beam moves with what presses it, which cannot have gone round its end.
  void remember() noexcept {
    memory.touching = obstacle.touching;
    if constexpr (planar) {
      memory.through = obstacle.touching && !(at_end && end.past());
      if (obstacle.touching) memory.side = obstacle.round.side < 0 ? -1 : 1;
    } else if (obstacle.touching) {
      memory.s = obstacle.pushed.s;
      memory.normal = at_end ? contact.normal : obstacle.pushed.normal;
    }
  }
};

}  // namespace hapbeam::detail
