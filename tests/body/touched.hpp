// Scenes of one touched element, and all that it tells at the equilibrium of what is within it.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "support/random.hpp"
#include <hapbeam/body/touched_element.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/von_karman.hpp>

namespace hapbeam::testing {

using Kind = detail::InnerContact<double>::Kind;

enum class Nature { straight, arc, arcs };

struct Shape {
  Nature nature;
  double rotations;  // of the ends against the chord [rad]
  double q;          // N l²/EI, but for what the rotations stretch
  double chord = 0;  // [rad]
};

template <class Element, int Most>
struct Told {
  using Forces = std::array<double, Most>;
  double energy = 0, potential = 0, local_change = 0;  // [J]
  Vector6<double> r;
  Matrix6<double> K;
  std::array<Vector6<double>, Most> column;
  Forces residual{};
  std::array<Forces, Most> yields{};
};

template <class Element, int Most>
struct Scene {
  using Contact = detail::InnerContact<double>;
  using Touched = detail::TouchedElement<Element, double, Most>;
  using Forces = std::array<double, Most>;
  static constexpr bool turns = any_rotation<Element>;

  ElementProperties<double> p;
  NaturalShape<double> natural{Beam(1, 1, 1, 1e-3, Support::clamped, Support::free)};
  double start = 1;
  Vector6<double> d;
  std::array<Contact, Most> contacts{};
  int count = 0;
  double N = 0;

  Scene(Random& random, const Shape& shape) {
    const double l = 0.1 * (1 + random(0.3)), EI = 3 * (1 + random(0.5)), unit = EI / (l * l),
                 EA = 1e4 * unit;
    p = ElementProperties<double>(l, EA, EI);
    if (shape.nature != Nature::straight) {
      const double k = -2 * shape.rotations * random(0.2, 0.5) / l;
      Beam beam(start + l, EA, EI, 1e-3, Support::clamped, Support::free);
      if (shape.nature == Nature::arc) beam.naturally({{start + l, k}});
      else beam.naturally({{start + 0.45 * l, 0.5 * k}, {start + 0.55 * l, 1.5 * k}, {start + l, 0.7 * k}});
      natural = NaturalShape<double>(beam);
      natural.apply(start, p);
    }
    const double a = shape.rotations * random(0.3, 1), b = -shape.rotations * random(0.3, 1);
    const double rise = turns ? 0 : shape.rotations * random(0.3) * l;
    // The mean of ½ w'² takes part of the stretch.
    const double bow = (2 * a * a - a * b + 2 * b * b) / 30 + (turns ? 0 : rise * rise / (2 * l * l));
    const double stretch = shape.q * unit / EA - bow + (p.natural_stretch + natural_bow()) / l;
    N = shape.q * unit;
    d << random(0.01) * l, random(0.01) * l, a, 0, 0, b;
    d[3] = d[0] + stretch * l, d[4] = d[1] + rise;
    if (!turns) d[2] -= rise / l, d[5] -= rise / l;
    turn(shape.chord);
  }

  /// All of it about the origin, against the clock.
  void turn(double angle) {
    const Eigen::Rotation2Dd by(angle);
    const auto go = [&](Vector2<double> moved, double s) {
      return Vector2<double>(by * (Vector2<double>(s, 0) + moved) - Vector2<double>(s, 0));
    };
    if (angle == 0) return;
    d.segment<2>(0) = go(d.segment<2>(0), start), d.segment<2>(3) = go(d.segment<2>(3), start + p.length);
    d[2] -= angle, d[5] -= angle;
    for (int k = 0; k < count; ++k) {
      Contact& contact = contacts[of(k)];
      contact.centre = by * contact.centre;
      if (contact.kind == Contact::Kind::round) continue;
      const Vector2<double> before = contact.normal, at(contact.s, 0);
      contact.normal = by * before;
      contact.reach += before.dot(at) - contact.normal.dot(at);
    }
  }
  void hold(double at, const Vector2<double>& normal, double force = 0) {
    Contact& contact = contacts[of(count++)];
    contact.kind = Contact::Kind::along, contact.moves = false;
    contact.s = start + at, contact.normal = normal, contact.force = force;
  }
  /// A circle that touches at that place of the element without it.
  void touch(double at, double side, double reach, double force) {
    Scene bare = *this;
    bare.count = 0;
    for (int k = 0; k < Most; ++k) bare.contacts[of(k)] = Contact();
    bare.hold(at, {0, 1});
    bare.settled();
    const Contact& held = bare.contacts[0];
    Contact& contact = contacts[of(count++)];
    contact.s = start + at, contact.side = side, contact.reach = reach, contact.force = force;
    // The beam passes the centre on its left where side is -1.
    contact.centre = held.place + side * reach * Vector2<double>(-held.tangent.y(), held.tangent.x());
  }

