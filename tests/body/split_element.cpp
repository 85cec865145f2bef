// An element that is split at its contacts: what it tells the beam are the derivatives of one function, wherever the contacts lie.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/body/split_element.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/element/von_karman.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Assumed = VonKarman<AssumedStrain>;

namespace {

constexpr double beam_length = 2, start = 0.9, l = 0.1, height = 0.004, young = 2e11;
// Beside a node of the mesh a contact acts on it.
constexpr double shortest = 2.46078e-3;  // sixth root of eps

Section section(double h) { return Section::rectangle(0.02, h); }
Beam make_beam(double curvature, bool tapers) {
  Beam beam(beam_length, section(height), Material{young}, Support::clamped, Support::free);
  if (curvature != 0) beam.naturally({{beam_length, curvature}});
  if (tapers) beam.section([](double s) { return section(height * (1.2 - 0.4 * s / beam_length)); });
  return beam;
}
const double EI = make_beam(0, false).bending_stiffness(), EA = make_beam(0, false).axial_stiffness();
const double force_unit = EI / (l * l);

template <int Most>
struct Told {
  double energy, potential;
  Vector6<double> r;
  Matrix6<double> K;
  std::array<Vector6<double>, Most> column;
  std::array<double, Most> residual;
  std::array<std::array<double, Most>, Most> yields;
};

template <class Element, int Most>
struct Scene {
  using Contact = detail::InnerContact<double>;
  using Split = detail::SplitElement<Element, double, Most>;
  using Pieces = detail::BeamPieces<Element, double>;
  static constexpr bool turns = any_rotation<Element>;
  static constexpr std::size_t of(int k) { return static_cast<std::size_t>(k); }

  Pieces pieces;
  Vector6<double> d;
  std::array<Contact, Most> contacts{};
  int count = 0;

