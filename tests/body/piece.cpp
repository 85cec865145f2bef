// A piece of an element: its derivatives are those of its energy, and pieces in series are the whole.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/body/piece.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/von_karman.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using detail::PieceDensity;
using detail::PieceProperties;

namespace {

enum class Nature { straight, arc, arcs };
enum class Side { left, right };  // of the root

std::vector<Arc> arcs_of(Nature nature, double l, double angle) {
  const double k = angle / l;
  if (nature == Nature::straight) return {};
  if (nature == Nature::arc) return {{1 + l, k}};
  return {{1, k}, {1 + 0.4 * l, k}, {1 + 0.55 * l, -2 * k}, {1 + l, 0.5 * k}};
}

/// A part of a beam, from 1 m on.
struct Part {
  NaturalShape<double> natural;
  ElementProperties<double> element;
  PieceProperties<double> all;

  /// @param angle  of which an arc of that length is [rad]
  Part(Nature nature, double l, double EA, double EI, double angle)
      : natural(
            Beam(1 + l, EA, EI, 1e-3, Support::clamped, Support::free).naturally(arcs_of(nature, l, angle))),
        element(bent(l, EA, EI)),
        all(element, 1, &natural) {}
  Part(const Part&) = delete;

 private:
  ElementProperties<double> bent(double l, double EA, double EI) const {
    ElementProperties<double> p(l, EA, EI);
    natural.apply(1, p);
    return p;
  }
};

using Variables = std::array<double, 4>;  // p, q, N, l

template <bool Turns>
void check_derivatives(Nature nature, Side side, bool tip_moves, double q, Random& random) {
  const double L = 0.4, EI = 2, EA = 2e3 * EI / (L * L), l = L * random(0.4, 0.6),
               root = 1 + L * random(0.3, 0.7);
  const Part part(nature, L, EA, EI, -0.7);
  const double N = q * EI / (l * l), to = side == Side::left ? 1 : -1, stretch = N / EA + random(0.01);
  const auto density = [&](const Variables& v) {
    const double root_at = tip_moves ? root : root + to * (l - v[3]);
    return PieceDensity<Turns, double>(part.all, root_at, root_at + to * v[3], to, v[2], stretch, v[0], v[1],
                                       tip_moves);
  };
  const Variables at{random(0.5, 1) / l, random(-1, -0.1) / l, N, l};
  const auto here = density(at);
  const Variables size{1 / l, 1 / l, EI / (l * l) * (1 + std::abs(q)), l};
  const double energy = EI / (l * l) * (1 + std::abs(q));
  const std::array<double, 4> first{here.p, here.q, here.N, here.l};
  const std::array<std::array<double, 4>, 4> second{{{here.pp, here.pq, here.pN, here.pl},
                                                     {here.pq, here.pp, here.qN, here.ql},
                                                     {here.pN, here.qN, here.NN, here.Nl},
                                                     {here.pl, here.ql, here.Nl, here.ll}}};
  INFO("N l²/EI " << q << ", nature " << int(nature) << ", side " << int(side) << ", tip moves "
                  << tip_moves);
  for (std::size_t i = 0; i < 4; ++i) {
    // Fourth order: h⁴/30 of the fifth derivative, in units of size and energy at most ten.
    const double h = (nature == Nature::arcs ? 0.5e-3 : 1.5e-3) * size[i];
    const auto differences = [&](auto&& of) {
      const auto moved = [&](double by) {
        Variables v = at;
        v[i] += by * h;
        return of(density(v));
      };
      return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * h);
    };
    const double tolerance = 1e-10 * energy / size[i];
    CHECK(std::abs(differences([](const auto& d) { return d.D; }) - first[i]) <= tolerance);
    const auto compare = [&](std::size_t j, auto&& of) {
      INFO("by " << i << " and " << j);
      CHECK(std::abs(differences(of) - second[i][j]) <= tolerance / size[j]);
    };
    compare(0, [](const auto& d) { return d.p; });
    compare(1, [](const auto& d) { return d.q; });
    compare(2, [](const auto& d) { return d.N; });
    compare(3, [](const auto& d) { return d.l; });
  }
}

