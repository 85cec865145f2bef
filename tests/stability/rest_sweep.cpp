// Any beam finds its rest: random sections, ends, prestress, natural arcs and dead loads, 4 to 512 elements, moderate and
// any rotation.  Loads stop short of what no equilibrium bears: a column of moderate rotation whose end is free has none
// beyond Euler's load, and an end on a roller that a moment inside the span can turn over none at ML/EI = 5.6.
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/random_scene.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Ends {
  Support left, right;
  double euler;  // NL²/EI that buckles it
};

constexpr Ends pairs[] = {{Support::pinned, Support::pinned, 9.8696},
                          {Support::clamped, Support::clamped, 39.478},
                          {Support::clamped, Support::pinned, 20.191},
                          {Support::pinned, Support::roller, 9.8696},
                          {Support::clamped, Support::free, 2.4674}};

Beam random_beam(Random& random) {
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

}  // namespace

TEMPLATE_TEST_CASE("two thousand random beams find their rest", "[rest]", VonKarman<>, Corotational<>) {
  Random random(2026);
  int snapped = 0, most = 0, refused = 0;
  long solves = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Beam beam = random_beam(random);
    const int elements = static_cast<int>(log_even(random, 4, 512));
    const FemModel<TestType> model(beam, elements);
    CAPTURE(trial, elements, name(beam.left()), name(beam.right()), beam.length() / beam.thickness());
    CHECK(is_answer(model.rest().status));
    snapped += model.rest().status == Status::snapped;
    solves += model.rest().solves;
    most = std::max(most, model.rest().solves);
    if (elements > 32) continue;
    // In float it is the same shape, or the model says that in float its tangent has lost its digits.
    const FemModel<TestType, float> rounded(beam, elements);
    if (rounded.rest().status == Status::singular) {
      ++refused;
      continue;
    }
    CHECK(rounded.rest().status == model.rest().status);
    const double eps = 1.2e-7, L = beam.length();
    double off = 0;
    for (int i = 0; i <= elements; ++i)
      off = std::max(off, std::abs(static_cast<double>(rounded.shape()[i].w) - model.shape()[i].w) / L);
    CHECK(off <= 4 * eps);
  }
  CAPTURE(solves / 2000, most, snapped, refused);
  CHECK(snapped <= 40);  // few: arcs that prestress or loads turn inside out
  CHECK(solves <= 2000 * 80);
  CHECK(refused <= 10);  // of some 850 with 32 elements or fewer
}
