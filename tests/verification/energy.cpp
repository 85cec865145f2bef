// What the hand puts in is what the beam stores: work, force as a derivative of energy, reciprocity,
// symmetry.
#include <array>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/loads.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// ∫F dd from the model's depth a to b in pieces, each by the five-point Gauss rule: exact to degree nine of
/// F, which is nearly a cubic of d, so that ten pieces of 50 mm leave less than 1e-10.
template <class Model>
double work(Model& model, double s, double a, double b, int pieces) {
  double sum = 0;
  const double h = (b - a) / pieces;
  for (int i = 0; i < pieces; ++i)
    for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
      const Response<double> response = model.press({s, a + (i + detail::gauss_points[k]) * h});
      REQUIRE(response.status == Status::ok);
      sum += h * detail::gauss_weights[k] * response.force;
    }
  REQUIRE(model.press({s, b}).status == Status::ok);
  return sum;
}

}  // namespace

// The way back uses other depths than the way in, so that an error cannot cancel itself.
TEST_CASE("pressing and letting go takes no energy: closed loop within 1e-6 of the peak", "[energy]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const int elements : {4, 16, 64})
      for (const double position : {0.1, 0.3, 0.5}) {
        FemModel<> model(thesis_beam(end, end), elements);
        const double s = position * thesis_length, deep = 50e-3;
        const double in = work(model, s, 0, deep, 20), peak = model.strain_energy();
        const double out = work(model, s, deep, 0, 23);
        INFO(name(end) << ", " << elements << " elements at " << position << ": in " << in << " J, out "
                       << out << " J, stored " << peak << " J");
        CHECK(std::abs(in - peak) <= 1e-6 * peak);
        CHECK(std::abs(in + out) <= 1e-6 * peak);
        CHECK(model.strain_energy() <= 1e-12 * peak);
      }
}

// Five-point differences of a nearly quartic V: the rule's error is h⁴V⁽⁵⁾/30 < 1e-8 V' with h = d/50; a
// force converged to 1e-8 leaves V converged to its square.
TEST_CASE("the force is the derivative of the strain energy by the depth", "[energy]") {
  for (const double position : {0.1, 0.37, 0.5})
    for (const double depth : {1e-3, 10e-3, -40e-3}) {
      FemModel<> model(thesis_beam(Support::pinned, Support::clamped), 16);
      const double s = position * thesis_length, h = depth / 50;
      std::array<double, 5> V{};
      for (int i = -2; i <= 2; ++i) {
        REQUIRE(model.press({s, depth + i * h}).status == Status::ok);
        V[static_cast<std::size_t>(i + 2)] = model.strain_energy();
      }
      const double derivative = (V[0] - 8 * V[1] + 8 * V[3] - V[4]) / (12 * h);
      CHECK(relative_error(model.press({s, depth}).force, derivative) <= 1e-7);
    }
}

TEST_CASE("the linear beam is reciprocal (Betti): force at a moves b as force at b moves a", "[energy]") {
  const Beam beam = thesis_beam(Support::clamped, Support::pinned);
  FemModel<Linear> model(beam, 8);
  for (const double a : {0.07, 0.21, 0.5})
    for (const double b : {0.33, 0.62, 0.94}) {
      const double sa = a * beam.length(), sb = b * beam.length();
      const double force_a = model.press({sa, 3e-3}).force, moved_b = model.shape().at(sb).w;
      const double force_b = model.press({sb, -2e-3}).force, moved_a = model.shape().at(sa).w;
      // Between nodes the unloaded linear beam is a cubic, so only round-off is left: 64 n² eps.
      CHECK(relative_error(moved_b / force_a, moved_a / force_b) <= 64 * 64 * 2.2e-16);
    }
}

TEST_CASE("pressed from the other side the force turns its sign, bit for bit", "[symmetry]") {
  FemModel<> up(thesis_beam(Support::pinned, Support::clamped), 8), down = up;
  for (const double position : {0.1, 0.3, 0.62})
    for (const double depth : {1e-4, 3e-3, 40e-3}) {
      const Response<double> above = up.press({position * thesis_length, depth});
      const Response<double> below = down.press({position * thesis_length, -depth});
      CHECK(above.status == Status::ok);
      CHECK(above.force == -below.force);
    }
}

// The mirrored problem is solved from the other end, with other round-off and another last iterate: 2 · 1e-8
// is what the solver's tolerance allows.
TEST_CASE("pressed at L - s the mirrored beam answers the same", "[symmetry]") {
  FemModel<> one(thesis_beam(Support::pinned, Support::clamped), 8);
  FemModel<> other(thesis_beam(Support::clamped, Support::pinned), 8);
  for (const double position : {0.1, 0.3, 0.5, 0.62, 0.9})
    for (const double depth : {1e-4, 3e-3, 40e-3}) {
      const double s = position * thesis_length;
      const double force = one.press({s, depth}).force;
      CHECK(relative_error(other.press({thesis_length - s, depth}).force, force) <= 2e-8);
    }
}
