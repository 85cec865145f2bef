// SPDX-License-Identifier: MIT
// One contact of an avatar with a beam, from tick to tick: where it is sought, and how it holds the beam.
//
// A Touch (touch.hpp) has one, a TouchSeveral (touch_several.hpp) as many as the model has contacts.
// Real-time: noexcept, no allocation.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/contact/place_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

/// What became of a contact.
enum class Hold {
  pressing,
  released,  ///< the beam would have to pull
  lost,      ///< the point of contact has left the beam: it has slipped off, or the search for it went astray
  slipped,   ///< off an end that holds w and has slid away
};

template <typename Scalar>
struct Held {
  Hold hold;
  Scalar force;  ///< [N] along the contact's normal, not negative
  Status status;
};

template <class Model>
struct LastingContact {
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static constexpr bool planar = dimension == 2;
  using Avatar = hapbeam::Avatar<Scalar, dimension>;
  using Contact = hapbeam::Contact<Scalar, dimension>;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  using Round = decltype(Obstacle::round);

  /// Of the length: an end that holds w has not slid.
  static constexpr Scalar still = Scalar(1e-6);

  Mode mode = Mode::apart;
  int side = 1;  // from which the beam is pressed, as Contact::side
  ContactMemory<Scalar, dimension> memory;
  PlaceContact<Scalar, dimension> place;
  FrictionState<Scalar, dimension> friction;
  Obstacle obstacle;  // as the model is asked, and has answered

  /// Where the avatar lies to the beam.  A pressed beam moves with the hand, which cannot have gone round its end.  Only a beam that has
  /// stopped at the end of its range can be passed, and that must not turn the press into one from the other side.  A rigid end is gone
  /// round.
  /// @param pressing  since the tick before   @param close_by  it is sought there first   @param volumes  () -> those of the present shape
  template <class Volumes>
  Contact find(const Model& model, const Avatar& avatar, bool pressing, bool close_by,
               Volumes&& volumes) noexcept {
    memory.touching = pressing;
    memory.through = pressing && mode != Mode::support;
    if (pressing) memory.side = side;
    Contact contact;
    if (close_by && find_contact_near(model, memory.s, avatar, memory, contact)) return contact;
    return find_contact(avatar, model.shape(), volumes(), model.thickness(), memory);
  }
  /// How the contact holds the beam from now on.   @param before  it has held it, apart where it begins
  void choose(const Model& model, const Contact& contact, const Avatar& avatar, Scalar reach,
              Mode before) noexcept {
    mode = place.mode(model, contact, avatar, reach, before);
    if (mode == before && mode != Mode::support) return;
    side = contact.side;
    if (mode != Mode::support) friction.begin();
  }
  /// The contact has been found there, by the model or by a search.
  void know(Scalar s, const VectorOf<Scalar, dimension>& normal) noexcept {
    memory.s = s, memory.normal = normal;
  }

  /// The avatar, as the model is asked.   @param s  [m] beside which they touch
  static Round round(const Avatar& avatar, Scalar s, Scalar reach, const Contact& contact) noexcept {
    if constexpr (planar) return {s, avatar.position, reach, static_cast<Scalar>(contact.side)};
    else return {s, avatar.place(), reach, contact.normal};
  }

  /// Where they touch.   @param contact  in: on the shape before, out: where it was pressed, of a push on the new shape
  /// @param asked  out: what was asked of the model
  Held<Scalar> hold(Model& model, Contact& contact, const Avatar& avatar, Press<Scalar>& asked) noexcept {
    const Mode before = mode;
    const Scalar reach = avatar.radius + model.thickness() / 2;
    choose(model, contact, avatar, reach, before);
    if constexpr (takes_push<Model>)
      if (mode == Mode::pushed) {
        if (before != mode) obstacle = {};
        return push(model, contact, avatar, reach, asked);
      }
    if (mode == Mode::support && place.slid(contact, model, still))
      return {Hold::slipped, 0, Status::out_of_range};
    Push<Scalar, dimension> at{0, 0, VectorOf<Scalar, dimension>::Zero()};
    // One that nothing across the beam holds beside a rigid end had slid there.
    const Hold off = before == Mode::pushed && mode == Mode::across ? Hold::lost : Hold::released;
    if (!place.aim(model, contact, avatar, reach, mode, side, before > Mode::inside, at))
      return {off, 0, Status::ok};
    const Response<Scalar> response = press(model, at, asked);
    const Scalar force = -response.force * place.factor();
    if (mode == Mode::support) return {Hold::pressing, std::abs(force), response.status};
    const bool answer = is_answer(response.status);
    if (force < 0 || (answer && force == 0)) return {answer ? off : Hold::lost, 0, response.status};
    return {Hold::pressing, force, response.status};
  }

 private:
  static Response<Scalar> press(Model& model, const Push<Scalar, dimension>& at,
                                Press<Scalar>& asked) noexcept {
    if constexpr (planar) {
      asked = {at.s, at.normal.y() * at.d};
      const Response<Scalar> response = model.press(asked);
      return {at.normal.y() * response.force, response.status};
    } else {
      asked = {at.s, at.d};
      const Response<Scalar> response = model.push(at);
      return {response.force, response.status == Status::ok ? Status::out_of_range : response.status};
    }
  }
  /// out_of_range: the circle touches at two points, and force and shape are those of one.
  Held<Scalar> push(Model& model, Contact& contact, const Avatar& avatar, Scalar reach,
                    Press<Scalar>& asked) noexcept {
    // No beam goes along with a hand farther than it is long.
    if (contact.depth > reach + model.shape().length()) return {Hold::lost, 0, Status::iteration_limit};
    obstacle.round = round(avatar, contact.s, reach, contact);
    obstacle.valid = obstacle.touching = true;
    obstacle.friction = friction.rough() ? &friction : nullptr;
    Status status = model.push(&obstacle, 1);
    const auto& pushed = obstacle.pushed;
    if (status == Status::ok) status = pushed.status;
    asked = {pushed.s, planar ? pushed.point[1] : pushed.normal.dot(pushed.point)};
    if (!obstacle.touching || (is_answer(status) && pushed.force == 0)) return {Hold::released, 0, status};
    // Pushed along itself an end has no place on the circle any more: it slips off.
    if (status == Status::iteration_limit && pushed.past_end) return {Hold::lost, 0, status};
    lay(contact, pushed.s, pushed.point, pushed.normal, model.thickness());
    contact.past_end = pushed.past_end;
    if (status == Status::ok && friction.rough() && !friction.settled) status = Status::iteration_limit;
    return {Hold::pressing, -pushed.force, status};
  }
};

}  // namespace hapbeam::detail
