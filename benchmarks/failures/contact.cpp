// Contact: inside an element, next to a support, past the end, and between two ticks.
#include <algorithm>
#include <cmath>
#include <limits>

#include "report.hpp"
#include "support/chain.hpp"
#include "support/error.hpp"
#include "support/naive_contact.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/hermite.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

constexpr double L = thesis_length;

Beam ruler() {
  return Beam(0.3, Section::rectangle(0.03, 0.001), Material{thesis_young}, Support::clamped, Support::free);
}
/// Of the linear beam between two hinges.
double stiffness(double s) { return 3 * thesis_EI * L / (s * s * (L - s) * (L - s)); }

/// The same of 8 elements, one of which has the force inside: at its nodes, by what it does there.
double stiffness_inside(double s) {
  constexpr int n = 8;
  constexpr double l = L / n;
  const int e = std::min(n - 1, static_cast<int>(s / l));
  const ShapeFunctions<double> there(s / l - e, l);
  const Vector6<double> load = there.nodal_forces(0, 1, 0);
  BlockTridiagonal<double> chain(n);
  Vector6<double> r;
  Matrix6<double> K;
  Linear::tangent(ElementProperties<double>(l, thesis_EA, thesis_EI),
                  Vector6<double>(Vector6<double>::Zero()), r, K);
  testing::add_elements(
      chain, n, [&](int) -> const auto& { return K; },
      [&](int i) { return Vector6<double>(i == e ? Vector6<double>(r - load) : r); });
  for (const int end : {0, n})
    for (const int component : {0, 1}) chain.prescribe(end, component, 0);
  if (chain.solve() != Status::ok) return std::numeric_limits<double>::quiet_NaN();
  Vector6<double> both;
  both << chain.increment(e), chain.increment(e + 1);
  return 1 / load.dot(both);
}

void inside(Report& report) {
  Series series = report.series("inside", "s,nearest_node,inside,follows");
  FemModel<Linear> model(pinned(), 8);
  double worst_nearest = 0, worst_inside = 0, worst = 0;
  for (int k = 1; k <= 200; ++k) {
    const double s = L * k / 400, node = L / 8 * std::round(8 * s / L);
    const double nearest =
        node > 0 ? std::abs(stiffness(node) / stiffness(s) - 1) : std::numeric_limits<double>::quiet_NaN();
    const double within = relative_error(stiffness_inside(s), stiffness(s));
    const double follows = relative_error(model.press({s, 1e-4}).force / 1e-4, stiffness(s));
    series.add(s / L, nearest, within, follows);
    if (node > 0) worst_nearest = std::max(worst_nearest, nearest);
    worst_inside = std::max(worst_inside, within);
    worst = std::max(worst, follows);
  }
  report.failure("inside-an-element", "everywhere but at a node");
  report.row("error of the force at the nearest node of 8 elements", percent(worst_nearest), number(worst));
  report.row("error of the force inside one of 8 elements", percent(worst_inside), number(worst));
}

/// Force of a press on a mesh of 8 elements with a node at s, from what the elements beside it say.
template <typename Scalar>
Scalar force_at_node(Scalar s, Scalar d) {
  constexpr int n = 8;
  const ContactMesh<Scalar> mesh = ContactMesh<Scalar>(n, Scalar(L)).at(s);
  const int at = mesh.node();
  BlockTridiagonal<Scalar> chain(n);
  Eigen::Matrix<Scalar, 3, n + 1> x = Eigen::Matrix<Scalar, 3, n + 1>::Zero();
  const auto respond = [&](int e, Vector6<Scalar>& r, Matrix6<Scalar>& K) {
    Vector6<Scalar> both;
    both << x.col(e), x.col(e + 1);
    Linear::tangent(ElementProperties<Scalar>(mesh.position(e + 1) - mesh.position(e), Scalar(thesis_EA),
                                              Scalar(thesis_EI)),
                    both, r, K);
  };
  Vector6<Scalar> r, next;
  Matrix6<Scalar> K;
  for (int k = 0; k < 3; ++k) {
    testing::add_elements(
        chain, n, [&](int e) { return respond(e, r, K), K; }, [&](int e) { return respond(e, r, K), r; });
    for (const int end : {0, n})
      for (const int component : {0, 1}) chain.prescribe(end, component, 0);
    chain.prescribe(at, 1, d - x(1, at));
    if (chain.solve() != Status::ok) return std::numeric_limits<Scalar>::quiet_NaN();
    for (int i = 0; i <= n; ++i) x.col(i) += chain.increment(i);
    x(1, at) = d;
  }
  respond(at - 1, r, K);
  respond(at, next, K);
  return r[4] + next[1];
}

/// A press from rest at s by s/100 and less, with a node there however near the support is: the worst of ten.
template <typename Scalar>
double beside(double part) {
  double worst = 0;
  for (int k = 1; k <= 10; ++k) {
    const Scalar s = static_cast<Scalar>(part * L * (1 + 0.01 * k)), d = s / 100;
    const double force = static_cast<double>(force_at_node(s, d)) /
                         (static_cast<double>(d) * stiffness(static_cast<double>(s)));
    worst = std::max(worst, std::isfinite(force) ? std::abs(force - 1) : 1);
  }
  return worst;
}

