// A beam in a host's hands feels as it does alone: whole strokes, touch, slide, release and positions that are no number.
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/hosts/chai3d.hpp>
#include <hapbeam/hosts/hapi.hpp>
#include <hapbeam/hosts/sofa.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Ruler = FemModel<Corotational<>>;
using Bar = FemModel<>;

constexpr double radius = 0.005, not_a_number = std::numeric_limits<double>::quiet_NaN();

Beam ruler_beam() {
  return Beam(0.3, Section::rectangle(0.025, 0.001), Material{210e9}, Support::clamped, Support::free);
}
Beam strip_beam() {
  return Beam(0.3, Section::rectangle(0.03, 0.003), Material{3e9}, Support::pinned, Support::pinned);
}

/// Down onto the beam and deep into it, along it, up, now and then from below and past the tip, and lost each 997th tick.
Vector2<double> stroke(int tick) {
  const double t = 1e-3 * tick;
  if (tick % 997 == 996) return {not_a_number, 0};
  if (tick % 1009 == 1008) return {0.2, -std::numeric_limits<double>::infinity()};
  return {0.19 + 0.12 * std::sin(0.7 * t), 0.004 + 0.016 * std::cos(1.9 * t) + 0.01 * std::cos(0.3 * t)};
}

constexpr int ticks = 20000;

struct Felt {
  int pressed = 0, differ = 0, finite = 0;

  /// @param alone  of Touch   @param there  the same tick's force in the host, along the beam and w   @param across  its third
  void compare(const TouchResult<double>& alone, double along, double w, double across) {
    pressed += alone.pressing && alone.force.norm() > 0;
    finite += std::isfinite(along) && std::isfinite(w) && std::isfinite(across);
    const bool answer = is_answer(alone.status);
    differ +=
        across != 0 || (answer ? along != alone.force.x() || w != alone.force.y() : along != 0 || w != 0);
  }
  void check() const {
    CHECK(pressed > ticks / 5);
    CHECK(pressed < ticks * 4 / 5);
    CHECK(differ == 0);
    CHECK(finite == ticks);
  }
};

template <typename Model>
struct Alone {
  explicit Alone(const Beam& beam) : model(beam, 8), touch(model, radius) {}
  TouchResult<double> tick(int k) { return touch.tick(stroke(k)); }
  Model model;
  Touch<Model> touch;
};

struct Tool {
  chai3d::cInteractionRecorder recorder;
  chai3d::cVector3d feel(chai3d::cGenericObject& world, const Vector2<double>& at, unsigned number = 7) {
    recorder.m_interactions.clear();
    return world.computeInteractions({0.01, at.x() - 0.15, at.y() + 0.02}, {}, number, recorder);
  }
};

}  // namespace

TEST_CASE("CHAI3D: each force is that of Touch, each touch an event, and the second tool feels nothing",
          "[hosts]") {
  Alone<Ruler> alone(ruler_beam());
  Ruler model(ruler_beam(), 8);
  chai3d::cWorld world;
  auto* beam = new Chai3dBeam<Ruler>(model, radius);
  world.addChild(beam);
  chai3d::cInteractionRecorder recorder;
  Felt felt;
  int events = 0, wrong_events = 0, second = 0;
  for (int k = 0; k < ticks; ++k) {
    const Vector2<double> at = stroke(k);
    recorder.m_interactions.clear();
    const auto force = world.computeInteractions({0.01, at.x(), at.y()}, {}, 7, recorder);
    const TouchResult<double> result = alone.tick(k);
    felt.compare(result, force.y(), force.z(), force.x());
    events += static_cast<int>(recorder.m_interactions.size());
    wrong_events += recorder.m_interactions.size() != (result.pressing && is_answer(result.status) ? 1u : 0u);
    for (const auto& event : recorder.m_interactions) {
      const auto out = event.m_localPos - event.m_localSurfacePos;
      wrong_events += event.m_object != beam || event.m_localForce.z() != force.z();
      wrong_events += std::abs(out.y() - radius * result.contact.normal.x()) > 1e-15 ||
                      std::abs(out.z() - radius * result.contact.normal.y()) > 1e-15;
    }
    const auto other = world.computeInteractions({0, 0.2, -0.002}, {}, 8, recorder);
    second += other.x() != 0 || other.y() != 0 || other.z() != 0;
  }
  felt.check();
  CHECK(events > ticks / 5);
  CHECK(wrong_events == 0);
  CHECK(second == 0);
}

