// How contact ends at a support: past an end that holds w the hand touches a fixed point.
//
// Such an end does not yield.  The force has the size that the nearest place in range takes for as much depth, and acts along
// the way from the end to the avatar's centre: it is a function of their distance, so no way round the end gains work.
// A roller holds w and slides.  A touch that begins past it meets the fixed point as well; one that comes from inside, whose
// press has drawn the end from under the avatar, has slipped off.
// Real-time: noexcept, no allocation; at most one press.
#pragma once

#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/force_model.hpp>

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
  static bool near(const Contact<Scalar>& contact, const Model& model, Scalar distance) noexcept {
    const Range<Scalar> range = model.range();
    return contact.s - range.left_support < distance || range.right_support - contact.s < distance;
  }

  /// Whether that end is no longer where it was.
  template <class Model>
  bool slid(const Contact<Scalar>& contact, const Model& model) const noexcept {
    const Centreline<Scalar> line = model.shape();
    const bool right = contact.s > 0;
    return !(std::abs(line[right ? line.segments() : 0].u - ends_[right].u) <= line.length() * Scalar(1e-6));
  }

  /// As PressContact::hold()
  template <class Model>
  Held<Scalar> hold(Model& model, const Contact<Scalar>& contact, Press<Scalar>& asked) const noexcept {
    if (slid(contact, model)) return {Hold::slipped, 0, Status::out_of_range};
    if (!contact.touching) return {Hold::released, 0, Status::ok};
    asked = {contact.s, ends_[contact.s > 0].w - static_cast<Scalar>(contact.side) * contact.depth};
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

/// An end of a rod in space that is held does not move, nor does what is beside it.
template <typename Scalar>
class SupportContact<Scalar, 3> {
 public:
  template <class Model>
  void begin(const Model& model) noexcept {
    const Centreline<Scalar, 3> line = model.shape();
    const Range<Scalar> range = model.range();
    across_[0] = line[0].director, across_[1] = line[line.segments()].director;
    home_[0] = across_[0].dot(line.at(range.s_min).r), home_[1] = across_[1].dot(line.at(range.s_max).r);
  }

  /// Whether the contact is past an end that is held, or nearer to it than a push is answered.
  template <class Model>
  static bool past(const Contact<Scalar, 3>& contact, const Model& model) noexcept {
    const Range<Scalar> range = model.range();
    return (contact.s < range.s_min && std::isfinite(range.left_support)) ||
           (contact.s > range.s_max && std::isfinite(range.right_support));
  }
  template <class Model>
  static bool near(const Contact<Scalar, 3>& contact, const Model& model, Scalar distance) noexcept {
    const Range<Scalar> range = model.range();
    return contact.s - range.left_support < distance || range.right_support - contact.s < distance;
  }
  template <class Model>
  static bool slid(const Contact<Scalar, 3>&, const Model&) noexcept {
    return false;
  }

  /// As PressContact::hold().  So near to the end the rod is pushed across by half of the way to it at most; deeper contacts
  /// take as many times the force.
  template <class Model>
  Held<Scalar> hold(Model& model, const Contact<Scalar, 3>& contact, Press<Scalar>& asked) const noexcept {
    if (!contact.touching) return {Hold::released, 0, Status::ok};
    const Range<Scalar> range = model.range();
    const bool right = std::isfinite(range.right_support) && contact.s > range.s_max;
    const Scalar s = right ? range.s_max : range.s_min,
                 most = (right ? range.right_support - s : s - range.left_support) / 2,
                 depth = std::min(contact.depth, most);
    asked = {s, home_[right] - depth};
    const Response<Scalar> response = model.push(Push<Scalar, 3>{s, asked.d, across_[right]});
    const Status status = response.status == Status::ok ? Status::out_of_range : response.status;
    return {Hold::pressing, std::abs(response.force) * (contact.depth / depth), status};
  }

 private:
  VectorOf<Scalar, 3> across_[2] = {VectorOf<Scalar, 3>::Zero(), VectorOf<Scalar, 3>::Zero()};
  Scalar home_[2] = {0, 0};  // of the nearest place in range, at rest, along that [m]
};

}  // namespace hapbeam::detail
