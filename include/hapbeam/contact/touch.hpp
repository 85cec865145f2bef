// From the hand's position to the force on the hand: contact, press and unilateral law, one call a tick.
//
// Knows the ForceModel contract and no particular model.  Each tick finds the contact on the shape of the
// last press and asks the model for the displacement that would just end the penetration: along the normal n
// the depth is closed by moving the foot point by depth / n_w across the beam, Newton's step for depth = 0.
// A resting avatar is therefore met exactly after a few ticks.  Without friction the force acts along n, and
// its transverse component is the model's; the axial one follows (it is the work-conjugate of moving the
// contact along the deformed beam).
// Allocates and throws in its constructor only.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What one tick says.
template <typename Scalar>
struct TouchResult {
  Vector2<Scalar> force = Vector2<Scalar>::Zero();  ///< [N] on the hand, (along x, along w); always finite
  Status status = Status::ok;  ///< of the press; invalid_request for a position that is not finite
  bool pressing = false;       ///< the hand holds the beam; read this, not contact.touching
  Contact<Scalar>
      contact;  ///< on the shape before this tick's press; segment -1: out of reach, or not finite
  Press<Scalar> press{0, 0};  ///< what was asked of the model; zero where nothing was
};

/// One avatar on one beam.  Between ticks the model may be read by others but pressed by nobody else.
template <typename Model>
class Touch {
  static_assert(
      is_force_model<Model>,
      "Touch<Model>: Model must offer press(const Press<Scalar>&), shape(), range(), thickness() and reset() "
      "as listed in hapbeam/force_model.hpp, each noexcept");

 public:
  using Scalar = typename Model::Scalar;

  /// The normal's transverse component is taken to be at least this (a slope of 60 degrees): on a steeper
  /// piece, or beside an end, a transverse press can do little against the penetration, and the force along
  /// the normal stays below |F| / least_normal.
  static constexpr Scalar least_normal = Scalar(0.5);

  /// @param model   kept by reference   @param avatar_radius  [m]
  /// Allocates.   @throws std::invalid_argument unless avatar_radius is finite and not negative
  Touch(Model& model, Scalar avatar_radius)
      : model_(model), avatar_radius_(avatar_radius), volumes_(model.shape().segments()) {
    if (!(avatar_radius >= 0 && std::isfinite(avatar_radius)))
      throw std::invalid_argument("avatar_radius = " + std::to_string(avatar_radius) +
                                  " m: must be finite and not negative");
    reset();
  }

  /// Lets go of the beam and forgets where the hand was.
  /// Real-time: as Model::reset, and O(n).
  void reset() noexcept {
    memory_ = {};
    release();
  }

  /// One tick.
  /// @param position  [m] centre of the avatar
  /// Real-time: noexcept, no allocation, bounded: at most one press, and none without contact.
  [[nodiscard]] TouchResult<Scalar> tick(const Vector2<Scalar>& position) noexcept {
    TouchResult<Scalar> result;
    Contact<Scalar>& contact = result.contact;
    const Avatar<Scalar> avatar{position, avatar_radius_};
    if (!pressing_ && out_of_reach(avatar, volumes_, model_.thickness(), memory_)) return result;
    // A pressed beam moves with the hand, which cannot have gone round its end.  Only a beam that has stopped at the
    // end of its range can be passed, and that must not turn the press into one from the other side.
    if (pressing_) memory_.touching = memory_.through = true, memory_.side = side_;
    contact = find_contact(avatar, model_.shape(), volumes_, model_.thickness(), memory_);
    if (contact.segment < 0) {
      result.status = Status::invalid_request;
      result.pressing = pressing_;
      return result;
    }
    if (pressing_) smooth_kink(contact, position);
    // A pressed beam follows a hand that draws back, until it would have to pull.
    if (!contact.touching && !pressing_) return result;

    if (!pressing_) side_ = contact.side, up_ = contact.normal.y() < 0 ? Scalar(-1) : Scalar(1);
    Scalar rise;
    if (!rise_to_touch(contact, position, rise)) {
      release();
      return result;
    }
    result.press = {contact.s, contact.foot.y() + rise};
    const Response<Scalar> response = model_.press(result.press);
    result.status = response.status;

    const Scalar n_w = contact.normal.y();
    if (response.force * n_w > 0 || (response.force == 0 && is_answer(response.status))) {
      release();
      return result;
    }
    volumes_.refit(model_.shape());
    pressing_ = true;
    result.pressing = true;
    const Scalar steepness = std::max(std::abs(n_w), least_normal);
    const Scalar force = std::abs(response.force) / steepness;
    if (std::isfinite(force)) result.force = contact.normal * force;
    else result.status = Status::non_finite;
    return result;
  }

