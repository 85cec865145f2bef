// The thesis' comparison of FEM and POD (Table 3.2), once with this library's reduction and once with the thesis' recipe.
//
// Half of the beam, four elements, pressed at its guided end: 15 degrees of freedom, 50 load cases 0.1, 0.2 … 5 mm.
#include <array>
#include <cmath>

#include "once_training.hpp"
#include "rom/training/trained.hpp"
#include "support/catch.hpp"
#include "support/noisy_force.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/pod.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int elements = 4;
constexpr int load_cases = 50;

Beam half_beam() { return thesis_half(Support::roller); }

/// All 15 degrees of freedom of a press by d at the guided end.
VectorXd finite_elements(double d) {
  FemModel<> model(half_beam(), elements, tight_solver());
  REQUIRE(model.press({half_beam().length(), d}).status == Status::ok);
  VectorXd x(3 * (elements + 1));
  for (int i = 0; i <= elements; ++i) {
    const auto& node = model.shape()[i];
    x.segment<3>(3 * i) << node.u, node.w, node.theta;
  }
  return x;
}

/// The recipe of section 3.3: 50 equidistant load cases, plain inner product, eigenvalues of XXᵀ, Lagrange's polynomial of
/// degree 49 through the coefficients.
class Recipe {
 public:
  Recipe() : depths_(load_cases, 0.1e-3, 5e-3) {
    MatrixXd X(3 * (elements + 1), load_cases);
    for (int k = 0; k < load_cases; ++k) X.col(k) = finite_elements(-depths_.node(k));
    const Pod<MethodOfSnapshots> pod(X, Truncation::count(15));
    basis_ = pod.basis();
    coefficients_ = pod.coefficients(X);
  }
  VectorXd operator()(double depth) const {
    VectorXd l(load_cases);
    depths_.weights(depth, l.data());
    return basis_ * (coefficients_ * l);
  }

 private:
  Lagrange<EquispacedNodes> depths_;
  MatrixXd basis_, coefficients_;
};

double largest(const VectorXd& difference) { return difference.cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("POD meets all 15 degrees of freedom of Table 3.2 within 1e-8, the axial ones too", "[thesis]") {
  const double L = half_beam().length();
  TrainingPlan plan = TrainingPlan::at(L, 5e-3);
  plan.segments = elements;
  PodModel<> pod(
      trained_pod(take_snapshots(half_beam(), FemModel<>(half_beam(), elements, tight_solver()), plan)));
  for (const double depth : {0.5e-3, 0.8e-3, 4e-3, 3.75e-3})
    for (const double side : {1.0, -1.0}) {
      REQUIRE(pod.press({L, side * depth}).status == Status::ok);
      const VectorXd fem = finite_elements(side * depth);
      for (int i = 0; i <= elements; ++i) {
        const auto& node = pod.shape()[i];
        INFO("pressed " << 1e3 * side * depth << " mm, node " << i);
        CHECK(std::abs(node.u - fem[3 * i]) <= 1e-8);
        CHECK(std::abs(node.w - fem[3 * i + 1]) <= 1e-8);
        CHECK(std::abs(node.theta - fem[3 * i + 2]) <= 1e-8);
      }
    }
}

// In the thesis its own recipe misses DOF 1 by 1.49 mm at 4 mm, where FEM has 0.  With the axial displacements in the
// snapshots they come out as well as any other: that error was not the method's.
TEST_CASE("the thesis' recipe is as good as its finite elements in the middle of the load cases",
          "[thesis]") {
  const Recipe recipe;
  for (const double depth : {0.5e-3, 0.8e-3, 4e-3, 3.75e-3}) {
    INFO(1e3 * depth << " mm: " << largest(recipe(depth) - finite_elements(-depth)));
    CHECK(largest(recipe(depth) - finite_elements(-depth)) <= 1e-8);
  }
}

// Between the outermost nodes round-off has grown by Λ = 2e12, outside by more than can be of use.  The thesis' printed
// answer for 8 mm, -0.069 mm, is that; this machine's is another, and both are none.
TEST_CASE("the thesis' recipe fails near the ends of its load cases and outside", "[thesis]") {
  const Recipe recipe;
  const auto relative = [&recipe](double depth) {
    const VectorXd fem = finite_elements(-depth);
    return largest(recipe(depth) - fem) / largest(fem);
  };
  const double middle = relative(2.55e-3), beside_end = std::max(relative(0.15e-3), relative(4.95e-3));
  INFO("middle " << middle << ", beside an end " << beside_end << ", at 8 mm " << relative(8e-3));
  CHECK(middle <= 1e-12);
  CHECK(beside_end >= 1e4 * middle);
  CHECK(relative(8e-3) >= 0.1);
}

// What such a training is worth is decided by the accuracy of its snapshots.  1e-10 is that of a good solver.
TEST_CASE(
    "with 1e-10 of noise in the snapshots the error of 50 equidistant ones is above a percent, of 50 "
    "Chebyshev ones 1e-10",
    "[thesis]") {
  const auto force_error = [](auto nodes) {
    FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 64, tight_solver());
    const auto force = [&model](double d) { return model.press({thesis_length / 2, d}).force; };
    // The thesis interpolates what FEM gives; what is compared here is the nodes, so both take F/d.
    NoisyForce<decltype(nodes)> noisy(50, 1e-3, 50e-3, 1e-10, force);
    double worst = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const double d = 1e-3 + 49e-3 * (trial + 0.5) / 400;
      worst = std::max(worst, std::abs(noisy(d) / force(d) - 1));
    }
    return worst;
  };
  const double equidistant = force_error(EquispacedNodes{}), chebyshev = force_error(ChebyshevNodes{});
  INFO("50 equidistant " << equidistant << ", 50 Chebyshev " << chebyshev);
  CHECK(equidistant > 1e-2);
  CHECK(chebyshev <= 3.5 * 2e-10);
}
