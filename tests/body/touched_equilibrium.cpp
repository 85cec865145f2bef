// A touched element in balance moves with the beam, stays in balance where another piece is the longest, and rubs.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "body/touched.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr Nature natures[] = {Nature::straight, Nature::arc, Nature::arcs};
const std::vector<std::vector<double>> several{{0.3}, {0.8}, {0.2, 0.8}, {0.2, 0.4}, {0.6, 0.8}};

/// Largest force or moment over what an EI/l² and N make.
template <class Element, int Most>
double off(const Scene<Element, Most>& s, const Vector6<double>& r, const Vector6<double>& other) {
  const double l = s.p.length, force = s.p.bending_per_length3 * l + std::abs(s.N);
  Vector6<double> size;
  size << 1, 1, l, 1, 1, l;
  return (other - r).cwiseQuotient(size).norm() / force;
}

void check_moves_along(Kind kind, const std::vector<double>& places, double angle, Random& random) {
  for (const Nature nature : natures) {
    auto s = pressed<Corotational<>, 2>(random, kind, {nature, 0.1, 20}, places);
    s.d[0] += 1e-4 * s.p.length, s.contacts[0].force *= 1.01;  // not quite in balance
    auto turned = s;
    turned.turn(angle);
    INFO("contacts " << s.count << ", angle " << angle << ", nature " << int(nature));
    auto here = s.element(), there = turned.element();
    const auto a = s.tell(here, [](int) {}), b = turned.tell(there, [](int) {});
    Matrix6<double> turn = Matrix6<double>::Identity();
    turn.block<2, 2>(0, 0) = turn.block<2, 2>(3, 3) = Eigen::Rotation2Dd(angle).toRotationMatrix();
    // Nodes are metres from the origin, which strains by ε/l: EA times that are their forces.
    const double round_off =
        1e-15 / s.p.length * s.p.axial_stiffness / (s.p.bending_per_length3 * s.p.length);
    CHECK(std::abs(b.energy - a.energy) <= round_off * std::abs(a.energy));
    CHECK(std::abs(b.local_change - a.local_change) <= round_off * std::abs(a.energy));
    CHECK(off(s, turn * a.r, b.r) <= round_off);
    CHECK((b.K - turn * a.K * turn.transpose()).norm() <= round_off * a.K.norm());
    for (int k = 0; k < s.count; ++k) {
      const auto i = s.of(k);
      CHECK((b.column[i] - turn * a.column[i]).norm() <= round_off * a.column[i].norm());
      CHECK(std::abs(b.residual[i] - a.residual[i]) <= round_off * s.p.length);
    }
  }
}

/// Moves contact k from a place to one next to it, between which another piece becomes the longest.
template <class Element, int Most>
void check_passes_middle(const std::vector<double>& places, std::size_t k, double by, Random& random) {
  for (const Nature nature : natures)
    for (const double q : {-5., 0., 20., 400.}) {
      auto s = pressed<Element, Most>(random, Kind::along, {nature, 0.1, q}, places);
      const auto before = s.settled();
      s.contacts[k].s += by * s.p.length;
      auto after = s.element();
      const auto now = s.tell(after, [](int) {});
      INFO(Element::name() << ", contact " << k << ", at " << places[k] << ", nature " << int(nature)
                           << ", N l²/EI " << q);
      const double force = s.p.bending_per_length3 * s.p.length + std::abs(s.N);
      // As far as the force has gone with its place, and round-off of strains, EA ε.
      const double tolerance = 4 * std::abs(by) + 1e-11;
      CHECK(std::abs(now.energy - before.energy) <= tolerance * std::abs(before.energy));
      CHECK(off(s, before.r, now.r) <= tolerance);
      CHECK((now.K - before.K).norm() <= tolerance * before.K.norm());
      CHECK(std::abs(now.local_change) <= tolerance * tolerance * force * s.p.length * 1e2);
      for (int j = 0; j < s.count; ++j)
        CHECK((now.column[s.of(j)] - before.column[s.of(j)]).norm() <=
              tolerance * before.column[s.of(j)].norm());
      // All of it goes on with the piece that is the longest now.
      const auto settled = s.settled();
      CHECK(off(s, before.r, settled.r) <= tolerance);
    }
}

template <class Element>
void check_friction(const std::vector<double>& places, Random& random) {
  auto s = pressed<Element, 2>(random, Kind::round, {Nature::straight, 0.03, 20}, places);
  const double unit = s.p.bending_per_length3 * s.p.length;
  s.settled();
  const auto free = s.contacts;
  const double force = 0.5 * unit;
  s.settled([&](int k) {
    auto& contact = s.contacts[s.of(k)];
    contact.friction = force * Vector2<double>(-contact.normal.y(), contact.normal.x());
  });
  for (int k = 0; k < s.count; ++k) {
    const auto &now = s.contacts[s.of(k)], &before = free[s.of(k)];
    INFO(Element::name() << ", contact " << k << " of " << s.count);
    // The jump of N²/2EA is left.
    const double tolerance =
        force * (force + std::abs(now.force)) / s.p.axial_stiffness / std::abs(now.force);
    CHECK(std::abs(now.normal.dot(now.tangent) - before.normal.dot(before.tangent)) <= tolerance);
  }
}

