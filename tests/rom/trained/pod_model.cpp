// PodModel: its force against closed form and finite elements, inside its range and outside.
#include <algorithm>
#include <vector>

#include "once_training.hpp"
#include "rom/training/press_errors.hpp"
#include "rom/training/trained.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

}  // namespace

TEST_CASE("14 snapshots at mid-span give the force of any press up to 50 mm within 1e-6", "[pod_model]") {
  const PodModel<> model(trained_pod(pinned(), TrainingPlan::at(L / 2, 0.05, 14)));
  // Between the nodes, from 2 % of the range up.
  for (int k = 0; k <= 200; ++k) {
    const double d = 0.05 * (0.02 + 0.98 * k / 200);
    const Response<double> response = model.force({L / 2, d});
    REQUIRE(response.status == Status::ok);
    CHECK(relative_error(response.force, pinned_closed_form(L / 2, d)) <= 1e-6);
  }
}

TEST_CASE("16 x 12 snapshots give the force of any press on 5 to 95 % of a pinned beam within 1e-4",
          "[pod_model]") {
  PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  const ForceErrors errors = force_errors(model, pinned_closed_form, 0, 0.05);
  CHECK(errors.max() <= 1e-4);
  CHECK(errors.median() <= 1e-6);
  const ForceErrors shallow = force_errors(model, pinned_closed_form, 0, 0.005);
  CHECK(shallow.max() <= 1e-4);
}

TEST_CASE("and of a press up to 5 mm, trained for that, within 1e-5", "[pod_model]") {
  PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.005)));
  CHECK(force_errors(model, pinned_closed_form, 0, 0.005).max() <= 1e-5);
}

TEST_CASE("16 x 12 snapshots serve clamped beams and cantilevers as well, against 64 elements",
          "[pod_model]") {
  const auto [left, right] = GENERATE(
      table<Support, Support>({{Support::clamped, Support::clamped}, {Support::clamped, Support::free}}));
  const Beam beam = thesis_beam(left, right);
  PodModel<> model(trained_pod(beam, TrainingPlan::anywhere(beam, 0.05)));
  FemModel<> full(beam, 64, tight_solver());
  const ForceErrors errors = force_errors(model, from_rest(full), 0, 0.05);
  CHECK(errors.max() <= 1e-4);
  CHECK(errors.median() <= 1e-5);
  CHECK(force_errors(model, from_rest(full), 0, 0.005).max() <= 1e-4);
}

// 2V/e² keeps the digits of float: what is left of them is the error of the interpolation, and 1e-6 of round-off.
TEST_CASE("in float the potential keeps its digits", "[pod_model][float]") {
  PodModel<float> model(cast<float>(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05))));
  const ForceErrors errors = force_errors(model, pinned_closed_form, 0.001, 0.05);
  CHECK(errors.max() <= 1e-4);
  CHECK(errors.median() <= 1e-5);
}

TEST_CASE("force() and press() agree, and force() leaves the shape alone", "[pod_model]") {
  PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  model.press({0.7, 0.01});
  for (const Press<double>& press :
       {Press<double>{1.0, 0.02}, Press<double>{2.0, -0.04}, Press<double>{2.0, 0.2},
        Press<double>{0.01, 0.02}, Press<double>{-1, 0}}) {
    const Response<double> alone = model.force(press);
    CHECK(model.shape().at(0.7).w == 0.01);
    PodModel<> other(model);
    const Response<double> with_shape = other.press(press);
    CHECK(alone.force == with_shape.force);
    CHECK(alone.status == with_shape.status);
  }
}

TEST_CASE("deeper than its range the force goes on with the tangent at its end, and never falls",
          "[pod_model]") {
  const double s = GENERATE(0.06, 0.31, 0.5, 0.94) * L, side = GENERATE(1.0, -1.0);
  const PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  const auto force = [&](double d) { return side * model.force({s, side * d}).force; };
  const double at_end = force(0.05), stiffness = (at_end - force(0.0499)) / 1e-4;
  double before = at_end;
  for (double d = 0.0501; d < 10; d *= 1.3) {
    CHECK(model.force({s, side * d}).status == Status::out_of_range);
    CHECK(force(d) > before);
    // Constant: the one stiffness holds at any depth.  The difference quotient above is good to 1e-4/0.05 of the change
    // of stiffness over the range.
    CHECK((force(d) - at_end) / (d - 0.05) == Approx(stiffness).epsilon(5e-3));
    before = force(d);
  }
  CHECK(std::isfinite(model.force({s, 1e300}).force));
}

