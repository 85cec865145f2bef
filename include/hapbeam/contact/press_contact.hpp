// SPDX-License-Identifier: MIT
// Contact by a model that is pressed across the beam.
//
// The depth along the normal n is removed by moving the foot point by depth / n_w across the beam, Newton's step for
// depth = 0. With a standing avatar this is exact after a few ticks. Without friction the force acts along n. Its
// transverse component is the model's. The axial one follows from it, and is work-conjugate to a motion of the contact
// along the deformed beam.
// Real-time: noexcept, no allocation; one press.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>

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

template <typename Scalar>
class PressContact {
 public:
  /// The normal's transverse component is taken to be at least this (a slope of 60 degrees): on a steeper piece, or
  /// beside an end, a transverse press can do little against the penetration, and the force along the normal stays below
  /// |F| / least_normal.  A shape that has turned over, of a model far beyond its range, counts as upright: its normal never
  /// points to the other side.
  static constexpr Scalar least_normal = Scalar(0.5);

  void begin(const Contact<Scalar>& contact) noexcept { up_ = static_cast<Scalar>(contact.side); }

  /// @param contact  in: on the shape before, out: where it was pressed   @param pressing  since the tick before
  /// @param reach  [m] from the avatar's centre to the centreline   @param asked  out: what was asked of the model
  template <class Model>
  Held<Scalar> hold(Model& model, Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar reach,
                    bool pressing, Press<Scalar>& asked) const noexcept {
    if (!aim(model, contact, position, reach, pressing, asked)) return {Hold::released, 0, Status::ok};
    const Response<Scalar> response = model.press(asked);
    const Scalar force = -up_ * response.force * along_normal(contact);
    const bool answer = is_answer(response.status);
    if (force < 0 || (answer && force == 0))
      return {answer ? Hold::released : Hold::lost, 0, response.status};
    return {Hold::pressing, force, response.status};
  }

  /// What is asked of the model.   @return false where no press touches
  template <class Model>
  bool aim(const Model& model, Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar reach,
           bool pressing, Press<Scalar>& asked) const noexcept {
    if (pressing) smooth_kink(model, contact, position, reach);
    Scalar rise;
    if (!rise_to_touch(contact, position, reach, rise)) return false;
    asked = {contact.s, contact.foot.y() + rise};
    return true;
  }
  /// The force along the normal, in units of that across the beam.  @param contact  in and out: its normal never points to the other side
  Scalar along_normal(Contact<Scalar>& contact) const noexcept {
    const Scalar n_w = up_ * contact.normal.y();
    if (n_w < 0) contact.normal = {contact.normal.x() < 0 ? Scalar(-1) : Scalar(1), 0};
    return 1 / (std::max)(n_w, least_normal);
  }

 private:
  /// Axial strain is constant in each piece, so the centreline has a small kink at the pressed node, and a
  /// disc in it touches both flanks.  Nearest is now one, now the other, and the force would never come to
  /// rest.  As near to a node as its kink matters, the contact is therefore taken on the node's mean tangent.
  template <class Model>
  static void smooth_kink(const Model& model, Contact<Scalar>& contact, const Vector2<Scalar>& position,
                          Scalar reach) noexcept {
    const CentrelinePart<Scalar> piece = part_of(model, contact.s, contact.s);
    const int i = contact.segment - piece.first;
    const Scalar before_it = contact.s - piece.line[i].s, after_it = piece.line[i + 1].s - contact.s;
    const int nearer = before_it < after_it ? 0 : 1;
    if (contact.past_end || contact.segment + nearer == 0 || contact.segment + nearer == piece.segments)
      return;
    const Scalar s = piece.line[i + nearer].s;
    const CentrelinePart<Scalar> part = part_of(model, s, s);
    const Centreline<Scalar>& line = part.line;
    const int node = contact.segment + nearer - part.first;
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
    contact.normal = {-side * mean.y(), side * mean.x()};
    contact.point = contact.foot + contact.normal * (model.thickness() / 2);
    contact.depth = reach - offset.dot(contact.normal);
    contact.touching = contact.depth > 0;
  }

  /// How far the foot point has to move across the beam [m]; false where no transverse motion can touch.  Past an end
  /// it also turns the normal to where the end point will touch the disc.
  bool rise_to_touch(Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar reach,
                     Scalar& rise) const noexcept {
    if (contact.past_end) {  // exactly: the end point moves onto the circle around the avatar's centre
      const Vector2<Scalar> offset = position - contact.foot;
      if (!(std::abs(offset.x()) < reach)) return false;
      const Scalar above = up_ * std::sqrt((reach - offset.x()) * (reach + offset.x()));
      rise = offset.y() - above;
      contact.normal = {offset.x() / reach, above / reach};
      return true;
    }
    rise = -up_ * contact.depth / (std::max)(up_ * contact.normal.y(), least_normal);
    return true;
  }

  Scalar up_ = 1;  // sign of w on the side that is pressed
};

}  // namespace hapbeam::detail
