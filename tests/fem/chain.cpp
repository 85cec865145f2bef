// How increments are laid as a chain, and what that is for: solves that do not depend on mesh or stretching stiffness.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/laid_beam.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Turning = FemModel<Corotational<>>;
using Nodes = std::vector<CentrelineNode<double>>;

/// A chain as lay_chain() asks for it: sizes are ints.
struct Chain {
  Nodes nodes;
  std::vector<ElementProperties<double>> properties;

  int size() const { return static_cast<int>(nodes.size()); }
  auto begin() { return nodes.begin(); }
  auto end() { return nodes.end(); }
  CentrelineNode<double>& operator[](int i) { return nodes[static_cast<std::size_t>(i)]; }
  const CentrelineNode<double>& operator[](int i) const { return nodes[static_cast<std::size_t>(i)]; }

  Vector6<double> displacements(int e) const {
    const auto &a = (*this)[e], &b = (*this)[e + 1];
    return (Vector6<double>() << a.u, a.w, a.theta, b.u, b.w, b.theta).finished();
  }
  double chord(int e) const {
    const auto &a = (*this)[e], &b = (*this)[e + 1];
    return std::hypot(b.s + b.u - a.s - a.u, b.w - a.w);
  }
};

/// What chains ask of properties and tensions: [] with an int.
template <class T>
struct ByInt {
  const std::vector<T>& of;
  const T& operator[](int i) const { return of[static_cast<std::size_t>(i)]; }
};

/// A crooked chain, a little strained.
Chain crooked(Random& random, int elements) {
  Chain chain;
  CentrelineNode<double> at{0, 0.1, -0.2, random(1)};
  double x = at.u, w = at.w;
  for (int i = 0; i <= elements; ++i) {
    at.u = x - at.s, at.w = w;
    chain.nodes.push_back(at);
    if (i == elements) break;
    const double l = random(0.5, 1.5) / elements, stretched = l * (1 + random(1e-4)), turn = random(0.3);
    chain.properties.emplace_back(l, 1e5, 2.0);
    x += stretched * std::cos(at.theta + turn / 2);
    w -= stretched * std::sin(at.theta + turn / 2);
    at.s += l;
    at.theta += turn;
  }
  return chain;
}

double strain(const Chain& chain, int e) {
  using Element = Corotational<>;
  Vector6<double> r;
  Element::residual(chain.properties[static_cast<std::size_t>(e)], chain.displacements(e), r);
  const auto &a = chain[e], &b = chain[e + 1];
  const double x = b.s + b.u - a.s - a.u, y = b.w - a.w, c = x / std::hypot(x, y), s = y / std::hypot(x, y);
  return (c * r[3] + s * r[4]) / 1e5;  // along the chord: the normal force
}

/// N of each element after an increment, as Newton's method has it.
template <class Increment>
std::vector<double> tensions(const Chain& chain, const Increment& increment) {
  std::vector<double> all;
  for (int e = 0; e + 1 < chain.size(); ++e) {
    const ElementProperties<double>& p = chain.properties[static_cast<std::size_t>(e)];
    OwnTension<double> own;
    own.normal = 1e5 * strain(chain, e);
    (void)Corotational<>::core(p, chain.displacements(e), own);
    const Vector3<double> x = increment(e), y = increment(e + 1);
    all.push_back(own.normal + own.missing + own.s * (y[0] - x[0]) + own.r * (y[1] - x[1]) +
                  p.length * (own.t1 * x[2] + own.t2 * y[2]));
  }
  return all;
}

}  // namespace

// A rigid motion's increment, linear as Newton finds it, turns the chain and strains nothing: for any angle.
TEST_CASE("an increment that turns all of a chain keeps every length and bend", "[chain]") {
  Random random(1);
  for (const double angle : {1e-3, 0.5, -2.0, 6.0}) {
    Chain chain = crooked(random, 12);
    const Chain before = chain;
    const auto rigid = [&](int i) -> Vector3<double> {
      const auto& node = before[i];
      const double x = node.s + node.u, w = node.w;
      return {angle * w, -angle * x, angle};  // θ is clockwise
    };
    detail::lay_chain<Corotational<>, double>(chain, ByInt<ElementProperties<double>>{before.properties},
                                              ByInt<double>{tensions(before, rigid)}, rigid);
    for (int e = 0; e < 12; ++e) {
      CAPTURE(angle, e);
      CHECK(relative_error(chain.chord(e), before.chord(e)) <= 1e-12);
      CHECK(std::abs(chain[e + 1].theta - chain[e].theta - before[e + 1].theta + before[e].theta) <= 1e-12);
      CHECK(std::abs(strain(chain, e) - strain(before, e)) <= 1e-11);
    }
  }
}