  /// @param q  N l²/EI, about
  Scene(Random& random, double curvature, double q) : pieces(make_beam(curvature, detail::tapers<Element>)) {
    const double a = random(0.03, 0.1), b = -random(0.03, 0.1), bow = (2 * a * a - a * b + 2 * b * b) / 30;
    const bool bows = !std::is_same_v<Element, Linear>;
    d << random(1e-3), random(1e-3), a, 0, 0, b;
    d[3] = d[0] + l * (q * force_unit / EA - (bows ? bow : 0)), d[4] = d[1];
  }
  void turn(double angle) {
    const Eigen::Rotation2Dd by(angle);
    const auto go = [&](const Vector2<double>& moved, double s) {
      return Vector2<double>(by * (Vector2<double>(s, 0) + moved) - Vector2<double>(s, 0));
    };
    d.segment<2>(0) = go(d.segment<2>(0), start), d.segment<2>(3) = go(d.segment<2>(3), start + l);
    d[2] -= angle, d[5] -= angle;
    for (int k = 0; k < count; ++k) {
      Contact& contact = contacts[of(k)];
      contact.centre = by * contact.centre;
      contact.moved = go(contact.moved, contact.was), contact.theta -= angle;
      if (contact.kind == Contact::Kind::round) continue;
      const Vector2<double> before = contact.normal, at(contact.s, 0);
      contact.normal = by * before;
      contact.reach += before.dot(at) - contact.normal.dot(at);
    }
  }
  void hold(double at, const Vector2<double>& normal, double force) {
    Contact& contact = contacts[of(count++)];
    contact.kind = Contact::Kind::along, contact.moves = false;
    contact.s = start + at * l, contact.normal = normal, contact.force = force;
  }
  /// A circle that touches there.
  void touch(double at, double side, double reach, double force, bool moves) {
    Scene bare = *this;
    bare.count = 0;
    bare.hold(at, {0, 1}, 0);
    bare.element().look();
    const Contact held = bare.contacts[0];
    Contact& contact = contacts[of(count++)];
    contact.s = start + at * l, contact.side = side, contact.reach = reach, contact.force = force;
    contact.moves = moves;
    const Vector2<double> along = held.tangent.normalized();
    contact.centre = held.place + side * reach * Vector2<double>(-along.y(), along.x());
  }
  Split element() {
    const CentrelineNode<double> a{start, d[0], d[1], d[2]}, b{start + l, d[3], d[4], d[5]};
    Split split(pieces, a, b, 0);
    for (int k = 0; k < count; ++k) split.add(contacts[of(k)], k);
    return split;
  }
  Told<Most> tell(Split& split) {
    Told<Most> t;
    t.energy = split.condense(t.r, t.K, [](int) {});
    t.potential = t.energy + split.local_change();
    for (int k = 0; k < count; ++k) {
      t.potential -= contacts[of(k)].force * contacts[of(k)].gap;
      t.column[of(k)] = split.column(k), t.residual[of(k)] = split.residual(k);
      for (int j = 0; j < count; ++j) t.yields[of(k)][of(j)] = split.yields(k, j);
    }
    return t;
  }
  Told<Most> tell() {
    Split split = element();
    return tell(split);
  }
  void step() {
    Split split = element();
    (void)tell(split);
    double longer = 0;
    (void)split.advance(Vector6<double>::Zero(), {}, longer);
  }
  void settle(int steps = 25) {
    for (int i = 0; i < steps; ++i) step();
  }
};

template <class Element, int Most>
Scene<Element, Most> pressed(Random& random, double curvature, double q, const std::vector<double>& places,
                             bool round, bool moves) {
  Scene<Element, Most> s(random, curvature, q);
  for (const double at : places) {
    const double force = force_unit * random(0.1, 0.4) * (random(1) < 0 ? -1 : 1);
    if (round) s.touch(at, random(1) < 0 ? -1 : 1, l * random(0.2, 0.4), force, moves);
    else s.hold(at, Eigen::Rotation2Dd(random(1)) * Vector2<double>(0, 1), force);
  }
  s.settle();
  return s;
}

/// A scene in balance, and what a single look at moved ones tells: all of it holds to first order.
template <class Element, int Most>
void check_derivatives(const Scene<Element, Most>& s) {
  const auto of = Scene<Element, Most>::of;
  double arm = 0, piece = 1;
  for (int k = 0; k < s.count; ++k) {
    const double f = (s.contacts[of(k)].s - start) / l, beside = std::min(std::abs(f), std::abs(1 - f));
    if (beside < 1.5 * shortest) arm = std::max(arm, beside);
    else piece = std::min(piece, beside);
  }
  const auto here = Scene<Element, Most>(s).tell();
  INFO(Element::name() << ", contacts " << s.count << ", at " << (s.contacts[0].s - start) / l
                       << (s.contacts[0].kind == detail::InnerContact<double>::Kind::round ? ", round" : ""));
  // A piece loses (l/a)³ eps of what stands beside it.
  CHECK((here.K - here.K.transpose()).norm() <= (1e-14 + 2.2e-16 / (piece * piece * piece)) * here.K.norm());
  // The curvature of an arm, 6/l² by w and 4/l by θ at most, is not in the derivatives: ½ arm² of it is in places, and arm of it in the tangent
  // at a place that moves, which turns λ R, 0.16 at most, twice, over 1 - κ R.
  const double exact = 1e-8, curved = 6 * arm * arm, turned = curved + (s.contacts[0].moves ? 3 * arm : 0);
  const auto differences = [&](double h, auto&& move, auto&& check) {
    const auto at = [&](double by) {
      auto moved = s;
      move(moved, by * h);
      return moved.tell();
    };
    const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
    check([&](auto&& tell) {
      using T = std::decay_t<decltype(tell(a))>;
      return T((8 * (tell(c) - tell(b)) - (tell(d) - tell(a))) / (12 * h));
    });
  };
  for (int i = 0; i < 6; ++i) {
    const double size = i % 3 == 2 ? l : 1;
    differences(
        i % 3 == 2 ? 4e-4 : 2e-5 * l * std::min(1.0, 10 * piece),
        [i](auto& moved, double by) { moved.d[i] += by; },
        [&](auto&& difference) {
          INFO("by " << i);
          CHECK(std::abs(difference([](const auto& t) { return t.potential; }) - here.r[i]) <=
                (exact + curved) * force_unit * size);
          for (int j = 0; j < 6; ++j)
            CHECK(std::abs(difference([j](const auto& t) { return t.r[j]; }) - here.K(j, i)) <=
                  (exact * EA + turned * force_unit) / l * size * (j % 3 == 2 ? l : 1));
          for (int k = 0; k < s.count; ++k)
            CHECK(std::abs(difference([&](const auto& t) { return t.residual[of(k)]; }) -
                           here.column[of(k)][i]) <= (exact + curved) * size);
        });
  }
  for (int k = 0; k < s.count; ++k)
    differences(
        1e-3 * force_unit, [&](auto& moved, double by) { moved.contacts[of(k)].force += by; },
        [&](auto&& difference) {
          INFO("by force " << k);
          CHECK(std::abs(difference([](const auto& t) { return t.potential; }) - here.residual[of(k)]) <=
                exact * l);
          for (int j = 0; j < 6; ++j)
            CHECK(std::abs(difference([j](const auto& t) { return t.r[j]; }) - here.column[of(k)][j]) <=
                  exact * (j % 3 == 2 ? l : 1));
          for (int j = 0; j < s.count; ++j)
            CHECK(std::abs(difference([&](const auto& t) { return t.residual[of(j)]; }) -
                           here.yields[of(j)][of(k)]) <= exact * l / force_unit);
        });
}

template <class Element>
void check_derivatives(unsigned seed) {
  Random random(seed);
  const std::vector<std::vector<double>> all{{0.3},        {0.8},  {0.03},        {1e-4},   {0},
                                             {1},          {0.99}, {-5e-4},       {1.0005}, {0.2, 0.3},
                                             {0.15, 0.85}, {0, 1}, {0.01, 0.985}, {0, 0.5}, {0.4, 0.405}};
  for (const double curvature : {0., 1.5})
    for (const double q : {-3., 0., 10.})
      for (const auto& places : all) {
        check_derivatives(pressed<Element, 2>(random, curvature, q, places, false, false));
        check_derivatives(pressed<Element, 2>(random, curvature, q, places, true, false));
        if (places.size() == 1)
          check_derivatives(pressed<Element, 2>(random, curvature, q, places, true, true));
      }
}

double off(const Vector6<double>& a, const Vector6<double>& b) {
  Vector6<double> size;
  size << 1, 1, l, 1, 1, l;
  return (a - b).cwiseQuotient(size).norm() / force_unit;
}

template <class Element>
void check_at_node(Random& random) {
  for (const double place : {0., 1.})
    for (const double q : {-3., 10.}) {
      Scene<Element, 2> s(random, 1.5, q);
      const Vector2<double> normal(0.6, 0.8);
      Vector6<double> r;
      Matrix6<double> K;
      const double energy = Element::tangent(s.pieces.between(start, start + l), s.d, r, K);
      for (int k = 0; k < 2; ++k) {
        s.hold(place, normal, force_unit);
        r.template segment<2>(place == 0 ? 0 : 3) -= force_unit * normal;
        const auto now = s.tell();
        INFO(Element::name() << ", contacts " << k + 1 << ", at " << place);
        CHECK(now.energy == energy);
        CHECK(off(now.r, r) <= 1e-14);
        CHECK(now.K == K);
      }
    }
}

}  // namespace