  [[nodiscard]] bool pressing() const noexcept { return pressing_; }

 private:
  /// Axial strain is constant in each piece, so the centreline has a small kink at the pressed node, and a
  /// disc in it touches both flanks.  Nearest is now one, now the other, and the force would never come to
  /// rest.  As near to a node as its kink matters, the contact is therefore taken on the node's mean tangent.
  void smooth_kink(Contact<Scalar>& contact, const Vector2<Scalar>& position) const noexcept {
    const Centreline<Scalar> line = model_.shape();
    const int i = contact.segment;
    const int node = contact.s - line[i].s < line[i + 1].s - contact.s ? i : i + 1;
    if (contact.past_end || node == 0 || node == line.segments()) return;
    const CubicSegment<Scalar> right = line.segment(node);
    const Vector2<Scalar> before = tangent(line.segment(node - 1), Scalar(1)).normalized();
    const Vector2<Scalar> after = tangent(right, Scalar(0)).normalized();
    const Vector2<Scalar> offset = position - right.col(0);
    const Vector2<Scalar> mean = (before + after).normalized();
    const Scalar shift = offset.dot(mean), kink = cross(before, after);
    if (!(std::abs(shift) <= std::abs(kink) * offset.norm())) return;
    const Scalar side = static_cast<Scalar>(contact.side);
    contact.s = std::clamp(line[node].s + shift, line[node - 1].s, line[node + 1].s);
    contact.foot = position - offset + shift * mean;
    contact.normal << -side * mean.y(), side * mean.x();
    contact.point = contact.foot + contact.normal * (model_.thickness() / 2);
    contact.depth = avatar_radius_ + model_.thickness() / 2 - offset.dot(contact.normal);
    contact.touching = contact.depth > 0;
  }

  /// How far the foot point has to move across the beam [m]; false where no transverse motion can touch.  Past an end
  /// it also turns the normal to where the end point will touch the disc.
  bool rise_to_touch(Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar& rise) const noexcept {
    if (contact.past_end) {  // exactly: the end point moves onto the circle around the avatar's centre
      const Vector2<Scalar> offset = position - contact.foot;
      const Scalar reach = avatar_radius_ + model_.thickness() / 2;
      if (!(std::abs(offset.x()) < reach)) return false;
      const Scalar above = up_ * std::sqrt((reach - offset.x()) * (reach + offset.x()));
      rise = offset.y() - above;
      contact.normal << offset.x() / reach, above / reach;
      return true;
    }
    rise = -up_ * contact.depth / std::max(std::abs(contact.normal.y()), least_normal);
    return true;
  }

  /// The beam springs back to the shape that it has untouched.
  void release() noexcept {
    model_.reset();
    volumes_.refit(model_.shape());
    pressing_ = false;
  }

  Model& model_;
  Scalar avatar_radius_;
  BoundingVolumes<Scalar> volumes_;
  ContactMemory<Scalar> memory_;
  bool pressing_ = false;
  int side_ = 1;   // of the press, as Contact::side
  Scalar up_ = 1;  // sign of w on that side
};

}  // namespace hapbeam
