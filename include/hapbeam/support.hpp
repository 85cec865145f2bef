// SPDX-License-Identifier: MIT
// How the ends of a beam or a rod are held, and where those of a rod are.
//
// Apart from beam.hpp, because a program that loads a trained model needs no loads.
// An end of a rod has six motions, in the axes of its pose: along d1, d2 and d3, turns of its tangent about d1 and d2, and twist about
// d3.  Each is held, free, or on a spring.
// Offline: checks throw std::invalid_argument naming field, value, unit and what is allowed.  All else is noexcept.
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/check.hpp>

namespace hapbeam {

/// How an end is held.  Each name says which of u, w, theta are zero there.
enum class Support {
  free,     ///< none
  clamped,  ///< u, w, theta
  pinned,   ///< u, w: a hinge that cannot move
  roller,   ///< w: a hinge that slides along the beam's axis
  guided,   ///< u, theta: a symmetry plane
};

constexpr bool fixes_u(Support s) noexcept {
  return s == Support::clamped || s == Support::pinned || s == Support::guided;
}
constexpr bool fixes_w(Support s) noexcept {
  return s == Support::clamped || s == Support::pinned || s == Support::roller;
}
constexpr bool fixes_theta(Support s) noexcept { return s == Support::clamped || s == Support::guided; }

constexpr const char* name(Support support) noexcept {
  return detail::word_for<Support::guided>(support, {"free", "clamped", "pinned", "roller", "guided"});
}

/// Stiffness against each motion of an end; infinity holds it, 0 leaves it free.  The moment of a turn by α is sin α times its
/// stiffness: most at a quarter of a turn, none at half a turn.  That of a twist is proportional to its angle.
struct RodSupport {
  double place1;  ///< [N/m] along d1
  double place2;  ///< [N/m] along d2
  double along;   ///< [N/m] along d3
  double turn1;   ///< [N·m/rad] of the tangent about d1; held where turn2 is
  double turn2;   ///< [N·m/rad] about d2
  double twist;   ///< [N·m/rad] of the section about the tangent

  static constexpr double held = std::numeric_limits<double>::infinity();
  static const RodSupport free;     ///< not held at all
  static const RodSupport clamped;  ///< place, direction and twist
  static const RodSupport hinged;   ///< place: a ball joint
  static const RodSupport
      cardan;  ///< place and twist: a universal joint, whose director follows the tangent by the smallest rotation
  static const RodSupport sliding;  ///< all but the place along d3: a sleeve

  /// @throws std::invalid_argument where a stiffness is negative or no number, or one turn alone is held
  static RodSupport elastic(double place1, double place2, double along, double turn1, double turn2,
                            double twist) {
    const auto checked = [](const char* field, double value, const char* unit) {
      if (!(value >= 0)) detail::reject(field, value, unit, "0 (free), positive, or infinity (held)");
      return value;
    };
    const RodSupport support{
        checked("support place1", place1, "N/m"),   checked("support place2", place2, "N/m"),
        checked("support along", along, "N/m"),     checked("support turn1", turn1, "N·m/rad"),
        checked("support turn2", turn2, "N·m/rad"), checked("support twist", twist, "N·m/rad")};
    if (std::isinf(turn1) != std::isinf(turn2))
      detail::reject("support turn2", turn2, "N·m/rad", "held where turn1 is, and only there");
    return support;
  }

  friend constexpr bool operator==(const RodSupport& a, const RodSupport& b) noexcept {
    return a.place1 == b.place1 && a.place2 == b.place2 && a.along == b.along && a.turn1 == b.turn1 &&
           a.turn2 == b.turn2 && a.twist == b.twist;
  }
  friend constexpr bool operator!=(const RodSupport& a, const RodSupport& b) noexcept { return !(a == b); }
};

inline constexpr RodSupport RodSupport::free{0, 0, 0, 0, 0, 0};
inline constexpr RodSupport RodSupport::clamped{held, held, held, held, held, held};
inline constexpr RodSupport RodSupport::hinged{held, held, held, 0, 0, 0};
inline constexpr RodSupport RodSupport::cardan{held, held, held, 0, 0, held};
inline constexpr RodSupport RodSupport::sliding{held, held, 0, held, held, held};

/// Whether the end resists a turn of the section about the tangent.
constexpr bool holds_twist(const RodSupport& support) noexcept { return support.twist > 0; }
/// Whether it resists turns of the tangent about both axes.
constexpr bool holds_direction(const RodSupport& support) noexcept {
  return support.turn1 > 0 && support.turn2 > 0;
}
/// Whether it resists motions across d3.
constexpr bool holds_across(const RodSupport& support) noexcept {
  return support.place1 > 0 && support.place2 > 0;
}

constexpr const char* name(const RodSupport& support) noexcept {
  return support == RodSupport::free      ? "free"
         : support == RodSupport::clamped ? "clamped"
         : support == RodSupport::hinged  ? "hinged"
         : support == RodSupport::cardan  ? "cardan"
         : support == RodSupport::sliding ? "sliding"
                                          : "elastic";
}

/// Where an end is, and how its section is turned.
struct RodPose {
  VectorOf<double, 3> at{0, 0, 0};     ///< [m]
  VectorOf<double, 3> along{1, 0, 0};  ///< d3: direction of the tangent, from the left end to the right one
  VectorOf<double, 3> director{0, 1, 0};  ///< d1

  /// Makes both directions unit and perpendicular.  @return false where there are none
  bool make_valid() noexcept {
    along /= std::sqrt(along.squaredNorm());
    director -= along * along.dot(director);
    director /= std::sqrt(director.squaredNorm());
    // Not finite where one is too long to be squared.
    const double sizes = along.squaredNorm() * director.squaredNorm();
    return at.allFinite() && std::isfinite(sizes) && sizes > 0;
  }
};

enum class RodSide { left, right };

namespace detail {

/// @throws std::invalid_argument where a beam with these ends is a mechanism
[[gnu::cold]] inline void check_supports(Support left, Support right) {
  const char* why = nullptr;
  const int held_w = fixes_w(left) + fixes_w(right);
  const bool held_theta = fixes_theta(left) || fixes_theta(right);
  if (!fixes_u(left) && !fixes_u(right)) why = "slides along its axis; hold u at one end";
  if (held_w == 0) why = "moves across its axis; hold w at one end";
  if (held_w == 1 && !held_theta) why = "turns about its only hinge; hold theta or the other end";
  if (why) refuse("supports = %s, %s: the beam is a mechanism, it %s", name(left), name(right), why);
}

/// Whether a rod with these ends, at d3 of the same direction, is no mechanism.
constexpr bool hold_rod(const RodSupport& left, const RodSupport& right) noexcept {
  const bool direction = (holds_across(left) && holds_direction(left)) ||
                         (holds_across(right) && holds_direction(right)),
             both = holds_across(left) && holds_across(right);
  return (left.along > 0 || right.along > 0) && (direction || both);
}
[[gnu::cold]] inline void check_supports(const RodSupport& left, const RodSupport& right) {
  if (hold_rod(left, right)) return;
  refuse("supports = %s, %s: the rod is a mechanism, %s", name(left), name(right),
         left.along > 0 || right.along > 0 ? "hold the direction of one end or the place of both"
                                           : "it slides along its axis; hold that at one end");
}

}  // namespace detail

}  // namespace hapbeam
