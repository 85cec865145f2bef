// A round avatar on a beam that turns as far as it likes: a steel ruler of 300 × 25 × 1 mm, clamped at one end.
#include <limits>

#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Turning = FemModel<Corotational<>>;

constexpr double length = ruler_length, thickness = ruler_thickness;

/// Distance of a point from the deformed centreline, by samples a hundredth of an element apart and a parabola: to
/// 1e-6 of an element.
double distance(const Centreline<double>& line, const Vector& point) {
  const int samples = 100 * line.segments();
  std::vector<double> squared;
  for (int i = 0; i <= samples; ++i) {
    const double s = line.length() * i / samples;
    const Displacement<double> at = line.at(s);
    squared.push_back((Vector(s + at.u, at.w) - point).squaredNorm());
  }
  const auto least = std::min_element(squared.begin(), squared.end());
  if (least == squared.begin() || least + 1 == squared.end()) return std::sqrt(*least);
  const double a = least[-1], b = least[0], c = least[1], bend = a - 2 * b + c;
  return std::sqrt(std::max(0.0, b - (bend > 0 ? (a - c) * (a - c) / (8 * bend) : 0)));
}

/// What a tick must say whatever the hand does.
void check_law(const TouchResult<double>& r) {
  REQUIRE(r.force.allFinite());
  REQUIRE(r.force.dot(r.contact.normal) >= 0);  // a beam never pulls, and has no friction
  REQUIRE(std::abs(cross<double>(r.force, r.contact.normal)) <= 1e-12 * r.force.norm());
  if (!r.pressing) REQUIRE(r.force.isZero(0));
}

/// Straight from one place to another.  @param visit  (from, to, TouchResult)
template <class Model, class Visit>
void move(Touch<Model>& touch, const Vector& from, const Vector& to, int ticks, Visit&& visit) {
  for (int k = 1; k <= ticks; ++k) {
    const Vector before = from + (to - from) * (double(k - 1) / ticks),
                 now = from + (to - from) * (double(k) / ticks);
    visit(before, now, touch.tick(now));
  }
}
template <class Model>
TouchResult<double> rest_at(Touch<Model>& touch, const Vector& at) {
  TouchResult<double> r;
  for (int k = 0; k < 10; ++k) r = touch.tick(at);
  return r;
}

}  // namespace

// The equations do not know which way is up.
TEST_CASE("a push from below is the mirror image of a push from above, for a beam straight or bent",
          "[push]") {
  Turning above(steel_ruler(), 8), below(steel_ruler(), 8);
  for (const double angle : {0.0, 0.3, -1.0, 1.5})
    for (const double d : {-1e-4, -0.01, -0.05, -0.1}) {
      const Vector n(std::sin(angle), std::cos(angle)), mirrored(n.x(), -n.y());
      above.reset(), below.reset();
      const Response<double> one = above.push({0.2, d * n.y(), n}),
                             other = below.push({0.2, d * n.y(), mirrored});
      CAPTURE(angle, d, one.force, other.force);
      CHECK(one.status == other.status);
      CHECK(std::abs(one.force - other.force) <= 1e-9 * std::abs(one.force));
      for (int i = 0; i <= 8; ++i) {
        CHECK(std::abs(above.shape()[i].w + below.shape()[i].w) <= 1e-9);
        CHECK(std::abs(above.shape()[i].u - below.shape()[i].u) <= 1e-9);
      }
    }
}

// Along -n the displacement and the force are the negative of those along n.
TEST_CASE("the sense of the normal is a matter of signs", "[push]") {
  Turning one(steel_ruler(), 8), other(steel_ruler(), 8);
  for (const double angle : {0.0, 0.4, -0.8})
    for (const double d : {1e-4, -0.03}) {
      const Vector n(std::sin(angle), std::cos(angle));
      one.reset(), other.reset();
      const Response<double> a = one.push({0.25, d, n}), b = other.push({0.25, -d, Vector(-n)});
      CAPTURE(angle, d, a.force, b.force);
      CHECK(a.status == Status::ok);
      CHECK(b.status == Status::ok);
      CHECK(relative_error(b.force, -a.force) <= 1e-9);
    }
}

