// What is within a touched element, by the iteration: it follows nodes and forces, and tells what it will be.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "body/touched.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr Nature natures[] = {Nature::straight, Nature::arc, Nature::arcs};
const std::vector<std::vector<double>> several{{0.3}, {0.8}, {0.2, 0.8}, {0.2, 0.4}, {0.6, 0.8}};

/// An increment leaves what is within it off by its square, which is the fourth power of it in energy.
template <class Element>
void check_follows(Kind kind, const std::vector<double>& places, Random& random) {
  for (const Nature nature : natures) {
    if (nature == Nature::arcs && kind == Kind::round && places.size() > 1) continue;
    auto s = pressed<Element, 2>(random, kind, {nature, 0.1, 20}, places);
    const double l = s.p.length, unit = s.p.bending_per_length3 * l;
    s.settled();
    Vector6<double> by;
    by << random(1e-3) * l, random(1e-2) * l, random(0.05), random(1e-3) * l, random(1e-2) * l, random(0.05);
    std::array<double, 2> forces{random(0.1) * unit, places.size() > 1 ? random(0.1) * unit : 0};
    std::array<double, 3> left{};
    for (std::size_t i = 0; i < left.size(); ++i) {
      const double h = 0.1 * std::pow(0.5, i);
      auto moved = s;
      moved.step([](int) {}, h * by, {h * forces[0], h * forces[1]});
      auto element = moved.element();
      left[i] = std::abs(moved.tell(element, [](int) {}).local_change);
    }
    INFO(Element::name() << (kind == Kind::round ? ", round" : ", along") << ", contacts " << s.count
                         << ", nature " << int(nature));
    for (std::size_t i = 0; i + 1 < left.size(); ++i) CHECK(left[i] / left[i + 1] == Approx(16).epsilon(0.1));
  }
}

/// Forces, gaps and the energy that it will have, of what is not yet in balance, are off by the square of that and more.
template <class Element>
void check_foresees(Kind kind, const std::vector<double>& places, Random& random) {
  auto s = pressed<Element, 2>(random, kind, {Nature::arc, 0.1, 20}, places);
  const double l = s.p.length;
  Vector6<double> by;
  by << random(1e-3) * l, random(1e-2) * l, random(0.05), random(1e-3) * l, random(1e-2) * l, random(0.05);
  std::array<std::array<double, 3>, 2> errors{};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    auto moved = s;
    moved.d += 0.02 * std::pow(0.5, i) * by;
    auto element = moved.element();
    const auto now = moved.tell(element, [](int) {}), goal = moved.settled();
    errors[i] = {(now.r - goal.r).norm(), std::abs(now.residual[0] - goal.residual[0]),
                 std::abs(now.potential + now.local_change - goal.potential)};
  }
  INFO(Element::name() << (kind == Kind::round ? ", round" : ", along") << ", contacts " << s.count);
  for (std::size_t j = 0; j < 3; ++j)
    CHECK(errors[0][j] / errors[1][j] == Approx(j < 2 ? 4 : 8).epsilon(0.2));
}

/// A contact that comes has no force, which says nothing of its place, and then a little.
template <class Element>
void check_comes(const std::vector<double>& places, double q, Random& random) {
  Scene<Element, 2> s(random, {Nature::arc, 0.1, q});
  const double l = s.p.length, unit = s.p.bending_per_length3 * l;
  for (const double at : places) s.touch(at * l, random(1) < 0 ? -1 : 1, 0.2 * l, 0);
  for (const double force : {0., 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (int k = 0; k < s.count; ++k) s.contacts[s.of(k)].force = force * unit;
    for (int i = 0; i < 8; ++i) {
      s.step();
      for (int k = 0; k < s.count; ++k) {
        INFO(Element::name() << ", contact " << k << " of " << s.count << ", N l²/EI " << q << ", force "
                             << force << ", iteration " << i);
        // As far as the cubic, where it begins, is turned against the curve, or pieces push.
        CHECK(std::abs((s.contacts[s.of(k)].s - s.start) / l - places[s.of(k)]) <= 0.05);
      }
    }
  }
}

/// A force that becomes ten thousand times itself in one increment, at a place that is not yet quite the foot.
template <class Element>
void check_grows(const std::vector<double>& places, Random& random) {
  Scene<Element, 2> s(random, {Nature::arc, 0.1, 20});
  const double l = s.p.length, unit = s.p.bending_per_length3 * l;
  for (const double at : places) s.touch(at * l, random(1) < 0 ? -1 : 1, 0.2 * l, 1e-4 * unit);
  for (int i = 0; i < 8; ++i) s.step();
  for (int k = 0; k < s.count; ++k) s.contacts[s.of(k)].s += 1e-3 * l;
  s.step([](int) {}, Vector6<double>::Zero(), {unit, places.size() > 1 ? unit : 0});
  for (int k = 0; k < s.count; ++k) {
    INFO(Element::name() << ", contact " << k << " of " << s.count);
    CHECK(std::abs((s.contacts[s.of(k)].s - s.start) / l - places[s.of(k)]) <= 0.1);
  }
}

}  // namespace

TEST_CASE("what is within a touched element follows nodes and forces to second order", "[body]") {
  Random random(85);
  for (const auto& places :
       std::vector<std::vector<double>>{{0.3}, {0.8}, {0.2, 0.8}, {0.2, 0.4}, {0.6, 0.8}})
    for (const Kind kind : {Kind::round, Kind::along}) {
      check_follows<Corotational<>>(kind, places, random);
      check_follows<VonKarman<>>(kind, places, random);
    }
}

TEST_CASE("a touched element that is not in balance tells what it will be", "[body]") {
  Random random(86);
  for (const auto& places :
       std::vector<std::vector<double>>{{0.3}, {0.8}, {0.2, 0.8}, {0.2, 0.4}, {0.6, 0.8}})
    for (const Kind kind : {Kind::round, Kind::along}) {
      check_foresees<Corotational<>>(kind, places, random);
      check_foresees<VonKarman<>>(kind, places, random);
    }
}

TEST_CASE("a contact with little force, or none, stays where its circle touches", "[body]") {
  Random random(87);
  for (const auto& places : several)
    for (const double q : {-5., 0., 20., 200.}) {
      check_comes<Corotational<>>(places, q, random);
      check_comes<VonKarman<>>(places, q, random);
    }
}

TEST_CASE("a place stays where a force grows to a multiple of itself", "[body]") {
  Random random(88);
  for (const auto& places : several) {
    check_grows<Corotational<>>(places, random);
    check_grows<VonKarman<>>(places, random);
  }
}
