// Snap-through under a dead load: both limit points of a toggle frame and of a shallow arch, against shooting.
//
// The references are those of the rod that stretches and bends at any rotation (support/rod.hpp), symmetric about the
// middle: the library's own equations, without its elements.  Elements are of fourth order, so that 1 % is met with
// 4 of them and 16 are at 1e-5.
#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/pi.hpp"
#include "support/rod.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Turning = FemModel<Corotational<>>;

/// A limit point: the load on all of the frame, and how far its middle has come down.
struct LimitPoint {
  double load, down;
};

/// Half of a symmetric frame under a load P in its middle, shot from its left end; unknown are the end's moment or angle,
/// the thrust H, and P.
struct HalfFrame {
  PlanarRod rod;
  double length, span, rise, angle, curvature;  // of the half; the angle at its left
  bool hinged;
  double middle_angle;

  RodState middle(const Eigen::Vector3d& z) const {
    const RodState left = hinged ? RodState{0, 0, z[0], 0} : RodState{0, 0, angle, z[0]};
    return rod.along(left, length, z[1], -z[2] / 2, curvature);
  }
  std::vector<LimitPoint> limit_points() const {
    const auto equations = [this](const Eigen::Vector3d& z) -> Eigen::Vector2d {
      const RodState at = middle(z);
      return {(at.x - span) / rise, (at.phi - middle_angle) / angle};
    };
    const double moment = rod.EI * angle / length, force = moment / rise;
    Curve<3> curve(equations, {hinged ? angle : 0, 0, 0}, {hinged ? angle : moment, force, force}, {0, 0, 1});
    std::vector<LimitPoint> found;
    while (curve.found() && found.size() < 2) {
      const Eigen::Vector3d z = curve.turning_point(equations, 2, 0.02, 2000);
      if (curve.found()) found.push_back({z[2], rise - middle(z).y});
    }
    return found;
  }
};

/// 0 before the first limit point, 1 between the two, 0 behind: what is next to a limit point is on neither side.
void check_inertia(const Path& path, const std::vector<Turn>& limits) {
  REQUIRE(limits.size() == 2);
  int wrong = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    if (i + 1 >= limits[0].index && i <= limits[0].index + 1) continue;
    if (i + 1 >= limits[1].index && i <= limits[1].index + 1) continue;
    wrong += path.points[i].negative_pivots != (i > limits[0].index && i < limits[1].index ? 1 : 0);
  }
  CHECK(wrong == 0);
}

// Williams' toggle frame [in, lbf].
constexpr double half_span = 12.943, rise = 0.386, toggle_EA = 1.885e6, toggle_EI = 9.27e3;

HalfFrame half_toggle() {
  const double length = std::hypot(half_span, rise), angle = std::atan2(rise, half_span);
  return {{toggle_EA, toggle_EI}, length, half_span, rise, angle, 0, false, angle};
}
Beam toggle() {
  const HalfFrame half = half_toggle();
  Beam beam(half.length, toggle_EA, toggle_EI, 0.243, Support::clamped, Support::guided);
  beam.place({0, 0, -half.angle}, {half_span - half.length, rise, -half.angle});
  return beam.add({half.length, 0, -0.5, 0});
}

// A hinged arch so shallow (rise 3.6 √(EI/EA); from 4 on it leans over) that it stays symmetric.
constexpr double arch_length = 1, arch_angle = 0.2, arch_EI = 1, arch_EA = 20736;

HalfFrame half_arch() {
  const double span = arch_length / arch_angle * std::sin(arch_angle / 2);
  return {{arch_EA, arch_EI}, arch_length / 2,           span, level_arch_rise(arch_length, arch_angle),
          arch_angle / 2,     -arch_angle / arch_length, true, 0};
}
Beam arch() {
  return level_arch(arch_length, arch_angle, arch_EA, arch_EI, 0.001, Support::pinned, Support::pinned);
}

}  // namespace

// The rod's own error, halving its steps: nothing at the precision that is asked for here.
TEST_CASE("the reference by shooting has converged", "[continuation]") {
  const PlanarRod rod{toggle_EA, toggle_EI};
  const RodState once = rod.along({0, 0, 0.03, -60}, 12.95, -630, -17),
                 finer = rod.along({0, 0, 0.03, -60}, 12.95, -630, -17, 0, 400);
  CHECK(std::abs(once.x - finer.x) <= 1e-10);
  CHECK(std::abs(once.y - finer.y) <= 1e-10);
  // A full circle under an end moment, and a stretched one: closed forms.
  const RodState circle = rod.along({0, 0, 0, 2 * pi * rod.EI}, 1, 0, 0);
  CHECK(std::hypot(circle.x, circle.y) <= 1e-8);
  CHECK(std::abs(rod.along({}, 1, 1e4, 0).x - (1 + 1e4 / rod.EA)) <= 1e-14);
}