TEST_CASE("forces, tangent and columns of a split element are derivatives of its potential", "[body]") {
  check_derivatives<Corotational<Assumed>>(91);
  check_derivatives<Corotational<Linear>>(92);
  check_derivatives<Corotational<Tapered<>>>(93);
  check_derivatives<Assumed>(94);
  check_derivatives<Linear>(95);
}

TEST_CASE("contacts at a node are loads of it", "[body]") {
  Random random(96);
  check_at_node<Corotational<Assumed>>(random);
  check_at_node<Tapered<>>(random);
  check_at_node<Linear>(random);
}

TEST_CASE("a split element of cubics is the whole one", "[body]") {
  Random random(97);
  for (const auto& places : std::vector<std::vector<double>>{{0.3}, {0.021}, {0.2, 0.9}, {0.5, 0.5}}) {
    Scene<Linear, 2> s(random, 0, 5);
    Vector6<double> r;
    Matrix6<double> K;
    const double energy = Linear::tangent(s.pieces.between(start, start + l), s.d, r, K);
    for (const double at : places) s.hold(at, {0.6, 0.8}, 0);
    s.settle(3);
    const auto now = s.tell();
    // The round-off of nodes that are so near, over l: its cube.
    const double round_off = 1e-15 / (shortest * shortest * shortest);
    INFO("at " << places[0]);
    CHECK(std::abs(now.energy - energy) <= round_off * energy);
    CHECK(off(now.r, r) <= round_off * off(r, Vector6<double>::Zero()));
    CHECK((now.K - K).norm() <= round_off * K.norm());
  }
}