template <bool Turns>
void check_derivatives(unsigned seed) {
  Random random(seed);
  for (const Nature nature : {Nature::straight, Nature::arc, Nature::arcs})
    for (const Side side : {Side::left, Side::right})
      for (const bool tip_moves : {true, false})
        for (const double q : {-8., -0.5, 0., 3., 40., 1000.})
          check_derivatives<Turns>(nature, side, tip_moves, q, random);
}

/// Ends of a chord of moderate rotation.
struct Ends {
  double u, w, a, b;  // of the right one against the left one, rotations of both
};

/// Energy of a piece and its gradient by u, w, a, b and N.
struct Told {
  double energy;
  Eigen::Matrix<double, 5, 1> gradient;
};
Told told(const PieceProperties<double>& all, double from, double l, const Ends& e, double N, Side side) {
  const bool left = side == Side::left;
  const double alpha = e.w / l, a = (e.a + alpha) / l, b = (e.b + alpha) / l, to = from + l;
  const PieceDensity<false, double> d(all, left ? from : to, left ? to : from, left ? 1 : -1, N,
                                      (e.u + alpha * e.w / 2) / l, left ? a : b, left ? b : a, true);
  const double by_a = left ? d.p : d.q, by_b = left ? d.q : d.p;
  Told t{l * d.D, {}};
  t.gradient << N, N * alpha + (by_a + by_b) / l, by_a, by_b, l * d.N;
  return t;
}
/// Stationary in what is free.  Newton's method, with a matrix of differences of a gradient that is next to linear.
template <int Free, class Gradient>
Eigen::Matrix<double, Free, 1> stationary(Gradient&& gradient, Eigen::Matrix<double, Free, 1> x,
                                          const Eigen::Matrix<double, Free, 1>& size) {
  for (int it = 0; it < 12; ++it) {
    Eigen::Matrix<double, Free, Free> H;
    for (int j = 0; j < Free; ++j) {
      auto up = x, down = x;
      up[j] += 1e-5 * size[j], down[j] -= 1e-5 * size[j];
      H.col(j) = (gradient(up) - gradient(down)) / (2e-5 * size[j]);
    }
    x -= H.fullPivLu().solve(gradient(x));
  }
  return x;
}

}  // namespace

TEST_CASE("derivatives of a piece are those of its energy", "[body]") {
  check_derivatives<true>(61);
  check_derivatives<false>(62);
}

TEST_CASE("a piece of an arc at rest has no energy and no forces, as long as it may be", "[body]") {
  const double l = 0.3, EI = 2, EA = 1e5;
  for (const double angle : {0.05, 0.8, -1.5}) {
    const Part arc(Nature::arc, l, EA, EI, -angle);
    for (const double part : {1., 0.4, 1e-3, 1e-8})
      for (const double side : {1., -1.}) {
        const double k = side * angle / l, x = angle * part / 2, root = 1 + l / 2;
        // sin x/x - 1 by its series where the difference cancels
        const double shorter =
            std::abs(x) > 0.1 ? std::sin(x) / x - 1 : -x * x / 6 * (1 - x * x / 20 * (1 - x * x / 42));
        const PieceDensity<true, double> d(arc.all, root, root + side * part * l, side, 0, shorter, k / 2,
                                           -k / 2, true);
        INFO("angle " << angle << ", part " << part);
        const double eps = 1e-15;
        CHECK(std::abs(d.D) <= 4 * eps * EI * k * k);
        CHECK(std::abs(d.p) <= 4 * eps * EI * std::abs(k));
        CHECK(std::abs(d.q) <= 4 * eps * EI * std::abs(k));
        CHECK(std::abs(d.l) <= 4 * eps * EI * k * k / l);
        // The next term of the series of ε0 is x¹²/13!.  A short piece is as long as its ends are rounded.
        const double rounded = 1 + root / (part * l);
        CHECK(std::abs(d.N) <= 4 * eps * rounded * x * x + std::pow(x, 12) / 6.2e9);
      }
  }
}