TEST_CASE("CHAI3D: a beam that was moved is felt where it was moved to, and drawn as it is bent", "[hosts]") {
  Alone<Ruler> alone(ruler_beam());
  Ruler model(ruler_beam(), 8);
  chai3d::cWorld world;
  auto* beam = new Chai3dBeam<Ruler>(model, radius);
  beam->setLocalPos(0, -0.15, 0.02);
  world.addChild(beam);
  Tool tool;
  TouchResult<double> result;
  chai3d::cVector3d force;
  for (int k = 0; k <= 300; ++k) {
    const Vector2<double> at(0.25, 0.01 - 1e-4 * k);
    force = tool.feel(world, at);
    result = alone.touch.tick(at);
  }
  REQUIRE(result.force.y() > 1);
  // Placing it costs round-off of the position, 1e-17 m of 84 N/m.
  CHECK(force.z() == Approx(result.force.y()).epsilon(1e-12));
  chai3d::cRenderOptions options;
  world.renderSceneGraph(options);
  REQUIRE(drawing.points.size() > 100);
  CHECK_FALSE(drawing.open);
  for (const auto& point : drawing.points) CHECK(point.x == 0);
  // Two edges, half a thickness on either side of the centreline, from the clamp to the tip.
  const auto &first = drawing.points[0], &last = drawing.points.back(), &beside = drawing.points.end()[-2];
  CHECK(first.y == 0);
  CHECK(first.z == 0.0005);
  const auto tip = alone.model.shape().at(0.3);
  CHECK((last.y + beside.y) / 2 == Approx(0.3 + tip.u));
  CHECK((last.z + beside.z) / 2 == Approx(tip.w));
  CHECK(std::hypot(last.y - beside.y, last.z - beside.z) == Approx(0.001));
  options.m_render_transparent_back_faces_only = true;
  drawing.points.clear();
  world.renderSceneGraph(options);
  CHECK(drawing.points.empty());
}

TEST_CASE("CHAI3D: what the graphics thread draws is one whole shape, while the haptic thread presses",
          "[hosts][thread]") {
  Ruler model(ruler_beam(), 8);
  chai3d::cWorld world;
  auto* beam = new Chai3dBeam<Ruler>(model, radius);
  world.addChild(beam);
  std::atomic<bool> done{false};
  std::atomic<int> pictures{0};
  int torn = 0, bent = 0;
  std::thread graphics([&] {
    chai3d::cRenderOptions options;
    do {
      world.renderSceneGraph(options);
      ++pictures;
      // The band is a thousandth of the way thick everywhere: neighbouring points of two shapes would not be.
      const auto& points = drawing.points;
      for (std::size_t k = 0; k + 1 < points.size(); k += 2)
        torn += std::abs(std::hypot(points[k].y - points[k + 1].y, points[k].z - points[k + 1].z) - 0.001) >
                1e-12;
      for (std::size_t k = 2; k < points.size(); k += 2)
        torn += std::abs(std::hypot(points[k].y - points[k - 2].y, points[k].z - points[k - 2].z) -
                         0.3 / 128) > 1e-4;
      bent += points.back().z < -1e-3;
    } while (!done);
  });
  chai3d::cInteractionRecorder recorder;
  for (int k = 0; k < ticks || (pictures < 200 && k < 50 * ticks); ++k) {
    recorder.m_interactions.clear();
    const Vector2<double> at = stroke(k % ticks);
    (void)world.computeInteractions({0, at.x(), at.y()}, {}, 7, recorder);
  }
  done = true;
  graphics.join();
  CHECK(bent > 0);
  CHECK(torn == 0);
}

