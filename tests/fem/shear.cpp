// Beams that shear, against Timoshenko's closed forms and a shooting solution of finite rotation.
#include <array>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pressed.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

// h/L = 1/10, ν = 0.3, κ = 5/6.
constexpr double length = 1, height = 0.1, young = 10e9, EA = young * 0.05 * height,
                 EI = EA * height * height / 12, GA = 5. / 6 * EA / 2.6;

Beam stocky(Support left, Support right) {
  return Beam(length, Section::rectangle(0.05, height), Material{young}, left, right).shear(GA);
}

/// Displacement per force at s, of ends that hold what they hold: M = M0 + V x - <x - s>, by the unit moment's and the unit force's work.
double compliance(Support left, Support right, double s) {
  const double a = s, b = length - s, bend = 1 / EI, shear = 1 / GA;
  if (right == Support::free) return a * a * a / 3 * bend + a * shear;
  if (left == Support::pinned) return a * a * b * b / (3 * length) * bend + a * b / length * shear;
  // Clamped at both ends: a free right end, brought back by a force and a moment there.
  const double w = a * a * a / 3 + a * a * b / 2, t = a * a / 2;  // of the right end, times EI, without shear
  const double ww = length * length * length / 3 * bend + length * shear, wt = length * length / 2 * bend,
               tt = length * bend, rw = w * bend + a * shear, rt = t * bend, det = ww * tt - wt * wt;
  const double F = (rw * tt - rt * wt) / det, M = (ww * rt - wt * rw) / det;
  return a * a * a / 3 * bend + a * shear - F * rw - M * rt;
}

/// Tip of a cantilever under a dead force across it: θ' = M/EI, r' = (1 + N/EA) (cos φ, sin φ), φ = θ + V/κGA, with V across r' (Engesser), from
/// the clamp by Runge and Kutta, the moment there by Newton's method.
std::array<double, 2> bent_tip(double force) {
  const int steps = 2000;
  const auto shoot = [&](double moment) {
    std::array<double, 4> y{0, 0, 0, moment};  // x, w, angle, M
    const auto rate = [&](const std::array<double, 4>& at) {
      double slope = at[2];
      for (int k = 0; k < 20; ++k) slope = at[2] + force * std::cos(slope) / GA;
      const double stretch = 1 + force * std::sin(slope) / EA, x = stretch * std::cos(slope);
      return std::array<double, 4>{x, stretch * std::sin(slope), at[3] / EI, -x * force};
    };
    const double h = length / steps;
    for (int k = 0; k < steps; ++k) {
      const auto moved = [&](const std::array<double, 4>& by, double t) {
        std::array<double, 4> to = y;
        for (int i = 0; i < 4; ++i) to[std::size_t(i)] += t * by[std::size_t(i)];
        return to;
      };
      const auto k1 = rate(y), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)),
                 k4 = rate(moved(k3, h));
      for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    return y;
  };
  double moment = force * length;
  for (int k = 0; k < 30; ++k) {
    const double d = 1e-6 * moment, off = shoot(moment)[3];
    moment -= off * d / (shoot(moment + d)[3] - off);
  }
  const auto end = shoot(moment);
  return {end[0], end[1]};
}

}  // namespace

TEST_CASE("a press of a beam that shears is Timoshenko's, anywhere and with any elements", "[shear]") {
  using Model = FemModel<Tapered<Linear>>;
  for (const auto& [left, right] :
       {std::pair(Support::clamped, Support::clamped), std::pair(Support::pinned, Support::pinned),
        std::pair(Support::clamped, Support::free)})
    for (const int elements : {2, 3, 8})
      for (double s = 0.05; s < 0.96; s += 0.09) {
        const double force = pressed<Model>(stocky(left, right), elements, s, -1e-4);
        INFO(elements << " elements at " << s);
        CHECK(std::abs(force / (-1e-4 / compliance(left, right, s)) - 1) <= 1e-9);
      }
}

