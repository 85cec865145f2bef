// Where the instructions of a tick go: contact, and the parts of a press.  Counted and not timed, so that another program on
// the machine changes nothing; compiler and flags do.
//
// The thesis' beam, both ends pinned, touched at 1 m by a hand that presses 10 µm a tick or slides 1 mm; and a steel ruler, 300 × 25 × 1 mm,
// clamped at one end, by a hand that has bent it 60 mm down at 110 mm and does the same.  A wire and a strip in space, 300 mm long, are
// pressed 4 mm deep by a sphere of 30 mm: `tick_instructions rods`, with 8 to 1024 elements in some minutes.  Prints CSV, which docs/performance.md quotes;
// Linux alone.
#include <cmath>
#include <cstdio>
#include <cstring>

#include "support/instructions.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;
using hapbeam::testing::instructions;

namespace {

/// The same element by another name, whose closed form the model does not take.
struct NodeByNode : VonKarman<> {
  using Abreast = NodeByNode;
};

constexpr double start = 1.0, pressed = 0.02;

volatile double felt;

template <class F>
long count(F&& f) {
  return instructions(f) - instructions([] {});
}

void line(const char* model, int elements, const char* hand, const char* part, long n, int solves) {
  std::printf("%s,%d,%s,%s,%ld,%d\n", model, elements, hand, part, n, solves);
}

template <class Model>
void ticks(const char* name, int elements, bool slides) {
  const char* const hand = slides ? "slides" : "presses";
  {
    Model model(thesis_beam(), elements);
    Press<double> press{start, -pressed};
    const auto next = [&] {
      (slides ? press.s : press.d) += slides ? 1e-3 : -1e-5;
      felt = model.press(press).force;
    };
    for (int k = 0; k < 3; ++k) next();
    const long n = count(next);
    next();
    line(name, elements, hand, "press", n, model.report().solves);
  }
  Model model(thesis_beam(), elements);
  Touch<Model> touch(model, 0.01);
  Vector2<double> at(start, 0.01 + 0.0127);
  for (int k = 0; k < 2000; ++k) (void)touch.tick(at -= Vector2<double>(0, pressed / 2000));
  const auto next = [&] {
    at += slides ? Vector2<double>(1e-3, 0) : Vector2<double>(0, -1e-5);
    felt = touch.tick(at).force.y();
  };
  const long n = count(next);
  next();
  line(name, elements, hand, "tick", n, model.report().solves);
}

/// The parts of a press that has one unknown.
void parts(int elements, bool slides) {
  const char* const hand = slides ? "slides" : "presses";
  TautSystem<double, Eigen::Dynamic, Eigen::Dynamic> system(thesis_beam(), elements);
  double s = start, d = -pressed;
  SolveReport<double> report{};
  const auto go = [&] {
    (slides ? s : d) += slides ? 1e-3 : -1e-5;
    system.set_goal(s, d);
  };
  const auto solve = [&] { report = NewtonRaphson{}.solve(system); };
  for (int k = 0; k < 3; ++k) go(), solve(), system.lay();
  const char* const name = "one_tension";
  const long goal = count(go);
  const long solved = count([&] { go(), solve(); }) - goal;
  go(), solve();
  line(name, elements, hand, "mesh", goal, 0);
  line(name, elements, hand, "solve", solved, report.solves);
  line(name, elements, hand, "of which an iteration", count([&] { felt = system.iterate().size; }), 1);
  line(name, elements, hand, "shape", count([&] { system.lay(); }), 0);
}

/// A tick on a ruler that is bent far.
void on_ruler(int elements, bool slides) {
  using Model = FemModel<Corotational<>>;
  Model model({0.3, Section::rectangle(0.025, 0.001), Material{206.84e9}, Support::clamped, Support::free},
              elements);
  Touch<Model> touch(model, 0.005);
  Vector2<double> at(0.11, 0.0055);
  for (int k = 0; k < 600; ++k) (void)touch.tick(at -= Vector2<double>(0, 1e-4));
  const auto next = [&] {
    at += slides ? Vector2<double>(1e-3, 0) : Vector2<double>(0, -1e-5);
    felt = touch.tick(at).force.y();
  };
  for (int k = 0; k < 3; ++k) next();
  const long n = count(next);
  next();
  line("corotational", elements, slides ? "slides" : "presses", "tick on a ruler", n, model.report().solves);
}

/// A tick on a rod that is pressed in, 0.1 rad beside a side of its section.
template <class Element>
void on_rod(const char* name, const Rod& rod, int elements, const VectorOf<double, 3>& side) {
  using Model = FemModel<Element>;
  constexpr double radius = 0.03;
  Model model(rod, elements);
  Touch<Model> touch(model, radius);
  VectorOf<double, 3> at = VectorOf<double, 3>(0.15, 0, 0) + (radius + rod.thickness() / 2) * side;
  for (int k = 0; k < 200; ++k) (void)touch.tick(at -= 2e-5 * side);
  const auto next = [&] { felt = touch.tick(at -= 1e-5 * side).force.y(); };
  for (int k = 0; k < 3; ++k) next();
  const long n = count(next);
  next();
  line(name, elements, "presses", "tick on a rod", n, model.report().solves);
}

void on_rods(int elements) {
  const auto rod = [](const RodSection& section) {
    return Rod(0.3, section, RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
  };
  const VectorOf<double, 3> first(0, std::cos(0.1), std::sin(0.1)), second(0, std::sin(0.1), std::cos(0.1));
  on_rod<RoundRod>("round-rod wire", rod(RodSection::circle(0.0015)), elements, first);
  on_rod<TwistedRod>("twisted-rod wire", rod(RodSection::circle(0.0015)), elements, first);
  on_rod<TwistedRod>("twisted-rod strip", rod(RodSection::rectangle(0.01, 0.001)), elements, second);
}

}  // namespace

int main(int argc, char** argv) {
  if (instructions([] {}) < 0) {
    std::fprintf(stderr, "this system does not let a process trace its child\n");
    return 1;
  }
  std::printf("model,elements,hand,part,instructions,solves\n");
  if (argc > 1 && std::strcmp(argv[1], "rods") == 0) {
    for (const int elements : {8, 64, 512, 1024}) on_rods(elements);
    return 0;
  }
  for (const int elements : {8, 64})
    for (const bool slides : {false, true}) {
      parts(elements, slides);
      ticks<FemModel<>>("one_tension", elements, slides);
      ticks<FemModel<NodeByNode>>("block_tridiagonal", elements, slides);
      ticks<FemModel<Corotational<>>>("corotational", elements, slides);
      on_ruler(elements, slides);
    }
}
