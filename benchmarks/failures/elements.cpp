// Elements: membrane locking, and moderate rotation where the beam turns far.
#include <cmath>

#include "report.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/rod.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

/// Of the thesis' bar on rollers under a uniform load [N/m], which stretches nothing: against 5qL⁴/384EI.
template <class Element>
double locking_error(double load, int elements) {
  Beam beam = thesis_half(Support::roller);
  beam.transverse(load);
  const FemModel<Element> model(beam, elements, patient_solver());
  const double exact = 5 * load * std::pow(thesis_length, 4) / (384 * thesis_EI);
  return relative_error(mesh_node(model, elements).w, exact);
}

void locking(Report& report) {
  using Full = VonKarman<FullIntegration>;
  const double load = 10 * lbf / inch;
  Series series = report.series("locking", "elements,full,assumed");
  int enough = 0;
  for (int n = 2; n <= 256; n *= 2) {
    const double full = locking_error<Full>(load, n);
    if (enough == 0 && full <= 0.01) enough = n;
    series.add(n, full, locking_error<VonKarman<>>(load, n));
  }
  const double begins = first_beyond([](double q) { return locking_error<Full>(q, 4); }, 0.01, 1e-3, load);
  const double depth = 5 * begins * std::pow(thesis_length, 4) / (384 * thesis_EI);
  report.failure("membrane-locking",
                 "error 1 % at a deflection of " + number(depth / inch) + " heights, 4 elements");
  report.row("error of a deflection of 5.2 heights, 4 elements", percent(locking_error<Full>(load, 4)),
             percent(locking_error<VonKarman<>>(load, 4)));
  report.row("elements for an error of 1 %", std::to_string(enough), "2");
}

struct Tip {
  double w, angle;  // over the length, [rad]
};

/// Of the inextensible cantilever under a tip load α = PL²/EI, shot from its clamp; there M² = 2α sin φ(L) < 2α.
Tip elastica(double alpha) {
  const PlanarRod rod{1e9, 1};
  double low = 0, high = std::sqrt(2 * alpha);
  RodState end;
  for (int k = 0; k < 50; ++k) {
    const double moment = (low + high) / 2;
    end = rod.along({0, 0, 0, moment}, 1, 0, alpha);
    (end.moment > 0 ? high : low) = moment;
  }
  return {end.y, end.phi};
}

template <class Element>
double tip(double alpha, int elements) {
  Beam beam(1, 1e8, 1, 0.01, Support::clamped, Support::free);
  beam.add({1, 0, alpha, 0});
  return mesh_node(FemModel<Element>(beam, elements, patient_solver()), elements).w;
}

void rotation(Report& report) {
  Series series = report.series("rotation", "alpha,elastica,von_karman,corotational");
  for (double alpha = 0.25; alpha <= 10; alpha += 0.25)
    series.add(alpha, elastica(alpha).w, tip<VonKarman<>>(alpha, 8), tip<Corotational<>>(alpha, 8));
  const auto error = [](double alpha) {
    return relative_error(tip<VonKarman<>>(alpha, 8), elastica(alpha).w);
  };
  const double begins = first_beyond(error, 0.01, 0.01, 1);
  report.failure("large-rotation", "error 1 % at " + number(elastica(begins).angle * 57.29578) +
                                       "°, a deflection of " + number(elastica(begins).w) + " lengths");
  for (const double alpha : {1.0, 10.0})
    report.row("error of the deflection, tip at " + number(elastica(alpha).angle * 57.29578) + "°",
               percent(error(alpha)),
               percent(relative_error(tip<Corotational<>>(alpha, 8), elastica(alpha).w)));
}

}  // namespace

void elements(Report& report) {
  locking(report);
  rotation(report);
}

}  // namespace hapbeam::benchmarks
