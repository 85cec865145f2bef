// FemModel under a hand: bounded work on any path, honest statuses, and the same force however a press was
// reached.
#include <limits>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The thesis beam on every pair of supports that holds it.
std::vector<Beam> beams_on_all_supports() {
  const Support all[] = {Support::free, Support::clamped, Support::pinned, Support::roller, Support::guided};
  std::vector<Beam> beams;
  for (const Support left : all)
    for (const Support right : all) try {
        beams.push_back(thesis_beam(left, right));
      } catch (const std::invalid_argument&) {
      }
  return beams;
}

/// 0 → 50 → 0 → -50 → 0 mm in steps of 1 mm.  @return the most linear solves of one press
template <class Model>
int most_solves(Model& model, double s) {
  using Scalar = typename Model::Scalar;
  int most = 0;
  for (int k = 0; k <= 200; ++k) {
    const int phase = k <= 50 ? k : k <= 150 ? 100 - k : k - 200;
    const Response<Scalar> response =
        model.press({static_cast<Scalar>(s), static_cast<Scalar>(1e-3 * phase)});
    REQUIRE(response.status == Status::ok);
    most = std::max(most, model.report().solves);
  }
  return most;
}

}  // namespace

TEST_CASE("a press path of 0 to 50 to -50 to 0 mm in 1 mm steps takes at most 6 solves a tick", "[press]") {
  for (const Support end : {Support::pinned, Support::clamped, Support::roller})
    for (const int elements : {4, 16, 64, 256, 1024})
      for (const double position : {0.05, 0.1, 0.3, 0.5}) {
        FemModel<> model(thesis_beam(Support::pinned, end), elements);
        INFO(name(end) << ", " << elements << " elements at " << position);
        CHECK(most_solves(model, position * thesis_length) <= 6);
      }
}

TEST_CASE("the same path in float takes at most 6 solves a tick", "[press][float]") {
  for (const int elements : {4, 16, 64})
    for (const double position : {0.1, 0.3, 0.5}) {
      FemModel<VonKarman<>, float> model(thesis_beam(Support::pinned, Support::pinned), elements);
      INFO(elements << " elements at " << position);
      CHECK(most_solves(model, position * thesis_length) <= 6);
    }
}

// Nothing but the contact moves then, so that it alone tells how far the state has gone.
TEMPLATE_TEST_CASE("two elements between clamped ends answer a press of their middle as their cubics do",
                   "[press]", FemModel<VonKarman<AssumedStrain>>, (FemModel<VonKarman<AssumedStrain>, float>),
                   (FemModel<VonKarman<AssumedStrain>, double, 2>)) {
  using Scalar = typename TestType::Scalar;
  const Beam beam = thesis_beam(Support::clamped, Support::clamped);
  TestType model(beam, 2);
  const double l = thesis_length / 2;
  for (const double d : {1e-3, 5e-3, 25e-3, 0.1}) {
    model.reset();
    const Response<Scalar> response = model.press({static_cast<Scalar>(l), static_cast<Scalar>(d)});
    // F = 2 (12 EI d/l³ + N 6/5 d/l),  N = EA 3/5 d²/l²
    const double force = 24 * beam.bending_stiffness() * d / (l * l * l) +
                         36.0 / 25 * beam.axial_stiffness() * d * d * d / (l * l * l);
    CAPTURE(d, model.report().solves);
    CHECK(response.status == Status::ok);
    CHECK(relative_error(response.force, force) <= 100 * std::numeric_limits<Scalar>::epsilon());
  }
}

// A moment bends the beam the other way, and Newton's first increment overshoots.
TEST_CASE("few presses of a beam that is bent the other way take more than one tick from rest", "[press]") {
  Beam beam(1, Section::rectangle(0.005, 0.005), Material{2e11}, Support::clamped, Support::guided);
  beam.add({0.1745, 0, 0, -0.25 * beam.bending_stiffness()});
  FemModel<> moderate(beam, 16);
  FemModel<Corotational<>> any_rotation(beam, 16);
  const auto on_the_way = [](auto& model) {
    int presses = 0;
    for (int k = 2; k < 30; ++k)
      for (int part = -50; part <= 50; ++part) {
        const double s = 0.01 * k;
        model.reset();
        presses += model.press({s, part / 50.0 * 0.999 * model.range().depth_at(s)}).status != Status::ok;
      }
    return presses;
  };
  // Of 2828 each; one more tick answers them.
  CHECK(on_the_way(moderate) <= 5);
  CHECK(on_the_way(any_rotation) <= 5);
}

