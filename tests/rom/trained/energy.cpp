// Work over closed paths of the contact.  tests/stability/training.cpp has what it is without a potential.
#include "rom/training/trained.hpp"
#include "support/catch.hpp"
#include "support/closed_path.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class Model>
double worst_gain(Model&& model) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) worst = std::max(worst, gain(feel_of(model), seed));
  return worst;
}

}  // namespace

// Cubic elements are off by what the moving mesh changes of the energy: their discretisation error, of fourth order or
// better.  The closed form has no mesh, and both reduced models derive force and rotation from one function, so what is left is the
// quadrature of this test, the differences of the path (1e-8) and, for Galerkin's, the settling of its iteration.
TEST_CASE("closed paths of the contact neither gain nor lose energy", "[energy]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  using Cubic = FemModel<VonKarman<AssumedStrain>>;
  const double coarse = worst_gain(Cubic(beam, 32)), fine = worst_gain(Cubic(beam, 64)),
               closed = worst_gain(FemModel<>(beam, 8));
  const double pod = worst_gain(PodModel<>(trained_pod(beam, TrainingPlan::anywhere(beam, 0.05))));
  const double galerkin =
      worst_gain(GalerkinModel<>(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05))));
  INFO("cubic 32 " << coarse << ", cubic 64 " << fine << ", closed " << closed << ", POD " << pod
                   << ", Galerkin " << galerkin);
  CHECK(coarse <= 1e-5);
  CHECK(fine <= coarse / 8);
  CHECK(closed <= 1e-7);
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
