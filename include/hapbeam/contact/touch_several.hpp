// SPDX-License-Identifier: MIT
// From the places of several hands to the force on each: several avatars and props on one beam, one call a tick, in a plane or in space.
//
//   FemModel<Several<Corotational<>, 3>> model(beam, 16);
//   TouchSeveral touch(model, {0.005, 0.005}, {Prop<>::peg({0.5, -0.02}, 0.01)});
//   const auto felt = touch.tick(left, right);        // felt.force(0) on the left hand, felt.force(1) on the right one
//
// A *prop* is an avatar that nobody moves.  Each tick finds where the avatars and props lie to the shape of the last tick and asks the model for
// the equilibrium under all of them (Obstacle, force_model.hpp).  Each pushes or does not touch; none pulls but a support.  Each round one may
// have friction (friction.hpp).
// Beside and past an end that holds w an avatar is held as by Touch (end_contact.hpp).
// Allocates and throws in its constructor only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <type_traits>

#include <hapbeam/contact/bounding_volumes.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/contact/several_result.hpp>
#include <hapbeam/contact/touching_bodies.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// Several avatars and props on one beam.  Between ticks the model may be read by others but pressed by nobody else.
template <class Model>
class TouchSeveral : private detail::TouchingBodies<Model> {
  using Bodies = detail::TouchingBodies<Model>;

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static constexpr int most = Model::contacts;
  using Vector = VectorOf<Scalar, dimension>;
  using Result = TouchSeveralResult<Scalar, dimension, most>;
  using Prop = hapbeam::Prop<dimension>;

  /// @param model  kept by reference   @param avatars, props  at most Contacts places together
  /// Allocates.   @throws std::invalid_argument naming what makes no sense
  TouchSeveral(Model& model, std::initializer_list<RoundAvatar> avatars,
               std::initializer_list<Prop> props = {})
      : Bodies(static_cast<double>(model.shape().length()), avatars, props),
        model_(model),
        volumes_(model.shape().segments()) {
    reset();
  }

  /// Lets go of the beam and forgets where the hands were; where it rests on props it does so after the next tick.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    model_.reset();
    moved_ = true;
    for (int i = 0; i < size_; ++i) places_[at(i)].forget(), forget_answer(i);
    moving_ = false;
    unanswered_ = 0;
    begin();
  }

  /// One tick.  @param positions  [m] the centre of each avatar, in space the centre of each sphere
  /// Real-time: noexcept, no allocation, bounded: at most one push and one release; nothing where nobody touches a beam at rest.
  template <class... Positions,
            std::enable_if_t<std::conjunction_v<std::is_convertible<const Positions&, Vector>...>, int> = 0>
  [[nodiscard]] Result tick(const Positions&... positions) noexcept {
    const std::array<Vector, sizeof...(Positions)> all{positions...};
    return tick(all.data(), static_cast<int>(all.size()));
  }
  /// The same.  @param count  of positions: as many as there are avatars, else invalid_request
  [[nodiscard]] Result tick(const Vector* positions, int count) noexcept {
    return tick(positions, nullptr, count);
  }
  /// The same in space, with capsules.  @param positions  of the tips of their axes   @param shafts  [m] from there to the other ends
  [[nodiscard]] Result tick(const Vector* positions, const Vector* shafts, int count) noexcept;

  // For hands that are ticked one by one (two_hands.hpp).

  /// One avatar moves, and the others stay where they are.   @param shaft  of a capsule in space
  [[nodiscard]] Result tick(int avatar, const Vector& position,
                            const Vector& shaft = Vector::Zero()) noexcept;
  /// An avatar leaves the scene, until it is moved again.
  void lift(int avatar) noexcept {
    for (int i = 0; i < size_; ++i)
      if (places_[at(i)].obstacle.body == avatar) {
        places_[at(i)].forget(), forget_answer(i);
        places_[at(i)].away = true;
      }
  }
  /// Nobody moves.
  [[nodiscard]] Result tick_still() noexcept { return solve(); }
  /// Whether a tick takes it, else invalid_request.
  [[nodiscard]] static bool is_place(const Vector& position, const Vector& shaft) noexcept {
    return std::isfinite(position.squaredNorm()) && std::isfinite(shaft.squaredNorm());
  }
  using Bodies::rough;
  using Bodies::set_friction;
  using Bodies::set_radius;
  using Bodies::soften;
  using Bodies::touching;
  /// The contact of the beam as it lies now with an avatar, gone straight to a place from that of its last tick.
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(
      int avatar, const Vector& position, const Vector& shaft = Vector::Zero()) noexcept {
    hapbeam::Contact<Scalar, dimension> contact;
    each_of(avatar, [&](Place place) {
      place.avatar.position = position;
      if constexpr (!planar) place.avatar.shaft = shaft;
      contact = find_contact(place.avatar, model_.shape(), volumes(), model_.thickness(), place.memory);
    });
    return contact;
  }

  int avatars() const noexcept { return avatars_; }
  /// Nobody touches the beam, and it is at rest.
  [[nodiscard]] bool resting() const noexcept { return !moving_; }

  using Bodies::most_radius;
  /// As Touch::patience.
  static constexpr int patience = 20;

 private:
  using Bodies::again;
  using Bodies::at;
  using Bodies::avatars_;
  using Bodies::each_of;
  using Bodies::fixed_;
  using Bodies::places_;
  using Bodies::size_;
  using typename Bodies::Place;
  static constexpr bool planar = dimension == 2;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;

  Result solve() noexcept;
  Result invalid() const noexcept {
    Result result;
    result.size = size_;
    result.status = Status::invalid_request;
    for (int i = 0; i < size_; ++i) result.places[at(i)].body = places_[at(i)].obstacle.body;
    return result;
  }

  void forget_answer(int i) noexcept {
    answer_[at(i)] = {};
    answer_[at(i)].body = places_[at(i)].obstacle.body;
  }
  /// To be called where the beam is at rest.
  void begin() noexcept {
    for (int i = 0; i < size_; ++i) places_[at(i)].end.begin(model_);
  }
  /// Where it lies to the beam.   @return whether the two touch
  bool look(int i) noexcept {
    const bool before = again(i), several = before || (i + 1 < size_ && again(i + 1));
    return places_[at(i)].look(
        model_, [this]() -> decltype(auto) { return volumes(); }, before, several);
  }
  /// Fitted to the present shape.  A lasting touch does without.
  const BoundingVolumes<Scalar, dimension>& volumes() noexcept {
    if (moved_) volumes_.refit(model_.shape());
    moved_ = false;
    return volumes_;
  }

  Status push() noexcept {
    std::array<Obstacle, most> all;
    for (int i = 0; i < size_; ++i) {
      all[at(i)] = places_[at(i)].obstacle;
      if (places_[at(i)].rough()) all[at(i)].friction = &places_[at(i)].friction;
    }
    const Status status = model_.push(all.data(), size_);
    for (int i = 0; i < size_; ++i) {
      all[at(i)].friction = nullptr;
      places_[at(i)].obstacle = all[at(i)];
    }
    moved_ = true;
    return status;
  }
  bool found() const noexcept {
    return std::all_of(places_.begin(), places_.begin() + size_,
                       [this](const Place& place) { return place.found(model_); });
  }

  Model& model_;
  BoundingVolumes<Scalar, dimension> volumes_;
  bool moved_ = true;                                       // since the volumes were fitted
  bool moving_ = false;                                     // touched, or let go and not yet at rest
  std::array<TouchPlace<Scalar, dimension>, most> answer_;  // of the last tick that had one
  int unanswered_ = 0;                                      // ticks since the last answer
};