TEST_CASE("beside its range in s the answer is that of the nearest place, and says so", "[pod_model]") {
  const PodModel<> model(trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  for (const auto& [asked, nearest] : {std::pair{0.01 * L, 0.05 * L}, std::pair{L, 0.95 * L}}) {
    CHECK(model.force({asked, 0.01}).status == Status::out_of_range);
    CHECK(model.force({asked, 0.01}).force == model.force({nearest, 0.01}).force);
  }
}

// 12 nodes for each sign; the dead loads are those of the other tests, 1 kN/m in all.
TEST_CASE("a beam under dead loads is trained with both signs", "[pod_model]") {
  Beam beam = pinned();
  beam.transverse([](double s) { return -60 * s; }).axial(20).add({0.3, 100, -40, 2});
  TrainingPlan plan = TrainingPlan::anywhere(beam, 0.05, 16, 24);
  CHECK_THROWS_WITH(trained_pod(beam, plan), "symmetric = true: must be false for a beam under dead loads");
  plan.symmetric = false;
  PodModel<> model(trained_pod(beam, plan));
  FemModel<> full(beam, 64, tight_solver());
  const double rest = full.shape().at(L / 2).w;
  CHECK(model.shape().at(L / 2).w == Approx(rest).epsilon(1e-6));
  const ForceErrors errors = force_errors(model, from_rest(full), 0.005, 0.05);
  CHECK(errors.max() <= 1e-3);
  CHECK(errors.median() <= 1e-4);
  // Held where it hangs it takes no force, but for the error of interpolating where it hangs.
  CHECK(std::abs(model.press({L / 2, rest}).force) <= 1e-4 * std::abs(model.press({L / 2, 0}).force));
}

TEST_CASE("the tip of a cantilever is in range, and the shape passes through it", "[pod_model]") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  PodModel<> model(trained_pod(beam, TrainingPlan::anywhere(beam, 0.05)));
  for (const double s : {L, 0.9995 * L, 0.99 * L}) {
    const Response<double> response = model.press({s, 0.03});
    CHECK(response.status == Status::ok);
    CHECK(relative_error(response.force, 3 * thesis_EI * 0.03 / (s * s * s)) <= 1e-6);
    CHECK(model.shape().at(s).w == Approx(0.03).epsilon(1e-14));
    CHECK(model.shape().at(s).theta == Approx(-1.5 * 0.03 / s).epsilon(1e-5));
    CHECK(model.shape().length() == L);
  }
}

TEST_CASE("data that do not make a model are refused by name", "[pod_model]") {
  const PodModelData<double> good = trained_pod(pinned(), TrainingPlan::anywhere(pinned(), 0.05, 4, 4));
  const auto refused = [&good](auto spoil, const char* message) {
    PodModelData<double> bad = good;
    spoil(bad);
    CHECK_THROWS_WITH(PodModel<>(bad), Catch::Matchers::ContainsSubstring(message));
  };
  using Data = PodModelData<double>;
  refused([](Data& d) { d.positions = 65; }, "positions = 65: must be 1 to 64");
  refused([](Data& d) { d.depths = 1; }, "depths = 1: must be 2 to 64");
  refused([](Data& d) { d.depth = 0; }, "depth = 0 m: must be positive");
  refused([](Data& d) { d.s_min = 0; }, "s_min = 0 m: must be");
  refused([](Data& d) { d.s_max = 3; }, "s_max = 3 m: must be");
  refused([](Data& d) { d.beam.length = -1; }, "length = -1 m: must be positive");
  refused([](Data& d) { d.y_low = 9; }, "y_low");
  refused([](Data& d) { d.potential.pop_back(); }, "potential = 15");
  refused([](Data& d) { d.potential[3] = std::nan(""); }, "potential");
  refused([](Data& d) { d.potential[3] = -1; }, "potential = -1");
  refused([](Data& d) { d.rest.push_back(0); }, "rest");
  refused([](Data& d) { d.rest[2] = 1e-3; }, "rest = 0.001: must be 0 where symmetric");
  refused([](Data& d) { d.shape.modes = 0; }, "modes = 0");
  refused([](Data& d) { d.shape.segments = 1 << 20; }, "segments");
  refused([](Data& d) { d.shape.contact_node = 33; }, "contact_node = 33: must be 0 to 32");
  refused([](Data& d) { d.shape.basis.pop_back(); }, "basis");
  refused([](Data& d) { d.shape.coefficients.clear(); }, "coefficients");
  refused([](Data& d) { d.shape.rest.clear(); }, "rest_shape");
}

TEST_CASE("half beams, symmetric at a guided end, are met with as many snapshots", "[pod_model]") {
  const Beam beam = thesis_half(Support::pinned);
  PodModel<> model(trained_pod(beam, TrainingPlan::anywhere(beam, 0.02)));
  // A press at the plane of symmetry takes half of the force that the whole beam takes there.
  for (const double d : {0.001, 0.01, 0.02})
    CHECK(relative_error(2 * model.press({beam.length(), d}).force, pinned_closed_form(L / 2, d)) <= 1e-3);
}

