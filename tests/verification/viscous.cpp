// Viscous material: the decrement of a beam that rings, creep and relaxation, against closed forms.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include <hapbeam/fem/dynamic_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Beam ruler(const Material& material) {
  return {0.3, Section::rectangle(0.025, 0.001), material, Support::clamped, Support::free};
}

/// Damping ratio and circular frequency of what rings as y(k), by the recursion of a damped sine.
struct Ringing {
  double ratio, omega;
};
Ringing ringing(const std::vector<double>& y, double dt) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (std::size_t k = 2; k < y.size(); ++k) {
    const Eigen::Vector2d x(y[k - 1], -y[k - 2]);
    A += x * x.transpose(), b += y[k] * x;
  }
  const double det = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0), p = (b[0] * A(1, 1) - b[1] * A(0, 1)) / det,
               q = (A(0, 0) * b[1] - A(1, 0) * b[0]) / det;
  const double decay = -std::log(q) / (2 * dt), damped = std::acos(p / (2 * std::sqrt(q))) / dt,
               omega = std::sqrt(decay * decay + damped * damped);
  return {decay / omega, omega};
}

/// How far a hand goes, and how fast [m, m/s].
constexpr double farthest = 1e-5;
double way(double t) { return farthest * (1 - std::cos(pi * t)); }
double speed(double t) { return farthest * pi * std::sin(pi * t); }

}  // namespace

TEST_CASE("a viscous material takes its share of each period", "[dynamics]") {
  const double ratio0 = 0.7340955137589128, beta = 1.8751040687119611;
  std::vector<CentrelineNode<double>> mode;
  for (int i = 0; i <= 8; ++i) {
    const double x = beta * i / 8, size = 1e-5;
    mode.push_back(
        {0.3 * i / 8, 0, size * (std::cosh(x) - std::cos(x) - ratio0 * (std::sinh(x) - std::sin(x))),
         -size * beta / 0.3 * (std::sinh(x) + std::sin(x) - ratio0 * (std::cosh(x) - std::cos(x)))});
  }
  const double omega = beta * beta / 0.09 * std::sqrt(200e9 * 0.025 * 1e-9 / 12 / (7850 * 0.025 * 0.001));
  struct Case {
    double dt, error;
  };
  for (const Case& c : {Case{1e-3, 3e-4}, {2.5e-4, 3e-5}})
    for (const double ratio : {0.005, 0.05}) {
      DynamicModel<> model(ruler({200e9, 7850, Damping::ratio(ratio, omega / (2 * pi))}), 8, 1);
      model.let_go_from({mode.data(), static_cast<int>(mode.size()), true});
      std::vector<double> y;
      double energy = model.energy().sum();
      for (int k = 0; k * c.dt < 0.8; ++k) {
        REQUIRE(model.step(c.dt) == Status::ok);
        const double now = model.energy().sum();
        CHECK(now <= energy);
        energy = now;
        if (k * c.dt > 0.2) y.push_back(model.shape().at(0.3).w);
      }
      const Ringing found = ringing(y, c.dt);
      CAPTURE(c.dt, ratio, found.ratio / ratio - 1, found.omega / omega - 1);
      CHECK(std::abs(found.ratio / ratio - 1) <= c.error);
      CHECK(std::abs(found.omega / omega - 1) <= 2e-4);
    }
}

