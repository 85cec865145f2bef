// The trained models as ForceModels: both kinds, both scalars, one position or many, guarded or not.
#include "conformance/force_model_suite.hpp"
#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The plan of the whole beam, or of one place.
TrainingPlan plan(const Beam& beam, bool anywhere) {
  return anywhere ? TrainingPlan::anywhere(beam, 0.05, 12, 10)
                  : TrainingPlan::at(0.4 * beam.length(), 0.05, 10);
}

template <class Model>
auto train(const Beam& beam, const TrainingPlan& plan);

template <>
auto train<PodModel<>>(const Beam& beam, const TrainingPlan& plan) {
  return train_pod(take_snapshots(beam, full_model(beam, 64), plan));
}
template <>
auto train<GalerkinModel<>>(const Beam& beam, const TrainingPlan& plan) {
  return train_galerkin(take_snapshots_at_tensions(beam, full_model(beam, 64), plan));
}

template <class Model, typename Scalar>
using As = std::conditional_t<std::is_same_v<Model, PodModel<>>, PodModel<Scalar>, GalerkinModel<Scalar>>;

template <class Model, typename Scalar = double>
void check(Support left, Support right, bool anywhere) {
  const Beam beam = thesis_beam(left, right);
  const auto data = cast<Scalar>(train<Model>(beam, plan(beam, anywhere)));
  check_force_model([&data] { return As<Model, Scalar>(data); });
}

}  // namespace

TEMPLATE_TEST_CASE("a trained model keeps the contract of a ForceModel", "[contract][rom]", PodModel<>,
                   GalerkinModel<>) {
  SECTION("between hinges") { check<TestType>(Support::pinned, Support::pinned, true); }
  SECTION("between hinges, in float") { check<TestType, float>(Support::pinned, Support::pinned, true); }
  SECTION("between clamps") { check<TestType>(Support::clamped, Support::clamped, true); }
  SECTION("as a cantilever") { check<TestType>(Support::clamped, Support::free, true); }
  SECTION("as a cantilever to the left") { check<TestType>(Support::free, Support::clamped, true); }
  SECTION("as half a beam") { check<TestType>(Support::roller, Support::guided, true); }
  SECTION("at one place") { check<TestType>(Support::pinned, Support::clamped, false); }
}

TEST_CASE("a guarded model keeps the contract of a ForceModel", "[contract][rom]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const auto data = train<PodModel<>>(beam, TrainingPlan::anywhere(beam, 0.01, 12, 10));
  check_force_model([&] { return Guarded<PodModel<>, FemModel<>>(PodModel<>(data), FemModel<>(beam, 16)); });
}
