// Where a chain of masses and springs fails that is stepped explicitly (thesis eq. 2.2–2.5): steps too long for its springs.
#include <cmath>

#include "support/catch.hpp"
#include "support/mass_spring.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double tick = 1e-3;                                               // [s]
constexpr double steel = 7850, mass = steel * inch * inch * thesis_length;  // [kg/m³], [kg]

/// How far any mass of an undamped chain gets that was disturbed by 1 µm [m].
double farthest(int pieces, double dt, int steps) {
  MassSpringChain chain(pinned(), pieces, mass, 0);
  Random random(1);
  const auto at = [&chain](std::size_t i) -> Vector2<double>& { return chain.position(i); };
  const std::size_t last = static_cast<std::size_t>(pieces);
  for (std::size_t i = 1; i < last; ++i) at(i) += Vector2<double>(random(1e-6), random(1e-6));
  double worst = 0;
  for (int k = 0; k < steps && worst < 1; ++k) {
    chain.step(dt, chain.middle(), 0);
    for (std::size_t i = 1; i < last; ++i)
      worst = std::max(worst, std::abs(at(i).x() - thesis_length * static_cast<double>(i) / pieces));
  }
  return worst;
}

}  // namespace

// Δt ω < 2 with ω = 2√(k/m) cos(π/2n), the fastest of n springs between two walls.  A hundredth short of it the amplitude
// is at most √n/√(1 - 0.99²) = 7√n times the disturbance; a hundredth beyond it grows by e^0.28 a step.
TEST_CASE("an explicit step is stable up to 2/ω, just, whatever the number of masses", "[mass-spring]") {
  for (const int pieces : {4, 8, 16, 32, 64}) {
    const MassSpringChain chain(pinned(), pieces, mass, 0);
    const double limit = chain.largest_step() / std::cos(std::acos(-1.0) / (2 * pieces));
    CAPTURE(pieces, limit);
    CHECK(farthest(pieces, 0.99 * limit, 1000) <= 7 * std::sqrt(pieces) * 1e-6);
    CHECK(farthest(pieces, 1.01 * limit, 1000) >= 1);
    // Eq. 2.2 is on the safe side: its K_c is a π²th of what is stable.
    CHECK(farthest(pieces, chain.critical_step(), 1000) <= 7 * std::sqrt(pieces) * 1e-6);
  }
}

TEST_CASE("at 1 kHz a chain of the thesis' bar is gone in ten ticks; finite elements know no step",
          "[mass-spring]") {
  for (const int pieces : {4, 16, 64}) {
    MassSpringChain chain(pinned(), pieces, mass, 0);
    CHECK(chain.spring() > 600 * chain.mass() / (tick * tick * 9.87));  // K over K_c
    double force = 0;
    for (int k = 0; k < 10; ++k) force = chain.step(tick, chain.middle(), 1e-4);
    CHECK_FALSE(std::abs(force) < 1e6);
    // A press from rest is the same press whatever was before, how fast and how late the hand comes.
    FemModel<> model(pinned(), pieces);
    const Response<double> response = model.press({thesis_length / 2, 1e-4});
    CHECK(response.status == Status::ok);
    CHECK(std::abs(response.force / (48 * thesis_EI * 1e-4 / std::pow(thesis_length, 3)) - 1) <= 1e-4);
  }
}