TEST_CASE("in the middle between clamps shear takes an eighth of the force of h/L = 1/10", "[shear]") {
  const double euler = 192 * EI, force = pressed<FemModel<Tapered<>>>(
                                             stocky(Support::clamped, Support::clamped), 8, 0.5, 1e-5) /
                                         1e-5;
  CHECK(std::abs(force * (1 / euler + 1 / (4 * GA)) - 1) <= 1e-6);
  CHECK(force < 0.9 * euler);
}

TEST_CASE("a beam that shears and bends far follows the equations of finite rotation", "[shear]") {
  for (const double load : {0.5, 2., 4.}) {
    const double force = load * EI;
    const auto exact = bent_tip(force);
    const auto error = [&](int elements) {
      const FemModel<Corotational<Tapered<>>> model(
          stocky(Support::clamped, Support::free).add(PointLoad{length, 0, force}), elements);
      const auto tip = model.shape().position(length);
      return std::hypot(tip.x() - exact[0], tip.y() - exact[1]);
    };
    // The membrane takes the angle of shear, too, for the slope of a cubic: a strain of 0.1 of its square.  The mesh leaves less.
    const double angle = force / GA, e8 = error(8), e32 = error(32);
    INFO("load " << load << ", tip " << exact[0] << " " << exact[1] << ": " << e8 << " " << e32);
    CHECK(e8 <= 1e-4 * load);
    CHECK(e32 <= 0.2 * angle * angle * length);
  }
}

TEST_CASE("the force of a beam that shears is the slope of its energy", "[shear]") {
  FemModel<Corotational<Tapered<>>> model(stocky(Support::clamped, Support::pinned), 8);
  for (const double d : {1e-3, 0.02, -0.05}) {
    const auto energy = [&](double depth) {
      CHECK(model.press({0.43, depth}).status == Status::ok);
      return model.strain_energy();
    };
    const double h = 1e-6, slope = (energy(d + h) - energy(d - h)) / (2 * h);
    CHECK(std::abs(model.press({0.43, d}).force / slope - 1) <= 1e-6);
  }
}

TEST_CASE("a beam that hardly shears is the one that does not", "[shear]") {
  const Beam beam(length, Section::rectangle(0.05, 0.01), Material{young}, Support::clamped, Support::pinned);
  const double stiff = pressed<FemModel<Corotational<Tapered<>>>>(beam, 8, 0.3, 0.05);
  CHECK(
      std::abs(pressed<FemModel<Corotational<Tapered<>>>>(Beam(beam).shear(1e12 * GA), 8, 0.3, 0.05) / stiff -
               1) <= 1e-9);
}

TEST_CASE("shear of a section that changes is as its area", "[shear]") {
  // A step from 0.1 to 0.05 m in the middle of a cantilever.
  const Beam beam =
      stocky(Support::clamped, Support::free)
          .sections({{0.5, Section::rectangle(0.05, height)}, {1, Section::rectangle(0.05, height / 2)}});
  const double thin = EI / 8, half = 0.5;
  const double exact =
      (1 - half * half * half) / (3 * EI) + half * half * half / (3 * thin) + half / GA + half / (GA / 2);
  for (const int elements : {2, 5})
    CHECK(std::abs(pressed<FemModel<Tapered<Linear>>>(beam, elements, length, 1e-5) / 1e-5 * exact - 1) <=
          1e-9);
}

TEST_CASE("a beam that shears is rejected where that would be ignored", "[shear]") {
  const Beam beam = stocky(Support::clamped, Support::free);
  CHECK_THROWS_WITH(FemModel<>(beam, 8), ContainsSubstring("beam shear stiffness"));
  CHECK_THROWS_WITH(FemModel<Corotational<>>(beam, 8), ContainsSubstring("beam shear stiffness"));
  const Beam heavy =
      Beam(length, Section::rectangle(0.05, height), Material{young, 1000}, Support::clamped, Support::free)
          .shear(GA);
  CHECK_THROWS_WITH(DynamicModel<Corotational<Tapered<>>>(heavy, 8),
                    ContainsSubstring("beam shear stiffness"));
  for (const double bad : {0., -1., std::nan("")})
    CHECK_THROWS_WITH(Beam(beam).shear(bad), ContainsSubstring("shear stiffness"));
}
