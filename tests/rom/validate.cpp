// The error report: of presses that were not trained with, reproducible, by regions that make up the whole.
#include "rom/trained.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/galerkin_model.hpp>
#include <hapbeam/rom/pod_model.hpp>
#include <hapbeam/rom/validate.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Beam pinned() { return thesis_beam(Support::pinned, Support::pinned); }

/// Off by a known part of the force: 1 % in the left half and 3 % in the right one.
class Wrong : public FemModel<> {
 public:
  using FemModel<>::FemModel;
  Response<double> press(const Press<double>& request) noexcept {
    Response<double> response = FemModel<>::press(request);
    response.force *= request.s < thesis_length / 2 ? 1.01 : 0.97;
    return response;
  }
  Range<double> range() const noexcept {
    Range<double> range = FemModel<>::range();
    return {0.1 * thesis_length,    0.9 * thesis_length,    0.02, 1,
            range.left_support - 1, range.right_support + 1};
  }
};

}  // namespace

TEST_CASE("a model against itself has no error, one with a known error has that", "[validate]") {
  const FemModel<> full(pinned(), 16);
  ValidationOptions options;
  options.presses = 200;
  options.s_regions = 2;
  const ErrorReport wrong = validate(Wrong(pinned(), 16), full, options, "itself");
  CHECK(wrong.reference == "itself");
  CHECK(wrong.all.presses == 200);
  CHECK(wrong.all.force_max == Approx(0.03).epsilon(1e-5));
  CHECK(wrong.all.force_p95 == Approx(0.03).epsilon(1e-5));
  CHECK(wrong.all.shape_max <= 1e-7);
  REQUIRE(wrong.regions.size() == 6);
  int presses = 0;
  for (const RegionError& region : wrong.regions) {
    presses += region.errors.presses;
    REQUIRE(region.errors.presses > 0);
    CHECK(region.errors.force_max ==
          Approx(region.s_max <= thesis_length / 2 + 1e-9 ? 0.01 : 0.03).epsilon(1e-5));
    CHECK(region.errors.force_median == Approx(region.errors.force_max).epsilon(1e-5));
  }
  CHECK(presses == 200);
}

TEST_CASE(
    "presses are held out: the same for the same seed, the range's edges among them, none of them a training "
    "node",
    "[validate]") {
  const FemModel<> full(pinned(), 32);
  const PodModelData<double> data = trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.02, 6, 5));
  const PodModel<> model(data);
  const auto errors = press_errors(model, full);
  REQUIRE(errors.size() == 500);
  const Snapshots snapshots = take_snapshots(pinned(), full, TrainingPlan::anywhere(pinned(), 0.02, 6, 5));
  int at_edges = 0, shallow = 0;
  for (const PressError& error : errors) {
    at_edges += error.s == model.range().s_min || error.s == model.range().s_max || error.depth == 0.02;
    CHECK((error.depth > 0 && error.depth <= 0.02 * (1 + 1e-12)));
    shallow += error.depth < 0.02 * 0.02;
    for (const Snapshot& snapshot : snapshots.grid)
      CHECK((error.s != snapshot.s || error.depth != snapshot.d));
  }
  CHECK(shallow > 40);
  CHECK(at_edges == 154);  // four corners, and three of ten
  CHECK(validate(model, full).all.force_max == validate(model, full).all.force_max);
  ValidationOptions other;
  other.seed = 2;
  CHECK(validate(model, full, other).all.force_max != validate(model, full).all.force_max);
}

TEST_CASE("the report of a trained model is kept with it", "[validate]") {
  const FemModel<> full(pinned(), 64);
  GalerkinModelData<double> data = trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.02, 12, 8));
  data.errors = validate(GalerkinModel<>(data), full);
  const GalerkinModel<> model(data);
  CHECK(model.errors().all.force_max > 0);
  CHECK(model.errors().all.force_max <= 1e-3);
  CHECK(model.errors().all.shape_max <= 1e-2);
  CHECK(model.errors().regions.size() == 9);
}

TEST_CASE("a full model that does not answer fails the validation", "[validate]") {
  const PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.02, 4, 4)));
  const PodModel<> smaller(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.01, 4, 4)));
  CHECK_THROWS_AS(validate(model, smaller), TrainingError);
}

// Relative errors are of forces, and a beam under dead loads has places where it takes none to hold it.
TEST_CASE("under dead loads depth counts from where the beam hangs", "[validate]") {
  Beam beam = pinned();
  beam.transverse(-200);  // hangs 11 mm
  TrainingPlan plan = TrainingPlan::anywhere(beam, 0.02, 16, 20);
  plan.symmetric = false;
  const FemModel<> full(beam, 64);
  const PodModel<> model(trained_pod(beam, plan));
  for (const PressError& error : press_errors(model, full)) {
    CHECK(error.force <= 2e-2);
    CHECK(error.depth <= 0.02);
  }
}
