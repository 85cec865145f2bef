// Lee's frame: two legs at a right angle between hinges, P down at a fifth of the upper one.  The load passes two limit
// points, and between them the loaded point goes back up: no control of load or displacement follows it.
//
// Source: S. L. Lee, F. S. Manuel and E. C. Rossow, Large deflections and stability of elastic frames, J. Engineering
// Mechanics Division ASCE 94 (1968).  The reference is shot (support/rod.hpp), with a true corner.  The beam has a short
// arc for it, which cuts off R/leg of the frame, and the element that holds the arc rounds it by some of its own length: a
// quarter of that, 3e-3 with 160 elements, is allowed.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/pi.hpp"
#include "support/rod.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double leg = 120, at = 24;  // [cm]
constexpr double EA = 720 * 6, EI = 720 * 2;

/// Where load and displacement turn back: P at the limit points, and how far down the loaded point is at its extremes.
struct FrameTurns {
  std::vector<double> load, down;
};

/// Unknown: the left hinge's angle, its force (H, V), P, and how far down the loaded point is.
FrameTurns shot_turns() {
  using Unknowns = Eigen::Matrix<double, 5, 1>;
  const PlanarRod rod{EA, EI};
  const auto equations = [&](const Unknowns& z) -> Eigen::Vector4d {
    RodState end = rod.along({0, 0, z[0], 0}, leg, z[1], z[2], 0, 80);
    end.phi -= pi / 2;
    end = rod.along(end, at, z[1], z[2], 0, 20);
    const double down = leg - end.y;
    end = rod.along(end, leg - at, z[1], z[2] + z[3], 0, 80);
    return {(end.x - leg) / leg, (end.y - leg) / leg, end.moment * leg / EI, (z[4] - down) / leg};
  };
  Unknowns start = Unknowns::Zero(), scale;
  start[0] = pi / 2;
  scale << 1, 0.3, 1, 1, leg;
  const Curve<5> begin(equations, start, scale, Unknowns::Unit(3));
  FrameTurns found;
  for (const int k : {3, 4}) {
    Curve<5> curve = begin;
    for (int turn = 0; turn < 2; ++turn) {
      const Unknowns z = curve.turning_point(equations, k, 0.05, 1000);
      REQUIRE(curve.found());
      (k == 3 ? found.load : found.down).push_back(z[k]);
    }
  }
  return found;
}

/// Up the left leg, round the corner, along the upper one.
struct Frame {
  double radius, arc = pi * radius / 2, straight = leg - radius, length = 2 * straight + arc,
                 loaded = straight + arc + at - radius;

  Beam beam() const {
    Beam frame(length, EA, EI, 1, Support::pinned, Support::pinned);
    frame.naturally({{straight, 0}, {straight + arc, 1 / radius}});
    frame.place({0, 0, -pi / 2}, {leg - length, leg, 0});
    return frame.add({loaded, 0, -1, 0});
  }
  Path path(int elements, double step) const {
    return follow(
        beam(), elements, step, [&](const auto& system) { return leg - system.centreline().at(loaded).w; },
        [](const Equilibrium& e) { return e.load < 2.5; });
  }
};

}  // namespace

TEST_CASE(
    "Lee's frame: both limit points, 1.856 and -0.941, and the snap-back between, whatever its corner's arc",
    "[continuation]") {
  const FrameTurns exact = shot_turns();
  CAPTURE(exact.load[0], exact.load[1], exact.down[0], exact.down[1]);
  CHECK(std::abs(exact.load[0] - 1.856) <= 5e-4);
  CHECK(std::abs(exact.load[1] + 0.941) <= 5e-4);
  for (const double radius : {1.0, 0.1, 0.01}) {
    const Frame frame{radius};
    const double corner = (frame.length / 160 / 4 + radius) / leg;
    const Path path = frame.path(160, 0.01);
    REQUIRE(path.status == Status::ok);
    const std::vector<Turn> loads = load_turns(path),
                            downs = turns(
                                path.points, [](const Equilibrium&e) { return e.way; },
                                [](const Equilibrium&e) { return e.load; });
    REQUIRE(loads.size() == 2);
    REQUIRE(downs.size() == 2);
    CHECK((loads[0].index < downs[0].index && downs[1].index < loads[1].index));
    for (std::size_t k = 0; k < 2; ++k) {
      CAPTURE(radius, k, loads[k].extreme, downs[k].extreme);
      CHECK(relative_error(loads[k].extreme, exact.load[k]) <= corner);
      CHECK(relative_error(downs[k].extreme, exact.down[k]) <= corner);
    }
    int wrong = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const bool beside = i + 1 == loads[0].index || i == loads[0].index || i == loads[0].index + 1 ||
                          i + 1 == loads[1].index || i == loads[1].index || i == loads[1].index + 1;
      const int expected = i > loads[0].index && i < loads[1].index ? 1 : 0;
      wrong += !beside && path.points[i].negative_pivots != expected;
    }
    CHECK(wrong == 0);  // also where the displacement turns: under this load that is no event
  }
}

// The step is a tenth of the whole way at most; a coarse path is the same path.
TEST_CASE("the path does not depend on the steps that it is followed with", "[continuation]") {
  const Frame frame{0.1};
  const Path fine = frame.path(40, 0.005), coarse = frame.path(40, 0.05);
  REQUIRE(fine.status == Status::ok);
  REQUIRE(coarse.status == Status::ok);
  CHECK(coarse.points.size() < 150);
  double worst = 0;
  for (const Equilibrium& point : coarse.points) {
    // Distance to the chords of the fine path, in units of its size; chords are off by h²/8 of the curvature, 1e-4.
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < fine.points.size(); ++i) {
      const Eigen::Vector2d a(fine.points[i].load / 2, fine.points[i].way / 100),
          b(fine.points[i + 1].load / 2, fine.points[i + 1].way / 100), p(point.load / 2, point.way / 100);
      const double t = std::max(0., std::min(1., (p - a).dot(b - a) / (b - a).squaredNorm()));
      nearest = std::min(nearest, (a + t * (b - a) - p).norm());
    }
    if (point.load < 2.4) worst = std::max(worst, nearest);
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-4);
}