TEST_CASE("HAPI: each force is that of Touch", "[hosts]") {
  Alone<Bar> alone(strip_beam());
  Bar model(strip_beam(), 8);
  HapiBeam<Bar> beam(model, radius, Placement());
  HAPI::HAPIHapticsDevice device;
  Felt felt;
  for (int k = 0; k < ticks; ++k) {
    const Vector2<double> at = stroke(k);
    device.position = {at.x(), at.y(), -0.01};
    const HAPI::Vec3 force = beam.calculateForces({&device, 1e-3}).force;
    felt.compare(alone.tick(k), force.x, force.y, force.z);
  }
  felt.check();
}

TEST_CASE("SOFA: each force is that of Touch, asked for in either way", "[hosts]") {
  Alone<Bar> alone(strip_beam());
  Bar model(strip_beam(), 8);
  SofaBeam<Bar> beam(model, radius, Placement());
  Felt felt;
  int torques = 0;
  for (int k = 0; k < ticks; ++k) {
    const Vector2<double> at = stroke(k);
    sofa::type::Vec3 force{1, 1, 1};
    if (k % 2) {
      beam.computeForce(at.x(), at.y(), 0.02, 0, 0, 0, 1, force[0], force[1], force[2]);
    } else {
      sofa::type::SpatialVector wrench;
      wrench.setTorque({1, 1, 1});
      beam.computeWrench(sofa::type::Transform({at.x(), at.y(), 0.02}), {}, wrench);
      force = wrench.getForce();
      for (const double torque : wrench.getTorque()) torques += torque != 0;
    }
    felt.compare(alone.tick(k), force[0], force[1], force[2]);
  }
  felt.check();
  CHECK(torques == 0);
}

TEST_CASE("a host in millimetres, and one whose y is away from the user, feel the same beam", "[hosts]") {
  Alone<Bar> alone(strip_beam());
  Bar in_mm(strip_beam(), 8), away(strip_beam(), 8);
  PlacedTouch<Bar> millimetres(in_mm, radius, Placement::in_plane({0, 0}, 1e-3));
  PlacedTouch<Bar> haply(away, radius, y_away_from_user({0, 0}));
  Felt felt;
  double most = 0;
  for (int k = 0; k < ticks; ++k) {
    const Vector2<double> at = stroke(k);
    const TouchResult<double> result = alone.tick(k);
    const Eigen::Vector3d there = haply.tick({at.x(), 0.01, at.y()});
    felt.compare(result, there[0], there[2], there[1]);
    const Eigen::Vector3d here = millimetres.tick({1e3 * at.x(), 1e3 * at.y(), 0});
    if (is_answer(result.status))
      most = std::max(most, std::hypot(here[0] - result.force.x(), here[1] - result.force.y()));
  }
  felt.check();
  CHECK(most < 1e-6);  // [N]: round-off of 1e-16 m, at no more than 1e10 N/m
}

TEST_CASE("a beam that gives no answer is silent, says so, and comes back", "[hosts]") {
  Bar model(strip_beam(), 8);
  PlacedTouch<Bar> touch(model, radius);
  Eigen::Vector3d force(0, 0, 0);
  for (int k = 0; k <= 100; ++k) force = touch.tick({0.15, 0.01 - 1e-4 * k, 0});
  CHECK(force.y() > 0);
  CHECK(touch.picture().record.status == LoopStatus::touching);
  CHECK(touch.tick({not_a_number, 0, 0}).isZero(0));
  CHECK(touch.picture().record.status == LoopStatus::no_answer);
  CHECK(touch.picture().record.model == Status::invalid_request);
  CHECK(touch.picture().record.failed_ticks == 1);
  CHECK(touch.tick({0.15, 0, 0}).y() == Approx(force.y()));
  touch.reset();
  CHECK(touch.tick({0.15, 0.02, 0}).isZero(0));
  CHECK(touch.picture().record.status == LoopStatus::free);
  CHECK(touch.picture().shape().at(0.15).w == 0);
}
