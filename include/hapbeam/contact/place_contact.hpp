// SPDX-License-Identifier: MIT
// A contact that presses one place of the beam, where no push lays the beam on the avatar.
//
// Across: the depth along the normal n is removed by moving the foot point by depth / n_w across the beam, Newton's step for
// depth = 0. With a standing avatar this is exact after a few ticks. Without friction the force acts along n. Its
// transverse component is the model's. The axial one follows from it, and is work-conjugate to a motion of the contact
// along the deformed beam.
//
// Past an end that holds w the hand touches a fixed point. The force has the size of a press by the same depth at the nearest place in
// range. It acts along the line from the end to the avatar's centre. It depends on their distance alone, so a closed path around
// the end gains no work.
// A roller holds w and slides. A touch that begins past it meets the fixed point, too. A touch from inside, whose press
// has drawn the end from under the avatar, has slipped off.
// Real-time: noexcept, no allocation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// What a contact does to the beam.
enum class Mode : std::int8_t {
  apart,    ///< nothing
  inside,   ///< nothing, though the avatar has not left the beam since it was let go
  pushed,   ///< the model finds the place that the avatar touches
  across,   ///< in a plane: one place is pressed across the beam
  support,  ///< as a fixed point past an end that holds w, in space past or beside one
};

/// A contact is found at a place of the beam.   @param foot  of the centreline [m]   @param normal  unit, out of the beam
template <typename Scalar, int D>
void lay(Contact<Scalar, D>& contact, Scalar s, const VectorOf<Scalar, D>& foot,
         const VectorOf<Scalar, D>& normal, Scalar thickness) noexcept {
  contact.s = s, contact.foot = foot, contact.normal = normal;
  contact.point = foot + normal * (thickness / 2);
}

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class PlaceContact {
 public:
  /// The normal's transverse component is taken to be at least this (a slope of 60 degrees): on a steeper piece, or
  /// beside an end, a transverse press can do little against the penetration, and the force along the normal stays below
  /// |F| / least_normal.  A shape that has turned over, of a model far beyond its range, counts as upright: its normal never
  /// points to the other side.
  static constexpr Scalar least_normal = Scalar(0.5);
  /// Of the length.  So near to the end a thin avatar bends the beam more sharply than a mesh can show.
  static constexpr Scalar beside = Scalar(3e-3);

  /// A touch begins.   @param model  before it is touched
  template <class Model>
  void begin(const Model& model) noexcept {
    const Centreline<Scalar> line = model.shape();
    const Range<Scalar> range = model.range();
    ends_[0] = {line[0].u, line.at(range.s_min).w};
    ends_[1] = {line[line.segments()].u, line.at(range.s_max).w};
  }

  /// How the beam is held.   @param before  in the tick before
  template <class Model>
  Mode mode(const Model& model, const Contact<Scalar>& contact, const Avatar<Scalar>& avatar, Scalar reach,
            Mode before) const noexcept {
    const Range<Scalar> range = model.range();
    if (contact.past_end && std::isfinite(contact.s > 0 ? range.right_support : range.left_support))
      return Mode::support;
    // Beside a rigid end, which no push moves, the beam is pressed across, and that ends with its range.
    if (!takes_push<Model> || (before == Mode::across && contact.depth > reach)) return Mode::across;
    const Centreline<Scalar> line = model.shape();
    if (range.nearest({contact.s, 0}).s != contact.s) return Mode::across;
    const Scalar around = (std::max)(reach, beside * line.length());
    const auto within = [&](const CentrelineNode<Scalar>& end, Scalar support) {
      return std::isfinite(support) && avatar.way_from({end.s + end.u, end.w}).norm() < around;
    };
    const bool over =
        within(line[0], range.left_support) || within(line[line.segments()], range.right_support);
    return over ? Mode::across : Mode::pushed;
  }

  /// Whether the end past which the contact is has left its place.   @param slack  of the length
  template <class Model>
  bool slid(const Contact<Scalar>& contact, const Model& model, Scalar slack) const noexcept {
    const Centreline<Scalar> line = model.shape();
    const bool right = contact.s > 0;
    return !(std::abs(line[right ? line.segments() : 0].u - ends_[right].u) <= line.length() * slack);
  }

  /// What presses the beam there.   @param contact  in: on the shape before, out: where it is pressed   @param mode  across | support
  /// @param side  from which the beam is pressed   @param pressing  since the tick before
  /// @param place  out; its normal points out of the beam   @return false where no press touches
  template <class Model>
  bool aim(const Model& model, Contact<Scalar>& contact, const Avatar<Scalar>& avatar, Scalar reach,
           Mode mode, int side, bool pressing, Push<Scalar>& place) noexcept {
    const Scalar up = static_cast<Scalar>(side);
    Scalar d;
    if (mode == Mode::support) {
      if (!contact.touching) return false;
      d = ends_[contact.s > 0].w - up * contact.depth;
      factor_ = 1;
    } else {
      if (pressing) smooth_kink(model, contact, avatar.position, reach);
      if (!rise_to_touch(contact, avatar.position, reach, up, d)) return false;
      d += contact.foot.y();
      const Scalar n_w = up * contact.normal.y();
      if (n_w < 0) contact.normal = {contact.normal.x() < 0 ? Scalar(-1) : Scalar(1), 0};
      factor_ = 1 / (std::max)(n_w, least_normal);
    }
    place = {contact.s, up * d, {0, up}};
    return true;
  }
  /// The force along the contact's normal, in units of that along the place's.
  Scalar factor() const noexcept { return factor_; }

 private:
  struct End {
    Scalar u;  // of the end [m]
    Scalar w;  // of the nearest place in range [m]
  };

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
    const Vector2<Scalar> offset = position - control_point(right, 0);
    const Vector2<Scalar> mean = (before + after).normalized();
    const Scalar shift = offset.dot(mean), kink = cross(before, after);
    if (!(std::abs(shift) <= std::abs(kink) * offset.norm())) return;
    const Scalar side = static_cast<Scalar>(contact.side);
    lay(contact, std::clamp(line[node].s + shift, line[node - 1].s, line[node + 1].s),
        Vector2<Scalar>(position - offset + shift * mean), Vector2<Scalar>(-side * mean.y(), side * mean.x()),
        model.thickness());
    contact.depth = reach - offset.dot(contact.normal);
    contact.touching = contact.depth > 0;
  }

  /// How far the foot point has to move across the beam [m]; false where no transverse motion can touch.  Past an end
  /// it also turns the normal to where the end point will touch the disc.
  static bool rise_to_touch(Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar reach,
                            Scalar up, Scalar& rise) noexcept {
    rise = -up * contact.depth / (std::max)(up * contact.normal.y(), least_normal);
    if (!contact.past_end) return true;
    // Exactly: the end point moves onto the circle around the avatar's centre.
    const Vector2<Scalar> offset = position - contact.foot;
    if (!(std::abs(offset.x()) < reach)) return false;
    const Scalar above = up * std::sqrt((reach - offset.x()) * (reach + offset.x()));
    rise = offset.y() - above;
    contact.normal = {offset.x() / reach, above / reach};
    return true;
  }

  End ends_[2] = {{0, 0}, {0, 0}};
  Scalar factor_ = 1;
};

