// Lagrange interpolation: exact where it must be, and how much an error in the values can grow.
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/rom/trained/lagrange.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class Axis, typename S>
std::vector<S> weights(const Axis& axis, S x) {
  std::vector<S> l(static_cast<std::size_t>(axis.size()));
  axis.weights(x, l.data());
  return l;
}

/// Λ = max Σ|l_k(x)|: by how much an error in the values can grow.
template <class Nodes>
double lebesgue_constant(int n) {
  const Lagrange<Nodes> axis(n, -1, 1);
  double most = 0;
  for (int k = 0; k <= 20000; ++k) {
    double sum = 0;
    for (const double l : weights(axis, -1 + k * 1e-4)) sum += std::abs(l);
    most = std::max(most, sum);
  }
  return most;
}

/// A policy of one's own: Chebyshev nodes of the second kind.
struct Lobatto {
  static constexpr const char* name() noexcept { return "lobatto"; }
  static double node(int k, int n) { return n == 1 ? 0 : -std::cos(3.14159265358979324 * k / (n - 1)); }
  static double weight(int k, int n) { return (k % 2 ? -1 : 1) * (k == 0 || k == n - 1 ? 0.5 : 1.0); }
};

}  // namespace

TEMPLATE_TEST_CASE("a polynomial of degree n - 1 is reproduced, and its derivative", "[lagrange]",
                   ChebyshevNodes, EquispacedNodes, Lobatto) {
  for (const int n : {1, 2, 3, 5, 8, 12}) {
    const Lagrange<TestType> axis(n, n == 1 ? 1 : -1, 2 - (n == 1));
    const auto p = [n](double x) { return std::pow(x + 0.3, n - 1); };
    const auto dp = [n](double x) { return n == 1 ? 0 : (n - 1) * std::pow(x + 0.3, n - 2); };
    std::vector<double> values, slopes(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) values.push_back(p(axis.node(k)));
    axis.differentiate(values.data(), 1, slopes.data(), 1);
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
      const double x = n == 1 ? 1 : random(-1, 2);
      const auto l = weights(axis, x);
      double value = 0, sum = 0, derivative = 0;
      for (int k = 0; k < n; ++k) {
        sum += l[static_cast<std::size_t>(k)];
        value += l[static_cast<std::size_t>(k)] * values[static_cast<std::size_t>(k)];
        derivative += l[static_cast<std::size_t>(k)] * slopes[static_cast<std::size_t>(k)];
      }
      // Round-off: eps times what the values can grow by, Λ <= 52 for 12 equidistant nodes, and n² for the derivative.
      const double size = std::pow(2.3, n - 1), eps = std::numeric_limits<double>::epsilon();
      CHECK(std::abs(sum - 1) <= 52 * n * eps);
      CHECK(std::abs(value - p(x)) <= 52 * n * eps * size);
      CHECK(std::abs(derivative - dp(x)) <= 52 * n * n * n * eps * size);
    }
  }
}

TEMPLATE_TEST_CASE("at a node the weights are one and zero exactly, beside it finite", "[lagrange]",
                   (std::pair<ChebyshevNodes, double>), (std::pair<EquispacedNodes, double>),
                   (std::pair<ChebyshevNodes, float>)) {
  using S = typename TestType::second_type;
  for (const int n : {1, 2, 7, 16, 50, 64}) {
    const Lagrange<typename TestType::first_type, S> axis(n, S(0.1), n == 1 ? S(0.1) : S(5));
    for (int k = 0; k < n; ++k) {
      const auto l = weights(axis, axis.node(k));
      for (int j = 0; j < n; ++j) CHECK(l[static_cast<std::size_t>(j)] == (j == k ? S(1) : S(0)));
      for (const S direction : {S(0), S(10)})
        for (const S value : weights(axis, std::nextafter(axis.node(k), direction)))
          CHECK(std::isfinite(value));
    }
  }
}

TEST_CASE("Chebyshev nodes lie inside the interval, ascend and mirror each other", "[lagrange]") {
  for (const int n : {2, 3, 16, 63}) {
    for (int k = 0; k < n; ++k) {
      CHECK(ChebyshevNodes::node(k, n) == Approx(-ChebyshevNodes::node(n - 1 - k, n)).margin(1e-16));
      CHECK(std::abs(ChebyshevNodes::node(k, n)) < 1);
      if (k > 0) CHECK(ChebyshevNodes::node(k, n) > ChebyshevNodes::node(k - 1, n));
    }
  }
}

// Λ = (2/π) ln n + 0.9625 + o(1) for n Chebyshev nodes of the first kind; 2ⁿ⁺¹/(e n (ln n + γ)) for n + 1 equidistant ones
// (Schönhage 1961; Trefethen and Weideman 1991), an asymptote that is good to a few percent at 49 intervals.
TEST_CASE("errors grow by 3.5 between 50 Chebyshev nodes and by 2e12 between 50 equidistant ones",
          "[lagrange]") {
  for (const int n : {8, 16, 50})
    CHECK(lebesgue_constant<ChebyshevNodes>(n) == Approx(2 / pi * std::log(n) + 0.9625).epsilon(0.01));
  const double euler = 0.57721566490153286;
  const double asymptote = std::pow(2.0, 50) / (std::exp(1.0) * 49 * (std::log(49) + euler));
  CHECK(lebesgue_constant<EquispacedNodes>(50) == Approx(asymptote).epsilon(0.05));
}

TEST_CASE("nodes that are none are refused by name", "[lagrange]") {
  using Axis = Lagrange<>;
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(Axis(0, 0, 1), "nodes = 0: must be 1 to 64");
  CHECK_THROWS_WITH(Axis(65, 0, 1), "nodes = 65: must be 1 to 64");
  for (const auto& [low, high] :
       {std::pair{1.0, 0.0}, std::pair{1.0, 1.0}, std::pair{0.0, infinity}, std::pair{std::nan(""), 1.0}})
    CHECK_THROWS_AS(Axis(4, low, high), std::invalid_argument);
  CHECK_THROWS_WITH(Axis(16, 1, 1 + 1e-12),
                    Catch::Matchers::ContainsSubstring("must be wider for so many nodes"));
  CHECK_THROWS_AS(Axis(-1, 0, 1), std::invalid_argument);
  CHECK_NOTHROW(Axis(1, 2, 2));
}
