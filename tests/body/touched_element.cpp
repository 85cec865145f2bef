// An element that is touched within it: what it tells the beam are the derivatives of one function.
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "body/touched.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr Nature natures[] = {Nature::straight, Nature::arc, Nature::arcs};

// Places that are held without a force leave an element what it is.  Of finite rotation that holds to the second order of the rotations within it, and
// beside a node as far as the short piece is turned.
template <class Element>
void check_untouched(double rotations, double turned) {
  Random random(71);
  const std::vector<std::vector<double>> all{{1e-7}, {1 - 1e-7},       {0.3},      {0.49999},  {0.50001},
                                             {0.9},  {1e-7, 1 - 1e-7}, {0.2, 0.3}, {0.1, 0.8}, {0.8, 0.7}};
  // An element bends against one arc, or the linear function nearest to several, which their pieces do not.
  for (const Nature nature : {Nature::straight, Nature::arc})
    for (const double q : {-6., 0., 30., 400.})
      for (const auto& places : all) {
        Scene<Element, 2> s(random, {nature, rotations, q});
        for (const double at : places) s.hold(at * s.p.length, {0.6, 0.8});
        const Whole<Element> whole(s);
        const auto now = s.settled();
        INFO(Element::name() << ", nature " << int(nature) << ", N l²/EI " << q << ", at " << places[0]
                             << ", rotations " << rotations);
        const bool beside = places[0] == 1e-7 || places[0] == 1 - 1e-7;
        // Tensions have the round-off of the nodes, EA ε, and moments are the rotations' EI/l.
        const double tolerance = 2e-12 / rotations + turned * rotations * (beside ? 1e-7 : rotations);
        CHECK(std::abs(now.energy - whole.energy) / std::abs(whole.energy) <= tolerance);
        CHECK(whole.off(now.r) <= tolerance);
        CHECK(whole.off(now.K) <= tolerance);
      }
}

/// The larger one, or what is not a number.
double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

template <class Element, int Most>
void check_derivatives(Kind kind, const Shape& shape, const std::vector<double>& places, Random& random) {
  using S = Scene<Element, Most>;
  const S s = pressed<Element, Most>(random, kind, shape, places);
  const auto here = S(s).settled();
  const double l = s.p.length, unit = s.p.bending_per_length3 * l, force = unit * (1 + std::abs(shape.q));
  INFO(Element::name() << (kind == Kind::round ? ", round" : ", along") << ", contacts " << s.count << ", at "
                       << places[0] << ", nature " << int(shape.nature) << ", N l²/EI " << shape.q);
  CHECK(std::abs(here.local_change) <= 1e-20 * force * l);
  CHECK((here.K - here.K.transpose()).norm() <= 1e-15 * here.K.norm());
  // A piece of several arcs is not exact under tension, and carries a force along the beam.
  if (kind == Kind::round && shape.nature != Nature::arcs)
    for (int k = 0; k < s.count; ++k) {
      // To the second order of rotations, by which moderate ones are off.
      const auto& contact = s.contacts[S::of(k)];
      CHECK(std::abs(contact.normal.dot(contact.tangent)) <= 1e-3);
    }
  const auto of = S::of;
  const auto differences = [&](double h, auto&& move, auto&& check) {
    const auto at = [&](double by) {
      S moved = s;
      move(moved, by * h);
      return moved.settled();
    };
    const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
    check([&](auto&& tell) {
      using T = std::decay_t<decltype(tell(a))>;
      return T((8 * (tell(c) - tell(b)) - (tell(d) - tell(a))) / (12 * h));
    });
  };
  // Fourth order in steps that change N by 0.2 EI/l² at most.
  const double exact = 1e-8;
  for (int i = 0; i < 6; ++i) {
    const double size = i % 3 == 2 ? l : 1;
    differences(
        i % 3 == 2 ? 4e-4 : 2e-5 * l, [i](S& moved, double by) { moved.d[i] += by; },
        [&](auto&& difference) {
          INFO("by " << i);
          CHECK(std::abs(difference([](const auto& t) { return t.potential; }) - here.r[i]) /
                    (exact * force * size) <=
                1);
          double rows = 0, gaps = 0;
          for (int j = 0; j < 6; ++j)
            rows = worse(rows, std::abs(difference([j](const auto& t) { return t.r[j]; }) - here.K(j, i)) /
                                   (exact * s.p.axial_per_length * size * (j % 3 == 2 ? l : 1)));
          for (int k = 0; k < s.count; ++k)
            gaps = worse(gaps, std::abs(difference([&](const auto& t) { return t.residual[of(k)]; }) -
                                        here.column[of(k)][i]) /
                                   (exact * size));
          CHECK(rows <= 1);
          CHECK(gaps <= 1);
        });
  }
  for (int k = 0; k < s.count; ++k)
    differences(
        5e-3 * std::abs(s.contacts[of(k)].force),
        [&](S& moved, double by) { moved.contacts[of(k)].force += by; },
        [&](auto&& difference) {
          INFO("by force " << k);
          CHECK(std::abs(here.residual[of(k)] + S(s).contacts[of(k)].gap) <= 1e-12 * l);
          CHECK(std::abs(difference([](const auto& t) { return t.potential; }) - here.residual[of(k)]) /
                    (exact * l) <=
                1);
          double rows = 0, gaps = 0;
          for (int j = 0; j < 6; ++j)
            rows = worse(rows,
                         std::abs(difference([j](const auto& t) { return t.r[j]; }) - here.column[of(k)][j]) /
                             (exact * (j % 3 == 2 ? l : 1)));
          for (int j = 0; j < s.count; ++j)
            gaps = worse(gaps, std::abs(difference([&](const auto& t) { return t.residual[of(j)]; }) -
                                        here.yields[of(j)][of(k)]) /
                                   (exact * l / unit));
          CHECK(rows <= 1);
          CHECK(gaps <= 1);
        });
}
template <class Element>
void check_derivatives(Kind kind, unsigned seed) {
  Random random(seed);
  std::vector<std::vector<double>> all{{0.3}, {0.8}, {0.03}, {0.2, 0.3}, {0.15, 0.8}, {0.7, 0.85}};
  if (kind == Kind::along) all.insert(all.end(), {{1e-4}, {-1e-3}, {1 + 1e-3}, {0, 1}, {1e-8, 3e-8}});
  for (const Nature nature : natures)
    for (const double q : {-5., 0., 3., 20., 200.})
      for (const auto& places : all) {
        // What a place makes of the natural curvature at the root of a piece beside it is not in its derivatives.
        // Where its tension makes a force along the beam that is a twentieth of the contact's, its place is not told.
        if (nature == Nature::arcs && kind == Kind::round && (places.size() > 1 || q > 100)) continue;
        check_derivatives<Element, 2>(kind, {nature, 0.1, q, any_rotation<Element> ? random(2) : 0}, places,
                                      random);
      }
}

