// What every element of a rod in space promises: exact derivatives, and nothing for rigid motion or the natural shape.
#include "rod/elements.hpp"
#include "support/catch.hpp"
#include "support/sanitized.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class E>
typename E::template Inner<Long> inner_of(const RandomElement& of) {
  typename E::template Inner<Long> inner;
  if constexpr (E::unknowns == 7) inner.twist.value = of.twist;
  if (!of.p.taut) return inner;
  // In equilibrium: where N lags behind the shape, the tangent is not that of the energy.
  VectorOf<Long, 2 * E::unknowns> r;
  Eigen::Matrix<Long, 2 * E::unknowns, 2 * E::unknowns> K;
  for (int k = 0; k < 6; ++k) {
    (void)E::tangent(of.p, of.a, of.b, inner, r, K);
    inner.tension.value -= inner.tension.residual / inner.tension.stiffness;
  }
  return inner;
}

/// Energy, and its derivatives by differences of long double: five-point rules of step 1e-4 leave about 1e-10.
template <class E>
struct Differences {
  static constexpr int n = E::unknowns;
  const RandomElement& of;

  Long energy(const Long* x) const {
    auto inner = inner_of<E>(of);
    inner.tension.value += x[2 * n];
    if constexpr (n == 7) inner.twist.value += x[2 * n + 1];
    return energy_of<E>(of.p, moved(of.a, x, n == 7), moved(of.b, x + n, n == 7), inner);
  }
  Long at(int i, Long s, int j, Long t) const {
    Long x[16] = {};
    x[i] += s, x[j] += t;
    return energy(x);
  }
  Long first(int i, Long h = 1e-4L) const {
    return (8 * (at(i, h, i, 0) - at(i, -h, i, 0)) - at(i, 2 * h, i, 0) + at(i, -2 * h, i, 0)) / (12 * h);
  }
  Long second(int i, int j) const {
    const auto rough = [&](Long h) {
      return i == j ? (at(i, h, i, 0) - 2 * at(i, 0, i, 0) + at(i, -h, i, 0)) / (h * h)
                    : (at(i, h, j, h) - at(i, h, j, -h) - at(i, -h, j, h) + at(i, -h, j, -h)) / (4 * h * h);
    };
    return (4 * rough(1e-4L) - rough(2e-4L)) / 3;
  }
};

template <class E>
void check_derivatives(bool round, bool taut = false) {
  constexpr int n = 2 * E::unknowns;
  Random random(31);
  for (int trial = 0; trial < (sanitized ? 2 : 8); ++trial) {
    RandomElement of(random);
    of.p.round = round, of.p.taut = taut;
    const Differences<E> differences{of};
    auto inner = inner_of<E>(of);
    VectorOf<Long, n> r, gradient;
    Eigen::Matrix<Long, n, n> K, hessian;
    (void)E::tangent(of.p, of.a, of.b, inner, r, K);
    for (int i = 0; i < n; ++i) {
      gradient[i] = differences.first(i);
      for (int j = 0; j <= i; ++j) hessian(i, j) = hessian(j, i) = differences.second(i, j);
    }
    const auto condense = [&](int own, const auto& found) {
      VectorOf<Long, n> by;
      for (int i = 0; i < n; ++i) by[i] = differences.second(i, own);
      const Long g = differences.first(own), k = differences.second(own, own);
      CHECK(std::abs(g - found.residual) <= 1e-9L);
      CHECK(std::abs(k - found.stiffness) <= 1e-8L * std::abs(k));
      CHECK((by - found.row).norm() <= 1e-8L * found.row.norm());
      gradient -= by * (g / k);
      hessian -= by * by.transpose() / k;
    };
    if (taut) condense(n, inner.tension);
    if constexpr (E::unknowns == 7)
      if (!round) condense(n + 1, inner.twist);
    if (E::unknowns == 7 && taut && !round) CHECK(std::abs(differences.second(n, n + 1)) <= 1e-9L);
    CHECK((r - gradient).norm() <= 1e-9L * gradient.norm());
    CHECK((K - hessian).norm() <= 1e-9L * hessian.norm());
    CHECK((K - K.transpose()).norm() <= 1e-16L * K.norm());
  }
}

