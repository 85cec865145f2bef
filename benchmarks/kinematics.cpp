// How accurate each kinematics is: where the error of the force of a press is 1, 5 and 10 %.
//
// A steel beam of 2.54 m, square 25.4 mm (thick) or 25.4 mm wide and a tenth as high (thin), pressed across the middle or,
// with a free end, across that end.  All have 64 elements, so that what is off is the kinematics; the truth is
// Corotational<> with 256.
//
//   kinematics/ENDS/SECTION/ELEMENT
//     slope_1, _5, _10             largest rotation of the true beam there [degrees]
//     deflection_1, _5, _10        d/L [-]
//     press_1, _5, _10             d over the beam's height [-]
//     deepest, error_at_deepest    d/L up to which it was pressed, and how far the force is off there
//   A counter is left out where no such depth was found.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/beam_system.hpp>

using namespace hapbeam;

namespace {

constexpr double length = 2.54, width = 0.0254;

struct Case {
  Support left, right;
  double s;        // where it is pressed, over the length
  double deepest;  // d/L
};

constexpr Case cases[] = {{Support::pinned, Support::pinned, 0.5, 0.25},
                          {Support::clamped, Support::clamped, 0.5, 0.25},
                          {Support::pinned, Support::roller, 0.5, 0.4},
                          {Support::clamped, Support::free, 1, 0.8}};

struct Answer {
  double force;     // [N]
  double rotation;  // largest [rad]
};

template <class Element>
Answer press(const Beam& beam, int elements, double s, double d) {
  BeamSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic> system(beam, elements);
  system.set_goal(Push<double>{s, d, {0, 1}});
  NewtonRaphson patient;
  patient.max_solves = 1000;
  if (patient.solve(system).status != Status::ok) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  double rotation = 0;
  for (const auto& node : system.centreline()) rotation = std::max(rotation, std::abs(node.theta));
  return {system.linear_reaction(), rotation};
}

template <class Element>
void find_limits(benchmark::State& state, const Beam& beam, const Case& c) {
  const double s = c.s * length;
  const auto truth = [&](double d) { return press<Corotational<>>(beam, 256, s, d); };
  const auto error = [&](double d) {
    return std::abs(press<Element>(beam, 64, s, d).force / truth(d).force - 1);
  };
  for (auto _ : state) {
    for (const int percent : {1, 5, 10}) {
      const double tolerance = percent / 100.0, deepest = c.deepest * length;
      double low = 1e-5 * length, high = low;
      while (high < deepest && error(high) < tolerance) low = high, high = std::min(1.25 * high, deepest);
      if (error(high) < tolerance) continue;
      for (int k = 0; k < 20; ++k) {
        const double middle = std::sqrt(low * high);
        (error(middle) < tolerance ? low : high) = middle;
      }
      const std::string which = "_" + std::to_string(percent);
      state.counters["slope" + which] = truth(low).rotation * 57.295779513;
      state.counters["deflection" + which] = low / length;
      state.counters["press" + which] = low / beam.thickness();
    }
    state.counters["deepest"] = c.deepest;
    state.counters["error_at_deepest"] = error(c.deepest * length);
  }
}

template <class Element>
void add(const std::string& element) {
  for (const Case& c : cases)
    for (const auto& [section, height] : {std::pair("thick", width), std::pair("thin", width / 10)}) {
      const Beam beam(length, Section::rectangle(width, height), Material{206.84e9}, c.left, c.right);
      const std::string name = std::string("kinematics/") + hapbeam::name(c.left) + "-" +
                               hapbeam::name(c.right) + "/" + section + "/" + element;
      benchmark::RegisterBenchmark(
          name.c_str(), [beam, &c](benchmark::State& state) { find_limits<Element>(state, beam, c); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
}

const bool registered =
    (add<Linear>("linear"), add<VonKarman<>>("von_karman"), add<Corotational<>>("corotational"), true);

}  // namespace