  /// To its forces from none, at which places stay.
  void ramp() {
    const std::array<Contact, Most> goal = contacts;
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k < count; ++k)
        contacts[of(k)].force = goal[of(k)].force * i / 8, contacts[of(k)].moves = goal[of(k)].moves && i > 0;
      settled();
    }
  }

  Touched element() {
    Touched touched(p, start, d, N, 1, &natural);
    for (int k = 0; k < count; ++k) touched.add(contacts[of(k)], k);
    return touched;
  }
  template <class Rub>
  Told<Element, Most> tell(Touched& touched, Rub&& rub) {
    Told<Element, Most> t;
    t.energy = touched.condense(t.r, t.K, rub);
    t.local_change = touched.local_change();
    t.potential = t.energy;
    for (int k = 0; k < count; ++k) {
      t.potential -= contacts[of(k)].force * contacts[of(k)].gap;
      t.column[of(k)] = touched.column(k), t.residual[of(k)] = touched.residual(k);
      for (int j = 0; j < count; ++j) t.yields[of(k)][of(j)] = touched.yields(k, j);
    }
    return t;
  }
  /// An iteration of what is within it, or of nodes and forces too.
  template <class Rub>
  Told<Element, Most> step(Rub&& rub, const Vector6<double>& by = Vector6<double>::Zero(),
                           const Forces& forces = {}) {
    Touched touched = element();
    const auto t = tell(touched, rub);
    double longer = 0;
    N = touched.advance(by, forces, longer);
    d += by;
    return t;
  }
  Told<Element, Most> step() {
    return step([](int) {});
  }
  template <class Rub>
  Told<Element, Most> settled(Rub&& rub) {
    for (int i = 0; i < iterations; ++i) step(rub);
    Touched touched = element();
    return tell(touched, rub);
  }
  Told<Element, Most> settled() {
    return settled([](int) {});
  }

  static constexpr std::size_t of(int k) { return static_cast<std::size_t>(k); }
  static constexpr int iterations = 25;

 private:
  double natural_bow() const {
    const double a = p.natural_a / p.length, b = p.natural_b / p.length;
    return (2 * a * a - a * b + 2 * b * b) / 30 * p.length;
  }
};

/// Contacts that press or pull.   @param places  of the length
template <class Element, int Most>
Scene<Element, Most> pressed(Random& random, Kind kind, const Shape& shape,
                             const std::vector<double>& places) {
  Scene<Element, Most> s(random, shape);
  const double unit = s.p.bending_per_length3 * s.p.length, l = s.p.length;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double force = unit * random(0.3, 0.8) * (random(1) < 0 ? -1 : 1), at = places[k] * l;
    if (kind == Kind::round) s.touch(at, random(1) < 0 ? -1 : 1, l * random(0.1, 0.3), force);
    else s.hold(at, Eigen::Rotation2Dd(random(1)) * Vector2<double>(0, 1), force);
  }
  s.ramp();
  return s;
}

/// The element of a scene without contacts, under its own tension.
template <class Element>
struct Whole {
  double energy;
  Vector6<double> r, size;
  Matrix6<double> K;

  template <class S>
  explicit Whole(const S& s) {
    OwnTension<double> own;
    own.normal = s.N;
    for (int i = 0; i < 40; ++i) (void)Element::core(s.p, s.d, own), own.normal += own.missing;
    energy = Element::tangent(s.p, Element::core(s.p, s.d, own), r, K);
    const double l = s.p.length;
    size << 1, 1, l, 1, 1, l;
    unit = s.p.bending_per_length3 * l, length = l;
  }
  /// Largest entry over that of the whole.
  double off(const Vector6<double>& other) const {
    return (other - r).cwiseQuotient(size).norm() / r.cwiseQuotient(size).norm();
  }
  double off(const Matrix6<double>& other) const {
    const auto scaled = [this](const Matrix6<double>& M) {
      return Matrix6<double>(size.cwiseInverse().asDiagonal() * M * size.cwiseInverse().asDiagonal());
    };
    return scaled(other - K).norm() / scaled(K).norm();
  }
  double unit, length;
};

}  // namespace hapbeam::testing
