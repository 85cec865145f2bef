// SPDX-License-Identifier: MIT
// The connection of hand and beam: direct, or a virtual coupling, a spring and a damper that the device can render.
//
//   a coupling C
//   c.tick(touch, hand, dt)   CoupledForce   noexcept, no allocation; calls touch.tick() once and returns its result; dt [s] since the
//                                            tick before, positive
//   c.in_scene(scale)     C              noexcept; the same between positions in metres of a scene, `scale` of them to
//                                        one of the device's
//   C::for_device(info, delay_ticks)   C   its default; may throw std::invalid_argument
//   c.reset()             void           noexcept; no contact
//
// A coupling of a hand that turns takes a HandPose, and may return a torque.
// Touch is Touch<Model>, or a class with its tick(position) and contact_at(position).
//
// VirtualCoupling: the hand h does not press the beam itself.  A massless point p, the avatar, presses it, and a spring K and a damper B tie h to p:
//
//   K g + B g' = f(p),   p = h + n g,   g >= 0        n: normal of the contact, f: the beam's force along it
//
// It is solved by backward Euler in g, with f continued along its tangent: once before the press, for the place of p, and once after it,
// for the force.  Off the beam p returns to h within B/K, without a force.  Across n, p moves with the hand.
// The shaft of a stylus, at a lever ρ, turns the hand.  A spring K_r and a damper B_r about the hand are then in series with K and B: 1/K
// becomes 1/K + ρ²/K_r, and 1/B likewise.
// With friction the surface of the avatar has a spring and a damper of the same figures along the beam, within the model's equilibrium.
// A beam with mass is touched through K and B within the steps of its model (touch_in_motion.hpp), and no tangent is needed.
//
// If the model exhausts its budget, the last valid force is continued along its tangent (contact_tangent.hpp). With any
// other failure the force is zero. In both cases the status is touch.status.
// Real-time: no allocation, noexcept, wait-free; as touch.tick() and O(1).
// Source: Colgate, Stanley and Brown, "Issues in the haptic display of tool use", IROS 1995; the massless
// point is Zilles and Salisbury's god-object, IROS 1995.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>
#include <hapbeam/haptics/stability/coupling_limits.hpp>

namespace hapbeam {

/// The result of a tick.
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D = 2>
struct CoupledForce {
  VectorOf<double, D> force = VectorOf<double, D>::Zero();   ///< [N] on the hand; always finite
  VectorOf<double, D> avatar = VectorOf<double, D>::Zero();  ///< [m] from where the beam was pressed
  bool continued = false;  ///< along the tangent: the model had no answer, or the beam was missed
  /// [J] that beam and coupling would give back, in metres of the scene; of a beam with mass without contact, too
  double energy = 0;
  TouchResult<Scalar, D> touch;     ///< the response of the beam
  Eigen::Vector3d torque{0, 0, 0};  ///< [N·m] about a hand that turns; always finite
};

/// Where a hand is in the scene, and how it is turned.
struct HandPose {
  Eigen::Vector3d place{0, 0, 0};                      ///< [m]
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the stylus' axes, a rotation
};

namespace detail {

/// Where the hand of a touch is [m].
template <typename Touch>
using HandOf = VectorOf<double, dimension_of<Touch>>;
template <typename Touch>
using CoupledForceOf = CoupledForce<typename Touch::Scalar, dimension_of<Touch>>;

// What a touch may offer.

template <typename Touch>
using Rough = decltype(std::declval<Touch&>().rough());  ///< friction
template <typename Touch>
using Lever = decltype(&Touch::lever);  ///< ρ [m], by which it turns the hand
/// Others press its beam between its ticks, and it says with what force they leave it.
template <typename Touch>
using Meanwhile = decltype(std::declval<Touch&>().meanwhile());
/// It takes the figures of the coupling, and solves for hand and beam together.
template <typename Touch>
using Stored = decltype(std::declval<Touch&>().stored());

/// What others have changed since the last tick.
template <typename Touch>
void look_at_others(const Touch& touch, LastResponse& last) noexcept {
  if constexpr (offers<Meanwhile, Touch>)
    if (const auto* const force = touch.meanwhile()) last.renew(in_scene(*force));
}

/// Whether others have taken the hand off, as its loop stood still: it engages anew.
template <typename Touch>
bool was_lifted(const Touch& touch) noexcept {
  if constexpr (offers<Meanwhile, Touch>) return touch.lifted();
  else return false;
}

/// A beam to call a coupling with.
struct AnyTouch {
  using Scalar = double;
  TouchResult<double> tick(const Vector2<double>&) noexcept;
  Contact<double> contact_at(const Vector2<double>&) const noexcept;
};

// Signatures alone, to be called with null pointers.
template <typename C>
auto as_coupling(C* c, const C* same, AnyTouch* touch, const Vector2<double>* hand, const DeviceInfo* info)
    -> std::bool_constant<noexcept(c->tick(*touch, *hand,
                                           0.0)) && noexcept(same->in_scene(1.0)) && noexcept(c->reset()) &&
                          std::is_same_v<decltype(c->tick(*touch, *hand, 0.0)), CoupledForce<double>> &&
                          std::is_same_v<decltype(same->in_scene(1.0)), C> &&
                          std::is_same_v<decltype(C::for_device(*info, 0)), C>>;
template <typename>
std::false_type as_coupling(...);

template <typename C, typename Touch>
using TickWithPose = std::enable_if_t<noexcept(
    std::declval<C&>().tick(std::declval<Touch&>(), std::declval<const HandPose&>(), 0.0))>;
/// Whether a coupling takes the orientation of the hand.
template <typename C, typename Touch>
inline constexpr bool couples_pose = offers<TickWithPose, C, Touch>;

}  // namespace detail

/// True where C fulfils the contract above, every noexcept included.
template <typename C>
inline constexpr bool is_coupling =
    decltype(detail::as_coupling<C>(nullptr, nullptr, nullptr, nullptr, nullptr))::value;

/// The hand presses the beam itself.  A beam that is stiffer than the device can render is unstable: steel buzzes near a support.
class Direct {
 public:
  /// @throws std::invalid_argument as DeviceInfo::check()
  static Direct for_device(const DeviceInfo& device, int) {
    device.check();
    return {};
  }
  Direct in_scene(double) const noexcept { return *this; }
  void reset() noexcept { last_.forget(); }
  void move(const Eigen::Vector3d& by) noexcept { last_.move(by); }

