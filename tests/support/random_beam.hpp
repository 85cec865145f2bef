// Beams at random: five pairs of ends, height 1/10 to 1/1000 of the length, straight or naturally an arc, prestressed from
// -0.7 to 20 times Euler's load or stretched by up to 30 %, under one dead load or none.
//
// Loads stop short of what no equilibrium bears: a column of moderate rotation whose end is free has none beyond Euler's
// load, and an end on a roller that a moment inside the span can turn over none at ML/EI = 5.6.
#pragma once

#include <algorithm>
#include <cmath>

#include "random.hpp"
#include "random_scene.hpp"
#include <hapbeam/beam.hpp>

namespace hapbeam::testing {

inline Beam any_beam(Random& random) {
  struct Ends {
    Support left, right;
    double euler;  // NL²/EI that buckles it
  };
  constexpr Ends pairs[] = {{Support::pinned, Support::pinned, 9.8696},
                            {Support::clamped, Support::clamped, 39.478},
                            {Support::clamped, Support::pinned, 20.191},
                            {Support::pinned, Support::roller, 9.8696},
                            {Support::clamped, Support::free, 2.4674}};
  const Ends& ends = pairs[random.integer(0, 4)];
  const double L = log_even(random, 0.1, 3), h = L * log_even(random, 1e-3, 0.1);
  Beam beam(L, Section::rectangle(h, h), Material{2e11}, ends.left, ends.right);
  const bool held = fixes_u(ends.left) && fixes_u(ends.right);
  const double unit = beam.bending_stiffness() / (L * L);
  EndPlace left, right;
  if (random.integer(0, 3) == 0) {
    const double angle = random(1.5), half = angle / 2;
    beam.naturally({{L, angle / L}});
    if (held && random.integer(0, 1))
      left.theta = -half, right.theta = half, right.u = L * std::sin(half) / half - L;
  }
  const int prestress = random.integer(0, 3);
  if (prestress == 1) {
    const double N = random(-0.7, 20) * ends.euler * unit;
    if (held) right.u += N * L / beam.axial_stiffness();
    else beam.add({L, N, 0, 0});
  } else if (prestress == 2 && held) {
    right.u += random(0, 0.3) * L;
  }
  beam.place(left, right);
  const double size = unit * log_even(random, 0.04, 40), load = random.integer(0, 1) ? size : -size;
  switch (random.integer(0, 4)) {
    case 1: beam.transverse(load / L); break;
    case 2: beam.add({random(0.05, 0.95) * L, 0, load, 0}); break;
    case 3: beam.axial((held ? load : std::abs(load)) / L); break;
    case 4: beam.add({random(0.1, 0.9) * L, 0, 0, load * L / 10}); break;
    default: break;
  }
  return beam;
}

}  // namespace hapbeam::testing