// A hand that goes to and fro on a spring K bends a beam k nearly without mass by w, at a node of it:
//   K (b - w) = k (w + g h),   h' = w' - h/τ
// A stiff spring prescribes the place, and the force relaxes; a soft one prescribes the force, and the beam creeps.
TEST_CASE("a beam relaxes where its place is held, and creeps where its force is", "[dynamics]") {
  const double g = 0.5, s = 0.225, k = 3 * 200e9 * 0.025 * 1e-9 / 12 / (s * s * s);
  struct Case {
    double dt, tau, spring, error;
  };
  for (const Case& c :
       {Case{1e-3, 0.2, 1e9, 1e-6}, {1e-3, 0.2, 5, 1e-6}, {2e-3, 0.04, 1e9, 2e-6}, {2e-3, 0.04, 5, 2e-6}}) {
    Material material{200e9, 1e-3};
    material.damping.branches[1] = {g, c.tau};
    DynamicModel<> model(ruler(material), 8, 1);
    double h = 0, off_place = 0, off_force = 0, most_place = 0, most_force = 0;
    const auto rate = [&](double t, double held) {
      return (c.spring * speed(t) / (c.spring + k) - held / c.tau) / (1 + g * k / (c.spring + k));
    };
    for (int i = 1; i * c.dt < 1.6; ++i) {
      constexpr int parts = 10;  // of fourth order
      for (int j = 0; j < parts; ++j) {
        const double d = c.dt / parts, t = (i - 1) * c.dt + j * d, k1 = rate(t, h),
                     k2 = rate(t + d / 2, h + d / 2 * k1), k3 = rate(t + d / 2, h + d / 2 * k2),
                     k4 = rate(t + d, h + d * k3);
        h += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      const double b = way(i * c.dt), w = (c.spring * b - k * g * h) / (c.spring + k),
                   force = k * (w + g * h);
      const auto felt = model.step(c.dt, {{s, {s, 1e-4 - b}, 1e-4, 1}, c.spring, 0});
      REQUIRE(felt.status == Status::ok);
      if (!(felt.force < 0)) break;  // the hand leaves
      off_place = std::max(off_place, std::abs(model.shape().at(s).w + w)),
      most_place = std::max(most_place, w);
      const double strain = k / 2 * (w * w + g * h * h);
      if (w > farthest / 10) CHECK(std::abs(model.energy().strain - strain) <= 1e-4 * strain);
      off_force = std::max(off_force, std::abs(-felt.force - force)),
      most_force = std::max(most_force, force);
    }
    CAPTURE(c.dt, c.spring, off_place / most_place, off_force / most_force);
    CHECK(most_place > 1e-7);
    CHECK(off_place <= c.error * most_place);
    CHECK(off_force <= c.error * most_force);
  }
}

// Of a beam without mass, loaded at once:  w = w∞ (1 - g/(1 + g) e^(-t/(τ (1 + g)))),  F = k w (1 + g e^(-t/τ)).
TEST_CASE("a beam without mass creeps under a load and relaxes under a hand, from the first step on",
          "[dynamics]") {
  const double g = 0.5, tau = 0.2, s = 0.225, k = 3 * 200e9 * 0.025 * 1e-9 / 12 / (s * s * s);
  Material material{200e9};
  material.damping.branches[2] = {g, tau};
  struct Case {
    double dt, error;
  };
  for (const Case& c : {Case{1e-3, 1e-6}, {1e-2, 5e-5}}) {
    Beam loaded = ruler(material);
    loaded.add(PointLoad{s, 0, -1e-4, 0});
    DynamicModel<> model(loaded, 8, 1), held(ruler(material), 8, 1);
    model.let_go_from(FemModel<Corotational<>>(ruler(material), 8).shape());
    const double last = 1e-4 / k, off = 1e-5;
    for (int i = 1; i * c.dt <= 1; ++i) {
      const double t = i * c.dt;
      REQUIRE(model.step(c.dt) == Status::ok);
      const double creeps = last * (1 - g / (1 + g) * std::exp(-t / (tau * (1 + g))));
      CAPTURE(c.dt, t, -model.shape().at(s).w / creeps - 1);
      CHECK(std::abs(-model.shape().at(s).w - creeps) <= c.error * last);
      const auto felt = held.step(c.dt, {{s, {s, 1e-4 - off}, 1e-4, 1}, 1e9, 0});
      REQUIRE(felt.status == Status::ok);
      const double relaxes = k * off * (1 + g * std::exp(-t / tau));
      CAPTURE(-felt.force / relaxes - 1);
      CHECK(std::abs(-felt.force - relaxes) <= c.error * k * off);
    }
    CHECK(model.energy().kinetic == 0);
  }
  CHECK_THROWS_WITH(DynamicModel<>(ruler(Material{200e9}), 8), Catch::Matchers::ContainsSubstring("density"));
}

TEST_CASE("a viscous beam that is let go never has more energy, that of its branches included",
          "[dynamics]") {
  for (const double dt : {1e-3, 1e-4}) {
    Material material{200e9, 7850, Damping::ratio(0.002, 9)};
    material.damping.branches = {{{0.5, 0.02}, {0.3, 0.3}}};
    Beam bent = ruler(material);
    bent.add(PointLoad{0.3, 0, -8, 0});
    DynamicModel<> model(ruler(material), 8, 1);
    model.let_go_from(FemModel<Corotational<>>(bent, 8).shape());
    const double begin = model.energy().sum();
    double most = 0;
    for (int k = 0; k * dt < 0.3; ++k) {
      REQUIRE(model.step(dt) == Status::ok);
      most = std::max(most, model.energy().sum());
    }
    CHECK(most <= begin * (1 + 1e-9));
    CHECK(model.energy().sum() < 0.5 * begin);
  }
}

TEST_CASE("damping names what makes no sense", "[dynamics]") {
  CHECK_THROWS_WITH(Damping::ratio(-1, 9), Catch::Matchers::ContainsSubstring("damping ratio"));
  CHECK_THROWS_WITH(Damping::air(0.1, 0), Catch::Matchers::ContainsSubstring("damping frequency"));
  Material material{200e9, 7850};
  material.damping.branches[0] = {0.1, 0};
  CHECK_THROWS_WITH(ruler(material), Catch::Matchers::ContainsSubstring("relaxation time"));
  CHECK(Damping::loss_factor(0.02, 9).viscosity == Damping::ratio(0.01, 9).viscosity);
}