// The thesis presses across and does not slide.  For a slope t both agree up to t² (here of 2 mm on 0.2 m: 3e-4).
TEST_CASE("for a small deflection a push is the press of the thesis", "[push]") {
  Turning turning(steel_ruler(), 16);
  FemModel<> moderate(steel_ruler(), 16);
  const double reach = 0.005 + thickness / 2;
  for (const double s : {0.1, 0.2, 0.28})
    for (const double d : {-1e-5, -1e-4, -1e-3}) {
      Touch<Turning> touch(turning, 0.005);
      const double slope = 1.5 * std::abs(d) / s, bound = 3 * slope * slope + 3 * slope * reach / s + 1e-7;
      (void)touch.tick({s, 0.02});
      const TouchResult<double> r = rest_at(touch, {s, d + reach});
      const Response<double> pressed = moderate.press({s, d});
      CAPTURE(s, d, r.force.y(), pressed.force, bound);
      CHECK(r.status == Status::ok);
      CHECK(relative_error(r.force.y(), -pressed.force) <= bound);
    }
}

// The push ends where the centre is as far from the normal as `near` = 1e-5 of reach, which is second order in the distance.
// An end that slides along a wall moves across the beam alone: (u, w) = (0, d / n_w), and of the force F the wall takes F n_x.
TEST_CASE("an end that slides along a wall is pushed along any normal as it is pressed", "[push]") {
  for (const Support left : {Support::clamped, Support::roller})
    for (const double angle : {-0.6, -0.1, 0.1, 0.3, 0.6, 1.0})
      for (const double d : {-1e-5, -3e-4, -3e-3, 1e-3}) {
        const Beam beam = steel_ruler(left, Support::guided);
        const Vector normal(std::sin(angle), std::cos(angle));
        Turning pushed(beam, 16), pressed(beam, 16);
        const Response<double> push = pushed.push({length, d, normal}),
                               press = pressed.press({length, d / normal.y()});
        CAPTURE(name(left), angle, d, push.force, press.force);
        CHECK(push.status == Status::ok);
        CHECK(push.force == Approx(press.force / normal.y()).epsilon(1e-7));
        CHECK(pushed.shape()[pushed.shape().segments()].u == 0);
        CHECK(pushed.shape()[pushed.shape().segments()].w == Approx(d / normal.y()).epsilon(1e-12));
      }
}

TEST_CASE("a circle at rest touches the centreline at radius + thickness/2, also of a ruler bent to 80 %",
          "[push]") {
  for (const int side : {1, -1})
    for (const double radius : {0.001, 0.005, 0.02}) {
      Turning model(steel_ruler(), 16);
      Touch<Turning> touch(model, radius);
      const double reach = radius + thickness / 2;
      Vector at(0.24, side * (reach + 0.001));
      (void)touch.tick(at);
      double deepest = 0;
      // Down and in, as a hand bends a ruler: the tip goes down by 0.8 of the length.
      for (int k = 0; k <= 600; ++k) {
        const double t = k / 600.0;
        const Vector to(0.24 - 0.16 * t * t, side * (reach + 0.001 - 0.2 * t));
        const TouchResult<double> r = touch.tick(to);
        check_law(r);
        CAPTURE(side, radius, k, r.contact.s, to.x(), to.y());
        REQUIRE(r.status == Status::ok);
        if (k % 20 == 0) {
          const TouchResult<double> still = rest_at(touch, to);
          REQUIRE(still.status == Status::ok);
          if (still.pressing) REQUIRE(std::abs(distance(model.shape(), to) - reach) <= 1e-7);
        }
        deepest = std::max(deepest, -side * model.shape().at(length).w);
      }
      CHECK(touch.pressing());
      CHECK(deepest >= 0.8 * length);
    }
}

