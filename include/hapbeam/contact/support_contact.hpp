// SPDX-License-Identifier: MIT
// How contact ends at a support: past an end that holds w the hand touches a fixed point.
//
// Such an end does not yield. The force has the size of a press by the same depth at the nearest place in range. It
// acts along the line from the end to the avatar's centre. It depends on their distance alone, so a closed path around
// the end gains no work.
// A roller holds w and slides. A touch that begins past it meets the fixed point, too. A touch from inside, whose press
// has drawn the end from under the avatar, has slipped off.
// Real-time: noexcept, no allocation; at most one press.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class SupportContact {
 public:
  /// @param model  before it is touched
  template <class Model>
  void begin(const Model& model) noexcept {
    const Centreline<Scalar> line = model.shape();
    const Range<Scalar> range = model.range();
    ends_[0] = {line[0].u, line.at(range.s_min).w};
    ends_[1] = {line[line.segments()].u, line.at(range.s_max).w};
  }

  /// Whether the contact is past an end that holds w.
  template <class Model>
  static bool past(const Contact<Scalar>& contact, const Model& model) noexcept {
    const Range<Scalar> range = model.range();
    return contact.past_end && std::isfinite(contact.s > 0 ? range.right_support : range.left_support);
  }

  /// Whether the avatar reaches over an end that holds w.
  template <class Model>
  static bool over(const Model& model, const Avatar<Scalar>& avatar, Scalar reach) noexcept {
    const Vector2<Scalar>& position = avatar.position;
    const Centreline<Scalar> line = model.shape();
    const Range<Scalar> range = model.range();
    const auto within = [&](const CentrelineNode<Scalar>& end, Scalar support) {
      return std::isfinite(support) && (position - Vector2<Scalar>(end.s + end.u, end.w)).norm() < reach;
    };
    return within(line[0], range.left_support) || within(line[line.segments()], range.right_support);
  }

  /// Whether the contact is nearer than so much to an end that holds w.
  template <class Model>
  static bool beside(const Contact<Scalar>& contact, const Model& model, Scalar distance) noexcept {
    const Range<Scalar> range = model.range();
    return contact.s - range.left_support < distance || range.right_support - contact.s < distance;
  }

  /// Whether that end is no longer where it was.   @param slack  of the length
  template <class Model>
  bool slid(const Contact<Scalar>& contact, const Model& model, Scalar slack = Scalar(1e-6)) const noexcept {
    const Centreline<Scalar> line = model.shape();
    const bool right = contact.s > 0;
    return !(std::abs(line[right ? line.segments() : 0].u - ends_[right].u) <= line.length() * slack);
  }

  /// What presses the beam as deep as the contact is.
  Press<Scalar> aim(const Contact<Scalar>& contact) const noexcept {
    return {contact.s, ends_[contact.s > 0].w - static_cast<Scalar>(contact.side) * contact.depth};
  }

  /// As PressContact::hold()
  template <class Model>
  Held<Scalar> hold(Model& model, const Contact<Scalar>& contact, Press<Scalar>& asked) const noexcept {
    if (slid(contact, model)) return {Hold::slipped, 0, Status::out_of_range};
    if (!contact.touching) return {Hold::released, 0, Status::ok};
    asked = aim(contact);
    const Response<Scalar> response = model.press(asked);
    return {Hold::pressing, std::abs(response.force), response.status};
  }

 private:
  struct End {
    Scalar u;  // of the end [m]
    Scalar w;  // of the nearest place in range [m]
  };
  End ends_[2] = {{0, 0}, {0, 0}};
};

/// An end of a rod in space that is held does not move, nor does much beside it: a contact that is deeper there than σ²/6 reach, at
/// the distance σ from the end, bends the rod half as sharply as the avatar, 3d/σ², and a hand soon more so than a mesh can show.  There
/// the rod counts as it lay before the touch: it is pushed across by a little of that distance, and deeper contacts take as many
/// times the force.
template <typename Scalar>
class SupportContact<Scalar, 3> {
  using Vector = VectorOf<Scalar, 3>;

