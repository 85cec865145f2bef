#include "instructions/strokes.hpp"
#include "many/rows.hpp"
#include <hapbeam/many/touch_many.hpp>

void hapbeam::testing::many() {
  const BeamArray brush(FemModel<>(bristle(), 8), row(1000, 0.002));
  Touch touch(brush, 0.005);
  volatile double felt = 0;
  const auto tick = [&](int k) { felt = touch.tick({0.99 + 1e-4 * k, 0.0635}).force.x(); };
  for (int k = -ticks; k < 0; ++k) tick(k);
  count("brush of 1000 bristles: slides", tick);
  static_cast<void>(felt);
}
