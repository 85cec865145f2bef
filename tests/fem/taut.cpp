// A beam whose one unknown is its tension: exact against solutions by brute force, and the same equilibrium as that of all displacements.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/sanitized.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include "support/tense_press.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The same element by another name, of which the model does not know that one tension serves all.
template <class Element>
struct NodeByNode : Element {
  using Abreast = std::conditional_t<goes_abreast<Element>, NodeByNode, void>;
};

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
/// At a node of the mesh that stays: one tension has its nodes there, too.
template <class Model>
Press<double> random_press_at_node(Random& random, const Model& model) {
  const ContactMesh<double> mesh(model.elements(), model.shape().length());
  const double s = mesh.position(random.integer(1, model.elements() - 1));
  return {s, random(model.range().depth_at(s))};
}

double length_of(const Beam& beam) { return beam.length(); }

}  // namespace

TEST_CASE("one tension and all displacements are the same equilibrium, to 1e-12", "[taut]") {
  Random random(1);
  int compared = 0;
  for (const Case& c : taut_beams())
    for (const int elements : {2, 5, 8}) {
      FemModel<> model(c.beam, elements, tight_solver());
      FemModel<NodeByNode<VonKarman<>>> nodes(c.beam, elements, patient_solver());
      REQUIRE(is_taut(c.beam));
      for (int k = 0; k < 10; ++k) {
        const Press<double> press =
            k % 2 == 0 ? random_press(random, model) : random_press_at_node(random, model);
        const Response<double> got = model.press(press);
        nodes.press(press);
        const Response<double> want = nodes.press(press);  // from its answer on: what a tolerance had left
        CAPTURE(c.name, elements, press.s, press.d, want.force);
        REQUIRE(got.status == Status::ok);
        if (want.status != Status::ok) continue;
        ++compared;
        CHECK(relative_error(got.force, want.force) <= 1e-12);
        CHECK(relative_error(model.strain_energy(), nodes.strain_energy()) <= 1e-12);
        // Both have nodes at the ends and where they are pressed.
        int common = 0;
        for (const auto& a : model.shape())
          for (const auto& b : nodes.shape()) {
            if (std::abs(a.s - b.s) > 1e-14 * length_of(c.beam)) continue;
            ++common;
            CHECK(std::abs(a.w - b.w) <= 1e-12 * length_of(c.beam));
            // Within an element u is drawn as a straight line.
            if (k % 2 == 1 || a.s != press.s) CHECK(std::abs(a.u - b.u) <= 1e-12 * length_of(c.beam));
            CHECK(std::abs(a.theta - b.theta) <= 1e-12);
          }
        CHECK(common >= (k % 2 == 0 ? 2 : elements + 1));
      }
    }
  CHECK(compared > 800);
}