/// The element's own strains, tangent and residual turn with it.
template <class E>
void check_rigid(bool round, bool taut = false) {
  constexpr int n = E::unknowns;
  Random random(32);
  for (int trial = 0; trial < 100; ++trial) {
    RandomElement of(random);
    of.p.round = round, of.p.taut = taut;
    const Axis axis = detail::unit(random_vector(random)), by = random_vector(random);
    const Long angle = random(20.0);  // three turns
    auto inner = inner_of<E>(of), same = inner;
    VectorOf<Long, 2 * n> r, turned;
    Eigen::Matrix<Long, 2 * n, 2 * n> K;
    const Long before = E::tangent(of.p, of.a, of.b, inner, r, K);
    const Long after =
        E::tangent(of.p, rotated(of.a, axis, angle, by), rotated(of.b, axis, angle, by), same, turned, K);
    CHECK(std::abs(after - before) <= 1e-15L);
    RodNode<Long> force{0, Axis::Zero(), Axis::Zero(), Axis::Zero()};
    for (const int k : {0, 3, n, n + 3}) {
      force.r = r.template segment<3>(k);
      force = rotated(force, axis, angle, Axis::Zero().eval());
      CHECK((force.r - turned.template segment<3>(k)).norm() <= 1e-15L * r.norm());
    }
    // No force, and no moment about the origin, of what is free.
    Axis sum = r.template segment<3>(0) + r.template segment<3>(n), moment = Axis::Zero();
    for (const int k : {0, n}) {
      const RodNode<Long>& node = k == 0 ? of.a : of.b;
      moment += detail::cross3<Long>(node.r, r.template segment<3>(k)) +
                detail::cross3<Long>(node.tangent, r.template segment<3>(k + 3));
      if (n == 7) moment += r[k + 6] * detail::unit(node.tangent);
    }
    CHECK(sum.norm() <= 1e-16L * r.norm());
    CHECK(moment.norm() <= 1e-15L * r.norm());
  }
}

}  // namespace

TEST_CASE("residual and tangent of a rod are the derivatives of its energy", "[rod]") {
  for (const bool taut : {false, true}) {
    check_derivatives<RoundRod>(true, taut);
    check_derivatives<TwistedRod>(true, taut);
    check_derivatives<TwistedRod>(false, taut);
  }
}

TEST_CASE("rigid motion of a rod does no work, three turns included", "[rod]") {
  for (const bool taut : {false, true}) {
    check_rigid<RoundRod>(true, taut);
    check_rigid<TwistedRod>(true, taut);
    check_rigid<TwistedRod>(false, taut);
  }
}

TEST_CASE("the natural shape of a rod has no energy and no forces", "[rod]") {
  Random random(33);
  for (int trial = 0; trial < 100; ++trial) {
    RandomElement of(random);
    TwistedRod::take_natural(of.a, of.b, of.twist, of.p);
    auto inner = inner_of<TwistedRod>(of);
    TwistedRod::Vector14<Long> r;
    TwistedRod::Matrix14<Long> K;
    // Directions inside are polynomials that are right to 4e-17.
    CHECK(TwistedRod::tangent(of.p, of.a, of.b, inner, r, K) <= 4e-33L);
    CHECK(r.norm() <= 1e-17L * K.norm());
  }
}