TEST_CASE("a split element that is moved as a rigid body tells the same", "[body]") {
  Random random(98);
  for (const bool round : {true, false})
    for (const auto& places : std::vector<std::vector<double>>{{0.3}, {0.01}, {0.2, 0.9}, {1e-4, 0.6}})
      for (const double angle : {0.3, -2., 3.1, 7., -40.}) {
        auto s = pressed<Corotational<Assumed>, 2>(random, 1.5, 5, places, round, round);
        auto turned = s;
        turned.turn(angle);
        const auto a = s.tell(), b = turned.tell();
        Matrix6<double> turn = Matrix6<double>::Identity();
        turn.block<2, 2>(0, 0) = turn.block<2, 2>(3, 3) = Eigen::Rotation2Dd(angle).toRotationMatrix();
        // Nodes are metres from the origin.  Of a piece they strain ε/(shortest l), and bend as much again.
        const double round_off = 1e-15 / l * EA / force_unit / shortest;
        INFO("contacts " << s.count << ", at " << places[0] << ", angle " << angle);
        CHECK(std::abs(b.potential - a.potential) <= round_off * force_unit * l);
        CHECK(off(turn * a.r, b.r) <= round_off);
        CHECK((b.K - turn * a.K * turn.transpose()).norm() <= round_off * a.K.norm());
        for (int k = 0; k < s.count; ++k) {
          const auto i = s.of(k);
          CHECK((b.column[i] - turn * a.column[i]).norm() <= round_off * a.column[i].norm());
          CHECK(std::abs(b.residual[i] - a.residual[i]) <= round_off * l);
        }
      }
}

TEST_CASE("an arc that lies as it is by nature takes no force, wherever it is touched", "[body]") {
  Random random(99);
  for (const double curvature : {0.5, 2., -4.})
    for (const double at : {0.5, 0.1, 0.021, 0.01}) {
      Scene<Corotational<Assumed>, 1> s(random, curvature, 0);
      const double half = curvature * l / 2, chord = l * (half == 0 ? 1 : std::sin(half) / half);
      s.d << 0, 0, -half, chord - l, 0, half;
      if (off(s.tell().r, Vector6<double>::Zero()) > 1e-9) s.d[2] *= -1, s.d[5] *= -1;
      s.hold(at, {0, 1}, 0);
      s.settle();
      const auto now = s.tell();
      INFO("curvature " << curvature << ", at " << at);
      // Round-off of strains: EA ε/l over EI/l³.
      CHECK(off(now.r, Vector6<double>::Zero()) <= 1e-15 * EA * l * l / EI / shortest);
      // A circle of no force lies beside the arc at a distance that is that of its piece of the chord.
      CHECK(std::abs(now.energy) <= 1e-12 * EI * curvature * curvature * l);
    }
}

TEST_CASE("the place of a circle goes to the foot of its centre", "[body]") {
  Random random(100);
  for (const double at : {0.3, 0.7, 0.03, 0.01, 1e-4})
    for (const double force : {0., 1e-6, 0.3}) {
      Scene<Corotational<Assumed>, 1> s(random, 1.5, 5);
      s.touch(at, 1, 0.1 * l, force * force_unit, true);
      s.contacts[0].centre += 0.03 * l * s.contacts[0].tangent;
      s.settle(6);
      (void)s.tell();
      INFO("at " << at << ", force " << force);
      CHECK(std::abs(s.contacts[0].normal.dot(s.contacts[0].tangent)) <= 1e-9);
    }
}

TEST_CASE("a contact that comes to act on a node changes nothing", "[body]") {
  Random random(101);
  for (const bool right : {false, true}) {
    const auto place = [right](double part) { return right ? 1 - part * shortest : part * shortest; };
    Scene<Linear, 1> s(random, 0, 0);
    s.hold(place(1.01), {0, 1}, 0.4 * force_unit);
    s.settle();
    const auto before = s.tell();
    const double slope = s.contacts[0].tangent.y();
    s.contacts[0].s = start + place(0.99) * l;
    const auto after = s.tell();
    const double moved = (place(0.99) - place(1.01)) * l;
    INFO("right " << right);
    // What the force bends of the piece, and what the curvature changes along it: the cube of its length.
    CHECK(std::abs(before.residual[0] - after.residual[0] - moved * slope) <=
          shortest * shortest * shortest * l);
    // The force goes by 0.02 of the shortest.  Of one at f between clamped ends 3f² goes to the other one, with the moment 2f² l of this and f² l of that.
    CHECK(off(after.r, before.r) <= 0.4 * (0.02 * shortest + 4.8 * shortest * shortest));
  }
}