// At what the model answers, the tangent of all displacements is stable and asks for no further increment.
TEST_CASE("a shape under one tension is a stable equilibrium of all displacements", "[taut]") {
  Random random(2);
  for (const Case& c : taut_beams())
    for (const int elements : {4, 9}) {
      FemModel<> model(c.beam, elements, tight_solver());
      BeamSystem<VonKarman<>, double, Eigen::Dynamic, Eigen::Dynamic> system(c.beam, elements);
      decltype(system)::State state(elements);
      for (int k = 0; k < 5; ++k) {
        const Press<double> press = random_press_at_node(random, model);
        const double force = model.press(press).force;
        std::copy(model.shape().begin(), model.shape().end(), state.nodes.begin());
        system.go_back(state, 0);
        system.find_tensions();
        system.set_goal(Push<double>{press.s, press.d, {0, 1}}, force);
        system.set_target(1);
        CAPTURE(c.name, elements, press.s, press.d);
        REQUIRE(system.factor(0) == Status::ok);
        CHECK(system.negative_pivots() == 0);
        CHECK(system.increment() <= 1e-11 * system.size());
        CHECK(relative_error(system.size() * system.size() / 2, model.strain_energy()) <= 1e-12);
        CHECK(relative_error(system.rows().reaction(0), force) <=
              1e-9);  // of rounded nodes: eps times 12EI/l³
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

// It is computed on a mesh, of which 128 elements leave 1e-9.
TEST_CASE("what is all but taut answers as what is taut", "[taut]") {
  const auto force = [](const Beam& beam) {
    return FemModel<>(beam, 128, tight_solver()).press({1.0, 0.02}).force;
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
    CHECK(relative_error(force(*beam), taut) <= 2e-9);
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

namespace {

/// Bars, a strip and a string, and the depth to which they are pressed.
struct Tense {
  std::string name;
  Beam beam;
  double depth;
  double cubic;  ///< largest error of 8 elements of assumed strain
};

std::vector<Tense> tense_beams() {
  const Beam strip(0.4, Section::rectangle(0.01, 3e-4), Material{2e11}, Support::pinned, Support::clamped);
  const auto wire = [](Support ends) {
    return Beam(0.65, Section::circle(2.7e-4), Material{2e11}, ends, ends);
  };
  return {{"bar, 5 mm", pinned(), 0.005, 3.4e-5},
          {"bar, 50 mm", pinned(), 0.05, 6.5e-3},
          {"strip, 10 mm", strip, 0.01, 0.213},
          {"string, 4 mm", tensioned(wire(Support::pinned), 84), 0.004, 5.3e-2},
          {"clamped string, 4 mm", tensioned(wire(Support::clamped), 84), 0.004, 0.133}};
}

TensePress reference(const Beam& beam) {
  return {beam.length(), beam.axial_stiffness(), beam.bending_stiffness(),
          beam.left(),   beam.right(),           beam.right_place().u - beam.left_place().u};
}

/// Of 40 presses over the beam.
template <class Model>
double worst_error(Model model, const Tense& tense, int step = 1) {
  TensePress exact = reference(tense.beam);
  double worst = 0;
  for (int k = 0; k < 40; k += step) {
    const double s = tense.beam.length() * (0.06 + 0.88 * (k + 0.37) / 40);
    model.reset();
    const auto response = model.press(
        {static_cast<typename Model::Scalar>(s), static_cast<typename Model::Scalar>(tense.depth)});
    REQUIRE(response.status == Status::ok);
    worst = std::max(worst, relative_error(static_cast<double>(response.force), exact(s, tense.depth)));
  }
  return worst;
}

}  // namespace

// What is left is the solver's tolerance, and in float some last places of place, depth and beam.
TEST_CASE("a straight beam has no error of a mesh, whatever it is drawn with", "[taut][float]") {
  constexpr int step = sanitized ? 8 : 1;
  for (const Tense& tense : tense_beams()) {
    CAPTURE(tense.name);
    for (const int elements : {2, 8})
      CHECK(worst_error(FemModel<>(tense.beam, elements), tense, step) <= 1e-9);
    CHECK(worst_error(FemModel<VonKarman<>, float>(tense.beam, 8), tense, step) <=
          32 * std::numeric_limits<float>::epsilon());
  }
}

TEST_CASE("cubic elements have the error that stability functions remove", "[taut]") {
  for (const Tense& tense : tense_beams()) {
    CAPTURE(tense.name);
    CHECK(worst_error(FemModel<VonKarman<AssumedStrain>>(tense.beam, 8), tense) ==
          Approx(tense.cubic).epsilon(0.05));
  }
}

TEST_CASE("a straight beam is exact from support to support, at any depth", "[taut]") {
  for (const Tense& tense : tense_beams()) {
    FemModel<> model(tense.beam, 8);
    TensePress exact = reference(tense.beam);
    for (const double at : {1.0001e-3, 3e-3, 0.02, 0.3, 0.97, 0.9989})
      for (const double part : {0.03, 0.3, 1.0}) {
        const double s = at * tense.beam.length(), d = part * model.range().depth_at(s);
        CAPTURE(tense.name, at, part);
        const Response<double> response = model.press({s, d});
        REQUIRE(response.status == Status::ok);
        CHECK(relative_error(response.force, exact(s, d)) <= 1e-9);
      }
  }
}

// The tension is left with the solver's tolerance, 1e-8 of the force, and makes the shape.
TEST_CASE("shape and internal forces of a straight beam are exact between any ends that hold it", "[taut]") {
  Random random(7);
  const Support all[] = {Support::clamped, Support::pinned, Support::guided};
  for (const Support left : all)
    for (const Support right : all) {
      if (left == Support::guided && right == Support::guided) continue;
      const Beam beam = thesis_beam(left, right);
      FemModel<> model(beam, 7, tight_solver());
      TensePress exact = reference(beam);
      for (int k = 0; k < 4; ++k) {
        const double s = beam.length() * random(0.05, 0.95), d = random(0.002, 0.05);
        const double force = exact(s, d);
        CAPTURE(name(left), name(right), s, d);
        REQUIRE(model.press({s, d}).status == Status::ok);
        for (const auto& node : model.shape()) {
          CHECK(std::abs(node.w - exact.w(node.s)) <= 1e-11 * d);
          CHECK(std::abs(node.theta + exact.slope(node.s)) <= 1e-10 * d);
          CHECK(std::abs(node.u - exact.u(node.s)) <= 1e-9 * d * d);
        }
        for (int i = 0; i < 9; ++i) {
          const double x = beam.length() * (i + 0.5) / 9;
          const auto cut = model.internal_forces(x);
          CHECK(relative_error(cut.normal, exact.tension()) <= 1e-9);
          CHECK(std::abs(cut.moment - exact.moment(x)) <= 1e-10 * force * beam.length());
          CHECK(std::abs(cut.shear - exact.shear(x)) <= 1e-10 * force);
        }
      }
    }
}

TEST_CASE("at the contact moment and rotation are continuous, and shear jumps by the force", "[taut]") {
  Random random(8);
  for (const Case& c : taut_beams()) {
    FemModel<> model(c.beam, 8, tight_solver());
    for (int k = 0; k < 5; ++k) {
      const Press<double> press = random_press(random, model);
      const double force = model.press(press).force;
      if (!(press.s > 1e-3 * c.beam.length() && press.s < 0.999 * c.beam.length())) continue;
      const auto line = model.shape();
      const int node = line.node_near(press.s);
      REQUIRE(line[node].s == press.s);
      const auto before = model.internal_forces(node - 1, press.s),
                 after = model.internal_forces(node, press.s);
      CAPTURE(c.name, press.s, press.d);
      CHECK(std::abs(before.moment - after.moment) <= 1e-11 * std::abs(force) * c.beam.length());
      CHECK(relative_error(before.shear - after.shear, force) <= 1e-11);
      CHECK(before.normal == after.normal);
    }
  }
}

TEST_CASE("a press that is not solved leaves force, shape and internal forces as they were", "[taut]") {
  NewtonRaphson hasty;
  hasty.max_solves = 1;
  for (const Support right : {Support::pinned, Support::guided}) {
    FemModel<> model(thesis_beam(Support::clamped, right), 8, hasty);
    Response<double> last = model.press({1.0, 1e-7});
    REQUIRE(last.status == Status::ok);
    const std::vector<CentrelineNode<double>> before(model.shape().begin(), model.shape().end());
    const auto cut = model.internal_forces(1.3);
    const Response<double> response = model.press({1.7, 0.2});
    REQUIRE(response.status == Status::iteration_limit);
    CHECK(relative_error(response.force, last.force) <= 1e-12);
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(model.shape()[static_cast<int>(i)].s == before[i].s);
      CHECK(model.shape()[static_cast<int>(i)].w == before[i].w);
    }
    CHECK(model.internal_forces(1.3).moment == cut.moment);
  }
}
