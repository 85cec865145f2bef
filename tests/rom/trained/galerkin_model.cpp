// GalerkinModel: one unknown, right inside the trained range and beyond it.
#include "once_training.hpp"
#include "rom/training/press_errors.hpp"
#include "rom/training/trained.hpp"
#include "support/error.hpp"
#include "support/global_modes.hpp"
#include "support/solver.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

}  // namespace

TEST_CASE("one unknown gives the force of any press up to 50 mm within 3e-3, the median within 1e-5",
          "[galerkin]") {
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  const ForceErrors errors = force_errors(model, pinned_closed_form, 0, 0.05);
  CHECK(errors.max() <= 3e-5);
  CHECK(errors.median() <= 5e-6);
}

// 1.6 times as deep, at the same places: the tensions there are 2.6 times as large.
TEST_CASE("beyond the trained depth it still solves the equation, within 1e-2", "[galerkin]") {
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  CHECK(force_errors(model, pinned_closed_form, 0.0501, 0.08, 500, Status::out_of_range).max() <= 1e-2);
  CHECK(force_errors(model, pinned_closed_form, 0.08, 0.08 + 1e-9, 500, Status::out_of_range).max() <= 1e-2);
  // And where it was trained for a tenth of that.
  GalerkinModel<> shallow(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.005)));
  CHECK(force_errors(shallow, pinned_closed_form, 0.008, 0.008 + 1e-9, 500, Status::out_of_range).max() <=
        2e-2);
}

// The polynomial of degree 49 through 50 equidistant forces, as the thesis extrapolates (eq. 3.67 at 8 of 5 mm).  It makes 10¹⁴ of what
// the forces are off by, here the tolerance of Newton's method.
TEST_CASE("where the thesis' interpolation has an error of more than half at 1.6 times the depth",
          "[galerkin][thesis]") {
  const Lagrange<EquispacedNodes> axis(50, 1e-3, 50e-3);
  std::vector<double> l(50);
  axis.weights(0.08, l.data());
  FemModel<> full(pinned(), 64);
  double force = 0;
  for (int k = 0; k < 50; ++k)
    force += l[static_cast<std::size_t>(k)] * full.press({L / 2, axis.node(k)}).force;
  CHECK(relative_error(force, pinned_closed_form(L / 2, 0.08)) > 0.5);
}

TEST_CASE("and so for other ends, against 64 elements", "[galerkin]") {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::clamped, Support::clamped},
                                                               {Support::clamped, Support::free},
                                                               {Support::pinned, Support::clamped},
                                                               {Support::roller, Support::pinned}}));
  const Beam beam = thesis_beam(left, right);
  GalerkinModel<> model(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05)));
  FemModel<> full(beam, 64, tight_solver());
  const ForceErrors errors = force_errors(model, from_rest(full), 0, 0.05);
  CHECK(errors.max() <= 1e-4);
  // 64 elements themselves are off by 2e-6 on average at these depths.
  CHECK(errors.median() <= 1e-5);
}

TEST_CASE("eight global modes leave ten thousand times the error of one that moves with the contact",
          "[galerkin]") {
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  double moving = 0, global = 0;
  for (const double s : {0.06 * L, 0.1 * L, 0.3 * L}) {
    const double wanted = pinned_closed_form(s, 0.04);
    moving = std::max(moving, relative_error(model.press({s, 0.04}).force, wanted));
    global = std::max(global, relative_error(force_in_global_modes(8, s, 0.04), wanted));
  }
  INFO("moving " << moving << ", global " << global);
  CHECK(global >= 0.1);
  CHECK(moving <= 1e-4 * global);
  // The reference in modes is right: with many of them it is the closed form.
  CHECK(relative_error(force_in_global_modes(2000, 0.3 * L, 0.04), pinned_closed_form(0.3 * L, 0.04)) <=
        1e-6);
}

TEST_CASE("where no tension arises it has no unknown", "[galerkin]") {
  SECTION("one end slides") {
    const Beam beam = thesis_beam(Support::clamped, Support::free);
    GalerkinModel<> model(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05)));
    CHECK(model.data().tensions == 1);
    const double s = 0.7 * L;
    CHECK(relative_error(model.press({s, 0.1}).force, 3 * thesis_EI * 0.1 / (s * s * s)) <= 1e-6);
    CHECK(model.iterations() == 0);
  }
  SECTION("the element is linear") {
    const FemModel<Linear> full(pinned(), 64, tight_solver());
    GalerkinModel<> model(
        trained_galerkin(take_snapshots_at_tensions(pinned(), full, TrainingPlan::anywhere(pinned(), 0.05))));
    CHECK(model.data().tensions == 1);
    const double s = 0.2 * L, b = 0.8 * L;
    CHECK(relative_error(model.press({s, 0.03}).force, 3 * thesis_EI * L * 0.03 / (s * s * b * b)) <= 1e-6);
  }
}

