// The point of a rod that is nearest to an avatar, against brute force.
#include <algorithm>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/bounding_volumes.hpp>
#include <hapbeam/contact/find_contact_near.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Point random_point(Random& random, double size) { return {random(size), random(size), random(size)}; }

double distance(const RodPoint<double>& at, const Shaft<double>& shaft) {
  return (shaft.at(shaft.nearest(at.r)) - at.r).norm();
}

/// The least distance of the rod, at samples, and by golden section beside the best of them.
double least(const Centreline<double, 3>& line, const Shaft<double>& shaft) {
  const int samples = 200 * line.segments();
  const double h = line.length() / samples;
  double best = 1e9, s = 0;
  for (int i = 0; i <= samples; ++i) {
    const double d = distance(line.at(i * h), shaft);
    if (d < best) best = d, s = i * h;
  }
  double low = std::max(s - h, 0.0), high = std::min(s + h, line.length());
  for (int k = 0; k < 60; ++k) {
    const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
    (distance(line.at(a), shaft) < distance(line.at(b), shaft) ? high : low) =
        distance(line.at(a), shaft) < distance(line.at(b), shaft) ? b : a;
  }
  return std::min(best, distance(line.at((low + high) / 2), shaft));
}

}  // namespace

TEST_CASE("the nearest point of a rod to a sphere or a capsule is exact to 1e-9 m", "[rod]") {
  Random random(61);
  for (const char* name : {"wire_under_load", "hook", "spring"}) {
    const PressedRod pressed = pressed_rod(name);
    FemModel<TwistedRod> model(pressed.rod, 8 * pressed.turns);
    const double size = pressed.rod.length() / 2;
    BoundingVolumes<double, 3> volumes(model.shape().segments());
    for (int trial = 0; trial < 60; ++trial) {
      if (trial % 20 == 0) (void)model.push({pressed.s, random(size / 5), pressed.normal});
      const auto line = model.shape();
      volumes.refit(line);
      Shaft<double> shaft{line.at(random(0.0, line.length())).r + random_point(random, size / 4),
                          random_point(random, size)};
      if (trial % 3 == 0) shaft.way.setZero();
      const auto found =
          trial % 3 == 0 && trial % 2 == 0 ? volumes.nearest(line, shaft.tip) : volumes.nearest(line, shaft);
      REQUIRE(found.segment >= 0);
      const double expected = least(line, shaft), d = std::sqrt(found.at.distance_squared);
      CAPTURE(name, trial, d, expected);
      CHECK(std::abs(d - expected) <= 1e-9);
      // The point that is named has that distance, and no box is nearer than what it holds.
      const auto &a = line[found.segment], &b = line[found.segment + 1];
      CHECK(std::abs(distance(line.at(found.segment, a.s + found.at.t * (b.s - a.s)), shaft) - d) <= 1e-12);
      CHECK(std::abs(found.at.offset.norm() - d) <= 1e-12);
      CHECK(volumes.distance_squared(shaft) <= d * d * (1 + 1e-12));
    }
  }
}

TEST_CASE("near where it was the contact of a rod is that of the whole rod, to the bit, or its own still",
          "[rod]") {
  Random random(67);
  int found = 0, apart = 0, passed = 0, own = 0;
  for (const char* name : {"wire_under_load", "hook", "spring"}) {
    const PressedRod pressed = pressed_rod(name);
    FemModel<TwistedRod> model(pressed.rod, 8 * pressed.turns);
    const double size = pressed.rod.length();
    BoundingVolumes<double, 3> volumes(model.shape().segments());
    for (int trial = 0; trial < 4000; ++trial) {
      if (trial % 200 == 0) {
        const double depth = random(size / 10);
        (void)model.push({pressed.s, depth, pressed.normal});
        volumes.refit(model.shape());
      }
      const double s = random(0.0, size), far = std::pow(10, random(-5, -0.5)) * size,
                   radius = random(0.0, 0.05) * size, stale = random(0.0, size),
                   moved = random(0.0, trial % 8 == 0 ? 4.0 : 0.1) * radius;
      const double z = random(far), y = random(far), x = random(far);
      Avatar<double, 3> avatar{model.shape().at(s).r + Point(x, y, z), radius};
      if (trial % 2 == 0) avatar.shaft = Point(y, z, x) / far * size / 4;
      ContactMemory<double, 3> near;
      near.place = avatar.place();
      near.place.tip.x() += moved;
      near.known = near.touching = true;
      near.s = trial % 4 == 3 ? stale : s;
      near.normal = detail::unit(Point(x, z, y));
      ContactMemory<double, 3> all = near;
      Contact<double, 3> here;
      if (!detail::find_contact_near(model, near.s, avatar, near, here)) {
        ++passed;
        continue;
      }
      ++found;
      const Contact<double, 3> whole = find_contact(avatar, model.shape(), volumes, model.thickness(), all);
      const auto away = [&](const auto& contact) { return avatar.way_from(contact.foot).norm(); };
      if (here.s != whole.s && away(here) - away(whole) <= (radius + model.thickness() / 2) / 2) {
        ++own;  // the nearest one is elsewhere, and not much deeper
        continue;
      }
      apart += !(here.touching == whole.touching && here.segment == whole.segment && here.s == whole.s &&
                 here.depth == whole.depth && here.foot == whole.foot && here.normal == whole.normal &&
                 here.past_end == whole.past_end && near.s == all.s && near.normal == all.normal);
    }
  }
  CHECK(apart == 0);
  CHECK(own > 100);
  CHECK(own < found / 10);
  CHECK(found > 10000);
  CHECK(passed > 100);  // steps that may have gone through the rod
}
