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
#include <string>
#include <type_traits>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/end_contact.hpp>
#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/contact/find_rod_contact.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/contact/push_contact.hpp>
#include <hapbeam/contact/several_result.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam {

/// A round avatar that a hand moves.
struct RoundAvatar {
  /// @param radius_  [m]   @param touches_  at so many places at most: 2 for one that is wide beside the bends of the beam
  constexpr RoundAvatar(double radius_, int touches_ = 1, const Friction& friction_ = {}) noexcept
      : radius(radius_), touches(touches_), friction(friction_) {}
  double radius;  ///< [m] >= 0
  int touches;
  Friction friction;
};

/// Several avatars and props on one beam.  Between ticks the model may be read by others but pressed by nobody else.
template <class Model>
class TouchSeveral {
  static_assert(
      is_force_model<Model> && takes_obstacles<Model>,
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
    const double length = static_cast<double>(model.shape().length());
    const auto add = [&](int body) -> Place& {
      if (size_ == most)
        detail::reject("avatars and props", size_ + 1.0, "places",
                       ("at most " + std::to_string(most) + ", the Contacts of the model's Several").c_str());
      Place& place = places_[at(size_++)];
      place.obstacle.body = body;
      return place;
    };
    for (const RoundAvatar& avatar : avatars) {
      check_radius(avatar.radius);
      if (avatar.touches < 1) detail::reject("avatar touches", avatar.touches, "places", "1 or more");
      for (int k = 0; k < avatar.touches; ++k)
        add(avatars_).avatar.radius = static_cast<Scalar>(avatar.radius);
      set_friction(avatars_++, avatar.friction);
    }
    int body = avatars_;
    for (const Prop& prop : props) {
      prop.check(length);
      Place& place = add(body++);
      place.prop = true;
      place.avatar = prop.template avatar<Scalar>(length);
      place.obstacle.kind = prop.kind();
      place.obstacle.place = prop.template place<Scalar>();
      take(prop.friction(), place);
      if (place.obstacle.kind != ObstacleKind::round) fixed_ = true;
    }
    reset();
  }

