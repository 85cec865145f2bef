// SPDX-License-Identifier: MIT
// One place at which an avatar or a prop of several may touch a beam, and what TouchSeveral says of it.
//
// TouchSeveral (touch_several.hpp) has as many as the model has contacts.  An avatar that may touch at k places has k of them.
// Real-time: noexcept, no allocation.
#pragma once

#include <algorithm>
#include <array>

#include <hapbeam/contact/lasting_contact.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What becomes of one possible contact in a tick.
template <typename Scalar, int D = 2>
struct TouchPlace {
  int body = 0;           ///< avatars in their order, then props in theirs
  bool touching = false;  ///< all else is zero where they do not touch
  Status status = Status::ok;
  Scalar s = 0;      ///< [m] arc position
  Scalar depth = 0;  ///< [m] of the body in the beam as it lay before this tick; negative: the gap
  VectorOf<Scalar, D> point = VectorOf<Scalar, D>::Zero();     ///< [m] of the centreline
  VectorOf<Scalar, D> normal = VectorOf<Scalar, D>::Zero();    ///< unit, out of the beam to the body
  VectorOf<Scalar, D> force = VectorOf<Scalar, D>::Zero();     ///< [N] on the body; always finite
  VectorOf<Scalar, D> friction = VectorOf<Scalar, D>::Zero();  ///< [N] what of the force is tangential
  bool sliding = false;   ///< with friction: the contact slides, else it sticks
  Scalar dissipated = 0;  ///< [J] by friction, since this contact began; anew where the touch is
};

/// What one tick says.
/// @tparam Contacts  most of them
template <typename Scalar, int D, int Contacts>
struct TouchSeveralResult {
  using Place = TouchPlace<Scalar, D>;

  /// Of the equilibrium.  Negative: all places are those of the last answer; invalid_request, for a position that is not
  /// finite: they are zero.
  Status status = Status::ok;
  int size = 0;  ///< possible contacts
  std::array<Place, Contacts> places;

  const Place* begin() const noexcept { return places.data(); }
  const Place* end() const noexcept { return places.data() + size; }
  /// On an avatar or a prop [N].
  VectorOf<Scalar, D> force(int body) const noexcept { return sum(body, &Place::force); }
  /// What of it is tangential [N].
  VectorOf<Scalar, D> friction(int body) const noexcept { return sum(body, &Place::friction); }
  bool touching(int body) const noexcept {
    return std::any_of(begin(), end(),
                       [body](const Place& place) { return place.body == body && place.touching; });
  }

 private:
  VectorOf<Scalar, D> sum(int body, VectorOf<Scalar, D> Place::*of) const noexcept {
    VectorOf<Scalar, D> all = VectorOf<Scalar, D>::Zero();
    for (const Place& place : *this)
      if (place.body == body) all += place.*of;
    return all;
  }
};

namespace detail {

template <class Model>
struct SeveralPlace {
  using Lasting = LastingContact<Model>;
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  using Vector = VectorOf<Scalar, dimension>;
  /// Of the length.  A touch bends the beam beside the end, which may slide: farther than that others have drawn it.
  static constexpr Scalar far_away = Scalar(1e-3);

  hapbeam::Avatar<Scalar, dimension> avatar{};
  enum { hand, lifted, prop } who = hand;
  bool again = false;    // the place before is of the same body
  bool several = false;  // that one or the place after it is
  Lasting at;
  hapbeam::Contact<Scalar, dimension> contact;  // in this tick, and on the shape before, where it is
  Status status = Status::ok;                   // of what keeps it from being an obstacle in this tick
  TouchPlace<Scalar, dimension> answer;         // of the last tick that had one

  void stand(const Prop<dimension>& stands, double length) {
    who = prop;
    avatar = stands.template avatar<Scalar>(length);
    at.obstacle.kind = stands.kind();
    at.obstacle.place = stands.template place<Scalar>();
    at.friction.take(stands.friction());
  }
  /// @param as  checked
  void take(const RoundAvatar& as) noexcept {
    avatar.radius = static_cast<Scalar>(as.radius);
    at.friction.take(as.friction);
  }
  /// A hand moves it.
  void move(const Vector& position, const Vector& shaft) noexcept {
    who = hand;
    avatar = avatar_at(position, avatar.radius, shaft);
  }
  /// It is nowhere, until a hand moves it.
  void lift() noexcept {
    forget();
    who = lifted;
  }
  /// Whether an end holds it.
  bool at_end() const noexcept { return at.mode > Mode::pushed; }
  /// Whether it is a place of the beam that is held.
  bool fixed() const noexcept { return at.obstacle.kind != ObstacleKind::round && !at_end(); }