// What Newton's tangent says of the normal force, N + ∂N/∂d Δ, is what it is afterwards, however far the element turns; as long
// as it bends by little, for of bending's share the square is left.
TEST_CASE("after an increment each element has the normal force that the tangent foresaw", "[chain]") {
  Random random(2);
  for (const double size : {1e-3, 0.03, 0.3}) {
    const Chain before = crooked(random, 10);
    std::vector<Vector3<double>> change(11);
    // A turn that is the same for all, so that elements turn without bending, and a stretch of each.
    for (int i = 0; i <= 10; ++i) {
      const auto& node = before[i];
      change[static_cast<std::size_t>(i)] = {size * node.w + 1e-5 * random(1),
                                             -size * (node.s + node.u) + 1e-5 * random(1), size};
    }
    const auto increment = [&](int i) -> Vector3<double> { return change[static_cast<std::size_t>(i)]; };
    // Directional derivative of the strain by central differences.
    const auto strained = [&](double h, int e) {
      Chain moved = before;
      for (int i = 0; i <= 10; ++i) {
        const Vector3<double> x = increment(i) * h;
        moved[i].u += x[0], moved[i].w += x[1], moved[i].theta += x[2];
      }
      return strain(moved, e);
    };
    Chain after = before;
    detail::lay_chain<Corotational<>, double>(after, ByInt<ElementProperties<double>>{before.properties},
                                              ByInt<double>{tensions(before, increment)}, increment);
    for (int e = 0; e < 10; ++e) {
      const double h = 1e-4, foreseen = strain(before, e) + (strained(h, e) - strained(-h, e)) / (2 * h);
      CAPTURE(size, e, strain(before, e), foreseen);
      // Left: h² of the difference, size² 1e-8, and the product of stretch and turn of an element, 1e-4 size.
      CHECK(std::abs(strain(after, e) - foreseen) <= 1e-8 + 3e-4 * size * std::abs(foreseen));
    }
  }
}

TEST_CASE("what a chain misses of its right end is shared out along the arc", "[chain]") {
  Random random(4);
  Chain chain = crooked(random, 6);
  const Chain before = chain;
  const double end = chain[6].s, far_u = chain[6].u + 0.01, far_w = chain[6].w - 0.02;
  detail::EndSupport<double> left(Support::clamped, {}), right(Support::pinned, {far_u, far_w, 0});
  left.set_target(1), right.set_target(1);
  detail::close_chain(chain, left, right);
  for (int i = 0; i <= 6; ++i) {
    CHECK(std::abs(chain[i].u - before[i].u - 0.01 * before[i].s / end) <= 1e-14);
    CHECK(std::abs(chain[i].w - before[i].w + 0.02 * before[i].s / end) <= 1e-14);
    CHECK(chain[i].theta == before[i].theta);
  }
  // A left end that is free to move goes along.
  Chain sliding = before;
  const detail::EndSupport<double> guided(Support::roller, {});
  detail::close_chain(sliding, guided, right);
  for (int i = 0; i <= 6; ++i) CHECK(std::abs(sliding[i].u - before[i].u - 0.01) <= 1e-14);
}

// 24 solves at PL²/EI = 5, 28 at 10: the way of a cantilever, whatever it is cut into and however it stretches.
TEST_CASE("the solves to a load do not depend on the mesh, nor on the stiffness against stretching",
          "[chain]") {
  for (const double alpha : {5.0, 10.0}) {
    int least = 1000, most = 0;
    for (const int elements : {8, 16, 64, 256, 1024})
      for (const double EA : {1e4, 1e6, 1e8}) {
        Beam beam(1, EA, 1, 0.01, Support::clamped, Support::free);
        const Turning model(beam.add({1, 0, alpha, 0}), elements);
        CAPTURE(alpha, elements, EA);
        REQUIRE(model.rest().status == Status::ok);
        least = std::min(least, model.rest().solves);
        most = std::max(most, model.rest().solves);
      }
    CAPTURE(alpha, least, most);
    CHECK(most <= 30);
    CHECK(most - least <= 2);
  }
}

TEST_CASE("a cantilever rolls up in two solves, whatever its mesh and stiffness", "[chain]") {
  for (const int elements : {8, 64, 1024})
    for (const double EA : {1e4, 1e6, 1e8}) {
      Beam beam(1, EA, 1, 0.01, Support::clamped, Support::free);
      const Turning model(beam.add({1, 0, 0, 2 * pi}), elements);
      CAPTURE(elements, EA, model.rest().solves);
      CHECK(model.rest().status == Status::ok);
      // Where it moved last it is looked at once more: whether it is stable there.
      CHECK(model.rest().solves <= 4);
      const auto& tip = model.shape()[model.shape().segments()];
      CHECK(std::hypot(1 + tip.u, tip.w) <= 1e-6);
      CHECK(std::abs(tip.theta - 2 * pi) <= 1e-6);
    }
}