TEST_CASE("a round element bends as one of three points and one bending stiffness, and twists by its ends",
          "[rod]") {
  Random random(35);
  for (int trial = 0; trial < 100; ++trial) {
    RandomElement of(random);
    of.p.round = true;
    const auto energy = [&of] { return energy_of<TwistedRod>(of.p, of.a, of.b); };
    const Long twisted = energy();
    of.b.director = detail::turn<Long>(of.b.director, detail::unit(of.b.tangent), 0.3L);
    const Long farther = energy();
    of.p.torsion = 0;
    CHECK(energy() == energy_of<RoundRod>(of.p, of.a, of.b));
    // ½ GJ/l (τ + 0.3)² less ½ GJ/l τ²
    const Long tau = std::sqrt(2 * (twisted - energy()) * of.p.length / 1.2L),
               by = (farther - twisted) * of.p.length / 1.2L - 0.045L;
    CHECK(std::abs(std::abs(by / 0.3L) - tau) <= 1e-15L);
  }
}

TEST_CASE("a round element carries a director along as its curve does", "[rod]") {
  // A helix of unit speed: a director that does not twist turns against its normal by the torsion.
  Random random(36);
  for (int trial = 0; trial < 50; ++trial) {
    const Long k = 1 + random(0.5), torsion = random(1.0), w = std::sqrt(k * k + torsion * torsion);
    const auto node = [&](Long s) {
      const Long c = std::cos(w * s), si = std::sin(w * s), alpha = -torsion * s;
      const Axis normal(-c, -si, 0), tangent(-k / w * si, k / w * c, torsion / w);
      return RodNode<Long>{s,
                           {k / (w * w) * c, k / (w * w) * si, torsion / w * s},
                           tangent,
                           detail::turn<Long>(normal, tangent, alpha)};
    };
    for (const Long l : {0.8L, 0.4L, 0.2L}) {
      RodProperties<Long> p;
      p.length = l, p.inverse_length = 1 / l, p.torsion = 1, p.round = true;
      const auto a = node(0), b = node(l);
      const detail::EndsAndMiddle<Long> at(p, a, b);
      const detail::RoundTwist<Long> twist(p, a, b, at);
      const Long carried = twist.carried(), missing = std::sqrt(2 * l * twist.energy());
      CHECK(missing <= 0.02L * w * w * l * l * std::abs(carried));
      // Within it as well as a cubic of ξ says.
      const auto middle = node(l / 2);
      CHECK((TwistedRod::director(p, a, b, Long(0), 0.5L) - middle.director).norm() <=
            0.02L * std::pow(w * l, 4.0L));
    }
  }
}

TEST_CASE("a director inside an element is what its own twist says", "[rod]") {
  Random random(34);
  for (int trial = 0; trial < 100; ++trial) {
    const RandomElement of(random);
    const auto at = [&](Long x) { return TwistedRod::director(of.p, of.a, of.b, of.twist, x); };
    CHECK((at(0) - of.a.director).norm() <= 1e-17L);
    CHECK((at(1) - of.b.director).norm() <= 1e-17L);
    CHECK(std::abs(TwistedRod::twist_to(of.p, of.a, of.b, at(0.5L)) - of.twist) <= 1e-17L);
  }
}

TEST_CASE("without twist a round rod has the energy of one that may twist", "[rod]") {
  // In a plane bend neither twists, and both sum the same curvatures at the same points.
  const auto difference = [](double l) {
    const auto node = [](double s) {
      RodNode<double> n{s, {s, s * s / 2, 0}, {1, s, 0}, {0, 0, 1}};
      n.tangent /= 1 + s * s / 6;
      return n;
    };
    RodProperties<double> p;
    p.length = l, p.inverse_length = 1 / l, p.axial = 1e3;
    for (auto& point : p.points) point.bending1 = point.bending2 = point.torsion = 1;
    p.torsion = 1, p.round = true;
    const auto a = node(0), b = node(l);
    const double round = energy_of<RoundRod>(p, a, b), twisted = energy_of<TwistedRod>(p, a, b);
    CHECK(round > 0);
    return std::abs(round - twisted) / round;
  };
  for (const double l : {0.1, 0.05, 0.025}) CHECK(difference(l) <= 1e-14);
}