/// Friction that is a spring along the surface: its stiffness is the derivative of its force.
template <class Element>
void check_friction_stiffness(const std::vector<double>& places, Random& random) {
  using S = Scene<Element, 2>;
  auto s = pressed<Element, 2>(random, Kind::round, {Nature::straight, 0.1, 20}, places);
  s.settled();
  const auto base = s.contacts;
  const double l = s.p.length, unit = s.p.bending_per_length3 * l, spring = 30 * unit / l;
  const auto rub = [&](S& scene) {
    return [&scene, &base, &s, spring](int k) {
      auto& now = scene.contacts[S::of(k)];
      const auto& was = base[S::of(k)];
      const Vector2<double> n = was.normal, t(-n.y(), n.x());
      const double stretched = 1 + was.piece.tension / s.p.axial_stiffness;
      const double slipped = t.dot(now.place - was.place) - stretched * t.dot(was.tangent) * (now.s - was.s);
      now.friction = -spring * slipped * Vector2<double>(-now.normal.y(), now.normal.x());
      now.friction_stiffness = spring;
    };
  };
  auto scene = s;
  const auto here = scene.settled(rub(scene));
  CHECK((here.K - here.K.transpose()).norm() <= 1e-15 * here.K.norm());
  for (int i = 0; i < 6; ++i) {
    const double size = i % 3 == 2 ? l : 1, h = i % 3 == 2 ? 4e-4 : 2e-5 * l;
    const auto at = [&](double by) {
      auto moved = s;
      moved.d[i] += by * h;
      return moved.settled(rub(moved));
    };
    const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
    INFO(Element::name() << ", contacts " << s.count << ", by " << i);
    for (int j = 0; j < 6; ++j)
      CHECK(std::abs((8 * (c.r[j] - b.r[j]) - (d.r[j] - a.r[j])) / (12 * h) - here.K(j, i)) <=
            1e-8 * s.p.axial_per_length * size * (j % 3 == 2 ? l : 1));
    for (int k = 0; k < s.count; ++k) {
      const auto m = S::of(k);
      CHECK(std::abs((8 * (c.residual[m] - b.residual[m]) - (d.residual[m] - a.residual[m])) / (12 * h) -
                     here.column[m][i]) <= 1e-8 * size);
    }
  }
}

}  // namespace

TEST_CASE("a touched element that is moved as a rigid body tells the same", "[body]") {
  Random random(81);
  for (const Kind kind : {Kind::round, Kind::along})
    for (const auto& places :
         std::vector<std::vector<double>>{{0.2}, {0.9}, {0.2, 0.8}, {0.2, 0.4}, {0.7, 0.9}})
      for (const double angle : {0.3, -2., 3.1, 7., -40.}) check_moves_along(kind, places, angle, random);
}

TEST_CASE("a contact that passes the middle leaves an element in balance as it is", "[body]") {
  Random random(82);
  const double by = 2e-13, half = by / 2;
  check_passes_middle<Corotational<>, 1>({0.5 - half}, 0, by, random);
  check_passes_middle<Corotational<>, 1>({0.5 + half}, 0, -by, random);
  check_passes_middle<VonKarman<>, 1>({0.5 - half}, 0, by, random);
  check_passes_middle<Corotational<>, 2>({0.4 - half, 0.8}, 0, by, random);
  check_passes_middle<Corotational<>, 2>({0.4 + half, 0.8}, 0, -by, random);
  check_passes_middle<Corotational<>, 2>({0.2, 0.6 + half}, 1, -by, random);
  check_passes_middle<VonKarman<>, 2>({0.2, 0.6 - half}, 1, by, random);
  check_passes_middle<Corotational<>, 2>({0.4 - half, 0.6}, 0, by, random);
  check_passes_middle<Corotational<>, 2>({0.4 + half, 0.6}, 0, -by, random);
  check_passes_middle<Corotational<>, 3>({0.3 - half, 0.5, 0.7}, 0, by, random);
  check_passes_middle<Corotational<>, 3>({0.3 + half, 0.5, 0.7}, 0, -by, random);
  check_passes_middle<Corotational<>, 3>({0.1, 0.4 - half, 0.7}, 1, by, random);
  check_passes_middle<VonKarman<>, 3>({0.1, 0.4 + half, 0.7}, 1, -by, random);
}

TEST_CASE("friction leaves the place where the curve is tangent", "[body]") {
  Random random(83);
  for (const auto& places : several) {
    check_friction<Corotational<>>(places, random);
    check_friction<VonKarman<>>(places, random);
  }
}

TEST_CASE("stiffness of friction is the derivative of its force", "[body]") {
  Random random(84);
  for (const auto& places : several) {
    check_friction_stiffness<Corotational<>>(places, random);
    check_friction_stiffness<VonKarman<>>(places, random);
  }
}