 public:
  template <class Model>
  void begin(const Model& model) noexcept {
    const Centreline<Scalar, 3> line = model.shape();
    const int last = line.segments() - 1;
    ends_[0] = {line.segment(0), line[1].s - line[0].s, line[0].director};
    ends_[1] = {line.segment(last).rowwise().reverse(), line[last + 1].s - line[last].s,
                line[last + 1].director};
  }

  /// Whether the contact is past an end that is held, or as deep as that beside it.
  template <class Model>
  bool past(const Contact<Scalar, 3>& contact, const Model& model, const Avatar<Scalar, 3>& avatar,
            Scalar reach) noexcept {
    const Range<Scalar> range = model.range();
    for (const bool right : {false, true}) {
      const End& end = ends_[right];
      const Scalar support = right ? range.right_support : range.left_support,
                   distance = std::abs(contact.s - support);
      if (!(distance < end.length)) continue;
      const ClosestPoint<Scalar, 3> at = closest_point(end.piece, avatar.place());
      const Scalar gap = std::sqrt(at.distance_squared),
                   nearest = right ? support - range.s_max : range.s_min;
      depth_ = reach - gap;
      distance_ = (std::max)(at.t * end.length, nearest);
      if (!(distance < nearest || 6 * reach * depth_ > distance_ * distance_)) continue;
      right_ = right;
      tangent_ = detail::unit(tangent(end.piece, at.t));
      normal_ = gap > 0 ? Vector(at.offset / gap) : detail::across(end.director, tangent_);
      foot_ = point_at(end.piece, at.t);
      return true;
    }
    return false;
  }
  template <class Model>
  static bool beside(const Contact<Scalar, 3>& contact, const Model& model, Scalar distance) noexcept {
    const Range<Scalar> range = model.range();
    return contact.s - range.left_support < distance || range.right_support - contact.s < distance;
  }
  template <class Model>
  static bool slid(const Contact<Scalar, 3>&, const Model&) noexcept {
    return false;
  }

  /// As PressContact::hold().
  template <class Model>
  Held<Scalar> hold(Model& model, Contact<Scalar, 3>& contact, Press<Scalar>& asked) const noexcept {
    Push<Scalar, 3> push{0, 0, Vector::Zero()};
    Scalar factor;
    if (!aim(model, contact, push, factor)) return {Hold::released, 0, Status::ok};
    asked = {push.s, push.d};
    const Response<Scalar> response = model.push(push);
    const Status status = response.status == Status::ok ? Status::out_of_range : response.status;
    return {Hold::pressing, std::abs(response.force) * factor, status};
  }
  /// What pushes the rod there.  @param contact  out   @param factor  out, of the force   @return whether it is touched
  template <class Model>
  bool aim(const Model& model, Contact<Scalar, 3>& contact, Push<Scalar, 3>& push,
           Scalar& factor) const noexcept {
    contact.touching = depth_ > 0;
    if (!contact.touching) return false;
    const Range<Scalar> range = model.range();
    const Scalar s = right_ ? range.right_support - distance_ : range.left_support + distance_,
                 depth = (std::min)(depth_, distance_ / 20);
    const Vector side = normal_ - tangent_ * tangent_.dot(normal_),
                 across = side.squaredNorm() > Scalar(0.01)
                              ? detail::unit(side)
                              : detail::across(ends_[right_].director, tangent_);
    push = {s, across.dot(foot_) - depth, across};
    factor = depth_ / depth;
    contact.s = s;
    contact.foot = foot_;
    contact.normal = normal_;
    contact.point = foot_ + normal_ * (model.thickness() / 2);
    contact.depth = depth_;
    return true;
  }

 private:
  struct End {
    CubicSegment<Scalar, 3> piece;  // from the end inward, before the touch
    Scalar length;                  // of it [m]
    Vector director;
  };

  End ends_[2] = {};
  bool right_ = false;
  Scalar distance_ = 0, depth_ = 0;  // of the last contact, from the end and into the rod [m]
  Vector tangent_ = Vector::Zero(), normal_ = Vector::Zero(), foot_ = Vector::Zero();
};

}  // namespace hapbeam::detail
