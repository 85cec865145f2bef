// Needles against rigid bodies: what a hand leads them against, and the same scene turned and moved.
#pragma once

#include <string>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include <hapbeam/world/world.hpp>

namespace hapbeam::testing {

inline const RodSupport clamped = RodSupport::clamped, free_end = RodSupport::free;

inline Rod needle(double length, double thickness, const RodPose& pose, const RodSupport& right = free_end) {
  Rod rod(length, RodSection::circle(thickness), spring_steel, clamped, right);
  rod.place_left(pose);
  return rod;
}

/// Of RodContact::force.
inline double normal_force(const RodContact& contact) { return (contact.force - contact.friction).norm(); }

/// Takes the first rod's left end there in straight steps.
template <class Element>
Status lead(World<Element>& world, RodPose from, const Point& to, int steps) {
  Status worst = Status::ok;
  const Point way = to - from.at, begin = from.at;
  for (int k = 1; k <= steps; ++k) {
    from.at = begin + double(k) / steps * way;
    Status status = world.hold(0, RodSide::left, from);
    if (status == Status::ok) status = world.tick();
    if (worse(status, worst)) worst = status;
  }
  return worst;
}

/// A rotation and then a displacement.
struct Motion {
  Point axis{0, 0, 1};
  double angle = 0;
  Point by{0, 0, 0};

  Point turn(const Point& x) const { return turned({x, x, x}, axis, angle).along; }
  Point operator()(const Point& x) const { return turn(x) + by; }
  RodPose operator()(const RodPose& pose) const {
    return {(*this)(pose.at), turn(pose.along), turn(pose.director)};
  }
};

/// A scene: a needle along x, what it is led against, and by which way.
struct Scene {
  std::string name;
  RigidBody (*body)(const Motion&);
  Point start, end;
};

/// That all of it may be turned and moved by.
inline const Motion elsewhere{detail::unit(Point(1, -2, 0.5)), 2.1, {0.3, -0.2, 0.1}};

/// That what is felt in a scene is what is felt in it moved, turned back.
inline void check_same(const Scene& scene, const std::vector<Point>& one, const std::vector<Point>& other) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    INFO(scene.name << ": " << one[k].transpose() << ", moved: " << other[k].transpose());
    CHECK((one[k] - other[k]).norm() < 1e-11 * one[k].norm());
  }
}

inline const Point start_along = detail::unit(Point(1, 0, 0.01));
inline const std::vector<Scene> scenes{
    {"plane",
     [](const Motion& m) { return RigidBody::plane(m(Point(0.1, 0, -0.004)), m.turn(Point(-0.4, 0.1, 1))); },
     {-0.1, 0, 0.002},
     {-0.095, 0.01, -0.01}},
    {"sphere",
     [](const Motion& m) { return RigidBody::sphere(m(Point(0.05, 0.001, -0.032)), 0.03); },
     {-0.1, 0, 0},
     {-0.09, 0.002, -0.005}},
    {"capsule",
     [](const Motion& m) {
       return RigidBody::capsule(m(Point(0.05, -0.03, -0.01)), m(Point(0.06, 0.04, -0.01)), 0.005);
     },
     {-0.1, 0, 0},
     {-0.09, 0.004, -0.02}},
    {"inside of a tube",
     [](const Motion& m) { return RigidBody::tube(m(Point(0, 0, 0)), m(Point(0.3, 0, 0)), 0.004); },
     {-0.1, 0, 0},
     {-0.07, 0.004, -0.006}},
    {"outside of a tube",
     [](const Motion& m) {
       return RigidBody::tube(m(Point(0.04, -0.03, -0.006)), m(Point(0.05, 0.05, -0.006)), 0.004);
     },
     {-0.1, 0, 0},
     {-0.09, 0.004, -0.02}},
};

template <class Element>
World<Element> world_of(const Scene& scene, const Motion& motion, int elements, const Friction& friction = {},
                        const NewtonRaphson& solver = {}) {
  const RodPose pose = motion(RodPose{scene.start, start_along, {0, 1, 0}});
  return World<Element>({{needle(0.2, 0.002, pose), elements, friction}}, {scene.body(motion)}, {}, solver);
}

}  // namespace hapbeam::testing