// Frame and measured loads: F. W. Williams, An approach to the non-linear behaviour of the members of a rigid jointed plane
// framework with finite deflections, Quarterly J. Mech. Appl. Math. 17 (1964); since Wood and Zienkiewicz, Computers and
// Structures 7 (1977), a benchmark.
TEST_CASE("Williams' toggle frame: both limit points, 33.86 and 31.26 lbf", "[continuation]") {
  const std::vector<LimitPoint> exact = half_toggle().limit_points();
  REQUIRE(exact.size() == 2);
  CAPTURE(exact[0].load, exact[0].down, exact[1].load, exact[1].down);
  CHECK(std::abs(exact[0].load - 33.86) <= 0.005);
  CHECK(std::abs(exact[1].load - 31.26) <= 0.005);
  for (const int elements : {4, 16}) {
    const Path path = follow(
        toggle(), elements, 0.0005, [&](const auto& at) { return rise - at.node(elements).w; },
        [](const Equilibrium& e) { return e.way < 2 * rise; });
    REQUIRE(path.status == Status::ok);
    const std::vector<Turn> limits = load_turns(path);
    REQUIRE(limits.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      CAPTURE(elements, k, limits[k].extreme, limits[k].other);
      CHECK(relative_error(limits[k].extreme, exact[k].load) <= (elements == 4 ? 1e-2 : 1e-5));
      CHECK(relative_error(limits[k].other, exact[k].down) <= (elements == 4 ? 1e-2 : 1e-3));
    }
    check_inertia(path, limits);
  }
}

TEST_CASE("a shallow arch: both limit points by arc length, and on the falling branch of a press",
          "[continuation]") {
  const std::vector<LimitPoint> exact = half_arch().limit_points();
  REQUIRE(exact.size() == 2);
  const double top = level_arch_rise(arch_length, arch_angle);
  CAPTURE(exact[0].load, exact[1].load, exact[0].down / top, exact[1].down / top);
  CHECK(exact[0].load > 2 * exact[1].load);  // a true snap
  Beam loaded = arch();
  const Path path = follow(
      loaded.add({arch_length / 2, 0, -1, 0}), 16, 0.002, [&](const auto& at) { return top - at.node(8).w; },
      [top](const Equilibrium& e) { return e.way < 3 * top; });
  REQUIRE(path.status == Status::ok);
  const std::vector<Turn> limits = load_turns(path);
  check_inertia(path, limits);

  Turning model(arch(), 16);
  std::vector<LimitPoint> pressed;
  for (int k = 0; k <= 300; ++k) {
    const double down = 2.5 * top * k / 300;
    const Response<double> response = model.press({arch_length / 2, top - down});
    REQUIRE(response.status == Status::ok);  // held in its middle it snaps nowhere
    pressed.push_back({-response.force, down});
  }
  const std::vector<Turn> held = turns(
      pressed, [](const LimitPoint& p) { return p.load; }, [](const LimitPoint& p) { return p.down; });
  REQUIRE(held.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(k, limits[k].extreme, held[k].extreme);
    CHECK(relative_error(limits[k].extreme, exact[k].load) <= 1e-4);
    CHECK(relative_error(held[k].extreme, exact[k].load) <= 1e-4);
    CHECK(std::abs(limits[k].other - exact[k].down) <= 2e-3 * top);
    CHECK(std::abs(held[k].other - exact[k].down) <= 2e-3 * top);
  }
}

// A dead load's work on the way is stored: V = ∫λ dw, by the trapezium rule off by the square of the steps.
TEST_CASE("along a path the load's work is the strain energy, past limit points", "[continuation]") {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const Path path = follow(
        toggle(), 8, 0.004 / (1 << k), [](const auto& at) { return rise - at.node(8).w; },
        [](const Equilibrium& e) { return e.way < 2 * rise; });
    double work = 0, worst = 0, largest = 0;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      const Equilibrium &a = path.points[i - 1], &b = path.points[i];
      work += (a.load + b.load) / 4 * (b.way - a.way);  // the half frame has half of the load
      worst = std::max(worst, std::abs(work - b.energy));
      largest = std::max(largest, b.energy);
    }
    error[k] = worst / largest;
  }
  CAPTURE(error[0], error[1]);
  CHECK(error[1] <= 1e-3);
  CHECK(std::abs(observed_order(error[0], error[1]) - 2) <= 0.3);
}

// Which way is on has to be known from the beam, and not from what memory held before.
TEST_CASE("a path begins toward larger loads, also where memory has been used", "[continuation]") {
  const auto none = [](const auto&) { return 0.0; };
  for (int trial = 0; trial < 8; ++trial) {
    {
      std::vector<std::vector<Vector3<double>>> used(
          8, std::vector<Vector3<double>>(9, Vector3<double>::Constant(trial % 2 ? 1e3 : -1e3)));
      REQUIRE(used.back().size() == 9);
    }
    const Path path =
        follow(toggle(), 8, 0.002, none, [](const Equilibrium& e) { return std::abs(e.load) < 5; });
    REQUIRE(path.status == Status::ok);
    CHECK(path.points.back().load > 0);
  }
}

TEST_CASE("a visitor ends the path where it likes, and the system stays there", "[continuation]") {
  System<> system(toggle(), 8);
  double last = 0;
  int visits = 0;
  const Status status = ArcLength{}.solve(system, [&](const auto&, const PathPoint& point) {
    last = point.load;
    return ++visits < 7;
  });
  CHECK(status == Status::ok);
  CHECK(visits == 7);
  CHECK(system.load() == last);
  // It is an equilibrium under that load: another step of Newton's moves nothing.
  const double energy = system.strain_energy();
  REQUIRE(system.factor(0) == Status::ok);
  system.advance();
  CHECK(relative_error(system.strain_energy(), energy) <= 1e-10);
}