template <class Model>
auto TouchSeveral<Model>::tick(const Vector* positions, const Vector* shafts, int count) noexcept -> Result {
  bool valid = count == avatars_;
  for (int k = 0; valid && k < count; ++k)
    valid = is_place(positions[k], shafts ? shafts[k] : Vector(Vector::Zero()));
  if (!valid) return invalid();
  for (int i = 0; i < size_; ++i) {
    Place& place = places_[at(i)];
    if (place.prop) continue;
    place.away = false;
    place.avatar.position = positions[place.obstacle.body];
    if constexpr (!planar)
      if (shafts) place.avatar.shaft = shafts[place.obstacle.body];
  }
  return solve();
}

template <class Model>
auto TouchSeveral<Model>::tick(int avatar, const Vector& position, const Vector& shaft) noexcept -> Result {
  if (!is_place(position, shaft)) return invalid();
  each_of(avatar, [&](Place& place) {
    place.away = false;
    place.avatar.position = position;
    if constexpr (!planar) place.avatar.shaft = shaft;
  });
  return solve();
}

template <class Model>
auto TouchSeveral<Model>::solve() noexcept -> Result {
  Result result;
  result.size = size_;
  bool touched = fixed_;
  for (int i = 0; i < size_; ++i) touched = look(i) || touched;
  const bool pushed = touched || moving_;
  if (pushed) {
    result.status = push();
    if (is_answer(result.status) && !found()) result.status = Status::iteration_limit;
    moving_ = touched || result.status == Status::iteration_limit;
    if (!moving_) begin();
  }
  const bool answer = is_answer(result.status);
  for (int i = 0; i < size_; ++i) {
    TouchPlace<Scalar, dimension>& place = result.places[at(i)];
    if (answer) places_[at(i)].report(pushed, place);
    else place = answer_[at(i)], place.status = result.status;
    if (worse(place.status, result.status)) result.status = place.status;
  }
  if (answer) answer_ = result.places, unanswered_ = 0;
  else if (++unanswered_ > patience) reset();
  return result;
}

template <class Model>
TouchSeveral(Model&, std::initializer_list<RoundAvatar>) -> TouchSeveral<Model>;
template <class Model>
TouchSeveral(Model&, std::initializer_list<RoundAvatar>, std::initializer_list<Prop<dimension_of<Model>>>)
    -> TouchSeveral<Model>;

}  // namespace hapbeam