/// An end of a rod in space that is held does not move, nor does much beside it: a contact that is deeper there than σ²/6 reach, at
/// the distance σ from the end, bends the rod half as sharply as the avatar, 3d/σ², and a hand soon more so than a mesh can show.  There
/// the rod counts as it lay before the touch: it is pushed across by a little of that distance, and deeper contacts take as many
/// times the force.
template <typename Scalar>
class PlaceContact<Scalar, 3> {
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

  template <class Model>
  Mode mode(const Model& model, const Contact<Scalar, 3>& contact, const Avatar<Scalar, 3>& avatar,
            Scalar reach, Mode) noexcept {
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
      return Mode::support;
    }
    return Mode::pushed;
  }

  template <class Model>
  static bool slid(const Contact<Scalar, 3>&, const Model&, Scalar) noexcept {
    return false;
  }

  template <class Model>
  bool aim(const Model& model, Contact<Scalar, 3>& contact, const Avatar<Scalar, 3>&, Scalar, Mode, int, bool,
           Push<Scalar, 3>& place) noexcept {
    contact.touching = depth_ > 0;
    if (!contact.touching) return false;
    const Range<Scalar> range = model.range();
    const Scalar s = right_ ? range.right_support - distance_ : range.left_support + distance_,
                 depth = (std::min)(depth_, distance_ / 20);
    const Vector side = normal_ - tangent_ * tangent_.dot(normal_),
                 across = side.squaredNorm() > Scalar(0.01)
                              ? detail::unit(side)
                              : detail::across(ends_[right_].director, tangent_);
    place = {s, across.dot(foot_) - depth, across};
    factor_ = depth_ / depth;
    lay(contact, s, foot_, normal_, model.thickness());
    contact.depth = depth_;
    return true;
  }
  Scalar factor() const noexcept { return factor_; }

 private:
  struct End {
    CubicSegment<Scalar, 3> piece;  // from the end inward, before the touch
    Scalar length;                  // of it [m]
    Vector director;
  };

  End ends_[2] = {};
  bool right_ = false;
  Scalar factor_ = 1, distance_ = 0, depth_ = 0;  // of the last contact, from the end and into the rod [m]
  Vector tangent_ = Vector::Zero(), normal_ = Vector::Zero(), foot_ = Vector::Zero();
};

}  // namespace hapbeam::detail