/// Forces at the nodes are loads of these, however many contacts make them.
template <class S>
void check_at_nodes(const std::vector<double>& places, double tolerance) {
  Random random(72);
  Scene<Corotational<>, 3> scene(random, {Nature::arc, 0.1, 20});
  const double l = scene.p.length, unit = scene.p.bending_per_length3 * l;
  Whole<Corotational<>> whole(scene);
  const Vector2<double> normal(0.6, 0.8);
  const ElementProperties<S> p = [&] {
    ElementProperties<S> q(static_cast<S>(l), static_cast<S>(scene.p.axial_stiffness),
                           static_cast<S>(unit * l * l));
    q.natural_a = static_cast<S>(scene.p.natural_a), q.natural_b = -q.natural_a;
    q.natural_stretch = static_cast<S>(scene.p.natural_stretch);
    return q;
  }();
  std::array<detail::InnerContact<S>, 3> contacts;
  const Vector6<S> d = scene.d.template cast<S>();
  Vector6<S> r;
  Matrix6<S> K;
  S N = static_cast<S>(scene.N);
  for (int i = 0; i < 20; ++i) {
    detail::TouchedElement<Corotational<>, S, 3> element(p, S(1), d, N);
    for (std::size_t k = 0; k < places.size(); ++k) {
      auto& contact = contacts[k];
      contact.kind = detail::InnerContact<S>::Kind::along, contact.moves = false;
      contact.s = S(1) + p.length * static_cast<S>(places[k]);
      contact.normal = normal.template cast<S>(), contact.force = static_cast<S>(unit);
      element.add(contact, static_cast<int>(k));
    }
    element.condense(r, K, [](int) {});
    S longer = 0;
    N = element.advance(Vector6<S>::Zero(), {}, longer);
  }
  for (const double place : places) whole.r.template segment<2>(place < 0.5 ? 0 : 3) -= unit * normal;
  INFO("contacts " << places.size() << ", at " << places[0] << ", digits " << std::numeric_limits<S>::digits);
  CHECK(whole.off(Vector6<double>(r.template cast<double>())) <= tolerance);
  CHECK(whole.off(Matrix6<double>(K.template cast<double>())) <= tolerance);
}

}  // namespace

TEST_CASE("an element that a place holds without force is what it is untouched", "[body]") {
  check_untouched<VonKarman<>>(0.1, 0);
  for (const double rotations : {0.1, 0.01, 1e-3}) check_untouched<Corotational<>>(rotations, 5);
}

TEST_CASE("contacts may lie at a node, and some of them at one place", "[body]") {
  for (const auto& places : std::vector<std::vector<double>>{
           {0}, {1}, {0, 0}, {1, 1}, {1, 1 - 1e-9}, {1 - 1e-8, 1}, {0, 1}, {0, 0, 0}, {1, 1, 1}, {1, 0, 1}}) {
    // Forces are as many shortest pieces, √ε of the length each, beside their node.
    const double pieces = static_cast<double>(places.size());
    check_at_nodes<double>(places, 2 * pieces * std::sqrt(std::numeric_limits<double>::epsilon()));
    check_at_nodes<float>(places, 2 * pieces * std::sqrt(std::numeric_limits<float>::epsilon()));
  }
}

TEST_CASE("forces, tangent and columns of a touched element are derivatives of its potential", "[body]") {
  check_derivatives<Corotational<>>(Kind::round, 51);
  check_derivatives<Corotational<>>(Kind::along, 52);
  check_derivatives<VonKarman<>>(Kind::along, 54);
}
