// What a section of a planar beam carries: free bodies, closed forms, orders of convergence.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Beam ruler() {
  return Beam(0.3, Section::rectangle(0.025, 0.001), Material{210e9}, Support::clamped, Support::free);
}
Beam loaded_ruler() {
  return ruler().transverse([](double s) { return -2 * (1 + s / 0.3); }).axial(1).add({0.12, 0, -0.3, 0.01});
}

/// Index of the node at s.
template <class Model>
int node_at(const Model& model, double s) {
  const auto line = model.shape();
  int i = 0;
  while (line[i].s < s - 1e-12) ++i;
  return i;
}

/// Largest difference of moment, shear and normal force from those of another model, over the largest of each.
template <class Model>
std::vector<double> errors(const Model& model, const Model& reference, double length) {
  double apart[3] = {0, 0, 0}, most[3] = {0, 0, 0};
  for (int k = 0; k < 100; ++k) {
    const double s = length * (k + 0.37) / 100;
    const auto a = model.internal_forces(s), b = reference.internal_forces(s);
    const double got[3] = {a.moment, a.shear, a.normal}, wanted[3] = {b.moment, b.shear, b.normal};
    for (int i = 0; i < 3; ++i) {
      apart[i] = std::max(apart[i], std::abs(got[i] - wanted[i]));
      most[i] = std::max(most[i], std::abs(wanted[i]));
    }
  }
  return {apart[0] / most[0], apart[1] / most[1], apart[2] / most[2]};
}

/// A pressed beam is in equilibrium, piece by piece and as a whole.
template <class Model>
void check_free_bodies(const Beam& beam, double s, double d, bool slope_counts) {
  Model model(beam, 9);
  const Response<double> response = model.press({s, d});
  REQUIRE(response.status == Status::ok);
  const auto line = model.shape();
  const double scale = std::abs(response.force);
  for (int i = 0; i <= line.segments(); ++i) {
    if (i == 0 || i == line.segments()) continue;
    const auto before = model.internal_forces(i - 1, line[i].s), after = model.internal_forces(i, line[i].s);
    // w-component of the force: at moderate rotation V - N θ.
    const double t = line[i].theta;
    const auto across = [&](const InternalForces<double>& cut) {
      if (any_rotation<typename Model::ElementType>)
        return std::cos(t) * cut.shear - std::sin(t) * cut.normal;
      return cut.shear - (slope_counts ? t * cut.normal : 0);
    };
    const double jump = across(before) - across(after);
    INFO("node " << i << " at " << line[i].s);
    CHECK(jump == Approx(line[i].s == s ? response.force : 0).margin(1e-7 * scale));
    CHECK(after.moment == Approx(before.moment).margin(1e-9 * scale * beam.length()));
  }
  for (const double at : {0.11, 0.37, 0.73, 0.95}) {
    // dM/ds = V, away from nodes and point loads.
    const double x = at * beam.length(), h = 1e-5 * beam.length();
    const double slope =
        (model.internal_forces(x + h).moment - model.internal_forces(x - h).moment) / (2 * h);
    INFO(Model::ElementType::name() << " at " << x);
    CHECK(slope == Approx(model.internal_forces(x).shear).epsilon(2e-3).margin(2e-3 * scale));
  }
}

}  // namespace

TEST_CASE("a cantilever carries the lever of its load", "[internal]") {
  FemModel<Linear> model(ruler(), 4);
  const double force = model.press({0.3, -0.01}).force;
  for (const double s : {0.0, 0.02, 0.15, 0.299}) {
    const auto cut = model.internal_forces(s);
    CHECK(cut.moment == Approx(-force * (0.3 - s)).epsilon(1e-9));
    CHECK(cut.shear == Approx(force).epsilon(1e-9));
    CHECK(cut.normal == Approx(0).margin(1e-9));
    // σ = M/W
    CHECK(210e9 * cut.surface_strain == Approx(std::abs(cut.moment) / (0.025 * 1e-6 / 6)).epsilon(1e-12));
  }
  const auto peak = peak_strain(model);
  CHECK(peak.s == 0);
  CHECK(peak.strain == model.internal_forces(0).surface_strain);
}