// A conservative beam and a frictionless contact have a potential: whatever way the hand goes, if it comes back to where it
// was the work is nothing.  The hand's work is integrated by Simpson's rule over three ticks: h⁴ of its way.
TEST_CASE("closed paths of the avatar along and around the bent ruler take no work", "[push]") {
  for (const int elements : {8, 16}) {
    Turning model(steel_ruler(), elements, tight_solver());
    Random random(3);
    double worst = 0;
    for (int path = 0; path < 6; ++path) {
      Touch<Turning> touch(model, 0.005);
      const Vector centre(random(0.16, 0.22), -random(0.02, 0.06)),
          size(random(0.01, 0.05), random(0.005, 0.015));
      const double phase = random(3), twist = random(3);
      const int round = path % 2 ? 1 : 2;
      const auto at = [&](double t) -> Vector {
        const double a = 2 * 3.14159265358979 * t;
        return {centre.x() + size.x() * std::sin(round * a + phase),
                centre.y() + size.y() * std::sin(a + twist)};
      };
      (void)touch.tick({at(0).x(), 0.02});
      move(touch, {at(0).x(), 0.02}, at(0), 200, [](auto&&...) {});
      Vector force = rest_at(touch, at(0)).force;
      const int steps = 4000;
      double work = 0, peak = model.strain_energy();
      int not_ok = 0;
      for (int k = 0; k < steps; ++k) {
        const double h = 1.0 / steps, t = k * h;
        Vector forces[2];
        for (int half = 0; half < 2; ++half) {
          const TouchResult<double> r = touch.tick(at(t + (half + 1) * h / 2));
          check_law(r);
          not_ok += r.status != Status::ok || !r.pressing;
          forces[half] = r.force;
        }
        const Vector v0 = (at(t + 1e-5) - at(t - 1e-5)) / 2e-5,
                     v1 = (at(t + h / 2 + 1e-5) - at(t + h / 2 - 1e-5)) / 2e-5,
                     v2 = (at(t + h + 1e-5) - at(t + h - 1e-5)) / 2e-5;
        work -= h / 6 * (force.dot(v0) + 4 * forces[0].dot(v1) + forces[1].dot(v2));
        force = forces[1];
        peak = std::max(peak, model.strain_energy());
      }
      CAPTURE(elements, path, work, peak, not_ok);
      CAPTURE(not_ok);
      CHECK(not_ok == 0);
      CHECK(std::abs(work) <= 1e-5 * peak);
      worst = std::max(worst, std::abs(work) / peak);
    }
    CAPTURE(elements, worst);
    CHECK(worst <= (elements == 8 ? 1e-5 : 1e-6));
  }
}

// F = -∇V of the hand's position: central differences of the stored energy with h = 1e-5 m leave (h/L)² and 1e-9 of round-off;
// what 16 elements miss of a potential, because their nodes follow the contact, is 1e-6.
TEST_CASE("the force is the gradient of the stored energy, along and across the beam", "[push]") {
  Turning model(steel_ruler(), 16, tight_solver());
  Touch<Turning> touch(model, 0.005);
  (void)touch.tick({0.2, 0.02});
  for (const Vector& at : {Vector(0.2, -0.02), Vector(0.17, -0.06), Vector(0.13, -0.1), Vector(0.22, 0.0)}) {
    move(touch, {0.2, 0.006}, at, 300, [](auto&&...) {});
    const TouchResult<double> r = rest_at(touch, at);
    REQUIRE(r.status == Status::ok);
    REQUIRE(r.pressing);
    const double h = 1e-5;
    for (int axis = 0; axis < 2; ++axis) {
      double energy[2];
      for (int k = 0; k < 2; ++k) {
        Vector to = at;
        to[axis] += k == 0 ? -h : h;
        rest_at(touch, to);
        energy[k] = model.strain_energy();
      }
      const double slope = (energy[1] - energy[0]) / (2 * h);
      CAPTURE(at.x(), at.y(), axis, slope, r.force[axis]);
      CHECK(std::abs(slope + r.force[axis]) <= 1e-5 * r.force.norm());
    }
    move(touch, at, {0.2, 0.006}, 300, [](auto&&...) {});
  }
}

