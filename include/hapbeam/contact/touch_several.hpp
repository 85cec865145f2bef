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
// Beside and past an end that holds w an avatar is held as by Touch (place_contact.hpp).
// Allocates and throws in its constructor only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <type_traits>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/bounding_volumes.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/contact/several_place.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <class Model>
class TwoHands;

/// Several avatars and props on one beam.  Between ticks the model may be read by others but pressed by nobody else.
template <class Model>
class TouchSeveral {
  static_assert(
      is_force_model<Model> && detail::takes_several<Model>,
      "TouchSeveral<Model>: Model must offer push(Obstacle<Scalar>*, int) and release(), each noexcept: "
      "FemModel<Several<Element, Contacts>>");

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
      : model_(model), volumes_(model.shape().segments()) {
    for (const RoundAvatar& avatar : avatars) {
      avatar.check(length());
      for (int k = 0; k < avatar.touches; ++k) {
        Place& place = add(avatars_);
        place.take(avatar);
        place.again = k > 0, place.several = avatar.touches > 1;
      }
      ++avatars_;
    }
    int body = avatars_;
    for (const Prop& prop : props) {
      prop.check(length());
      add(body++).stand(prop, length());
    }
    reset();
  }

  /// Lets go of the beam and forgets where the hands were; where it rests on props it does so after the next tick.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    model_.reset();
    volumes_.outdate();
    for (Place& place : *this) place.forget();
    moving_ = false;
    unanswered_ = 0;
    begin_touch();
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
                            const Vector& shaft = Vector::Zero()) noexcept {
    if (!is_place(position, shaft)) return invalid();
    each_of(avatar, [&](Place& place) { place.move(position, shaft); });
    return solve();
  }
  /// An avatar leaves the scene, until it is moved again.
  void lift(int avatar) noexcept {
    each_of(avatar, [](Place& place) { place.lift(); });
  }
  /// Whether a tick takes it, else invalid_request.
  [[nodiscard]] static bool is_place(const Vector& position, const Vector& shaft) noexcept {
    return std::isfinite(position.squaredNorm()) && std::isfinite(shaft.squaredNorm());
  }
  /// @throws std::invalid_argument naming what makes no sense
  void set_friction(int avatar, const Friction& friction) {
    friction.check();
    each_of(avatar, [&](Place& place) { place.at.friction.take(friction); });
  }
  /// As Touch::soften().
  void soften(int avatar, Scalar stiffness, Scalar damping) noexcept {
    each_of(avatar, [&](Place& place) { place.at.friction.soften(stiffness, damping); });
  }
  /// The contact of the beam as it lies now with an avatar, gone straight to a place from that of its last tick.
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(
      int avatar, const Vector& position, const Vector& shaft = Vector::Zero()) noexcept {
    hapbeam::Contact<Scalar, dimension> contact;
    each_of(avatar, [&](Place place) {
      place.move(position, shaft);
      contact = find_contact(place.avatar, model_.shape(), volumes_.fitted(model_.shape()),
                             model_.thickness(), place.at.memory);
    });
    return contact;
  }

  int avatars() const noexcept { return avatars_; }
  /// Nobody touches the beam, and it is at rest.
  [[nodiscard]] bool resting() const noexcept { return !moving_; }

  /// As Touch::patience.
  static constexpr int patience = 20;

 private:
  using Place = detail::SeveralPlace<Model>;
  friend class TwoHands<Model>;

  Result solve() noexcept;
  Result invalid() const noexcept {
    Result result;
    result.size = size_;
    result.status = Status::invalid_request;
    for (int i = 0; i < size_; ++i) result.places[at(i)].body = places_[at(i)].at.obstacle.body;
    return result;
  }

  Place* begin() noexcept { return places_.data(); }
  Place* end() noexcept { return places_.data() + size_; }
  static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  double length() const noexcept { return model_.shape().length(); }
  Place& add(int body) {
    if (size_ == most)
      detail::reject("avatars and props", size_ + 1.0, "places",
                     ("at most " + std::to_string(most) + ", the Contacts of the model's Several").c_str());
    Place& place = places_[at(size_++)];
    place.at.obstacle.body = body;
    return place;
  }
  template <class Use>
  void each_of(int avatar, Use&& use) {
    for (Place& place : *this)
      if (place.at.obstacle.body == avatar && place.who != Place::prop) use(place);
  }

  /// To be called where the beam is at rest.
  void begin_touch() noexcept {
    for (Place& place : *this) place.at.place.begin(model_);
  }

  Status push() noexcept {
    std::array<Obstacle<Scalar, dimension>, most> all;
    for (int i = 0; i < size_; ++i) {
      auto& contact = places_[at(i)].at;
      all[at(i)] = contact.obstacle;
      if (contact.friction.rough()) all[at(i)].friction = &contact.friction;
    }
    const Status status = model_.push(all.data(), size_);
    bool settled = true;
    for (int i = 0; i < size_; ++i) {
      all[at(i)].friction = nullptr;
      places_[at(i)].at.obstacle = all[at(i)];
      settled = settled && places_[at(i)].settled();
    }
    volumes_.outdate();
    return is_answer(status) && !settled ? Status::iteration_limit : status;
  }

  Model& model_;
  BoundingVolumes<Scalar, dimension> volumes_;
  std::array<Place, most> places_{};
  int size_ = 0, avatars_ = 0;
  bool moving_ = false;  // touched, or let go and not yet at rest
  int unanswered_ = 0;   // ticks since the last answer
};

template <class Model>
auto TouchSeveral<Model>::tick(const Vector* positions, const Vector* shafts, int count) noexcept -> Result {
  const auto shaft = [shafts](int k) { return shafts ? shafts[k] : Vector(Vector::Zero()); };
  bool valid = count == avatars_;
  for (int k = 0; valid && k < count; ++k) valid = is_place(positions[k], shaft(k));
  if (!valid) return invalid();
  for (Place& place : *this) {
    const int k = place.at.obstacle.body;
    if (place.who != Place::prop) place.move(positions[k], shaft(k));
  }
  return solve();
}

template <class Model>
auto TouchSeveral<Model>::solve() noexcept -> Result {
  Result result;
  result.size = size_;
  bool touched = false;
  const auto volumes = [this]() -> decltype(auto) { return volumes_.fitted(model_.shape()); };
  for (Place& place : *this) touched = place.look(model_, volumes) || touched;
  const bool pushed = touched || moving_;
  if (pushed) {
    result.status = push();
    moving_ = touched || result.status == Status::iteration_limit;
    if (!moving_) begin_touch();
  }
  const bool answer = is_answer(result.status);
  for (int i = 0; i < size_; ++i) {
    if (answer) places_[at(i)].report(pushed);
    TouchPlace<Scalar, dimension>& place = result.places[at(i)] = places_[at(i)].answer;
    if (!answer) place.status = result.status;
    if (worse(place.status, result.status)) result.status = place.status;
  }
  if (answer) unanswered_ = 0;
  else if (++unanswered_ > patience) reset();
  return result;
}

template <class Model>
TouchSeveral(Model&, std::initializer_list<RoundAvatar>) -> TouchSeveral<Model>;
template <class Model>
TouchSeveral(Model&, std::initializer_list<RoundAvatar>, std::initializer_list<Prop<dimension_of<Model>>>)
    -> TouchSeveral<Model>;

}  // namespace hapbeam