// A state that is carried to another mesh is in no equilibrium there, however short the step: Newton's method has to be let finish.
TEST_CASE("a contact that goes to and fro beside a support is answered in each tick", "[press]") {
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{2e11}, Support::clamped, Support::pinned);
  FemModel<> model(ruler, 16);
  for (int k = 0; k < 400; ++k) {
    const Press<double> press =
        k % 2 == 0 ? Press<double>{0.9508 * 0.3, -6e-3 - 1e-6 * k} : Press<double>{0.9785 * 0.3, -4.3e-3};
    CAPTURE(k, press.d);
    CHECK(is_answer(model.press(press).status));
  }
}

// Rest is the hardest start: no membrane force yet, and the whole depth in one tick.
TEMPLATE_TEST_CASE("from rest every press within range is answered in one tick", "[press]", FemModel<>,
                   FemModel<VonKarman<ReducedIntegration>>, FemModel<VonKarman<FullIntegration>>,
                   FemModel<Linear>, (FemModel<VonKarman<>, float>), (FemModel<Linear, float>)) {
  using Scalar = typename TestType::Scalar;
  int presses = 0;
  for (const Beam& beam : beams_on_all_supports())
    for (const int elements : {2, 4, 16}) {
      TestType model(beam, elements);
      const Range<Scalar> range = model.range();
      for (const double position : {0.0, 0.001, 0.02, 0.1, 0.5, 0.77, 0.999, 1.0})
        for (const double part : {0.1, 0.5, 1.0}) {
          const Scalar s = static_cast<Scalar>(position * thesis_length);
          if (s < range.s_min || s > range.s_max) continue;
          const Press<Scalar> press{s, static_cast<Scalar>(part) * range.depth_at(s)};
          model.reset();
          const Response<Scalar> response = model.press(press);
          INFO(name(beam.left()) << ", " << name(beam.right()) << ", " << elements << " elements, s "
                                 << press.s << " m, d " << press.d << " m, " << model.report().solves
                                 << " solves");
          CHECK(response.status == Status::ok);
          ++presses;
        }
    }
  CHECK(presses > 500);
}

TEST_CASE("impossible requests are refused with force 0 and the shape kept", "[press]") {
  FemModel<> model(thesis_beam(Support::pinned, Support::clamped), 8);
  REQUIRE(model.press({1.0, 2e-3}).status == Status::ok);
  const std::vector<CentrelineNode<double>> before(model.shape().begin(), model.shape().end());
  for (const auto& request : std::vector<Press<double>>{{1.0, not_a_number},
                                                        {not_a_number, 1e-3},
                                                        {not_a_number, not_a_number},
                                                        {1.0, infinity},
                                                        {1.0, -infinity},
                                                        {infinity, 0},
                                                        {-1e-9, 1e-3},
                                                        {thesis_length + 1e-9, 1e-3}}) {
    const Response<double> response = model.press(request);
    INFO("s " << request.s << " m, d " << request.d << " m");
    CHECK(response.status == Status::invalid_request);
    CHECK(response.force == 0);
    for (int i = 0; i <= 8; ++i) REQUIRE(model.shape()[i].w == before[static_cast<std::size_t>(i)].w);
  }
}

TEST_CASE("a request out of range gets the force of the nearest one in range, and says so", "[press]") {
  const Beam beam = thesis_beam(Support::pinned, Support::clamped);
  for (const auto& request : std::vector<Press<double>>{{1.0, 1e9},
                                                        {1.0, -1e9},
                                                        {1.0, 1e300},
                                                        {0.0, 1e-4},
                                                        {thesis_length, 1e-4},
                                                        {1e-6, -1e-5},
                                                        {thesis_length, -1e9}}) {
    FemModel<> model(beam, 8), nearest(beam, 8);
    const Response<double> response = model.press(request);
    const Response<double> expected = nearest.press(nearest.range().nearest(request));
    INFO("s " << request.s << " m, d " << request.d << " m");
    CHECK(response.status == (is_answer(expected.status) ? Status::out_of_range : expected.status));
    CHECK(std::isfinite(response.force));
    CHECK(response.force == expected.force);
  }
}

