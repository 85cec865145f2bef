// What contacts within an element of a rod add to its equations are derivatives of one energy, at the equilibrium of all that is condensed.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/body/touched_rod.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/rod/rod_elements.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr int most = 2;
using Kind = detail::InnerKind;
using Vector = VectorOf<double, 3>;
using Unknowns = VectorOf<double, 12>;
using Forces = std::array<double, most>;
using Touched = detail::TouchedRod<RoundRod, double, most>;

struct Told {
  double potential = 0;  // [J]
  Unknowns r;
  Eigen::Matrix<double, 12, 12> K;
  std::array<Unknowns, most> column;
  Forces residual{};
  std::array<Forces, most> yields{};
};

/// One element of a rod whose stretch costs about what its bend does, and what touches it.
class Scene {
 public:
  Scene(Random& random, RodSupport right, double drawn) {
    const Rod rod(0.3, RodStiffness{4e3, 0.16, 0.16, 0.12}, 0.002, RodSupport::clamped, right);
    const RodElements<RoundRod, double, Eigen::Dynamic, Eigen::Dynamic> parts(rod, 3);
    p_ = parts.properties(1);
    for (int i = 0; i < 2; ++i) {
      auto& node = nodes_[at(i)] = parts.nodes()[1 + i];
      node.r += Vector(i * drawn * p_.length, random(0.005), random(0.005));
      node.tangent = (1 + drawn) * detail::unit(Vector(1, random(0.2), random(0.2)));
    }
  }
  double length() const { return p_.length; }
  /// [N]
  double unit() const { return 0.16 / (p_.length * p_.length); }
  bool taut() const { return p_.taut; }

  void touch(Kind kind, double place, const Vector& normal, double force) {
    auto& contact = contacts_[at(count_++)];
    contact.kind = kind, contact.moves = kind == Kind::round;
    contact.s = nodes_[0].s + place * p_.length, contact.most = 1;
    contact.normal = normal, contact.side = -normal, contact.force = force;
    contact.reach = kind == Kind::round ? 0.03 : 0.;
    const Vector there = Centreline<double, 3>(nodes_.data(), 2).at(0, contact.s).r;
    contact.axis = {there - 0.03 * normal - Vector(0, 0, 0.2), Vector(0, 0, 0.4)};
  }
  void move(int unknown, double by) {
    auto& node = nodes_[at(unknown / 6)];
    (unknown % 6 < 3 ? node.r[unknown % 3] : node.tangent[unknown % 3]) += by;
  }
  void push(int contact, double by) { contacts_[at(contact)].force += by; }
  int count() const { return count_; }
  double place(int k) const { return (contacts_[at(k)].s - nodes_[0].s) / p_.length; }
  double tension() const { return inner_.tension.value; }

  /// To its forces from none, at which places stay.
  void ramp() {
    const auto goal = contacts_;
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k < count_; ++k)
        contacts_[at(k)].force = goal[at(k)].force * i / 8,
        contacts_[at(k)].moves = goal[at(k)].moves && i > 0;
      (void)settled();
    }
  }
  Told settled() {
    for (int i = 0; i < 40; ++i) (void)step();
    return step();
  }

  // As of RodElements, of one.
  const auto* nodes() const { return nodes_.data(); }
  const auto& properties(int) const { return p_; }
  const auto& inner(int) const { return inner_; }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// An iteration of what is condensed.
  Told step() {
    Told told;
    told.potential = RoundRod::tangent(p_, nodes_[0], nodes_[1], inner_, told.r, told.K);
    Touched touched(*this, 0);
    for (int k = 0; k < count_; ++k) touched.add(contacts_[at(k)], k);
    Unknowns r;
    decltype(Told::K) K;
    told.potential += touched.condense(r, K, [](int) {});
    told.r += r, told.K += K;
    for (int k = 0; k < count_; ++k) {
      told.potential -= contacts_[at(k)].force * contacts_[at(k)].gap;
      told.column[at(k)] = touched.column(k), told.residual[at(k)] = touched.residual(k);
      for (int j = 0; j < count_; ++j) told.yields[at(k)][at(j)] = touched.yields(k, j);
    }
    double longer = 0;
    inner_.tension.value = touched.advance(Unknowns::Zero(), {}, longer);
    return told;
  }

  RodProperties<double> p_;
  std::array<RodNode<double>, 2> nodes_;
  RoundRod::Inner<double> inner_;
  std::array<detail::InnerContact<double, 3>, most> contacts_{};
  int count_ = 0;
};

