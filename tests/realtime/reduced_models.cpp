// Trained models in a servo loop: no allocation, no exception, and a cost that knows nothing of elements.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <utility>

#include "once_training.hpp"
#include "realtime/requests.hpp"
#include "support/catch.hpp"
#include "support/instructions.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class Model>
constexpr bool is_noexcept() {
  using S = typename Model::Scalar;
  static_assert(is_force_model<Model>);
  static_assert(noexcept(std::declval<Model&>().force(std::declval<const Press<S>&>())));
  static_assert(noexcept(std::declval<const Model&>().errors()));
  static_assert(noexcept(std::declval<const Model&>().data()));
  return true;
}
static_assert(is_noexcept<PodModel<>>() && is_noexcept<PodModel<float>>() && is_noexcept<GalerkinModel<>>() &&
              is_noexcept<GalerkinModel<float>>());
static_assert(is_force_model<Guarded<PodModel<>, FemModel<>>>);

PodModelData<double> pod(int elements = 64, int segments = 32) {
  TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.05);
  plan.segments = segments;
  return train_pod(take_snapshots(pinned(), full_model(pinned(), elements), plan), Truncation::count(10));
}

GalerkinModelData<double> galerkin(int elements = 64, int segments = 32) {
  TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.05);
  plan.segments = segments;
  return train_galerkin(take_snapshots_at_tensions(pinned(), full_model(pinned(), elements), plan),
                        Truncation::count(10));
}

/// Asks the model everything that a servo may ask, and counts what was not finite.
template <class Model, class Path>
int drive(Model& model, const Path& path) noexcept {
  using S = typename Model::Scalar;
  int not_finite = 0;
  S looked_at = 0;
  for (const Press<S>& press : path) {
    const Response<S> response = model.press(press);
    not_finite += !std::isfinite(response.force);
    for (const auto& node : model.shape()) not_finite += !std::isfinite(node.u + node.w + node.theta);
    looked_at += model.range().depth + model.thickness();
  }
  model.reset();
  keep(looked_at);
  return not_finite;
}

template <class Model>
void check_heap(Model model) {
  using S = typename Model::Scalar;
  const auto path = requests(model.range(), model.shape().length(), 1);
  int not_finite = -1;
  CHECK(heap_use([&] { not_finite = drive(model, path); }) == HeapUse{});
  CHECK(not_finite == 0);
  // Far beyond any beam too.
  std::vector<Press<S>> far;
  for (const S d :
       {S(1e-30), S(1e6), S(1e30), std::numeric_limits<S>::max(), std::numeric_limits<S>::denorm_min()})
    for (const S s : {S(0), S(0.3), S(1.27), model.shape().length()})
      far.push_back({s, d}), far.push_back({s, -d});
  CHECK(drive(model, far) == 0);
}

}  // namespace

TEST_CASE("a trained model touches no heap, whatever is asked, and every force and shape is finite") {
  SECTION("POD") { check_heap(PodModel<>(pod())); }
  SECTION("POD in float") { check_heap(PodModel<float>(cast<float>(pod()))); }
  SECTION("Galerkin") { check_heap(GalerkinModel<>(galerkin())); }
  SECTION("Galerkin in float") { check_heap(GalerkinModel<float>(cast<float>(galerkin()))); }
  SECTION("guarded") {
    check_heap(Guarded<PodModel<>, FemModel<>>(PodModel<>(pod()), FemModel<>(pinned(), 16)));
  }
}

TEST_CASE("a touch of a trained model touches no heap") {
  PodModel<> model{pod()};
  Touch<PodModel<>> touch(model, 0.01);
  double looked_at = 0;
  CHECK(heap_use([&] {
          for (int tick = 0; tick < 2000; ++tick)
            looked_at +=
                touch.tick({1.27 + 0.5 * std::sin(0.01 * tick), 0.02 - 0.03 * std::sin(0.003 * tick)})
                    .force.y();
        }) == HeapUse{});
  CHECK(looked_at > 0);
}

TEST_CASE("the cost of a press does not depend on the elements that it was trained with") {
  const auto count = [](auto& model, bool shape) {
    const Press<double> press{0.4 * thesis_length, 0.02};
    return instructions([&] {
      if (shape) keep(model.press(press));
      else keep(model.force(press));
    });
  };
  if (instructions([] {}) < 0) {
    WARN("this system does not let a process count the instructions of its child: nothing was tested");
    return;
  }
  SECTION("POD") {
    PodModel<> coarse(pod(64)), fine(pod(1024));
    CHECK(count(coarse, false) > 500);
    CHECK(count(coarse, false) == count(fine, false));
    CHECK(count(coarse, true) == count(fine, true));
  }
  SECTION("Galerkin, with as many iterations") {
    GalerkinModel<> coarse(galerkin(64)), fine(galerkin(1024));
    CHECK(count(coarse, false) == count(fine, false));
    CHECK(coarse.iterations() == fine.iterations());
  }
  SECTION(
      "a press and what contact looks at cost the same with any number of points, all of the shape is linear "
      "in them") {
    const auto cost = [](int segments, bool all) {
      PodModel<> model(pod(64, segments));
      const Press<double> press{0.4 * thesis_length, 0.02};
      return instructions([&] {
        keep(model.press(press));
        keep(all ? model.shape()[0].w : model.part(press.s, press.s).line[0].w);
      });
    };
    CHECK(cost(512, false) == cost(32, false));
    // 128 points more cost twice what 64 more do, but for the ends of vectorised loops.
    const long few = cost(64, true), more = cost(128, true), most = cost(256, true);
    const double first = static_cast<double>(more - few), second = static_cast<double>(most - more);
    CHECK(first > 0);
    CHECK(second / first == Approx(2).epsilon(0.02));
  }
}