TEST_CASE("after any impossible request the next press equals that of a fresh model", "[press]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const auto& request : std::vector<Press<double>>{{1.0, not_a_number},
                                                          {not_a_number, 1e-3},
                                                          {1.0, infinity},
                                                          {1.0, 1e9},
                                                          {1.0, -1e9},
                                                          {-1.0, 1e-3},
                                                          {3.0, 1e-3},
                                                          {0.0, 1e9},
                                                          {thesis_length, 1e-3}}) {
      FemModel<> used(thesis_beam(end, end), 8, tight_solver()), fresh = used;
      CHECK(std::isfinite(used.press(request).force));
      const Response<double> response = used.press({0.7, 3e-3}), expected = fresh.press({0.7, 3e-3});
      INFO(name(end) << ", after s " << request.s << " m, d " << request.d << " m");
      CHECK(response.status == Status::ok);
      CHECK(relative_error(response.force, expected.force) <= 1e-9);
    }
}

TEST_CASE("random presses within range are answered, and their force does not know the way", "[press]") {
  for (const Support end : {Support::pinned, Support::clamped, Support::free}) {
    const Beam beam = thesis_beam(Support::clamped, end);
    FemModel<> wandering(beam, 8, tight_solver()), fresh(beam, 8, tight_solver());
    Random random(7);
    double worst = 0;
    int unanswered = 0;
    for (int k = 0; k < 1000; ++k) {
      const Range<double> range = wandering.range();
      const double s = random(range.s_min, range.s_max), d = random(std::min(range.depth_at(s), 50e-3));
      fresh.reset();
      const Response<double> response = wandering.press({s, d}), expected = fresh.press({s, d});
      if (response.status != Status::ok || expected.status != Status::ok) ++unanswered;
      else worst = std::max(worst, relative_error(response.force, expected.force));
    }
    INFO(name(end));
    CHECK(unanswered == 0);
    CHECK(worst <= 1e-9);
  }
}

TEST_CASE("with a budget too small for one tick the model catches up over the next ones", "[press]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const Press<double> press{0.1 * thesis_length, 50e-3};
  FemModel<> unhurried(beam, 16, tight_solver());
  const Response<double> expected = unhurried.press(press);
  REQUIRE(expected.status == Status::ok);
  for (const int max_solves : {3, 4}) {
    NewtonRaphson hurried;
    hurried.max_iterations = max_solves == 4 ? 2 : 3;
    hurried.max_solves = max_solves;
    FemModel<> model(beam, 16, hurried);
    Response<double> response = model.press(press);
    CHECK(response.status == Status::iteration_limit);
    int ticks = 1;
    for (double before = 0; response.status == Status::iteration_limit && ticks < 1000; ++ticks) {
      CHECK((response.force >= before && response.force <= expected.force));
      CHECK(model.report().solves <= hurried.max_solves);
      before = response.force;
      response = model.press(press);
    }
    INFO("at most " << hurried.max_solves << " solves: " << ticks << " ticks");
    CHECK(response.status == Status::ok);
    CHECK(relative_error(response.force, expected.force) <= hurried.relative_tolerance);
  }
}

