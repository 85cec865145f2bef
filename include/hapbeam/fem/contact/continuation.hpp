// SPDX-License-Identifier: MIT
// Whether an answer continues the last one: by the balance of energy.
//
//   V - V before = W - D        W: what the hands gave (contact_work.hpp), D: what friction has taken
//
// holds to third order of the step on one branch of equilibria.  Newton's method may land on another one, stable and with all pivots positive.  The energy is
// another there, and the beam has gone farther than the hand.
// Such an answer is sought again in halves and quarters of the hand's way, each from the one before.  The trapezoids' error falls by eight with each half.
// A rod slips off the top of a ball to either side with the same energy.  So an answer whose normal has turned far is sought in parts, too.  So is one whose
// force is far from a straight line over the way: a shank that is pushed along itself may have buckled to either side.  What is still so in a quarter stays.
// What is off in a quarter still has snapped.
// Real-time: noexcept, no allocation, O(1) but for the answers that are sought again: at most eight times, and the linear solves of AllDisplacements in all.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// What the energy says of an answer.
enum class Branch {
  same,    ///< the last one's
  unsure,  ///< the last one's, or another one with much the same energy
  other    ///< another one
};

/// An answer, as it is judged.
template <typename Scalar>
struct Continued {
  Scalar potential;     ///< V [J]
  Scalar given;         ///< W - D [J]
  Scalar size, change;  ///< of the work's parts before and now: the sum and the difference, without signs [J]
  Scalar strain;        ///< strain energy [J]
  Scalar length, way;   ///< of the beam, and how far the hand has gone [m]
  bool rough = false;   ///< friction has its part, of which less is known
  bool turned = false;  ///< in space: by 10 degrees, the normal of a body
};

/// What is known of a beam as hands let go of it.
template <typename Scalar>
struct LetGo {
  Scalar potential = 0;  ///< V when they last touched it [J]
  Scalar given = 0;      ///< what their forces of then give over their way [J]
  Scalar rubbed = 0;     ///< what friction may have taken on that [J]
  Scalar strain = 0;     ///< strain energy [J]
  bool known = false;

  /// Whether it has fallen to where it is now.  A hand that draws back gives or takes a part of what its last force would, which falls to zero.
  bool fell(Scalar now) const noexcept {
    const Scalar rest = now - potential,
                 off = (std::max)(rest - (std::max)(given, Scalar(0)), (std::min)(given, Scalar(0)) - rest);
    return known && off > rubbed + strain / 100;
  }
};

/// On the way from one place of a body to the next.  @param t  0 to 1
template <typename Scalar>
Circle<Scalar> between(const Circle<Scalar>& from, const Circle<Scalar>& to, Scalar t) noexcept {
  if (t >= 1) return to;
  const Scalar u = 1 - t;
  return {u * from.s + t * to.s, u * from.centre + t * to.centre, u * from.reach + t * to.reach, to.side};
}
template <typename Scalar>
Capsule<Scalar> between(const Capsule<Scalar>& from, const Capsule<Scalar>& to, Scalar t) noexcept {
  if (t >= 1) return to;
  const Scalar u = 1 - t;
  return {u * from.s + t * to.s,
          {u * from.axis.tip + t * to.axis.tip, u * from.axis.way + t * to.axis.way},
          u * from.reach + t * to.reach,
          to.normal};
}
/// Of two normals less than a right angle apart.
template <typename Scalar, int D>
Push<Scalar, D> between(const Push<Scalar, D>& from, const Push<Scalar, D>& to, Scalar t) noexcept {
  if (t >= 1) return to;
  const Scalar u = 1 - t;
  return {u * from.s + t * to.s, u * from.d + t * to.d, (u * from.normal + t * to.normal).normalized()};
}

/// How far any of some places has gone from one shape to another [m].
template <class Centreline>
auto farthest(const Centreline& from, const Centreline& to) noexcept {
  using Scalar = decltype(to.length());
  constexpr int places = 16;
  Scalar most = 0;
  for (int i = 0; i <= places; ++i) {
    const Scalar s = to.length() * static_cast<Scalar>(i) / places;
    most = (std::max)(most, (to.position(s) - from.position(s)).squaredNorm());
  }
  return std::sqrt(most);
}

template <typename Scalar>
class Continuation {
 public:
  /// Of the hand's way in a tick that is the shortest to be tried.
  static constexpr Scalar shortest = Scalar(0.25);

  void forget() noexcept { known_ = snapped_ = false; }
  bool known() const noexcept { return known_; }
  /// V of the answer to continue [J].
  Scalar potential() const noexcept { return stored_; }
  /// An answer to continue.  @param potential  V [J]
  void know(Scalar potential) noexcept { stored_ = potential, known_ = true; }

  /// @param how_far  () -> how far any place of the beam has gone [m]
  template <class HowFar>
  Branch judge(const Continued<Scalar>& now, HowFar&& how_far) const noexcept {
    if (!known_) return Branch::same;
    const Scalar rest = now.potential - stored_ - now.given,
                 off = std::abs(rest) - (now.rough ? little_rough : little) * now.strain;
    // A longer way is no hand's in a tick, and its force may be any line.
    const bool bent = !now.rough && now.way < now.length / 100 && off > most_bent * now.size,
               unsure = now.turned || bent;
    const Branch beside = unsure ? Branch::unsure : Branch::same;
    if (off <= now.change / 2 + now.size / 40) return beside;
    if (how_far() <= along * now.way + now.length / 1000) return beside;
    return Branch::other;
  }

  /// Goes from the last request to the next.  A snap on the way to where there is no answer is told with the next one.
  /// @param go  t in (0, 1] of the way -> status of its answer   @param judge  () -> Branch   @param keep  (status): the answer is to be continued
  /// @param back  (): to where go() began   @return status of the last answer
  template <class Go, class Judge, class Keep, class Back>
  Status follow(Go&& go, Judge&& judge, Keep&& keep, Back&& back) noexcept {
    bool snapped = snapped_;
    snapped_ = false;
    Scalar t = 0, step = 1;
    for (;;) {
      const Status status = go(t + step);
      const Branch branch = status == Status::ok ? judge() : Branch::same;
      if (branch != Branch::same && step > shortest) {
        back();
        step /= 2;
        continue;
      }
      snapped = snapped || branch == Branch::other || status == Status::snapped;
      keep(status);
      t += step;
      if (!is_answer(status)) {
        snapped_ = snapped;
        return status;
      }
      if (t >= 1) return snapped && status == Status::ok ? Status::snapped : status;
      step = (std::min)(2 * step, 1 - t);
    }
  }

 private:
  // Of the strain energy: what solvers leave, without and with friction.
  static constexpr Scalar little = Scalar(1e-4), little_rough = Scalar(1e-3);
  static constexpr Scalar most_bent =
      Scalar(0.1);                    // of the work's parts: a cube that doubles its way is off by 0.08
  static constexpr Scalar along = 2;  // times as far as the hand a beam goes with it

  Scalar stored_ = 0;
  bool known_ = false, snapped_ = false;
};

}  // namespace hapbeam::detail