  /// @param touch  of the same beam each tick   @param hand [m]
  template <typename Touch>
  [[nodiscard]] auto tick(Touch& touch, const detail::HandOf<Touch>& hand, double) noexcept {
    static_assert(!detail::offers<detail::Stored, Touch>,
                  "a beam with mass is touched through a VirtualCoupling");
    constexpr int D = dimension_of<Touch>;
    detail::CoupledForceOf<Touch> result;
    detail::look_at_others(touch, last_);
    result.avatar = hand;
    result.touch = touch.tick(hand.template cast<typename Touch::Scalar>());
    last_.learn(result.touch, detail::in_scene(hand));
    // The contact was sought at the hand itself: no contact is a valid answer.
    if (is_answer(result.touch.status) && !result.touch.pressing) last_.forget();
    result.continued = last_.continued();
    if (result.continued)
      result.force = detail::of_beam<double, D>(
          last_.tangent().normal() * (std::max)(0.0, last_.tangent().force_at(detail::in_scene(hand))));
    else if (is_answer(result.touch.status)) result.force = result.touch.force.template cast<double>();
    if (!result.force.allFinite()) result.force.setZero();
    else if (!result.force.isZero(0)) result.energy = last_.tangent().energy();
    return result;
  }

 private:
  LastResponse last_;
};

class VirtualCoupling {
 public:
  /// @param figures  K [N/m] and B [N·s/m]
  /// @throws std::invalid_argument unless K is positive, B not negative and both finite
  explicit VirtualCoupling(const CouplingFigures& figures)
      : straight_(detail::checked(figures, "coupling", "N/m", "N·s/m")), now_(straight_) {}
  /// @param turning  K_r [N·m/rad] and B_r [N·m·s/rad] about the hand   @throws as above
  VirtualCoupling(const CouplingFigures& figures, const CouplingFigures& turning) : VirtualCoupling(figures) {
    turning_ = detail::checked(turning, "turning coupling", "N·m/rad", "N·m·s/rad");
  }
  /// The largest figures that the device can render, with the margin of safe_coupling().   @throws as that
  static VirtualCoupling for_device(const DeviceInfo& device, int delay_ticks = 0) {
    const CouplingFigures figures = safe_coupling(device, delay_ticks);
    if (!(device.gimbal.peak_torque > 0)) return VirtualCoupling(figures);
    return VirtualCoupling(figures, safe_turning_coupling(device, delay_ticks));
  }

  CouplingFigures figures() const noexcept { return straight_; }
  /// K_r and B_r; zero where no torque is rendered.
  CouplingFigures turning() const noexcept { return turning_; }
  /// From the next tick on the hand is another point of a body that turns.   @param by [m] from the old one
  void move(const Eigen::Vector3d& by) noexcept { last_.move(by); }
  /// Longer metres, softer springs: force over displacement is divided by the scale.
  VirtualCoupling in_scene(double scale) const noexcept {
    VirtualCoupling scaled = *this;
    scaled.straight_ = straight_ * (1 / scale), scaled.turning_ = turning_ * scale;
    return scaled.reset(), scaled;
  }
  void reset() noexcept {
    last_.forget();
    gap_ = 0, now_ = straight_;
  }

