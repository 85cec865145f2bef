// A hand far beyond a trained range: there the drawn shape turns back, and the contact is that of the whole of it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rom/training/trained.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sanitized.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/closest_point.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// As the model draws itself now.
std::vector<CubicSegment<double>> drawn(const Centreline<double>& line) {
  std::vector<CubicSegment<double>> pieces;
  line.visit_segments([&](int, const CubicSegment<double>& piece) { pieces.push_back(piece); });
  return pieces;
}

double distance(const std::vector<CubicSegment<double>>& pieces, const Vector2<double>& q) {
  double squared = std::numeric_limits<double>::infinity();
  for (const CubicSegment<double>& piece : pieces)
    squared = std::min(squared, closest_point(piece, q).distance_squared);
  return std::sqrt(squared);
}

/// In, along and out again, with a jump in one tick of twenty.
Vector2<double> hand_at(double part, double from, double to, double depth, double reach) {
  const double along = std::clamp((part - 0.3) / 0.4, 0.0, 1.0),
               down = part < 0.3 ? part / 0.3 : std::min(1.0, (1 - part) / 0.3);
  return {from + (to - from) * along, reach - depth * down};
}

}  // namespace

// The axial displacement grows with the square of the depth, so the trained shape overtakes itself along x.
TEST_CASE("a hand that jumps far beyond the trained depth presses the nearest point of the whole shape",
          "[galerkin][touch]") {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::pinned, Support::pinned},
                                                               {Support::clamped, Support::clamped},
                                                               {Support::pinned, Support::clamped},
                                                               {Support::clamped, Support::guided}}));
  const Beam beam = thesis_beam(left, right);
  const double L = beam.length();
  GalerkinModel<> model(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.01), 32));
  Random random(4);
  int compared = 0, elsewhere = 0;
  double worst = 0;
  for (int stroke = 0; stroke < trials(250); ++stroke) {
    const double radius = L * (stroke % 2 ? random(0.002, 0.05) : std::pow(10, random(-3, 0)));
    const double depth = L * std::pow(10, random(-1.3, 0)), side = random.integer(0, 1) ? 1 : -1;
    const double from = L * random(-0.05, 1.05), to = L * random(-0.05, 1.05);
    const double reach = radius + model.thickness() / 2 + 0.01 * L;
    Touch touch(model, radius);
    for (int tick = 0; tick < 100; ++tick) {
      Vector2<double> hand = hand_at(tick / 100.0, from, to, depth + 0.01 * L, reach);
      hand.y() *= side;
      if (random.integer(0, 19) == 0) hand += L * Vector2<double>(random(0.2), random(0.1));
      const bool went_on = touch.pressing();
      const std::vector<CubicSegment<double>> before = drawn(model.shape());
      const TouchResult<double> result = touch.tick(hand);
      if (!went_on || result.status != Status::out_of_range) continue;
      // Beside a kink the contact is taken on the node's mean tangent, off the curve.
      if (distance(before, result.contact.foot) > 1e-10 * L) continue;
      const double off = ((hand - result.contact.foot).norm() - distance(before, hand)) / L;
      worst = std::max(worst, off);
      elsewhere += off > 1e-6;
      ++compared;
    }
  }
  CAPTURE(name(left), name(right), worst);
  CHECK(elsewhere == 0);
  CHECK(compared > trials(1000));
}
