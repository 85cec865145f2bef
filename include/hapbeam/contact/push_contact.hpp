// SPDX-License-Identifier: MIT
// Contact by a model that can be pushed along any direction. The avatar is a circle on a deformable curve, in space a
// capsule.
//
// The model places its centreline at the distance `reach` from the avatar's centre or axis, and returns the point of
// contact. It starts at the nearest point; in space plus the motion of that point in the last two ticks: the mesh of a rod has a
// node there already.
// Real-time: noexcept, no allocation; one push.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class PushContact {
  using Vector = VectorOf<Scalar, D>;

 public:
  /// Farther than this from where they touch, in units of reach, the contact has not been found.
  static constexpr Scalar too_far = Scalar(1e-2);

  void begin(const Contact<Scalar, D>&) noexcept {
    slid_ = before_ = 0;
    friction_.begin();
  }
  /// Of the touch, where there is friction.
  FrictionState<Scalar, D>& friction_state() noexcept { return friction_; }
  const FrictionState<Scalar, D>& friction_state() const noexcept { return friction_; }

  /// As PressContact::hold(); contact comes back as it is on the new shape.  out_of_range: the circle touches at two points,
  /// and force and shape are those of one.
  template <class Model>
  Held<Scalar> hold(Model& model, Contact<Scalar, D>& contact, const Avatar<Scalar, D>& avatar, Scalar reach,
                    Press<Scalar>& asked) noexcept {
    const Scalar length = model.shape().length(), first = contact.s;
    // No beam goes along with a hand farther than it is long.
    if (contact.depth > reach + length) return {Hold::lost, 0, Status::iteration_limit};
    const Scalar s = D == 2 ? first : std::clamp(first + (2 * slid_ - before_), Scalar(0), length);
    const Pushed<Scalar, D> pushed = push(model, s, avatar, reach, contact);
    asked = {pushed.s, D == 2 ? pushed.point.y() : pushed.normal.dot(pushed.point)};
    const bool answer = is_answer(pushed.status), found = pushed.miss <= too_far * reach,
               lost = answer && !found;
    // What pulls beside the contact, or on the way to it, may press there.
    if (pushed.force > 0 || (answer && pushed.force == 0))
      return {answer && found ? Hold::released : Hold::lost, 0, pushed.status};
    // Pushed along itself an end has no place on the circle any more: it slips off.
    if ((lost || pushed.status == Status::iteration_limit) && pushed.past_end)
      return {Hold::lost, 0, pushed.status};
    // A point that was not found is not extrapolated: its error would grow.
    before_ = pushed.miss == 0 ? slid_ : pushed.s - first;
    slid_ = pushed.s - first;
    contact.s = pushed.s;
    contact.foot = pushed.point;
    contact.normal = pushed.normal;
    contact.point = pushed.point + pushed.normal * (model.thickness() / 2);
    contact.past_end = pushed.past_end;
    Status status = lost ? Status::iteration_limit : pushed.status;
    if (status == Status::ok && friction_.sticking > 0 && !friction_.settled)
      status = Status::iteration_limit;
    if (status == Status::ok && !pushed.past_end && pinched(model.shape(), pushed.s, avatar, reach))
      status = Status::out_of_range;
    return {Hold::pressing, -pushed.force, status};
  }

 private:
  template <class Model>
  Pushed<Scalar, D> push(Model& model, Scalar s, const Avatar<Scalar, D>& avatar, Scalar reach,
                         const Contact<Scalar, D>& contact) noexcept {
    const auto request = [&] {
      if constexpr (D == 2)
        return Circle<Scalar>{s, avatar.position, reach, static_cast<Scalar>(contact.side)};
      else return Capsule<Scalar>{s, avatar.place(), reach, contact.normal};
    };
    if constexpr (takes_friction<Model>)
      if (friction_.sticking > 0) return model.push(request(), friction_);
    return model.push(request());
  }
  static Vector place(const Centreline<Scalar, D>& line, Scalar s) noexcept {
    const auto at = line.at(s);
    if constexpr (D == 2) return {s + at.u, at.w};
    else return at.r;
  }
  /// Whether the beam beside s lies within the circle, because it bends more sharply there and touches at two points.
  static bool pinched(const Centreline<Scalar, D>& line, Scalar s, const Avatar<Scalar, D>& avatar,
                      Scalar reach) noexcept {
    for (const Scalar way : {-reach / 2, reach / 2}) {
      const Scalar beside = std::clamp(s + way, Scalar(0), line.length());
      if (avatar.way_from(place(line, beside)).norm() < Scalar(0.99) * reach) return true;
    }
    return false;
  }

  FrictionState<Scalar, D> friction_;
  Scalar slid_ = 0,
         before_ = 0;  // how far the point went while the beam yielded, in the last tick and before [m]
};

}  // namespace hapbeam::detail