/// By central differences.  The tangent of what is held at a place leaves out how its compliance turns.
template <class Change>
void check_derivative(const Scene& scene, Kind kind, Change&& change, double h,
                      const std::vector<double>& expected, const std::vector<double>& size) {
  const auto all = [&](double by) {
    Scene moved = scene;
    change(moved, by);
    const Told told = moved.settled();
    std::vector<double> y{told.potential};
    y.insert(y.end(), told.r.data(), told.r.data() + 12);
    y.insert(y.end(), told.residual.begin(), told.residual.begin() + scene.count());
    return y;
  };
  const auto up = all(h), down = all(-h);
  for (std::size_t i = 0; i < (kind == Kind::round ? up.size() : 1); ++i) {
    CAPTURE(i);
    CHECK((up[i] - down[i]) / (2 * h) == Approx(expected[i]).epsilon(0).margin(2e-7 * size[i]));
  }
}

void check(Scene scene, Kind kind) {
  const Told told = scene.settled();
  const double l = scene.length(), f = scene.unit();
  CAPTURE(scene.taut(), scene.count(), scene.tension() / f, scene.place(0));
  const auto length_of = [l](int unknown) { return unknown % 6 < 3 ? l : 1.; };
  for (int j = 0; j < 12; ++j) {
    CAPTURE(j);
    std::vector<double> expected{told.r[j]}, size{f * l / length_of(j)};
    for (int i = 0; i < 12; ++i)
      expected.push_back(told.K(i, j)), size.push_back(f * l / length_of(i) / length_of(j));
    for (int k = 0; k < scene.count(); ++k)
      expected.push_back(told.column[std::size_t(k)][j]), size.push_back(l / length_of(j));
    check_derivative(
        scene, kind, [j](Scene& moved, double by) { moved.move(j, by); }, 1e-5 * length_of(j), expected,
        size);
  }
  for (int j = 0; j < scene.count(); ++j) {
    CAPTURE(j);
    std::vector<double> expected{told.residual[std::size_t(j)]}, size{l};
    for (int i = 0; i < 12; ++i)
      expected.push_back(told.column[std::size_t(j)][i]), size.push_back(l / length_of(i));
    for (int k = 0; k < scene.count(); ++k)
      expected.push_back(told.yields[std::size_t(k)][std::size_t(j)]), size.push_back(l / f);
    check_derivative(
        scene, kind, [j](Scene& moved, double by) { moved.push(j, by); }, 1e-4 * f, expected, size);
  }
}

}  // namespace

TEST_CASE("what contacts add to an element of a rod are derivatives of one energy", "[body][rod]") {
  Random random(95);
  const std::vector<std::vector<double>> places{{0.3}, {0.8}, {0.2, 0.7}, {0.45, 0.6}};
  for (const auto right : {RodSupport::clamped, RodSupport::free})
    for (const auto& at : places)
      for (const Kind kind : {Kind::round, Kind::along}) {
        if (kind == Kind::along && at.size() > 1) continue;
        Scene scene(random, right, right == RodSupport::free ? 0. : 0.05);
        REQUIRE(scene.taut() == (right == RodSupport::clamped));
        for (const double place : at)
          scene.touch(kind, place, {0, random(1) < 0 ? -1. : 1., 0}, scene.unit() * random(0.2, 0.6));
        scene.ramp();
        check(scene, kind);
      }
}
