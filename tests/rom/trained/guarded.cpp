// Guarded: the fast model inside its range, the full one outside, and no step between them larger than their difference.
#include "once_training.hpp"
#include "rom/training/trained.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/validate.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

using Model = Guarded<PodModel<>, FemModel<>>;

PodModelData<double> data() {
  static const PodModelData<double> trained = trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.02));
  return trained;
}

}  // namespace

TEST_CASE("Guarded answers with the fast model in its range and with the full one elsewhere", "[guarded]") {
  Model model(PodModel<>(data()), FemModel<>(pinned(), 32));
  PodModel<> fast(data());
  FemModel<> full(pinned(), 32);
  for (const Press<double>& press : {Press<double>{0.5 * L, 0.01}, Press<double>{0.3 * L, -0.02}}) {
    const Response<double> response = model.press(press);
    CHECK(response.status == Status::ok);
    CHECK(response.force == fast.press(press).force);
    CHECK_FALSE(model.full_answers());
    CHECK(model.shape().size() == fast.shape().size());
  }
  for (const Press<double>& press : {Press<double>{0.5 * L, 0.03}, Press<double>{0.02 * L, 0.01}}) {
    const Response<double> response = model.press(press);
    CHECK(response.status == Status::ok);
    CHECK(response.force == Approx(full.press(press).force).epsilon(1e-7));
    CHECK(model.full_answers());
    CHECK(model.shape().at(press.s).w == Approx(press.d));
  }
  CHECK(model.press({0.5 * L, 1}).status == Status::out_of_range);
  CHECK(model.press({0.5 * L, std::nan("")}).status == Status::invalid_request);
  CHECK(model.full_answers());
  model.reset();
  CHECK_FALSE(model.full_answers());
  CHECK(model.range().depth == full.range().depth);
}

TEST_CASE("the step at the hand-over is within the error that the fast model states", "[guarded]") {
  const FemModel<> full(pinned(), 64);
  PodModelData<double> stated = data();
  stated.errors = validate(PodModel<>(stated), full);
  Model model(PodModel<>(stated), full);
  const double error = model.fast().errors().all.force_max;
  CHECK(error > 0);
  for (int k = 0; k <= 40; ++k) {
    const double s = std::min(L * (0.05 + 0.9 * k / 40), 0.95 * L), d = 0.02;
    const double inside = model.press({s, d}).force;
    REQUIRE_FALSE(model.full_answers());
    const double outside = model.press({s, std::nextafter(d, 1.0)}).force;
    REQUIRE(model.full_answers());
    INFO("s " << s << ": " << outside / inside - 1 << " of " << error);
    CHECK(std::abs(outside - inside) <= error * std::abs(inside));
  }
  for (const double d : {0.002, 0.01, 0.019}) {
    const double inside = model.press({0.05 * L, d}).force;
    const double outside = model.press({std::nextafter(0.05 * L, 0.0), d}).force;
    CHECK(std::abs(outside - inside) <= error * std::abs(inside));
  }
}

TEST_CASE("handing over takes at most a dozen solves", "[guarded]") {
  Model model(PodModel<>(data()), FemModel<>(pinned(), 32));
  int most = 0;
  for (int crossing = 0; crossing < 50; ++crossing) {
    const double s = L * (0.1 + 0.8 * crossing / 50);
    model.press({s, 0.0199});
    model.press({s, 0.0201});
    REQUIRE(model.full_answers());
    most = std::max(most, model.full().report().solves);
  }
  CHECK(most <= 12);
}

TEST_CASE("a hand that presses through the edge feels one beam", "[guarded]") {
  Model model(PodModel<>(data()), FemModel<>(pinned(), 32));
  Touch<Model> touch(model, 0.005);
  const double clear = model.thickness() / 2 + 0.005;
  double before = 0, step_before = 0;
  bool handed_over = false;
  for (int tick = 0; tick <= 3000; ++tick) {
    const auto felt = touch.tick({0.4 * L, clear + 0.001 - 1e-5 * tick});
    REQUIRE(is_answer(felt.status));
    const double step = felt.force.y() - before;
    // Ten microns change the force by at most 6 N here, evenly.
    if (tick > 300) CHECK(std::abs(step - step_before) <= 0.05);
    before = felt.force.y(), step_before = step;
    handed_over = handed_over || model.full_answers();
  }
  CHECK(handed_over);
}