// The force that is sent while the model is on its way must be one that the beam has had, and not the residual of a shape
// that no load holds.
TEST_CASE("a press that is not reached answers with the force of the last that was", "[press]") {
  const Beam ruler(0.3, Section::rectangle(0.025, 1e-3), Material{2e11}, Support::clamped, Support::free);
  NewtonRaphson hurried;
  hurried.max_solves = 3;
  FemModel<Corotational<>> model(ruler, 16, hurried);
  double last = 0;
  int on_the_way = 0;
  bool set_back = true;
  for (int k = 1; k <= 400; ++k) {
    // 4 mm and 2 mm a tick: too far for three solves.
    const double turned = 0.5 * k;
    const auto response =
        model.push({0.2 + 0.05 * std::sin(0.04 * k), 0.06 * std::sin(turned) + 0.06, {0, 1}});
    REQUIRE(std::isfinite(response.force));
    if (response.status == Status::iteration_limit && model.report().steps == 0) {
      ++on_the_way;
      // Set back to rest, the beam has nothing to go on with but this once.
      CHECK((response.force == last || (response.force == 0 && set_back)));
    }
    set_back = !is_answer(response.status) && model.shape().at(0.3).w == 0;
    last = response.force;
  }
  CHECK(on_the_way >= 5);
}

// Two ways to one press, each within the tolerance of the force.
TEST_CASE("the force of a press does not depend on the way to it", "[press]") {
  const Beam ruler(0.3, Section::rectangle(0.025, 1e-3), Material{2e11}, Support::clamped, Support::free);
  for (const int elements : {8, 32}) {
    FemModel<Corotational<>> on_the_way(ruler, elements), from_rest(ruler, elements);
    Random random(1);
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      const double s = random(0.1, 0.95) * 0.3;
      const Press<double> press{s, 0.29 * s * random(0.02, 1)};
      from_rest.reset();
      const Response<double> fresh = from_rest.press(press);
      Response<double> used = on_the_way.press(press);
      for (int tick = 0; used.status == Status::iteration_limit && tick < 20; ++tick)
        used = on_the_way.press(press);
      REQUIRE(fresh.status == Status::ok);
      REQUIRE(used.status == Status::ok);
      worst = std::max(worst, relative_error(used.force, fresh.force));
    }
    CAPTURE(elements, worst);
    CHECK(worst <= 3 * NewtonRaphson{}.relative_tolerance);
  }
}

TEST_CASE("reset goes back to the shape at rest, exactly", "[press]") {
  Beam beam = thesis_beam(Support::clamped, Support::pinned);
  beam.transverse(-500);
  FemModel<> model(beam, 8);
  const FemModel<> rest = model;
  REQUIRE(model.press({0.9, 10e-3}).status == Status::ok);
  CHECK(model.shape().at(thesis_length / 2).w != rest.shape().at(thesis_length / 2).w);
  model.reset();
  for (int i = 0; i <= 8; ++i) {
    CHECK(model.shape()[i].s == rest.shape()[i].s);
    CHECK(model.shape()[i].u == rest.shape()[i].u);
    CHECK(model.shape()[i].w == rest.shape()[i].w);
    CHECK(model.shape()[i].theta == rest.shape()[i].theta);
  }
  CHECK(model.strain_energy() == rest.strain_energy());
}

// Where the beam already is, under its dead load, holding it takes no force.
TEST_CASE("pressing the beam to where it rests takes no force", "[press]") {
  Beam beam = thesis_beam(Support::clamped, Support::pinned);
  beam.transverse(-500);
  FemModel<> model(beam, 8, tight_solver());
  for (int i = 1; i < 8; ++i) {
    model.reset();
    const auto node = mesh_node(model, i);
    const Response<double> response = model.press({node.s, node.w});
    CHECK(response.status == Status::ok);
    CHECK(std::abs(response.force) <= 1e-9 * 500 * thesis_length);
  }
}

TEST_CASE(
    "reduced integration in float keeps its digits where an element's tension is sixteen times its bending",
    "[press]") {
  const Beam strip(1, Section::rectangle(0.02, 1e-3), Material{2e11}, Support::pinned, Support::pinned);
  FemModel<VonKarman<ReducedIntegration>, float> single(strip, 64);
  FemModel<VonKarman<ReducedIntegration>> exact(strip, 64);
  for (int k = 0; k <= 200; ++k) {
    const double d = 0.0685 + 0.005 * k / 200;
    const Response<float> response = single.press({0.37f, static_cast<float>(d)});
    CHECK(response.status == Status::ok);
    CHECK(response.force == Approx(exact.press({0.37, d}).force).epsilon(1e-4));
  }
}
