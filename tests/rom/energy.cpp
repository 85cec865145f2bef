// Work over closed paths of the contact.  A hand that comes back to where it was must have got back what it gave, or
// the model feeds the loop.
//
// The frictionless contact does the work F (dd - w' ds) = F (dd + θ ds), w' the slope at the contact.
#include <cmath>
#include <vector>

#include "rom/trained.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/galerkin_model.hpp>
#include <hapbeam/rom/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

/// Work over a loop of sines, over the most that was stored on the way.
template <class Model>
double gain(Model& model, std::uint64_t seed) {
  Random random(seed);
  double phase[6], size[6];
  for (int k = 0; k < 6; ++k) phase[k] = random(3.14), size[k] = random(0.3, 1.0);
  const auto wave = [&](int first, double t) {  // in [-1, 1]
    double sum = 0, all = 0;
    for (int k = 0; k < 3; ++k) {
      sum += size[first + k] * std::sin((k + 1) * t + phase[first + k]);
      all += size[first + k];
    }
    return sum / all;
  };
  const auto place = [&](double t) {
    return Press<double>{L * (0.5 + 0.44 * wave(0, t)), 0.025 + 0.024 * wave(3, t)};
  };
  // Trapezium rule on a periodic smooth integrand: it converges faster than any power.
  const int steps = 4000;
  const double turn = 2 * std::acos(-1.0), h = turn / steps;
  double work = 0, least = 0, most = 0;
  model.reset();
  for (int k = 0; k < steps; ++k) {
    const double t = k * h, e = 1e-4;
    const Press<double> press = place(t), ahead = place(t + e), behind = place(t - e);
    const Response<double> response = model.press(press);
    REQUIRE(response.status == Status::ok);
    const double theta = model.shape().at(press.s).theta;
    work += h * response.force * ((ahead.d - behind.d) + theta * (ahead.s - behind.s)) / (2 * e);
    least = std::min(least, work), most = std::max(most, work);
  }
  return std::abs(work) / (most - least);
}

template <class Model>
double worst_gain(Model&& model) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) worst = std::max(worst, gain(model, seed));
  return worst;
}

}  // namespace

// Finite elements are off by what the moving mesh changes of the energy: their discretisation error, of fourth order or
// better.  Both reduced models derive force and rotation from one function, so what is left is the
// quadrature of this test, the differences of the path (1e-8) and, for Galerkin's, the settling of its iteration.
TEST_CASE("closed paths of the contact neither gain nor lose energy", "[energy]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const double coarse = worst_gain(FemModel<>(beam, 32)), fine = worst_gain(FemModel<>(beam, 64));
  const double pod = worst_gain(PodModel<>(trained_pod(beam, TrainingPlan::anywhere(beam, 0.05))));
  const double galerkin =
      worst_gain(GalerkinModel<>(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05))));
  INFO("FEM 32 " << coarse << ", FEM 64 " << fine << ", POD " << pod << ", Galerkin " << galerkin);
  CHECK(coarse <= 1e-5);
  CHECK(fine <= coarse / 8);
  CHECK(pod <= 1e-7);
  CHECK(galerkin <= 1e-7);
}

TEST_CASE("nor do those of a coarse reduced model, whatever its error", "[energy]") {
  const Beam beam = thesis_beam(Support::clamped, Support::pinned);
  CHECK(worst_gain(PodModel<>(trained_pod(beam, TrainingPlan::anywhere(beam, 0.05, 4, 3)))) <= 1e-7);
  CHECK(worst_gain(GalerkinModel<>(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05, 4, 3)))) <=
        1e-6);
}

TEST_CASE("nor those of a beam under dead loads", "[energy]") {
  Beam beam = thesis_beam(Support::pinned, Support::pinned);
  beam.transverse([](double s) { return -60 * s; }).axial(20);
  TrainingPlan plan = TrainingPlan::anywhere(beam, 0.05, 12, 16);
  plan.symmetric = false;
  CHECK(worst_gain(PodModel<>(trained_pod(beam, plan))) <= 1e-7);
}