TEST_CASE("a moving hand takes three iterations, any jump no more than the limit", "[galerkin]") {
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05)));
  int most = 0;
  for (int tick = 0; tick <= 2000; ++tick) {  // 25 mm up and down, ±0.2 L to and fro, in two seconds
    const double turn = 6.283185307179586 * tick / 1000;
    model.press({L * (0.5 + 0.2 * std::sin(turn)), 0.025 * (1 - std::cos(turn))});
    most = std::max(most, model.iterations());
  }
  CHECK(most <= 4);
  Random random(3);
  most = 0;
  for (int k = 0; k < 20000; ++k) {
    const double d = std::pow(10, random(-9, 3)) * (k % 2 ? -1 : 1);
    const Response<double> response = model.press({L * random(0, 1), d});
    most = std::max(most, model.iterations());
    REQUIRE(std::isfinite(response.force));
    REQUIRE(response.force * d > 0);
  }
  INFO("most " << most);
  CHECK(most < GalerkinModel<>::max_iterations);
}

TEST_CASE("the force grows with the depth, over the end of the trained tensions too", "[galerkin]") {
  const double s = GENERATE(0.05, 0.2, 0.5) * L;
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.01)));
  double before = 0, stiffness_before = 0;
  for (double d = 1e-3; d < 0.2; d += 1e-3) {
    const double force = model.press({s, d}).force;
    CHECK(force - before > stiffness_before);  // a beam that stretches stiffens
    stiffness_before = (force - before) * (1 - 1e-5);
    before = force;
  }
}

TEST_CASE("it never pulls, whatever it was trained with and however deep it is pressed", "[galerkin]") {
  Random random(9);
  for (const auto& [left, right] : {std::pair{Support::pinned, Support::pinned},
                                    {Support::clamped, Support::pinned},
                                    {Support::guided, Support::clamped},
                                    {Support::clamped, Support::free}})
    for (const int tensions : {2, 12, 30}) {
      const Beam beam(1, Section::rectangle(0.02, std::pow(10, random(-3, -1.5))), Material{2e11}, left,
                      right);
      const double depth = std::pow(10, random(-5, -2));
      GalerkinModel<> model(
          trained_galerkin(beam, TrainingPlan::anywhere(beam, depth, random.integer(2, 16), tensions), 32));
      GalerkinModel<float> single(cast<float>(model.data()));
      int pulls = 0;
      for (int k = 0; k < 2000; ++k) {
        const double s = random(0, 1), d = (k % 2 ? -depth : depth) * std::pow(10, random(-3, 2));
        const Response<double> response = model.force({s, d});
        pulls += !(response.force * d > 0) || !is_answer(response.status);
        pulls += !(single.force({float(s), float(d)}).force * float(d) > 0);
      }
      CHECK(pulls == 0);
    }
}

// Beside a support and far beyond its depth the shape that it draws turns over: the normal there points to the other side.
TEST_CASE("a hand that jumps far deeper than was trained is pushed back to the side that it came from",
          "[galerkin]") {
  const double deep = GENERATE(2.0, 6.6, 30.0);
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05), 64));
  Touch<GalerkinModel<>> touch(model, 0.005);
  Random random(1);
  Vector2<double> hand(L / 2, 0.1), aim = hand;
  bool pressing = false;
  int side = 1, wrong = 0, pressed = 0;
  double step = 0;
  for (int k = 0; k < 40000; ++k) {
    if (k % 100 == 0) {
      aim << random(-0.1, 1.1) * L, random(-0.05, 0.05) * deep;
      step = 0.05 * std::pow(10, random(-3, 0));
    }
    const Vector2<double> way = aim - hand;
    hand += k / 100 % 3 == 0 ? way : Vector2<double>(way * std::min(1.0, step / (way.norm() + 1e-300)));
    const TouchResult<double> felt = touch.tick(hand);
    if (felt.pressing && !pressing) side = felt.contact.side;
    pressing = felt.pressing;
    pressed += pressing;
    wrong += felt.force.y() * side < 0 && !felt.contact.past_end;
  }
  CHECK(pressed > 10000);
  CHECK(wrong == 0);
}