  /// Once a period.  @param touch  of the same beam each tick   @param hand [m]   @param dt [s] since the tick before, positive
  template <typename Touch>
  [[nodiscard]] auto tick(Touch& touch, const detail::HandOf<Touch>& hand, double dt) noexcept {
    if constexpr (detail::offers<detail::Stored, Touch>) return within(touch, hand, dt);
    else return beside(touch, hand, dt);
  }

 private:
  /// Of a touch that solves for both.
  template <typename Touch>
  auto within(Touch& touch, const detail::HandOf<Touch>& hand, double dt) const noexcept {
    using Scalar = typename Touch::Scalar;
    detail::CoupledForceOf<Touch> result;
    result.touch = touch.tick(hand.template cast<Scalar>(), static_cast<Scalar>(dt),
                              static_cast<Scalar>(now_.stiffness), static_cast<Scalar>(now_.damping));
    result.avatar = hand + touch.off().template cast<double>();
    result.force = result.touch.force.template cast<double>();
    result.energy = touch.stored() + now_.stiffness * (result.avatar - hand).squaredNorm() / 2 +
                    result.touch.friction.template cast<double>().squaredNorm() / (2 * now_.stiffness);
    return result;
  }
  template <typename Touch>
  auto beside(Touch& touch, const detail::HandOf<Touch>& hand, double dt) noexcept {
    using Scalar = typename Touch::Scalar;
    constexpr int D = dimension_of<Touch>;
    const Eigen::Vector3d from = detail::in_scene(hand);
    const auto normal = [&] { return detail::of_beam<double, D>(last_.tangent().normal()); };
    detail::CoupledForceOf<Touch> result;
    if constexpr (detail::offers<detail::Rough, Touch>)
      if (touch.rough())
        touch.soften(static_cast<Scalar>(now_.stiffness), static_cast<Scalar>(now_.damping / dt));
    detail::look_at_others(touch, last_);
    result.avatar = hand + normal() * solve(from, dt).gap;
    result.touch = touch.tick(result.avatar.template cast<Scalar>());
    last_.learn(result.touch, detail::in_scene(result.avatar));
    if constexpr (detail::offers<detail::Lever, Touch>)
      if (result.touch.pressing) lean(touch.lever(result.touch, result.avatar));
    if (!result.touch.pressing && last_.tangent().known())
      last_.look_again(touch.contact_at(hand.template cast<Scalar>()), from);

    const Balance balance = solve(from, dt);
    if (!std::isfinite(balance.force)) {
      reset();
      return result;
    }
    gap_ = balance.gap;
    result.force = normal() * balance.force;
    result.continued = last_.continued() && (balance.force > 0 || result.touch.pressing);
    if (balance.force > 0) result.energy = last_.tangent().energy() + now_.stiffness * gap_ * gap_ / 2;
    if constexpr (detail::offers<detail::Rough, Touch>)
      if (touch.rough() && balance.force > 0) {  // what the skin transmits, and what it gives back
        const auto friction = result.touch.friction.template cast<double>().eval();
        result.force += friction;
        result.energy += friction.squaredNorm() / (2 * now_.stiffness);
      }
    if (balance.force == 0 && !result.touch.pressing) last_.forget();
    return result;
  }

  /// The line of the force passes the hand.   @param lever ρ [m]
  void lean(double lever) noexcept {
    const auto in_series = [squared = lever * lever](double straight, double turning) {
      return straight * turning / (turning + squared * straight);
    };
    if (!(turning_.stiffness > 0 && std::isfinite(lever))) return;
    now_ = {in_series(straight_.stiffness, turning_.stiffness),
            turning_.damping > 0 ? in_series(straight_.damping, turning_.damping)
            : lever == 0         ? straight_.damping
                                 : 0};
  }

  struct Balance {
    double gap;    // g [m]
    double force;  // K g + B g' [N]
  };

  /// (K + B/dt) g - B/dt g_before = f(p0) - k n·(h + n g - p0), g where neither side pulls.
  Balance solve(const Eigen::Vector3d& hand, double dt) const noexcept {
    const ContactTangent<3>& beam = last_.tangent();
    const double damper = now_.damping / dt, given = damper * gap_, own = now_.stiffness + damper;
    if (beam.known()) {
      const double gap = (beam.force_at(hand) + given) / (own + beam.stiffness()), force = own * gap - given;
      if (!(force <= 0)) return {gap, force};
    }
    const double gap = given / own;
    return {gap > least_gap ? gap : 0, 0};
  }

  static constexpr double least_gap = 1e-12;  // [m] is none

  CouplingFigures straight_, turning_{0, 0};
  CouplingFigures now_;  // K and B, with what turns
  LastResponse last_;
  double gap_ = 0;  // g [m], how far the hand is below the point
};

}  // namespace hapbeam
