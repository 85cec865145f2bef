// What the benchmarks press: the thesis' beam, and the hand's ways over it.
#pragma once

#include <cmath>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

inline constexpr double length = 2.54;           // [m] 100 in
inline constexpr double side = 0.0254;           // [m] 1 in, square
inline constexpr double young = 206842718795.3;  // [Pa] 30e6 psi
inline constexpr double depth = 0.05;            // [m] of the deepest press
inline constexpr int period = 1000;              // [ticks] of a path
inline constexpr double turn = 6.283185307179586 / period;

inline Beam thesis_beam(Support left = Support::pinned, Support right = Support::pinned,
                        double beam_length = length) {
  return Beam(beam_length, Section::rectangle(side, side), Material{young}, left, right);
}

using Path = Press<double> (*)(int tick);

/// 0 … 50 mm … 0 at mid-span.
inline Press<double> press_path(int tick) { return {length / 2, depth / 2 * (1 - std::cos(turn * tick))}; }
/// From mid-span to 0.3 L, to 0.7 L and back, at 20 mm.
inline Press<double> slide_path(int tick) { return {length * (0.5 - 0.2 * std::sin(turn * tick)), 0.02}; }

inline std::vector<Press<double>> presses(Path path, int ticks = period) {
  std::vector<Press<double>> all;
  for (int tick = 0; tick < ticks; ++tick) all.push_back(path(tick));
  return all;
}

}  // namespace hapbeam::benchmarks
