// SPDX-License-Identifier: MIT
// Joints of a World: a place of a rod is held on one of another rod, or of a body; a hinge and a weld hold directions, too.
//
//   World<RoundRod> bow({{limb, 16}, {string, 16}, {other, 16}}, {}, {{{0, 1}, {0.5, 0}}, {{1, 2}, {0.9, 0.5}}});
//   World<TwistedRod> branch({{trunk, 16}, {twig, 8}}, {}, {{{0, 1}, {0.3, 0}, JointKind::weld}});
//
// A joint is a pair whose places are nodes and stay: its three forces are unknowns of the same equations.  Three moments that hold directions are those of a
// second pair.  With θ₁ and θ₂ the rotations of both from where they are in an iteration, and θ what is between them there,
//
//   L = ... - m · (θ + θ₁ - θ₂)        of a hinge about e, which has no moment along e:   - m · (e₂ × e₁ + e × δe₁ - e × δe₂)
//
// Both have no product of unknowns of two rods.  A rod that its ends do not hold has no factor of
// its own.  So a joint lends it a stiffness κ, and takes that back from what it is held on and from the force:
//
//   ½ x₁ᵀK₁x₁ + ½ x₂ᵀK₂x₂ - f · (r₁ - r₂) = ½ x₁ᵀ(K₁ + κ) x₁ + ½ x₂ᵀ(K₂ - κ) x₂ - φ · (r₁ - r₂),   f = φ - ½ κ (r₁ + r₂)
//
// which is a congruence: solutions and inertia stay what they are.  So it is with moments.
// Offline: checks throw std::invalid_argument.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/world/rigid_body.hpp>

namespace hapbeam {

enum class JointKind {
  ball,   ///< holds the place
  hinge,  ///< and all directions but turns about one axis
  weld,   ///< and all directions, as rods and bodies rest without joints; of a RoundRod that of its tangent
};

/// Rods that joints hold together at one place do not touch each other, nor bodies there.
struct Joint {
  std::array<int, 2>
      rod;  ///< 0-based numbers in the World: rods; the second may be rods() + that of a sphere or a capsule
  std::array<double, 2> s;  ///< [m] arc positions; along the axis of a body
  JointKind kind = JointKind::ball;
  VectorOf<double, 3> axis = {0, 0, 0};  ///< of a hinge, as rods rest; of any length
};

namespace detail {

/// @throws std::invalid_argument where there is no such rod or place
[[gnu::cold]] inline void check_joint(const Joint& joint, const std::vector<Rod>& rods,
                                      const std::vector<RigidBody>& bodies) {
  const int number = static_cast<int>(rods.size()), all = number + static_cast<int>(bodies.size());
  for (std::size_t side = 0; side < 2; ++side) {
    const int rod = joint.rod[side];
    if (rod < 0 || rod >= (side == 0 ? number : all))
      reject("joint rod", rod, "",
             side == 0 ? "the number of a rod" : "the number of a rod, or rods + that of a body");
    if (rod >= number && bodies[static_cast<std::size_t>(rod - number)].kind() != RigidBody::Kind::round)
      reject("joint body", rod - number, "", "a sphere or a capsule");
    const double length = rod < number ? rods[static_cast<std::size_t>(rod)].length()
                                       : bodies[static_cast<std::size_t>(rod - number)].axis().length();
    if (!(joint.s[side] >= 0 && joint.s[side] <= length))
      reject("joint s", joint.s[side], "m",
             rod < number ? "on the rod, 0 to its length" : "on the axis of the body");
  }
  if (const double length = joint.axis.norm();
      joint.kind == JointKind::hinge && !(std::isfinite(length) && length > 0))
    reject("joint axis", length, "", "finite and more than 0");
  if (joint.rod[0] == joint.rod[1]) reject("joint rod", joint.rod[1], "", "another one than the first");
}

/// How many joints lead from what holds itself to each rod; more than there are rods: none do.   @param away  0: holds itself, else more than rods
inline std::vector<int> joints_away(std::vector<int> away, const std::vector<Joint>& joints) {
  const int number = static_cast<int>(away.size());
  const auto of = [&](int rod) { return rod < number ? away[static_cast<std::size_t>(rod)] : 0; };
  for (int pass = 0; pass < number; ++pass)
    for (const Joint& joint : joints)
      for (std::size_t side = 0; side < 2; ++side)
        if (const int next = of(joint.rod[1 - side]) + 1; next < of(joint.rod[side]))
          away[static_cast<std::size_t>(joint.rod[side])] = next;
  return away;
}

/// Who does not touch whom, the smaller number first: those of one joint, and of two at one place of a rod.
inline std::vector<std::pair<int, int>> held_together(const std::vector<Joint>& joints) {
  std::vector<std::pair<int, int>> all;
  const auto add = [&all](int i, int j) {
    if (i != j) all.emplace_back((std::min)(i, j), (std::max)(i, j));
  };
  for (const Joint& a : joints) {
    add(a.rod[0], a.rod[1]);
    for (const Joint& b : joints)
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          if (a.rod[i] == b.rod[j] && a.s[i] == b.s[j]) add(a.rod[1 - i], b.rod[1 - j]);
  }
  return all;
}

/// What a joint lends the first of its rods, in units of a rod's own stiffness; negative: the second.   @param first, second  joints_away() of both
inline double lent_share(int first, int second) noexcept {
  if (first == 0 && second == 0) return 0;
  const double share = std::pow(0.25, first == second ? first + 1 : (std::min)(first, second));
  return second > first ? -share : share;
}

}  // namespace detail

}  // namespace hapbeam