TEST_CASE("pieces of a pressed beam are in equilibrium", "[internal]") {
  const Beam held = thesis_beam(Support::clamped, Support::pinned);
  Beam loaded = held;
  loaded.transverse(-1000);
  for (const Beam& beam : {held, loaded}) {
    check_free_bodies<FemModel<Linear>>(beam, 0.9, -0.02, false);
    check_free_bodies<FemModel<>>(beam, 0.9, -0.02, true);
    check_free_bodies<FemModel<Corotational<>>>(beam, 0.9, -0.02, true);
  }
}

TEST_CASE("the clamp of a ruler that has bent far carries reaction times lever", "[internal]") {
  FemModel<Corotational<>> model(ruler(), 8);
  REQUIRE(model.push(Push<double>{0.28, -0.09, {0, 1}}).status == Status::ok);
  const double force = model.push(Push<double>{0.28, -0.1, {0, 1}}).force;
  const auto line = model.shape();
  const auto contact = line[node_at(model, 0.28)];
  const auto cut = model.internal_forces(0);
  CHECK(cut.moment == Approx(-force * (contact.s + contact.u)).epsilon(1e-8));
  CHECK(cut.shear == Approx(force).epsilon(1e-8));
  CHECK(cut.normal == Approx(0).margin(1e-6 * std::abs(force)));
  // Beyond the contact there is nothing.
  CHECK(model.internal_forces(0.29).surface_strain < 1e-9);
  // Cantilever in a parallel field: M² = 2 EI P (sin φ1 - sin φ), with φ the slope, at all places.
  const double EI = ruler().bending_stiffness();
  for (const double s : {0.0, 0.05, 0.1, 0.17, 0.23}) {
    const double slope = -line.at(s).theta, end = -contact.theta;
    CHECK(std::pow(model.internal_forces(s).moment, 2) ==
          Approx(2 * EI * force * (std::sin(end) - std::sin(slope)))
              .epsilon(1e-4)
              .margin(1e-5 * std::pow(cut.moment, 2)));
  }
}

TEST_CASE("moments at the clamps of a stretched beam are those of the closed form", "[internal]") {
  // Half of it: |M| = F/(2k) tanh(kL/4), k² = N/EI, at clamp and contact.
  const Beam beam = thesis_beam(Support::clamped, Support::clamped);
  const auto error = [&](int elements) {
    FemModel<> model(beam, elements);
    const double force = model.press({beam.length() / 2, -0.05}).force;
    const auto cut = model.internal_forces(0);
    const double k = std::sqrt(cut.normal / beam.bending_stiffness());
    const double wanted = -force / (2 * k) * std::tanh(k * beam.length() / 4);
    CHECK(model.internal_forces(beam.length() / 2).moment == Approx(-cut.moment).epsilon(1e-9));
    CHECK(cut.surface_strain == Approx(cut.normal / beam.axial_stiffness() +
                                       cut.moment / beam.bending_stiffness() * beam.thickness() / 2));
    return std::abs(cut.moment / wanted - 1);
  };
  CHECK(error(8) < 2e-3);
  CHECK(error(16) < 1.3e-4);
  CHECK(error(32) < 8e-6);
}

TEST_CASE("a distributed load is carried as it is between nodes, too", "[internal]") {
  // M = q s (L - s)/2 of w up, less what the press adds: none here.
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  const double q = -800, L = beam.length();
  beam.transverse(q);
  const FemModel<Linear> model(beam, 4);
  for (const double s : {0.0, 0.1, 0.3, 0.635, 1.0, 1.27, 2.0, 2.5}) {
    const auto cut = model.internal_forces(s);
    CHECK(cut.moment == Approx(q * s * (L - s) / 2).epsilon(1e-9).margin(1e-7));
    CHECK(cut.shear == Approx(q * (L / 2 - s)).epsilon(1e-9).margin(1e-6));
  }
  CHECK(peak_strain(model).s == Approx(L / 2));
  // A bar that hangs: N = f (L - s).
  Beam hanging(1.0, Section::circle(0.01), Material{200e9}, Support::clamped, Support::free);
  hanging.axial(500);
  const FemModel<Corotational<>> bar(hanging, 3);
  for (const double s : {0.0, 0.2, 1. / 3, 0.5, 0.99})
    CHECK(bar.internal_forces(s).normal == Approx(500 * (1 - s)).epsilon(1e-6));
}

