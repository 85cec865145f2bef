// The beams of the page, and the hand that shows each one until somebody presses it.
#pragma once

#include <cmath>
#include <utility>

#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/hand_path.hpp>
#include <hapbeam/shapes.hpp>

namespace page {

using hapbeam::Beam;
using Point = hapbeam::Vector2<double>;  // [m] x along the beam, w up

struct Scene {
  Beam beam;
  double rise;             ///< [m] of its middle, before it is touched
  double radius;           ///< [m] of the avatar
  double stiffness;        ///< [N/m] of the spring between hand and avatar
  double from, to, depth;  ///< [m] presses at which models are compared: between two places, up to a depth
  hapbeam::HandPath demonstration;  ///< of the hand

  /// Whether its ends have been pulled apart: it is a string.
  bool stretched() const { return beam.right_place().u > 0; }
  /// [m] from the avatar's centre to the centreline that it touches.
  double reach() const { return radius + beam.thickness() / 2; }
  /// Where the avatar meets the untouched beam from above.   @param x [m]   @return [m] of its centre
  double top(double x) const {
    if (rise == 0) return reach();
    const double half = (beam.length() + beam.right_place().u) / 2;
    const double circle = (half * half + rise * rise) / (2 * rise);
    return std::sqrt(circle * circle - (x - half) * (x - half)) - circle + rise + reach();
  }
};

/// Of the air: what swings falls to a tenth in a second and a half [1/s].
inline constexpr double drag = 3;

/// Of a beam of one's own.
enum Ends { both_pinned, both_clamped, one_clamped };

/// A beam of one's own, 20 mm wide, the spring as stiff as that beam: half of the way is lag at first.
/// @param length, thickness [m]
inline Scene own_scene(double length, double thickness, hapbeam::Material material, Ends ends) {
  using hapbeam::HandPath;
  using hapbeam::Support;
  const bool cantilever = ends == one_clamped;
  const Support left = ends == both_pinned ? Support::pinned : Support::clamped,
                right = cantilever ? Support::free : left;
  material.damping.drag = drag;
  Beam beam(length, hapbeam::Section::rectangle(0.02, thickness), material, left, right);
  const double radius = 0.02 * length, s = (cantilever ? 0.6 : 0.5) * length, small = 1e-4 * length;
  hapbeam::FemModel<> model(beam, 8);
  const double stiffness = std::abs(model.press({s, -small}).force) / small;
  const double depth = (cantilever ? 0.15 : 0.009) * length, above = 2 * radius;
  HandPath hand({s, above + radius});
  hand.press(2 * depth + above, 1.5).rest(0.4);
  if (cantilever) hand.release(2 * depth + above, 1).rest(0.4);
  else
    hand.slide(0.25 * length, 1.2)
        .slide(-0.5 * length, 1.8)
        .slide(0.25 * length, 1)
        .release(2 * depth + above, 0.6)
        .rest(0.4);
  return {std::move(beam),
          0,
          radius,
          stiffness,
          cantilever ? 0.35 * length : 0.2 * length,
          cantilever ? 0.65 * length : 0.8 * length,
          depth,
          std::move(hand)};
}

inline constexpr int scenes = 6;

/// @param index  of: steel bar, ruler, string, arch, strip, a beam of one's own as it is at first.  Figures: docs/scenes.md
inline Scene scene(int index) {
  using hapbeam::HandPath;
  using hapbeam::Section;
  using hapbeam::Support;
  hapbeam::Material steel{200e9, 7850};
  steel.damping.drag = drag;
  switch (index) {
    case 0: {
      Beam bar(2.54, Section::rectangle(0.0254, 0.0254), {206.84e9, 7850, steel.damping}, Support::pinned,
               Support::pinned);
      HandPath hand({0.8, 0.06});
      hand.press(0.11, 1.2).rest(0.3).slide(1, 2).slide(-0.5, 1).press(0.03, 0.6).release(0.14, 1).rest(0.6);
      return {std::move(bar), 0, 0.015, 3500, 0.5, 2, 0.02, std::move(hand)};
    }
    case 1: {
      Beam ruler(0.3, Section::rectangle(0.025, 0.001), steel, Support::clamped, Support::free);
      HandPath hand({0.17, 0.03});
      hand.press(0.2, 2.2).rest(0.4).release(0.12, 1).move_to({0.27, 0.03}, 1).rest(0.3);
      hand.press(0.1, 0.8).rest(0.2).move_to({0.34, 0.0}, 0.7).move_to({0.17, 0.03}, 1).rest(0.4);
      return {std::move(ruler), 0, 0.01, 300, 0.1, 0.2, 0.06, std::move(hand)};
    }
    case 2: {
      Beam wire(0.65, Section::circle(0.0008), steel, Support::pinned, Support::pinned);
      HandPath hand({0.2, 0.012});
      hand.press(0.026, 0.8)
          .slide(0.32, 2)
          .slide(-0.2, 1.2)
          .press(0.006, 0.5)
          .release(0.032, 0.03)
          .rest(0.82);
      hand.slide(-0.12, 0.8);
      return {tensioned(wire, 80), 0, 0.004, 600, 0.13, 0.52, 0.008, std::move(hand)};
    }
    case 3: {
      Beam bow = hapbeam::arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), steel, Support::pinned);
      HandPath hand({0.096, 0.03});
      hand.press(0.042, 2.4).rest(0.4).release(0.03, 0.6).move_to({0.235, 0.02}, 0.8);
      hand.move_to({0.235, -0.03}, 0.5).move_to({0.104, -0.035}, 0.9).release(0.045, 2.2).rest(0.4);
      hand.press(0.05, 0.7)
          .move_to({0.235, -0.03}, 0.8)
          .move_to({0.235, 0.03}, 0.5)
          .move_to({0.096, 0.03}, 0.8);
      return {std::move(bow), 0.012, 0.005, 400, 0.08, 0.09, 0.009, std::move(hand)};
    }
    case 5: return own_scene(0.5, 0.004, {70e9, 2700}, both_pinned);
    default: {
      Beam strip(0.4, Section::rectangle(0.02, 0.0005), steel, Support::pinned, Support::pinned);
      HandPath hand({0.2, 0.012});
      hand.press(0.02, 2)
          .rest(0.3)
          .slide(-0.1, 1)
          .slide(0.18, 1.6)
          .slide(-0.08, 0.8)
          .release(0.02, 0.8)
          .rest(0.6);
      return {std::move(strip), 0, 0.005, 4000, 0.08, 0.32, 0.003, std::move(hand)};
    }
  }
}

}  // namespace page