TEST_CASE("a piece of several arcs at rest has no energy and no forces, however it lies", "[body]") {
  Random random(65);
  const double L = 0.3, EI = 2, EA = 1e5;
  for (const double angle : {0.05, 0.8, -1.5}) {
    const Part part(Nature::arcs, L, EA, EI, angle);
    for (int i = 0; i < 200; ++i) {
      const double from = 1 + L * std::abs(random(1)), to = 1 + L * std::abs(random(1)),
                   l = std::abs(to - from), side = to > from ? 1 : -1;
      const Displacement<double> a = part.natural.at((std::min)(from, to)),
                                 b = part.natural.at((std::max)(from, to));
      const Vector2<double> chord(l + b.u - a.u, b.w - a.w);
      // The chord turns by less than half a turn against both ends.
      const double up = std::remainder(std::atan2(chord.y(), chord.x()) + (a.theta + b.theta) / 2, 2 * pi) -
                        (a.theta + b.theta) / 2;
      const double root = (side > 0 ? a.theta : b.theta) + up, tip = (side > 0 ? b.theta : a.theta) + up;
      const PieceDensity<true, double> d(part.all, from, to, side, 0, chord.norm() / l - 1, root / l, tip / l,
                                         random(1) > 0);
      INFO("angle " << angle << ", from " << from << " to " << to);
      // Of places 1 m from the start, that far apart.
      const double eps = 1e-15 / l, k = std::abs(angle) / L;
      CHECK(std::abs(d.D) <= eps * eps * EI / (l * l));
      CHECK(std::abs(d.p) <= 10 * eps * EI / l);
      CHECK(std::abs(d.q) <= 10 * eps * EI / l);
      CHECK(std::abs(d.l) <= 10 * eps * EI / l * k / l);
      CHECK(std::abs(d.N) <= 10 * eps);
    }
  }
}

TEST_CASE("two pieces in series are the whole", "[body]") {
  Random random(66);
  const double l = 0.3, EI = 2, EA = 1e4 * EI / (l * l);
  for (const Nature nature : {Nature::straight, Nature::arc})
    for (const double q : {-6., 0., 10., 100.})
      for (const double part : {0.5, 0.2, 1e-3}) {
        const PieceProperties<double> all(Part(nature, l, EA, EI, 0.05).element, 1, nullptr);
        const double m = part * l;
        const Ends ends{q * EI / (l * l) / EA * l, l * random(0.02), random(0.05), random(0.05)};
        using One = Eigen::Matrix<double, 1, 1>;
        const double scale = EI / (l * l);
        const double N = stationary<1>(
            [&](const One& x) { return One(told(all, 1, l, ends, x[0], Side::left).gradient[4]); },
            One(q * scale), One(scale))[0];
        const double whole = told(all, 1, l, ends, N, Side::left).energy;
        for (const Side first : {Side::left, Side::right})
          for (const Side second : {Side::left, Side::right}) {
            using Five = Eigen::Matrix<double, 5, 1>;  // u, w, θ of the middle, both tensions
            const auto both = [&](const Five& x, double& energy) {
              const Told a = told(all, 1, m, {x[0], x[1], ends.a, x[2]}, x[3], first),
                         b = told(all, 1 + m, l - m, {ends.u - x[0], ends.w - x[1], x[2], ends.b}, x[4],
                                  second);
              energy = a.energy + b.energy;
              Five g;
              g << a.gradient[0] - b.gradient[0], a.gradient[1] - b.gradient[1],
                  a.gradient[3] + b.gradient[2], a.gradient[4], b.gradient[4];
              return g;
            };
            double energy = 0;
            Five x, size;
            x << part * ends.u, part * ends.w, -ends.w / l, N, N;
            size << m * scale / EA, m * 1e-2, 1e-2, scale, scale;
            x = stationary<5>([&](const Five& y) { return both(y, energy); }, x, size);
            both(x, energy);
            INFO("nature " << int(nature) << ", N l²/EI " << q << ", part " << part);
            CHECK(std::abs(energy - whole) <= 1e-12 * (std::abs(whole) + std::abs(N * ends.u)));
            CHECK(std::abs(x[3] - N) <= 1e-10 * (scale + std::abs(N)));
          }
      }
}