TEST_CASE("equidistant depths may be trained, if the snapshots have them", "[pod_model]") {
  const FemModel<> full(pinned(), 64, tight_solver());
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.02, 9, 8);
  CHECK_THROWS_WITH(trained_pod(take_snapshots<EquispacedNodes>(pinned(), full, plan)),
                    Catch::Matchers::ContainsSubstring("nodes = equispaced: must be chebyshev"));
  CHECK_THROWS_WITH(trained_equispaced_pod(take_snapshots(pinned(), full, plan)),
                    Catch::Matchers::ContainsSubstring("nodes = chebyshev: must be equispaced"));
  PodModel<double, EquispacedNodes> model(
      trained_equispaced_pod(take_snapshots<EquispacedNodes>(pinned(), full, plan)));
  CHECK(relative_error(model.press({1.0, 0.015}).force, pinned_closed_form(1.0, 0.015)) <= 1e-3);
}

// A strip of 0.1 mm pressed 20 mm deep is pressed 700 radii of gyration: twelve depths cannot follow.
TEST_CASE("a training whose force would not be a beam's between the snapshots is refused", "[pod_model]") {
  const Beam strip(1.0, Section::rectangle(0.02, 1e-4), Material{2e11}, Support::pinned, Support::pinned);
  CHECK_THROWS_WITH(trained_pod(strip, TrainingPlan::anywhere(strip, 0.02)),
                    Catch::Matchers::ContainsSubstring("depths = 12: must be more, or the plan less deep"));
  const PodModel<> model(trained_pod(strip, TrainingPlan::anywhere(strip, 0.02, 16, 32)));
  double before = 0;
  for (double d = 1e-7; d < 0.02; d *= 1.05) {
    const double force = model.force({0.5, d}).force;
    CHECK(force > before);
    before = force;
  }
}

TEST_CASE("a range that does not reach past where the beam hangs is refused", "[pod_model]") {
  Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free);
  ruler.transverse(-1.93);  // its own weight; the tip hangs 4.6 mm
  TrainingPlan plan = TrainingPlan::at(0.3, 0.003);
  plan.symmetric = false;
  CHECK_THROWS_WITH(trained_pod(ruler, plan),
                    Catch::Matchers::ContainsSubstring("depth = 0.003 m: must be more than dead loads bend"));
}

TEST_CASE("a range at its narrowest and at its edges is the same in float, or refused",
          "[pod_model][float]") {
  Random random(9);
  for (int k = 0; k < 20; ++k) {
    const double length = random(0.1, 5);
    const Beam beam(length, 1e6, 1e2, 1e-2, Support::pinned, Support::pinned);
    const TrainingPlan plan{length / 1000, length - length / 1000, 3, length / 4000, 3};
    CHECK_NOTHROW(PodModel<float>(cast<float>(trained_pod(beam, plan, 16))));
  }
  const auto narrow = trained_pod(pinned(), TrainingPlan{1.0, 1.0 + 1e-6, 16, 0.01, 4}, 16);
  CHECK_NOTHROW(PodModel<>(narrow));
  CHECK_THROWS_AS(PodModel<float>(cast<float>(narrow)), std::invalid_argument);
}

TEST_CASE(
    "beside the contact the pieces that contact looks at are those of the whole shape, and elsewhere too",
    "[pod_model]") {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::pinned, Support::pinned},
                                                               {Support::clamped, Support::free},
                                                               {Support::free, Support::clamped},
                                                               {Support::roller, Support::guided}}));
  const Beam beam = thesis_beam(left, right);
  const auto compare = [&](auto model) {
    const Range<double> range = model.range();
    Random random(5);
    for (int k = 0; k < 200; ++k) {
      const double s = k == 0 ? range.s_max : random(range.s_min, range.s_max);
      const double d = random(1) * range.depth_at(s);
      model.press({s, d});
      // The contact's place, from there to any other, or a node: then both of its pieces.
      const double node = model.shape()[random.integer(0, model.shape().segments())].s;
      const double other = k % 2 ? s : random(0, beam.length());
      const double low = k % 3 ? std::min(s, other) : node, high = k % 3 ? std::max(s, other) : node;
      model.press({s, d});
      std::vector<CentrelineNode<double>> seen;
      const CentrelinePart<double> part = model.part(low, high);
      seen.assign(part.line.begin(), part.line.end());
      const Centreline<double> shape = model.shape();
      REQUIRE(part.segments == shape.segments());
      REQUIRE((part.begins() || seen.front().s < low));
      REQUIRE((part.ends() || seen.back().s > high));
      double apart = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const CentrelineNode<double>& drawn = shape[part.first + static_cast<int>(i)];
        REQUIRE(std::abs(seen[i].s - drawn.s) <= 1e-15 * beam.length());
        apart = std::max({apart, std::abs(seen[i].u - drawn.u) / std::abs(d),
                          std::abs(seen[i].w - drawn.w) / std::abs(d),
                          std::abs(seen[i].theta - drawn.theta) * beam.length() / std::abs(d)});
      }
      REQUIRE(apart <= 1e-11);
    }
  };
  const auto plan = TrainingPlan::anywhere(beam, 0.02, 12, 10);
  SECTION("POD") { compare(PodModel<>(trained_pod(beam, plan, 32))); }
  SECTION("Galerkin") { compare(GalerkinModel<>(trained_galerkin(beam, plan, 32))); }
}
