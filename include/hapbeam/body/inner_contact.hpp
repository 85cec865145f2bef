// A contact at any place of a beam whose mesh does not move, as a body sees it: a row of its equations, and a node within the element.
//
//   round    a circle of that reach lies on the centreline:  D = reach,  D from its centre to the curve;  the place s is an unknown
//   along    the place s is held so far along a direction:  n · (u, w) = d
//
// Unknown of both is the force λ, which pushes the beam away from the centre, or along n.
#pragma once

#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// The piece of a beam between an inner node, its tip, and the next node on one side, its root.  Its deformations are those of a unit of length, so that
/// it may be as short as it likes.
template <typename S>
struct RootedPiece {
  enum class Root { none, left, right };

  Root root = Root::none;  ///< none: not yet laid
  int element = 0;         ///< in which it is
  int next = -1;           ///< the contact that is its root, -1: a node of the mesh
  S stretch = 0;           ///< ε
  S at_root = 0;           ///< rotation of the root against the chord, over the length [1/m]
  S at_tip = 0;            ///< the same of the tip [1/m]
  S tension = 0;           ///< N [N]
};

/// What stays of a contact from one push to the next.
template <typename S>
struct InnerState {
  S s = 0;             ///< [m]
  S force = 0;         ///< λ [N]
  bool moves = true;   ///< whether s is sought; else it stays
  bool sharp = false;  ///< whether the curve is bent more sharply there than the circle
  RootedPiece<S> piece;
  S was = 0;               ///< the place where u, w and θ were these [m]
  Vector2<S> moved{0, 0};  ///< u, w [m]
  S theta = 0;             ///< [rad]
};

template <typename S>
struct InnerContact : InnerState<S> {
  enum class Kind { round, along };

  Kind kind = Kind::round;
  Vector2<S> centre{0, 0};  ///< [m]
  Vector2<S> normal{0, 1};  ///< n, unit; of a circle from the centre to the curve, found
  S reach = 0;              ///< [m], or d
  S side = 1;               ///< of the beam on which the circle is
  S curvature = 0;          ///< of the circle for which a place is held [1/m]
  S least = 0, most = 0;    ///< s stays between them [m]

  bool waits = false;         ///< s stays in the next solve
  bool rests = false;         ///< s stays, between two elements
  Vector2<S> friction{0, 0};  ///< on the beam [N]
  S friction_stiffness = 0;   ///< along the surface [N/m]

  // Found where an element looks at it.
  S gap = 0;                 ///< D - reach, or n · (u, w) - d [m]
  Vector2<S> place{0, 0};    ///< of the curve [m]
  Vector2<S> tangent{1, 0};  ///< of it
};

}  // namespace hapbeam::detail
