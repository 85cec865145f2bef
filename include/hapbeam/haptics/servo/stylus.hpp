// SPDX-License-Identifier: MIT
// A stylus that touches with all of its shaft: the avatar is a capsule that turns with the hand, and what presses on it at a
// distance from the hand turns the hand.
//
//   tip   p - ahead z        other end   tip + length z        z: the axis of the stylus, from the tip to the hand
//   τ = (c - p) × F                                            p: where the device's position is, c: where rod and capsule touch
//
// What the coupling ties to the hand is the point of the capsule's axis beside the contact, which turns with the hand.  It moves the
// capsule along the normal of the contact and does not turn it.
// Real-time: no allocation, noexcept, wait-free; as the coupling's tick and O(1).
#pragma once

#include <type_traits>
#include <utility>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// The capsule that touches a rod, in metres of the scene; a sphere at the device's position by default.
struct StylusOptions {
  double length = 0;  ///< [m] of the axis, not negative
  double ahead = 0;   ///< [m] of its tip before the device's position, where the gimbal turns
};

namespace detail {

/// @throws std::invalid_argument as Touch, and where the touch of such a model has no friction and one is asked for
template <typename Model, typename Scalar>
Touch<Model> make_touch(Model& model, Scalar radius, const Friction& friction) {
  if constexpr (std::is_constructible_v<Touch<Model>, Model&, Scalar, const Friction&>) {
    return Touch<Model>(model, radius, friction);
  } else {
    friction.check();
    if (!friction.none()) reject("friction", friction.sticking, "", "0 for this model: see docs/contact.md");
    return Touch<Model>(model, radius);
  }
}

/// A touch whose avatar is a capsule with a place and a direction of its own in each tick.
template <class Touch>
struct CapsuleTouch {
  using Scalar = typename Touch::Scalar;
  static constexpr int dimension = 3;
  using Vector = VectorOf<Scalar, 3>;

  Touch& touch;
  Vector tip, shaft;     // from the tied point to the tip, from there to the other end [m]
  Eigen::Vector3d tied;  // from the hand to the tied point [m]

  /// @param figures  time and coupling, of a touch that takes them
  template <typename... Figures>
  auto tick(const Vector& hand, Figures... figures) noexcept {
    return touch.tick(Vector(hand + tip), figures..., shaft);
  }
  template <class T = Touch>
  Meanwhile<const T> meanwhile() const noexcept {
    return touch.meanwhile();
  }
  template <class T = Touch>
  Stored<const T> stored() const noexcept {
    return touch.stored();
  }
  const auto& off() const noexcept { return touch.off(); }
  auto contact_at(const Vector& hand) noexcept { return touch.contact_at(Vector(hand + tip), shaft); }
  /// From the hand to the contact [m].   @param at  where the tied point is
  template <class Felt>
  Eigen::Vector3d arm(const Felt& felt, const Eigen::Vector3d& at) const noexcept {
    return in_scene(felt.contact.foot) - (at - tied);
  }
  double lever(const TouchResult<Scalar, 3>& felt, const Eigen::Vector3d& at) const noexcept {
    return cross3<double>(arm(felt, at), in_scene(felt.contact.normal)).norm();
  }
};

template <typename Coupling>
using Move = decltype(std::declval<Coupling&>().move(std::declval<const Eigen::Vector3d&>()));

/// @tparam D  of the space in which the beam bends: 2, where no shaft touches it, or 3
template <typename Scalar, int D>
class Stylus {
 public:
  explicit Stylus(const StylusOptions& options) : o_(options) {
    not_negative("stylus length", o_.length, "m");
    finite("stylus ahead", o_.ahead, "m");
    if (D == 2 && (o_.length != 0 || o_.ahead != 0))
      reject("stylus length", o_.length, "m", "0 for a beam in a plane, as ahead");
  }

  void reset() noexcept { tied_.setZero(), arm_.setZero(); }

  /// From its tip to its other end, as it is turned [m].
  Eigen::Vector3d shaft(const HandPose& hand) const noexcept { return o_.length * hand.turn.col(2); }
  /// From the hand to its tip [m].
  Eigen::Vector3d tip(const HandPose& hand) const noexcept { return -o_.ahead * hand.turn.col(2); }

  /// One tick of the coupling with a capsule.   @return with the torque on the hand
  template <class Coupling, class Touch>
  CoupledForce<Scalar, 3> tick(Coupling& coupling, Touch& touch, const HandPose& hand, double dt) noexcept {
    const Eigen::Vector3d tied = hand.turn * tied_;
    const Shaft<double> axis{tip(hand), shaft(hand)};
    CapsuleTouch<Touch> capsule{touch, (axis.tip - tied).template cast<Scalar>(),
                                axis.way.template cast<Scalar>(), tied};
    CoupledForce<Scalar, 3> felt{coupling.tick(capsule, hand.place + tied, dt)};
    // Without an answer of this tick the force goes on along the line on which it was.
    const auto& contact = felt.touch.contact;
    if (felt.touch.pressing && !felt.continued && contact.segment >= 0) {
      arm_ = capsule.arm(felt.touch, felt.avatar);
      if constexpr (offers<Move, Coupling>) {
        const Eigen::Vector3d now = axis.at(axis.nearest(arm_));
        coupling.move(now - tied);
        tied_ = hand.turn.transpose() * now;
      }
    }
    felt.avatar -= tied;
    felt.torque = cross3<double>(arm_, felt.force);
    if (!felt.torque.allFinite() || !tied_.allFinite()) {
      felt.force.setZero(), felt.torque.setZero();
      coupling.reset(), reset();
    } else if (!felt.touch.pressing && felt.force.isZero(0)) {
      reset();
    }
    return felt;
  }

 private:
  StylusOptions o_;
  Eigen::Vector3d tied_{0, 0, 0};  // from the hand to the tied point, in the stylus' axes [m]
  Eigen::Vector3d arm_{0, 0, 0};   // from the hand to the contact, in the scene [m]
};

}  // namespace detail

}  // namespace hapbeam
