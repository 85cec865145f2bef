// How contact asks a model that can be pushed along any direction: a circle on a curve that yields.
//
// The centreline is to lie on the tangent of the circle with radius `reach` around the avatar's centre, at the point where
// the two touch: one push along the normal there.  The beam slides along that tangent while it yields, so the point is
// sought again on the new shape; what it is off by shrinks to a few percent with each push.  Where the beam bends about as
// sharply as the circle that would grow instead of shrinking: the third push follows the secant through the first two.  The
// way that it went in the two ticks before is continued for a first guess, so that a smooth motion takes one push.
// At an end the normal is the way from the end point to the avatar's centre.
// Real-time: noexcept, no allocation; at most most_pushes pushes, which share the model's work for one.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class PushContact {
 public:
  static constexpr int most_pushes = 4;
  /// How far the avatar's centre may be from where the normal points, in units of reach: the relative error of the force.
  static constexpr Scalar near = Scalar(1e-5);
  /// Farther than this after the last push, the contact has not been found.
  static constexpr Scalar far = Scalar(1e-2);

  void begin(const Contact<Scalar>&) noexcept { slid_ = before_ = 0; }

  /// As PressContact::hold(); contact comes back as it is on the new shape.  out_of_range: the circle touches at two points,
  /// and force and shape are those of one.
  template <class Model>
  Held<Scalar> hold(Model& model, Contact<Scalar>& contact, const Vector2<Scalar>& position, Scalar reach,
                    bool, Press<Scalar>& asked) noexcept {
    const Scalar length = model.shape().length(), side = static_cast<Scalar>(contact.side), first = contact.s;
    Scalar s = std::clamp(first + (2 * slid_ - before_), Scalar(0), length);
    Foot foot(model, s, position, side);
    Secant secant;
    bool snapped = false;  // in any of the pushes
    for (int pushed = 1;; ++pushed) {
      const Vector2<Scalar> normal = foot.normal;
      const Scalar d = normal.x() * (position.x() - s) + normal.y() * position.y() - reach;
      const Response<Scalar> response = model.push({s, d, normal, pushed > 1});
      snapped = snapped || response.status == Status::snapped;
      foot = Foot(model, s, position, side);
      asked = {s, foot.point.y()};
      const Scalar off =
          std::max(std::abs(cross(normal, foot.offset)), foot.at_end ? Scalar(0) : std::abs(foot.ahead));
      const bool answer = is_answer(response.status), found = off <= far * reach;
      const bool pulls = response.force > 0 || (answer && response.force == 0);
      // What pulls beside the contact, or on the way to it, may press there.
      if (pulls) return {answer && found ? Hold::released : Hold::lost, 0, response.status};
      if (off <= near * reach || pushed == most_pushes || !answer) {
        const bool lost = answer && !found;
        // Pushed along itself an end has no place on the circle any more: it slips off.
        if (lost && foot.at_end) return {Hold::lost, 0, response.status};
        // A point that was not found says nothing of the way: continued, what it is off by would come back larger.
        before_ = off <= near * reach ? slid_ : s - first;
        slid_ = s - first;
        contact.s = s;
        contact.foot = foot.point;
        contact.normal = foot.normal;
        contact.point = foot.point + foot.normal * (model.thickness() / 2);
        contact.past_end = foot.at_end;
        Status status = snapped && response.status == Status::ok ? Status::snapped : response.status;
        if (status == Status::ok && !foot.at_end && pinched(model.shape(), s, position, reach))
          status = Status::out_of_range;
        return {Hold::pressing, -response.force, lost ? Status::iteration_limit : status};
      }
      const Aim next = secant.after({s + foot.ahead, foot.normal},
                                    {foot.ahead, reach * cross(normal, foot.normal)}, pushed > 1);
      s = std::clamp(next.s, Scalar(0), length);
      foot = Foot(model, s, position, side);
      if (!foot.at_end) foot.normal = next.normal;
    }
  }

 private:
  /// Where a push goes.
  struct Aim {
    Scalar s;                // [m]
    Vector2<Scalar> normal;  // unit
  };

  /// The search for x = g(x), of x = (s, normal), from the last two images g and the residuals g - x: Anderson's mixing
  /// of depth one (J. ACM 12(4), 1965).
  class Secant {
   public:
    Aim after(const Aim& image, const Vector2<Scalar>& residual, bool known) noexcept {
      const Vector2<Scalar> change = residual - residual_;
      Scalar share = known ? residual.dot(change) / change.squaredNorm() : Scalar(0);
      if (!(std::abs(share) < most_share)) share = 0;
      Aim next = image;
      if (share != 0) {
        next.s -= share * (image.s - image_.s);
        next.normal = (image.normal - share * (image.normal - image_.normal)).normalized();
      }
      image_ = image;
      residual_ = residual;
      return next;
    }

   private:
    static constexpr Scalar most_share = 2;  // of the last step that is taken back or taken again
    Aim image_{0, {0, 1}};
    Vector2<Scalar> residual_{0, 0};
  };

  /// Whether the beam beside s lies within the circle, because it bends more sharply there and touches at two points.
  static bool pinched(const Centreline<Scalar>& line, Scalar s, const Vector2<Scalar>& position,
                      Scalar reach) noexcept {
    for (const Scalar way : {-reach / 2, reach / 2}) {
      const Scalar beside = std::clamp(s + way, Scalar(0), line.length());
      const Displacement<Scalar> at = line.at(beside);
      if ((position - Vector2<Scalar>(beside + at.u, at.w)).norm() < (1 - far) * reach) return true;
    }
    return false;
  }

  /// The centreline at s, and the avatar's centre seen from there.
  struct Foot {
    Vector2<Scalar> point, normal, offset;  // [m], unit, [m] from the point to the avatar's centre
    Scalar ahead;                           // [m] of that along the beam
    bool at_end;                            // s is an end that the centre has passed

    template <class Model>
    Foot(const Model& model, Scalar s, const Vector2<Scalar>& position, Scalar side) noexcept {
      using std::cos;
      using std::sin;
      const Displacement<Scalar> at = model.shape().at(s);
      const Vector2<Scalar> along(cos(at.theta), -sin(at.theta));
      point << s + at.u, at.w;
      offset = position - point;
      normal << -side * along.y(), side * along.x();
      ahead = along.dot(offset);
      at_end = (s <= 0 && ahead < 0) || (s >= model.shape().length() && ahead > 0);
      if (at_end && normal.dot(offset) > 0) normal = offset.normalized();
    }
  };

  Scalar slid_ = 0,
         before_ = 0;  // how far the point went while the beam yielded, in the last tick and before [m]
};

}  // namespace hapbeam::detail
