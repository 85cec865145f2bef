// From metres of the scene to pixels and back.
//
// Lengths are true to scale but for what the hand and the beam do across the beam: displacements from rest, and the
// distance of hand and avatar from the surface that they press, are drawn `exaggeration` times as large.
#pragma once

#include <imgui.h>

#include <hapbeam/centreline.hpp>

namespace phantom {

using Point = hapbeam::Vector2<double>;

struct View {
  ImVec2 low, high;    ///< [pixel] the canvas
  double pixels = 1;   ///< for a metre
  Point middle{0, 0};  ///< [m] of the canvas, as drawn
  double exaggeration = 1;

  ImVec2 operator()(const Point& drawn) const {
    return {(low.x + high.x) / 2 + static_cast<float>((drawn.x() - middle.x()) * pixels),
            (low.y + high.y) / 2 - static_cast<float>((drawn.y() - middle.y()) * pixels)};
  }
  Point inverse(const ImVec2& at) const {
    return {middle.x() + static_cast<double>(at.x - (low.x + high.x) / 2) / pixels,
            middle.y() - static_cast<double>(at.y - (low.y + high.y) / 2) / pixels};
  }
  bool contains(const ImVec2& at) const {
    return at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y;
  }
};

/// What the hand does across the beam, from the height at which it begins to touch.
struct Across {
  double
      surface;  ///< [m] of the avatar's centre when it just touches the beam at rest, from the side it is on
  double exaggeration;

  Point drawn(const Point& p) const { return {p.x(), surface + exaggeration * (p.y() - surface)}; }
  Point real(const Point& p) const { return {p.x(), surface + (p.y() - surface) / exaggeration}; }
};

}  // namespace phantom