TEST_CASE("in float the tension is found as well", "[galerkin][float]") {
  GalerkinModel<float> model(cast<float>(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 0.05))));
  const ForceErrors errors = force_errors(model, pinned_closed_form, 0.001, 0.05);
  CHECK(errors.max() <= 1e-4);
  CHECK(errors.median() <= 1e-5);
}

TEST_CASE("dead loads are refused: under them the tension is not one number", "[galerkin]") {
  Beam beam = pinned();
  beam.transverse(-100);
  TrainingPlan plan = TrainingPlan::anywhere(beam, 0.05);
  CHECK_THROWS_WITH(trained_galerkin(beam, plan),
                    "symmetric = true: must be false for a beam under dead loads");
  plan.symmetric = false;
  CHECK_THROWS_WITH(trained_galerkin(beam, plan),
                    "symmetric = false: must be true, a GalerkinModel takes no dead loads");
}

// F θ = ∂V/∂s holds inside the trained tensions and beyond: differences of the work V(s, d) = ∫F dd.
TEST_CASE("the rotation at the contact is that of the force's potential, beyond the trained tensions too",
          "[galerkin]") {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::pinned, Support::pinned},
                                                               {Support::clamped, Support::guided},
                                                               {Support::guided, Support::pinned}}));
  const Beam beam = thesis_beam(left, right);
  GalerkinModel<> model(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.01)));
  const auto work = [&model](double s, double d) {
    const int panels = 2000;  // Simpson
    double V = 0;
    for (int k = 0; k <= panels; ++k)
      V += model.force({s, d * k / panels}).force * d / panels / 3 *
           (k == 0 || k == panels ? 1
            : k % 2               ? 4
                                  : 2);
    return V;
  };
  for (const double s : {0.15 * L, 0.4 * L, 0.8 * L})
    for (const double d : {0.005, 0.05, 0.15}) {
      const double h = 1e-4 * L, by_s = (work(s + h, d) - work(s - h, d)) / (2 * h);
      const double force = model.press({s, d}).force;
      INFO("s " << s << ", d " << d);
      CHECK(force * model.shape().at(s).theta == Approx(by_s).epsilon(1e-5).margin(1e-6 * force * d / L));
    }
}

TEST_CASE(
    "a depth whose tension the full model does not reach everywhere is refused, with one that it reaches",
    "[galerkin]") {
  const Beam beam = thesis_beam(Support::clamped, Support::guided);
  CHECK_THROWS_WITH(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.05)),
                    Catch::Matchers::ContainsSubstring("depth = 0.05 m") &&
                        Catch::Matchers::ContainsSubstring("m would be"));
  CHECK_NOTHROW(trained_galerkin(beam, TrainingPlan::anywhere(beam, 0.045)));
}

TEST_CASE("a plan so shallow that nothing is stretched is trained for tensions all the same", "[galerkin]") {
  GalerkinModel<> model(trained_galerkin(pinned(), TrainingPlan::anywhere(pinned(), 1e-7)));
  CHECK(model.data().tensions > 1);
  CHECK(relative_error(model.press({0.3 * L, 0.05}).force, pinned_closed_form(0.3 * L, 0.05)) <= 0.1);
}

TEST_CASE("cantilevers of any proportions have no tension, at the tip too", "[galerkin]") {
  Random random(5);
  for (int k = 0; k < 40; ++k) {
    const double length = std::pow(10, random(-2, 1)), height = length * std::pow(10, random(-3, -1.3));
    const bool left = k % 2 == 0;
    const Beam beam(length, Section::rectangle(height, height), Material{2e11},
                    left ? Support::clamped : Support::free, left ? Support::free : Support::clamped);
    GalerkinModel<> model(trained_galerkin(beam, TrainingPlan::at(left ? length : 0, 0.02 * length), 32));
    CHECK(model.data().tensions == 1);
  }
}

TEST_CASE("equidistant tensions may be trained, if the snapshots have them", "[galerkin]") {
  const FemModel<> full(pinned(), 64, tight_solver());
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.02, 9, 8);
  CHECK_THROWS_WITH(trained_galerkin(take_snapshots_at_tensions<EquispacedNodes>(pinned(), full, plan)),
                    Catch::Matchers::ContainsSubstring("nodes = equispaced: must be chebyshev"));
  GalerkinModel<double, EquispacedNodes> model(
      trained_equispaced_galerkin(take_snapshots_at_tensions<EquispacedNodes>(pinned(), full, plan)));
  CHECK(relative_error(model.press({1.0, 0.015}).force, pinned_closed_form(1.0, 0.015)) <= 1e-3);
}
