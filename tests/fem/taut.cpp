// A beam whose one unknown is its tension, against the equations of all displacements: the same equilibrium, and less work.
#include <algorithm>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/beam_shapes.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/solver/dense.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The same element by another name, of which the model does not know that one tension serves all.
template <class Element>
struct NodeByNode : Element {};

struct Case {
  std::string name;
  Beam beam;
};

/// Straight and unloaded, on all supports, not drawn or drawn apart by a thousandth.
std::vector<Case> taut_beams() {
  const Support all[] = {Support::free, Support::clamped, Support::pinned, Support::roller, Support::guided};
  std::vector<Case> cases;
  for (const Support left : all)
    for (const Support right : all)
      for (const double drawn : {0.0, 1e-3}) try {
          Beam beam = thesis_beam(left, right);
          beam.place({-drawn / 4, 0, 0}, {drawn * 3 / 4, 0, 0});
          cases.push_back(
              {std::string(name(left)) + ", " + name(right) + (drawn > 0 ? ", drawn" : ""), beam});
        } catch (const std::invalid_argument&) {
        }
  cases.push_back({"strip", Beam(0.3, Section::rectangle(0.02, 1e-4), Material{2e11}, Support::clamped,
                                 Support::pinned)});
  cases.push_back(
      {"string",
       tensioned(Beam(0.65, Section::circle(1e-3), Material{2e11}, Support::pinned, Support::pinned), 100)});
  return cases;
}

template <class Model>
Press<double> random_press(Random& random, const Model& model) {
  const auto range = model.range();
  const double s = random(range.s_min, range.s_max);
  return {s, random(range.depth_at(s))};
}

double length_of(const Beam& beam) { return beam.length(); }

}  // namespace

TEMPLATE_TEST_CASE("one tension and all displacements are the same equilibrium, to 1e-12", "[taut]",
                   VonKarman<AssumedStrain>, Linear) {
  Random random(1);
  int compared = 0;
  for (const Case& c : taut_beams())
    for (const int elements : {2, 5, 8}) {
      FemModel<TestType> model(c.beam, elements, tight_solver());
      FemModel<NodeByNode<TestType>> nodes(c.beam, elements, patient_solver());
      REQUIRE(is_taut(c.beam));
      for (int k = 0; k < 10; ++k) {
        const Press<double> press = random_press(random, model);
        const Response<double> got = model.press(press);
        nodes.press(press);
        const Response<double> want = nodes.press(press);  // from its answer on: what a tolerance had left
        CAPTURE(c.name, elements, press.s, press.d, want.force);
        REQUIRE(got.status == Status::ok);
        if (want.status != Status::ok) continue;
        ++compared;
        CHECK(relative_error(got.force, want.force) <= 1e-12);
        CHECK(relative_error(model.strain_energy(), nodes.strain_energy()) <= 1e-12);
        for (int i = 0; i <= elements; ++i) {
          const auto &a = model.shape()[i], &b = nodes.shape()[i];
          const double far = std::max({std::abs(a.s - b.s), std::abs(a.u - b.u), std::abs(a.w - b.w)});
          CHECK(far <= 1e-12 * length_of(c.beam));
          CHECK(std::abs(a.theta - b.theta) <= 1e-12);
        }
      }
    }
  CHECK(compared > 800);
}

// At what the model answers, the dense tangent of all displacements is stable and asks for no further increment.
TEST_CASE("a shape under one tension is a stable equilibrium of the dense equations", "[taut]") {
  Random random(2);
  for (const Case& c : taut_beams())
    for (const int elements : {4, 9}) {
      FemModel<> model(c.beam, elements, tight_solver());
      BeamSystem<VonKarman<>, double, Eigen::Dynamic, Eigen::Dynamic, Dense> system(c.beam, elements);
      decltype(system)::State nodes(elements);
      const double length = c.beam.length(), shortest = ContactMesh<double>::shortest(length);
      for (int k = 0; k < 5; ++k) {
        Press<double> press = random_press(random, model);
        press.s = std::clamp(press.s, shortest, length - shortest);
        const double force = model.press(press).force;
        const auto mesh = ContactMesh<double>(elements, length).at(press.s);
        std::copy(model.shape().begin(), model.shape().end(), nodes.begin());
        system.set_state(mesh, nodes);
        system.set_goal(mesh.node(), press.d);
        system.set_target(1);
        CAPTURE(c.name, elements, press.s, press.d);
        REQUIRE(system.factor(0) == Status::ok);
        CHECK(system.negative_pivots() == 0);
        CHECK(system.increment() <= 1e-11 * system.size());
        CHECK(relative_error(system.size() * system.size() / 2, model.strain_energy()) <= 1e-12);
        CHECK(relative_error(system.reaction(), force) <= 1e-9);  // of rounded nodes: eps times 12EI/l³
      }
    }
}