// Slips off: the ruler springs back, once, and nothing is left behind.
TEST_CASE("a hand that goes past the tip slips off the bent ruler and is free", "[push]") {
  for (const int side : {1, -1})
    for (const double radius : {0.001, 0.005, 0.02}) {
      Turning model(steel_ruler(), 8);
      Touch<Turning> touch(model, radius);
      Vector at(0.27, side * (radius + 0.01));
      (void)touch.tick(at);
      const Vector down(0.27, -side * 0.06), off(0.36, -side * 0.06);
      move(touch, at, down, 400, [&](const Vector&, const Vector&, const auto& r) {
        check_law(r);
        REQUIRE(r.status == Status::ok);
      });
      REQUIRE(touch.pressing());
      int let_go = 0, refused = 0;
      bool was = true;
      move(touch, down, off, 800, [&](const Vector&, const Vector& to, const auto& r) {
        CAPTURE(side, radius, to.x(), name(r.status));
        check_law(r);
        refused += !is_answer(r.status);
        let_go += was && !r.pressing;
        was = r.pressing;
      });
      CHECK(let_go == 1);
      CHECK(refused <= 2);  // where the tip is pushed along itself there is no equilibrium any more
      CHECK_FALSE(touch.pressing());
      for (const auto& node : model.shape()) {
        CAPTURE(node.s, node.u, node.w, side, radius);
        CHECK((node.u == 0 && node.w == 0));
      }
    }
}

TEST_CASE("an arch is met where it stands, from above and from below", "[push]") {
  const Beam beam = level_arch(0.2, 0.8, 1e6, 0.02, 0.0005, Support::clamped, Support::clamped);
  for (const int side : {1, -1})
    for (const double s : {0.06, 0.1, 0.13}) {
      Turning model(beam, 16);
      Touch<Turning> touch(model, 0.005);
      const Displacement<double> at = model.shape().at(s);
      const Vector foot(s + at.u, at.w), normal(side * std::sin(at.theta), side * std::cos(at.theta));
      const double reach = 0.005 + 0.0005 / 2;
      for (const double gap : {0.002, 1e-6, -1e-6, -0.0003}) {
        const Vector hand = foot + normal * (reach + gap);
        const TouchResult<double> r = rest_at(touch, hand);
        CAPTURE(side, s, gap, r.force.x(), r.force.y());
        CHECK(r.status == Status::ok);
        CHECK(r.pressing == (gap < 0));
        CHECK(r.force.dot(normal) * (gap < 0 ? 1 : 0) >= 0);
        if (gap < 0) CHECK(r.force.dot(normal) > 0);
        if (gap < 0) CHECK(std::abs(distance(model.shape(), hand) - reach) <= 1e-7);
      }
      rest_at(touch, foot + normal * 0.05);
      CHECK(model.strain_energy() <= 1e-9);
    }
}

TEST_CASE("in float the ruler answers to four digits", "[push][float]") {
  FemModel<Corotational<>, float> rounded(steel_ruler(), 8);
  Turning model(steel_ruler(), 8);
  Touch<FemModel<Corotational<>, float>> touch_float(rounded, 0.005f);
  Touch<Turning> touch(model, 0.005);
  double worst = 0;
  int not_ok = 0;
  for (int k = 0; k <= 1000; ++k) {
    const Vector at(0.22 - 0.05 * k / 1000, 0.007 - 0.08 * k / 1000);
    const TouchResult<double> r = touch.tick(at);
    const TouchResult<float> f = touch_float.tick(at.cast<float>());
    not_ok += f.status != Status::ok || r.status != Status::ok;
    if (k > 100) worst = std::max(worst, (f.force.cast<double>() - r.force).norm() / r.force.norm());
  }
  CAPTURE(worst);
  CAPTURE(not_ok);
  CHECK(not_ok == 0);
  CHECK(worst <= 1e-3);
}

// To second order of the last increment, which moves the beam by some 10⁻⁵ m: a look from before it is off by 5·10⁻⁸ and 10⁻⁷ m.
TEST_CASE("the point that is touched lies on the avatar, and where the beam was looked at it", "[push]") {
  const double radius = 0.005, reach = radius + ruler_thickness / 2;
  Turning model(steel_ruler(), 8);
  Touch<Turning> touch(model, radius);
  double off = 0, beside = 0;
  for (int k = 0; k <= 1000; ++k) {
    const Vector at(0.22 - 0.05 * k / 1000, 0.007 - 0.08 * k / 1000);
    const TouchResult<double> r = touch.tick(at);
    REQUIRE(r.status == Status::ok);
    if (!r.pressing) continue;
    off = std::max(off, std::abs((r.contact.foot - at).norm() - reach));
    beside = std::max(beside, (model.shape().position(r.contact.s) - r.contact.foot).norm());
  }
  CAPTURE(off, beside);
  CHECK(off <= 1e-9);
  CHECK(beside <= 1e-9);
}
