// SPDX-License-Identifier: MIT
// The bodies that may touch one beam at several places: round avatars, which hands move, and props, which nobody moves.
//
// Bodies are numbered: avatars in their order, then props in theirs.  Each has one place of contact (several_place.hpp), or as many as it may touch at.
// Throws in its constructor and where it is changed.  Real-time: all else is noexcept, no allocation, O(places).
#pragma once

#include <array>
#include <initializer_list>
#include <string>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/contact/several_place.hpp>
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

namespace detail {

/// Base class of TouchSeveral.
template <class Model>
class TouchingBodies {
  static_assert(
      is_force_model<Model> && takes_obstacles<Model>,
      "TouchSeveral<Model>: Model must offer push(Obstacle<Scalar>*, int) and release(), each noexcept: "
      "FemModel<Several<Element, Contacts>>");

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  static constexpr int most = Model::contacts;

  /// Whether an avatar touched in the last tick.
  [[nodiscard]] bool touching(int avatar) noexcept {
    bool any = false;
    each_of(avatar, [&](const Place& place) { any = any || place.obstacle.touching; });
    return any;
  }
  /// @param radius [m]   @throws std::invalid_argument
  void set_radius(int avatar, double radius) {
    check_radius(radius);
    each_of(avatar, [&](Place& place) { place.avatar.radius = static_cast<Scalar>(radius); });
  }
  /// @throws std::invalid_argument naming what makes no sense
  void set_friction(int avatar, const Friction& friction) {
    friction.check();
    each_of(avatar, [&](Place& place) { place.take(friction); });
  }
  /// Whether an avatar has friction.
  [[nodiscard]] bool rough(int avatar) noexcept {
    bool any = false;
    each_of(avatar, [&](const Place& place) { any = place.rough(); });
    return any;
  }
  /// As Touch::soften().
  void soften(int avatar, Scalar stiffness, Scalar damping) noexcept {
    each_of(avatar,
            [&](Place& place) { place.friction.stiffness = stiffness, place.friction.damping = damping; });
  }
  /// As Touch::most_radius.
  static constexpr double most_radius = 1000;

 protected:
  using Place = SeveralPlace<Model>;

  /// @param length  of the beam [m]   @param avatars, props  at most `most` places together   @throws std::invalid_argument
  TouchingBodies(double length, std::initializer_list<RoundAvatar> avatars,
                 std::initializer_list<Prop<dimension>> props)
      : length_(length) {
    for (const RoundAvatar& avatar : avatars) {
      check_radius(avatar.radius);
      if (avatar.touches < 1) reject("avatar touches", avatar.touches, "places", "1 or more");
      for (int k = 0; k < avatar.touches; ++k)
        add(avatars_).avatar.radius = static_cast<Scalar>(avatar.radius);
      set_friction(avatars_++, avatar.friction);
    }
    int body = avatars_;
    for (const Prop<dimension>& prop : props) {
      prop.check(length);
      Place& place = add(body++);
      place.prop = true;
      place.avatar = prop.template avatar<Scalar>(length);
      place.obstacle.kind = prop.kind();
      place.obstacle.place = prop.template place<Scalar>();
      place.take(prop.friction());
      if (place.obstacle.kind != ObstacleKind::round) fixed_ = true;
    }
  }

  static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  template <class Use>
  void each_of(int avatar, Use&& use) {
    for (int i = 0; i < size_; ++i)
      if (places_[at(i)].obstacle.body == avatar && !places_[at(i)].prop) use(places_[at(i)]);
  }
  /// Whether the place before is of the same body.
  bool again(int i) const noexcept {
    return i > 0 && places_[at(i)].obstacle.body == places_[at(i - 1)].obstacle.body;
  }

  std::array<Place, most> places_{};
  int size_ = 0, avatars_ = 0;
  bool fixed_ = false;  // there are stops or supports

 private:
  Place& add(int body) {
    if (size_ == most)
      reject("avatars and props", size_ + 1.0, "places",
             ("at most " + std::to_string(most) + ", the Contacts of the model's Several").c_str());
    Place& place = places_[at(size_++)];
    place.obstacle.body = body;
    return place;
  }
  void check_radius(double radius) const {
    if (!(radius >= 0 && radius <= most_radius * length_))
      reject("avatar radius", radius, "m", "0 to a thousand lengths of the beam");
  }

  double length_;
};

}  // namespace detail
}  // namespace hapbeam