// A central difference: (h/d)² of the force's own curvature, and the round-off of two energies.
TEST_CASE("the force of one tension is the derivative of its strain energy", "[taut]") {
  Random random(3);
  for (const Case& c : taut_beams()) {
    FemModel<> model(c.beam, 8, tight_solver());
    for (int k = 0; k < 5; ++k) {
      const Press<double> press = random_press(random, model);
      const double h = 1e-4 * press.d / 2;
      const auto energy = [&](double d) { return model.press({press.s, d}), model.strain_energy(); };
      const double slope = (energy(press.d / 2 + h) - energy(press.d / 2 - h)) / (2 * h);
      CAPTURE(c.name, press.s, press.d);
      const double scale = model.strain_energy() / std::abs(h);
      CHECK(std::abs(model.press({press.s, press.d / 2}).force - slope) <=
            1e-7 * std::abs(slope) + 1e-14 * scale);
    }
  }
}

TEST_CASE("what is all but taut answers as what is taut", "[taut]") {
  const auto force = [](const Beam& beam) {
    return FemModel<>(beam, 8, tight_solver()).press({1.0, 0.02}).force;
  };
  const double taut = force(pinned());
  Beam loaded = pinned(), pushed = pinned(), bent = pinned(), placed = pinned(), closer = pinned();
  loaded.transverse(1e-9);
  pushed.add({0.5, 1e-9, 0, 0});
  bent.naturally({{thesis_length, 1e-15}});
  placed.place({}, {0, 1e-15, 0});
  closer.place({}, {-1e-15, 0, 0});
  for (const Beam* beam : {&loaded, &pushed, &bent, &placed, &closer}) {
    CHECK_FALSE(is_taut(*beam));
    CHECK(relative_error(force(*beam), taut) <= 1e-9);
  }
}

TEST_CASE("a press under one tension takes no more solves than one of all displacements", "[taut]") {
  Random random(4);
  for (const Case& c : taut_beams()) {
    FemModel<> model(c.beam, 16);
    FemModel<NodeByNode<VonKarman<>>> nodes(c.beam, 16);
    for (int k = 0; k < 50; ++k) {
      const Press<double> press = random_press(random, model);
      CHECK(model.press(press).status == Status::ok);
      nodes.press(press);
      CAPTURE(c.name, press.s, press.d);
      CHECK(model.report().solves <= nodes.report().solves);
      CHECK(model.report().solves <= 5);
      if (!(fixes_u(c.beam.left()) && fixes_u(c.beam.right()))) CHECK(model.report().solves == 1);
    }
  }
}

// Each step adds and multiplies what is not negative, and rounds each a few times.
TEMPLATE_TEST_CASE("a span's stiffness is exact to n eps, in a string too", "[taut][float]", double, float) {
  const auto error = [](int n, int node, double s, double tension, Support left, Support right) {
    detail::TwoSpans<VonKarman<>, TestType, Eigen::Dynamic, Eigen::Dynamic> spans(n, left, right);
    detail::TwoSpans<VonKarman<>, long double, Eigen::Dynamic, Eigen::Dynamic> exact(n, left, right);
    const TestType at = static_cast<TestType>(s), nu = static_cast<TestType>(tension);
    spans.set(node, n - node, at, 0);
    exact.set(node, n - node, at, 0);
    const long double k = exact.stiffness(nu).c0;
    return static_cast<double>(std::abs(static_cast<long double>(spans.stiffness(nu).c0) / k - 1)) /
           static_cast<double>(std::numeric_limits<TestType>::epsilon());
  };
  for (const Support right : {Support::pinned, Support::clamped, Support::free, Support::guided})
    for (const int n : {8, 32, 128})
      for (const double s : {0.03, 0.1, 0.37, 0.5, 0.97})
        for (const double tension : {0.0, 1.0, 100.0, 1e4, 1e6}) {
          const int node = std::clamp(static_cast<int>(std::lround(s * n)), 1, n - 1);
          CAPTURE(n, s, tension, name(right));
          CHECK(error(n, node, s, tension, Support::clamped, right) <= n);
        }
}

TEST_CASE("a stiffness has the derivatives of its values", "[taut]") {
  detail::TwoSpans<VonKarman<>, double, Eigen::Dynamic, Eigen::Dynamic> spans(7, Support::clamped,
                                                                              Support::guided);
  for (const int node : {0, 2, 5, 7})
    for (const double lever : {0.0, 1e-3})
      for (const double tension : {0.0, 30.0}) {
        if (node == 0) continue;  // clamped
        spans.set(node, 7 - node, node == 7 ? 1.0 : 0.3, -lever);
        const double h = 1e-3;
        const auto below = spans.stiffness(tension - h), at = spans.stiffness(tension),
                   above = spans.stiffness(tension + h);
        CAPTURE(node, lever, tension);
        CHECK(relative_error(at.c1, (above.c0 - below.c0) / (2 * h)) <= 1e-6);
        CHECK(relative_error(2 * at.c2, (above.c1 - below.c1) / (2 * h)) <= 1e-6);
      }
}