TEST_CASE("forces in a section converge with the fourth power of the elements", "[internal]") {
  const auto check = [](const auto& tag, const Beam& beam, double s, double d, double at_16, double order) {
    using Model = std::decay_t<decltype(tag)>;
    const auto pressed = [&](int elements) {
      Model model(beam, elements);
      for (const double share : {0.5, 1.0}) REQUIRE(model.press({s, share * d}).status == Status::ok);
      return model;
    };
    const Model reference = pressed(256);
    const auto coarse = errors(pressed(16), reference, beam.length()),
               fine = errors(pressed(32), reference, beam.length());
    CHECK(coarse[0] < at_16);
    CHECK(std::log2(coarse[0] / fine[0]) > order);
    CHECK(coarse[1] < 30 * at_16);  // its slope: an order less inside of an element
    CHECK(coarse[2] < 50 * at_16);
  };
  const Beam held = thesis_beam(Support::clamped, Support::clamped);
  Beam loaded = held;
  loaded.transverse(-2000);
  check(FemModel<VonKarman<AssumedStrain>>(held, 2), held, 0.9, -0.02, 1.2e-5, 3.6);
  check(FemModel<>(held, 2), loaded, 0.9, -0.02, 4e-5, 3.6);
  check(FemModel<Corotational<>>(held, 2), ruler(), 0.2, -0.06, 1.2e-6, 3.6);
  check(FemModel<Corotational<>>(held, 2), loaded_ruler(), 0.2, -0.06, 3e-6, 3.2);
}

TEST_CASE("what is not stressed carries nothing, and what is stretched carries that", "[internal]") {
  // A bow that is bent by nature, between ends that let it.
  Beam bow(0.4, Section::rectangle(0.02, 0.002), Material{200e9}, Support::clamped, Support::free);
  bow.naturally({{0.15, 8}, {0.4, -3}});
  const FemModel<Corotational<>> model(bow, 7);
  CHECK(peak_strain(model).strain < 1e-10);
  const Beam string = stretched(thesis_beam(Support::pinned, Support::pinned), 0.001);
  const FemModel<> taut(string, 6);
  for (const double s : {0.0, 0.3, 2.5}) {
    const auto cut = taut.internal_forces(s);
    CHECK(cut.normal == Approx(string.axial_stiffness() * 0.001 / string.length()));
    CHECK(cut.axial_strain == Approx(0.001 / string.length()));
    CHECK(cut.moment == Approx(0).margin(1e-6));
  }
}

TEST_CASE("a section that is none gives no answer, and harms nothing", "[internal]") {
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
  (void)model.press({1.0, -0.01});
  const auto first = model.internal_forces(-1e300), last = model.internal_forces(infinity);
  CHECK(first.moment == model.internal_forces(0).moment);
  CHECK(last.moment == model.internal_forces(model.shape().length()).moment);
  CHECK(std::isnan(model.internal_forces(std::nan("")).moment));
}

TEST_CASE("float tells the strain to single precision", "[internal]") {
  const Beam beam = thesis_beam(Support::clamped, Support::clamped);
  FemModel<VonKarman<>, float> single(beam, 8);
  FemModel<> model(beam, 8);
  (void)single.press({0.9f, -0.02f}), (void)model.press({0.9, -0.02});
  // 100 eps n² of the force, as elsewhere.
  CHECK(static_cast<double>(peak_strain(single).strain) == Approx(peak_strain(model).strain).epsilon(8e-4));
}

// The boundary layers of a strip under the tension of its own bend are shorter than its elements.
TEST_CASE("between nodes moments are those of the curve under tension", "[internal]") {
  const Beam strip(1, Section::rectangle(0.02, 0.001), Material{200e9}, Support::clamped, Support::clamped);
  FemModel<Corotational<>> model(strip, 8), fine(strip, 256);
  for (const double s : {0.3, 0.5}) {
    for (int k = 1; k <= 5; ++k) {
      REQUIRE(model.press({s, 0.002 * k}).status == Status::ok);
      REQUIRE(fine.press({s, 0.002 * k}).status == Status::ok);
    }
    const auto off = errors(model, fine, 1);
    CAPTURE(s, off[0], off[1], off[2]);
    CHECK(off[0] <= 2e-4);
    CHECK(off[1] <= 2e-3);
  }
}