  /// Lets go of the beam and forgets where the hands were; where it rests on props it does so after the next tick.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    model_.reset();
    moved_ = true;
    for (int i = 0; i < size_; ++i) forget(places_[at(i)]);
    for (int i = 0; i < size_; ++i) {
      answer_[at(i)] = {};
      answer_[at(i)].body = places_[at(i)].obstacle.body;
    }
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
    each_of(avatar, [](Place& place) { forget(place), place.away = true; });
  }
  /// @param radius [m]   @throws std::invalid_argument
  void set_radius(int avatar, double radius) {
    check_radius(radius);
    each_of(avatar, [&](Place& place) { place.avatar.radius = static_cast<Scalar>(radius); });
  }
  /// @throws std::invalid_argument naming what makes no sense
  void set_friction(int avatar, const Friction& friction) {
    friction.check();
    each_of(avatar, [&](Place& place) { take(friction, place); });
  }
  /// Whether an avatar has friction.
  [[nodiscard]] bool rough(int avatar) noexcept {
    bool any = false;
    each_of(avatar, [&](const Place& place) { any = place.friction.sticking > 0; });
    return any;
  }
  /// As Touch::soften().
  void soften(int avatar, Scalar stiffness, Scalar damping) noexcept {
    each_of(avatar,
            [&](Place& place) { place.friction.stiffness = stiffness, place.friction.damping = damping; });
  }
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

  /// As Touch::most_radius and Touch::patience.
  static constexpr double most_radius = 1000;
  static constexpr int patience = 20;

 private:
  using Avatar = hapbeam::Avatar<Scalar, dimension>;
  using Contact = hapbeam::Contact<Scalar, dimension>;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  static constexpr bool planar = dimension == 2;

  struct Place {
    Obstacle obstacle;
    Avatar avatar{};
    bool prop = false;
    bool away = false;  // lifted
    Scalar depth = 0;
    ContactMemory<Scalar, dimension> memory;
    Contact contact;      // in this tick, and on the shape before, where it is
    bool at_end = false;  // held by an end
    detail::EndContact<Scalar, dimension> end;
    FrictionState<Scalar, dimension> friction;
    Status status = Status::ok;  // of what keeps it from being an obstacle in this tick
  };
  static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  void check_radius(double radius) const {
    if (!(radius >= 0 && radius <= most_radius * static_cast<double>(model_.shape().length())))
      detail::reject("avatar radius", radius, "m", "0 to a thousand lengths of the beam");
  }
  template <class Use>
  void each_of(int avatar, Use&& use) {
    for (int i = 0; i < size_; ++i)
      if (places_[at(i)].obstacle.body == avatar && !places_[at(i)].prop) use(places_[at(i)]);
  }
  static void take(const Friction& friction, Place& place) noexcept {
    place.friction.sticking = static_cast<Scalar>(friction.sticking);
    place.friction.sliding = static_cast<Scalar>(friction.sliding);
  }
  Result solve() noexcept;
  Result invalid() const noexcept {
    Result result;
    result.size = size_;
    result.status = Status::invalid_request;
    for (int i = 0; i < size_; ++i) result.places[at(i)].body = places_[at(i)].obstacle.body;
    return result;
  }

  /// To be called where the beam is at rest.
  void begin() noexcept {
    for (int i = 0; i < size_; ++i) places_[at(i)].end.begin(model_);
  }
  static void forget(FrictionState<Scalar, dimension>& friction) noexcept {
    friction.begin();
    friction.dissipated = 0;
  }
  static void forget(Place& place) noexcept {
    place.memory = {};
    forget(place.friction);
    if (place.at_end) place.obstacle.kind = ObstacleKind::round, place.at_end = false;
    place.obstacle.touching = false;
    place.obstacle.pushed.force = 0;
  }
  /// Whether it is a place of the beam that is held.
  static bool fixed(const Place& place) noexcept {
    return place.obstacle.kind != ObstacleKind::round && !place.at_end;
  }
  /// Whether the place before is of the same avatar.
  bool again(int i) const noexcept {
    return i > 0 && places_[at(i)].obstacle.body == places_[at(i - 1)].obstacle.body;
  }

  /// Where it lies to the beam.   @return whether the two touch
  bool look(int i) noexcept {
    Place& place = places_[at(i)];
    const bool touched = place.obstacle.touching, touches = find(i);
    // A contact that begins remembers nothing.
    if (!touched || !touches) place.friction.begin();
    // It may begin within the push, where another one brings the beam to it.
    if (!touched) place.friction.dissipated = 0;
    return touches;
  }
  bool find(int i) noexcept {
    Place& place = places_[at(i)];
    Obstacle& obstacle = place.obstacle;
    place.status = Status::ok;
    obstacle.valid = !place.away;
    if (place.away) return false;
    if (fixed(place)) return true;
    remember(place);
    const Scalar thickness = model_.thickness(), reach = place.avatar.radius + thickness / 2;
    Contact& contact = place.contact;
    if (!find_near(place))
      contact = find_contact(place.avatar, model_.shape(), volumes(), thickness, place.memory);
    place.depth = contact.depth;
    const bool lost = contact.depth > reach + model_.shape().length();
    obstacle.valid = contact.segment >= 0 && !lost;
    place.at_end = !again(i) && obstacle.valid &&
                   place.end.holds(model_, contact, place.avatar, reach, obstacle.touching);
    obstacle.kind = place.at_end ? ObstacleKind::stop : ObstacleKind::round;
    if (place.at_end) {
      obstacle.valid = place.end.aim(model_, contact, place.avatar, reach, obstacle.touching, obstacle.place);
      place.depth = contact.depth;
    }
    if (!obstacle.valid) {
      place.status = contact.touching ? Status::out_of_range : Status::ok;
      obstacle.touching = false;
      return false;
    }
    // One avatar that touches twice is nearest to the beam at one place alone.
    const bool twice = obstacle.touching && (again(i) || (i + 1 < size_ && again(i + 1)));
    const Scalar s = twice ? obstacle.pushed.s : contact.s;
    if constexpr (planar)
      obstacle.round = {s, place.avatar.position, reach, static_cast<Scalar>(contact.side)};
    else obstacle.round = {s, place.avatar.axis(), reach, twice ? obstacle.pushed.normal : contact.normal};
    // A pressed beam follows a hand that draws back; one that has jumped away is met again, if it is, as the beam springs back.
    if (contact.depth < -model_.shape().length() / 50) obstacle.touching = false, forget(place.friction);
    if (!again(i)) obstacle.touching = obstacle.touching || contact.touching;
    return obstacle.touching;
  }
  /// The contact of a touch that goes on, where it was.
  bool find_near(Place& place) noexcept {
    if (!place.obstacle.touching) return false;
    if constexpr (planar)
      return detail::find_contact_beside(model_.shape(), place.obstacle.pushed.s, place.avatar,
                                         model_.thickness(), place.memory, place.contact);
    else return detail::find_contact_near(model_, place.avatar, place.memory, place.contact);
  }
  /// Fitted to the present shape.  A lasting touch does without.
  const BoundingVolumes<Scalar, dimension>& volumes() noexcept {
    if (moved_) volumes_.refit(model_.shape());
    moved_ = false;
    return volumes_;
  }
  /// As Touch: a pressed beam moves with what presses it, which cannot have gone round its end.
  void remember(Place& place) noexcept {
    place.memory.touching = place.obstacle.touching;
    if constexpr (planar) {
      place.memory.through = place.obstacle.touching && !(place.at_end && place.end.past());
      if (place.obstacle.touching) place.memory.side = place.obstacle.round.side < 0 ? -1 : 1;
    } else if (place.obstacle.touching) {
      place.memory.s = place.obstacle.pushed.s;
      place.memory.normal = place.at_end ? place.contact.normal : place.obstacle.pushed.normal;
    }
  }

  Status push() noexcept {
    std::array<Obstacle, most> all;
    for (int i = 0; i < size_; ++i) {
      all[at(i)] = places_[at(i)].obstacle;
      if (places_[at(i)].friction.sticking > 0) all[at(i)].friction = &places_[at(i)].friction;
    }
    const Status status = model_.push(all.data(), size_);
    for (int i = 0; i < size_; ++i) {
      all[at(i)].friction = nullptr;
      places_[at(i)].obstacle = all[at(i)];
    }
    moved_ = true;
    return status;
  }
  /// Whether each contact is where the two touch, as in Touch, and its friction has settled.
  bool found() const noexcept {
    bool all = true;
    for (int i = 0; i < size_; ++i) {
      const Place& place = places_[at(i)];
      // A wall is as flat as any.
      const Scalar reach =
          (std::min)(place.avatar.radius + model_.thickness() / 2, model_.shape().length() / 10);
      if (place.obstacle.touching && !fixed(place) && !place.at_end)
        all = all && place.friction.settled &&
              place.obstacle.pushed.miss <= detail::PushContact<Scalar, dimension>::too_far * reach;
    }
    return all;
  }
  void report(int i, bool pushed, TouchPlace<Scalar, dimension>& to) const noexcept {
    const Place& place = places_[at(i)];
    const Obstacle& obstacle = place.obstacle;
    to.body = obstacle.body;
    to.touching = obstacle.touching;
    to.status = !obstacle.valid ? place.status : pushed ? obstacle.pushed.status : Status::ok;
    if (!obstacle.touching) return;
    to.s = obstacle.pushed.s;
    to.depth = place.depth;
    to.point = obstacle.pushed.point;
    to.normal = obstacle.pushed.normal;
    to.force = -obstacle.pushed.force * obstacle.pushed.normal;
    if (place.friction.sticking > 0) rub(place, to);
    if (!place.at_end) return;
    if (to.status == Status::ok) to.status = Status::out_of_range;
    to.s = place.contact.s;
    to.point = place.contact.foot;
    to.normal = place.contact.normal;
    to.force = -obstacle.pushed.force * place.end.factor() * place.contact.normal;
  }

  static void rub(const Place& place, TouchPlace<Scalar, dimension>& to) noexcept {
    to.friction = place.friction.on_hand(-place.obstacle.pushed.force);
    to.force += to.friction;
    to.sliding = place.friction.slides;
    to.dissipated = place.friction.dissipated;
  }

  Model& model_;
  BoundingVolumes<Scalar, dimension> volumes_;
  std::array<Place, most> places_{};
  int size_ = 0, avatars_ = 0;
  bool moved_ = true;                                       // since the volumes were fitted
  bool fixed_ = false;                                      // there are stops or supports
  bool moving_ = false;                                     // touched, or let go and not yet at rest
  std::array<TouchPlace<Scalar, dimension>, most> answer_;  // of the last tick that had one
  int unanswered_ = 0;                                      // ticks since the last answer
};

template <class Model>
auto TouchSeveral<Model>::tick(const Vector* positions, const Vector* shafts, int count) noexcept -> Result {
  const auto is_place = [](const Vector& x) { return std::isfinite(x.squaredNorm()); };
  bool valid = count == avatars_;
  for (int k = 0; valid && k < count; ++k) valid = is_place(positions[k]) && (!shafts || is_place(shafts[k]));
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
  if (!(std::isfinite(position.squaredNorm()) && std::isfinite(shaft.squaredNorm()))) return invalid();
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
    if (answer) report(i, pushed, place);
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
