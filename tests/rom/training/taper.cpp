// Trained models of a beam whose section changes along it.
#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {

Beam tapered_ruler() {
  Beam beam(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::pinned, Support::pinned);
  return beam.section([](double s) { return Section::rectangle(0.025, 0.003 - 0.005 * s); });
}

}  // namespace

TEST_CASE("a POD model learns a taper", "[taper][pod]") {
  const Beam beam = tapered_ruler();
  FemModel<Corotational<Tapered<>>> full(beam, 64);
  PodModel<> pod(train_pod(take_snapshots(beam, full, TrainingPlan::anywhere(beam, 0.006))));
  for (const double s : {0.05, 0.1, 0.17, 0.26})
    for (const double d : {5e-4, 0.003, -0.005}) {
      const auto trained = pod.press({s, d}), answer = full.press({s, d});
      INFO("at " << s << ", " << d);
      REQUIRE(trained.status == Status::ok);
      CHECK(std::abs(trained.force / answer.force - 1) <= 1e-4);
    }
}

TEST_CASE("a Galerkin model and a full model of one section reject a taper", "[taper][galerkin]") {
  const Beam beam = tapered_ruler();
  const FemModel<Corotational<Tapered<>>> full(beam, 16);
  const TrainingPlan plan = TrainingPlan::anywhere(beam, 0.006);
  CHECK_THROWS_WITH(take_snapshots_at_tensions(beam, full, plan), ContainsSubstring("beam sections"));
  Beam shears(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::pinned, Support::pinned);
  shears.shear(5e6);
  const FemModel<Corotational<Tapered<>>> that_shears(shears, 16);
  CHECK_THROWS_WITH(take_snapshots_at_tensions(shears, that_shears, plan),
                    ContainsSubstring("beam shear stiffness"));
  const Beam plain(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::pinned, Support::pinned);
  CHECK_THROWS_WITH(take_snapshots(beam, FemModel<Corotational<>>(plain, 16), plan),
                    ContainsSubstring("beam sections"));
}