void next_to_support(Report& report) {
  Series series = report.series("support", "s,double,float");
  double begins = 0;
  for (double part = 1e-9; part < 0.2; part *= std::pow(10, 0.25)) {
    const double single = beside<float>(part);
    if (single > 0.01) begins = part;
    series.add(part, beside<double>(part), single);
  }
  const auto far_end = [](double part, bool library) {
    const Beam beam = thesis_beam(Support::pinned, Support::roller);
    const Press<double> press{part * L, L / 10};
    FemModel<> model(beam, 8);
    if (library) return model.press(press), std::abs(model.shape()[8].u) / L;
    BeamSystem<VonKarman<>, double, Eigen::Dynamic, Eigen::Dynamic> system(beam, 8);
    system.set_goal(Push<double>{press.s, press.d, {0, 1}});
    NewtonRaphson{}.solve(system);
    return std::abs(system.node(8).u) / L;
  };
  const double steep = first_beyond([&](double times) { return far_end(1 / times, false); }, 1, 3, 1000);
  report.failure("next-to-a-support", "a tenth of the length deep: " + number(1 / steep) +
                                          " lengths from it; in `float`: error 1 % at " + number(begins));
  report.row("shortening of a press a tenth of the length deep, a thousandth from a hinge, in lengths",
             number(far_end(1e-3, false)), number(far_end(1e-3, true)) + ", `out_of_range`");
  FemModel<Linear> in_double(pinned(), 8);
  FemModel<Linear, float> in_float(pinned(), 8);
  const auto at_edge = [](auto& model) {
    const auto s = model.range().s_min, d = s / 100;
    return relative_error(static_cast<double>(model.press({s, d}).force),
                          stiffness(static_cast<double>(s)) * static_cast<double>(d));
  };
  report.row("distance from the support at which the range ends", "–",
             number(in_double.range().s_min / L) + " lengths, in float " +
                 number(static_cast<double>(in_float.range().s_min) / L));
  report.row("error of the force there", "–",
             number(at_edge(in_double)) + ", in float " + number(at_edge(in_float)));
}

void past_end(Report& report) {
  constexpr double radius = 0.005, reach = radius + 0.0005, depth = -0.01;
  FemModel<Corotational<>> model(ruler(), 16), held(ruler(), 16);
  Touch<FemModel<Corotational<>>> touch(model, radius);
  for (int k = 0; k <= 100; ++k) (void)touch.tick({0.28, 0.02 + (depth - 0.02) * k / 100});
  Series series = report.series("past_end", "past,held,hapbeam_across,hapbeam_along");
  double ghost = 0, last = 0;
  for (int k = 0; k <= 500; ++k) {
    const double x = 0.28 + 1e-4 * k;
    const TouchResult<double> result = touch.tick({x, depth});
    ghost = clamped_press(held, {x, depth}, reach);
    if (result.pressing) last = x - 0.3;
    series.add(1e3 * (x - 0.3), ghost, result.force.y(), result.force.x());
  }
  report.failure("past-the-end", "at the end");
  report.row("force 30 mm past the end of a ruler, N", number(ghost), "0");
  report.row("distance past the end at which contact ends, mm (avatar radius and half of the thickness: 5.5)",
             "never", number(1e3 * last));
}

void tunnelling(Report& report) {
  const FemModel<Corotational<>> resting(ruler(), 16);
  Series series = report.series("tunnelling", "speed,wrong_side,nothing,hapbeam");
  constexpr int phases = 200;
  const auto lost = [&](double speed, int& wrong, int& nothing, int& library) {
    wrong = nothing = library = 0;
    for (int phase = 0; phase < phases; ++phase) {
      const double step = 1e-3 * speed, begin = 0.02 + step * phase / phases;
      const Found found = fall_onto(resting, 0.15, begin, step, 0);
      wrong += found == Found::lower_side, nothing += found == Found::nothing;
      FemModel<Corotational<>> model(resting);
      Touch<FemModel<Corotational<>>> touch(model, 0);
      for (double y = begin; y > -0.02; y -= step) {
        const TouchResult<double> result = touch.tick({0.15, y});
        if (y < 0.0005 - 1e-12 && !(result.force.y() > 0)) {  // on the surface it may do either
          ++library;
          break;
        }
      }
    }
  };
  int wrong = 0, nothing = 0, library = 0;
  double begins = 0;
  for (double speed = 0.1; speed < 21; speed *= std::pow(10, 0.05)) {
    lost(speed, wrong, nothing, library);
    if (begins == 0 && wrong + nothing > 0) begins = speed;
    series.add(speed, 100.0 * wrong / phases, 100.0 * nothing / phases, 100.0 * library / phases);
  }
  report.failure("tunnelling", number(begins) + " m/s: half a ruler's thickness, 0.5 mm, in a tick");
  for (const double speed : {1.0, 5.0}) {
    lost(speed, wrong, nothing, library);
    report.row("contacts at " + number(speed) + " m/s found on the wrong side, not found",
               number(100.0 * wrong / phases) + " %, " + number(100.0 * nothing / phases) + " %",
               number(100.0 * library / phases) + " %");
  }
}

}  // namespace

void contact(Report& report) {
  inside(report);
  next_to_support(report);
  past_end(report);
  tunnelling(report);
}

}  // namespace hapbeam::benchmarks
