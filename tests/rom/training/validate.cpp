// The error report: of presses that were not trained with, reproducible, by regions that make up the whole.
#include <algorithm>
#include <cmath>
#include <utility>

#include "once_training.hpp"
#include "rom/training/trained.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/training_plan.hpp>
#include <hapbeam/rom/training/validate.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

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

namespace {

/// The largest error of the force on presses at random, and at both edges of the range, against many elements.  These are no judge
/// within a thousandth of an end that yields.
template <class Model, class Element>
double worst_held_out(const Model& trained, const FullModel<Element>& truth, Random& random, int presses) {
  Model model(trained);
  FullModel<Element> full(truth);
  const auto& data = model.data();
  double worst = 0;
  for (int k = 0; k < presses; ++k) {
    const double last = std::min(data.s_max, 0.999 * data.beam.length);
    const double s = k % 10 == 0 ? data.s_min : k % 10 == 1 ? data.s_max : random(data.s_min, last);
    full.reset();
    const double rest = full.shape().at(s).w,
                 way = random.integer(0, 1) ? data.depth - rest : -data.depth - rest;
    const double e = way * (k % 20 < 2 ? 1 : k % 4 == 0 ? std::pow(10, random(-3, 0)) : random(0.001, 1));
    const Response<double> wanted = full.press({s, rest + e});
    REQUIRE(wanted.status == Status::ok);
    const double floor = rest == 0 ? 1 : std::max(1.0, data.depth / 1000 / std::abs(e));
    const double error =
        std::abs(model.press({s, rest + e}).force - wanted.force) / std::abs(wanted.force) / floor;
    worst = std::max(worst, error);
  }
  return worst;
}

}  // namespace

// Tension bends this strip within an element of the model that trains it, √(N/EI) L = 361: that one is off by 7e-4 beside
// the clamp, and no press shows it that is judged by the same model, but for what it changes from a node to the middle of an element: 1.6e-4.
TEST_CASE("the stated bound holds the error of the full model", "[validate]") {
  const Beam strip(0.4, Section::rectangle(0.01, 0.0003), Material{150e9}, Support::pinned, Support::clamped);
  using Cubic = VonKarman<AssumedStrain>;
  const FullModel<Cubic> full = full_model<Cubic>(strip, 256), truth = full_model<Cubic>(strip, 1024);
  const PodModel<> model(
      trained_pod(take_snapshots(strip, full, TrainingPlan::anywhere(strip, 0.01, 16, 20))));
  const ErrorReport report = validate(model, full);
  Random random(1);
  const double worst = worst_held_out(model, truth, random, 100);
  CHECK(report.all.force_max < worst / 4);
  CHECK(report.reference_error >= worst / 2);
  CHECK((report.force_bound >= worst && report.force_bound <= 3 * worst));
}

// 50 beams and 5000 presses of each were tried so, with none beyond its bound, and no bound that is more than round-off above 1.24
// times what was found.
TEST_CASE("no press is beyond the stated bound, and the bound is no more than three times the worst",
          "[validate]") {
  Random random(4);
  for (const auto& [left, right] : {std::pair{Support::pinned, Support::pinned},
                                    {Support::clamped, Support::pinned},
                                    {Support::clamped, Support::guided}}) {
    const double L = random(0.1, 2), h = L * std::pow(10, random(-2.7, -1.3));
    Beam beam(L, Section::rectangle(10 * h, h), Material{2e11}, left, right);
    const double depth = std::min(0.015 * L, 5 * h);
    TrainingPlan plan = TrainingPlan::anywhere(beam, depth, 12, 12);
    const FullModel<> full = full_model(beam, 96), truth = full_model(beam, 384);
    INFO(name(left) << "-" << name(right) << ", h/L " << h / L << ", depth/L " << depth / L);
    const GalerkinModel<> galerkin(trained_galerkin(beam, plan, 96));
    const double found = worst_held_out(galerkin, truth, random, 300),
                 bound = validate(galerkin, full).force_bound;
    CHECK((found <= bound && bound <= 3 * found));
    beam.transverse(-30 * beam.bending_stiffness() / std::pow(L, 4) * depth);
    plan.symmetric = false;
    const PodModel<> pod(trained_pod(beam, plan, 96));
    const double loaded = worst_held_out(pod, full_model(beam, 384), random, 300);
    const double stated = validate(pod, full_model(beam, 96)).force_bound;
    CHECK((loaded <= stated && stated <= 3 * loaded));
  }
}

// Its worst presses are shallow ones on the edge of the range, where a sample at random has none, while many of the worst in the
// sample stand on one hill at the end that yields.
TEST_CASE("the bound is found where a sample has no press", "[validate]") {
  const Beam beam(1, Section::rectangle(0.02, 0.0025), Material{1e9}, Support::clamped, Support::guided);
  PodModel<> model(trained_pod(beam, TrainingPlan::anywhere(beam, 0.018, 26, 16), 128));
  FullModel<> full = full_model(beam, 128);
  const ErrorReport report = validate(model, full);
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const Press<double> press{model.data().s_min, 0.018 * std::pow(10, -k / 50.0)};
    full.reset();
    const double wanted = full.press(press).force;
    worst = std::max(worst, std::abs(model.press(press).force - wanted) / wanted);
  }
  INFO("bound " << report.force_bound << ", found " << worst << ", in the sample " << report.all.force_max);
  CHECK((report.force_bound >= worst && report.force_bound <= 3 * worst));
}

// There finite elements press the end's node through a straight tip, which is off by (δ/L)², 3e-6, and is what a search would find.
TEST_CASE("the bound beside a guided end is that of the trained model", "[validate]") {
  Random random(2);
  for (const bool hangs : {false, true}) {
    Beam beam(1, Section::rectangle(0.4, 0.05), Material{2e11}, hangs ? Support::clamped : Support::pinned,
              Support::guided);
    const double depth = 1e-3;
    TrainingPlan plan = TrainingPlan::anywhere(beam, depth, hangs ? 20 : 26, 14);
    if (hangs) beam.transverse(-depth * beam.bending_stiffness());
    plan.symmetric = !hangs;
    const PodModel<> model(trained_pod(beam, plan, 64));
    const double found = worst_held_out(model, full_model(beam, 128), random, 300);
    const double bound = validate(model, full_model(beam, 64)).force_bound;
    CAPTURE(hangs, found, bound);
    CHECK((found <= bound && bound <= std::max(3 * found, 1e-8)));
  }
}

TEST_CASE("no bound is below what round-off may be", "[validate]") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  const FullModel<> full = full_model(beam, 64);
  CHECK(validate(PodModel<>(trained_pod(beam, TrainingPlan::anywhere(beam, 0.01, 12, 6), 64)), full)
            .force_bound == 1e-8);
}