  void forget() noexcept {
    at.memory = {};
    forget_friction();
    if (at_end()) at.obstacle.kind = ObstacleKind::round;
    at.mode = Mode::apart;
    at.obstacle.touching = false;
    at.obstacle.round = {}, at.obstacle.pushed = {0, Status::ok};
    answer = {};
    answer.body = at.obstacle.body;
  }

  /// Where it lies to the beam.   @param volumes  () -> those of the present shape   @return whether the two touch
  template <class Volumes>
  bool look(Model& model, Volumes&& volumes) noexcept {
    const bool touched = at.obstacle.touching, touches = find(model, volumes);
    // A contact that begins remembers nothing.
    if (!touched || !touches) at.friction.begin();
    // It may begin within the push, where another one brings the beam to it.
    if (!touched) at.friction.dissipated = 0;
    return touches;
  }

  /// Whether its friction has settled.
  bool settled() const noexcept {
    return !at.obstacle.touching || fixed() || at_end() || at.friction.settled;
  }
  /// Answers.   @param pushed  whether there was a push in this tick
  void report(bool pushed) noexcept {
    answer = {};
    answer.body = at.obstacle.body;
    answer.touching = at.obstacle.touching;
    answer.status = !at.obstacle.valid ? status : pushed ? at.obstacle.pushed.status : Status::ok;
    if (!at.obstacle.touching) return;
    const bool past_end = at_end();
    if (past_end && answer.status == Status::ok) answer.status = Status::out_of_range;
    answer.s = past_end ? contact.s : at.obstacle.pushed.s;
    answer.depth = contact.depth;
    answer.point = past_end ? contact.foot : at.obstacle.pushed.point;
    answer.normal = past_end ? contact.normal : at.obstacle.pushed.normal;
    answer.force = -at.obstacle.pushed.force * (past_end ? at.place.factor() : Scalar(1)) * answer.normal;
    if (at.friction.rough() && !fixed()) {
      answer.dissipated = at.friction.dissipated;
      if (!past_end) at.friction.rub(-at.obstacle.pushed.force, answer);
    }
  }

 private:
  void forget_friction() noexcept {
    at.friction.begin();
    at.friction.dissipated = 0;
  }

  template <class Volumes>
  bool find(Model& model, Volumes&& volumes) noexcept {
    status = Status::ok;
    at.obstacle.valid = who != lifted;
    if (!at.obstacle.valid) return false;
    if (fixed()) return true;
    const Scalar reach = avatar.radius + model.thickness() / 2, length = model.shape().length();
    const bool touched = at.obstacle.touching;
    if (touched) at.know(at.obstacle.pushed.s, at_end() ? contact.normal : at.obstacle.pushed.normal);
    contact = at.find(model, avatar, touched, touched, volumes);
    at.obstacle.valid = contact.segment >= 0 && !(contact.depth > reach + length);
    if (at.obstacle.valid && !again)
      at.choose(model, contact, avatar, reach, touched ? at.mode : Mode::apart);
    else at.mode = Mode::pushed;
    at.obstacle.kind = at_end() ? ObstacleKind::stop : ObstacleKind::round;
    if (at_end()) at.obstacle.valid = stop(model, reach);
    if (!at.obstacle.valid) {
      status = contact.touching ? Status::out_of_range : Status::ok;
      at.obstacle.touching = false;
      return false;
    }
    // One avatar that touches twice is nearest to the beam at one place alone.
    auto there = contact;
    if (touched && several) there.s = at.obstacle.pushed.s, there.normal = at.obstacle.pushed.normal;
    at.obstacle.round = Lasting::round(avatar, there.s, reach, there);
    // A pressed beam follows a hand that draws back; one that has jumped away is met again, if it is, as the beam springs back.
    if (contact.depth < -length / 50) at.obstacle.touching = false, forget_friction();
    if (!again) at.obstacle.touching = at.obstacle.touching || contact.touching;
    return at.obstacle.touching;
  }
  /// Beside or past an end it is a stop, in a plane no farther than the range of the beam.   @return whether there is one
  bool stop(const Model& model, Scalar reach) noexcept {
    if (at.mode == Mode::support && at.place.slid(contact, model, far_away)) return false;
    Push<Scalar, dimension>& place = at.obstacle.place;
    if (!at.place.aim(model, contact, avatar, reach, at.mode, at.side, at.obstacle.touching, place))
      return false;
    if constexpr (dimension == 2) {
      const Press<Scalar> in_range = model.range().nearest({place.s, place.d});
      place.s = in_range.s, place.d = in_range.d;
    }
    return true;
  }
};

}  // namespace detail
}  // namespace hapbeam
