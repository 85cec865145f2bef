// Sign changes of a polynomial in Bernstein form, and the root in a bracket.
#include <algorithm>
#include <random>
#include <vector>

#include "../support/catch.hpp"
#include <hapbeam/contact/bernstein.hpp>

using namespace hapbeam::detail;

namespace {

// Product of (t - root), in Bernstein form: multiplying by (t - r) mixes neighbouring coefficients.
Bernstein<double, 5> with_roots(const std::vector<double>& roots, double factor) {
  std::vector<double> c{factor};
  for (const double r : roots) {
    const std::size_t n = c.size();  // new degree
    std::vector<double> next(n + 1, 0);
    for (std::size_t k = 0; k <= n; ++k) {
      if (k < n) next[k] += c[k] * -r * double(n - k) / double(n);
      if (k > 0) next[k] += c[k - 1] * (1 - r) * double(k) / double(n);
    }
    c = next;
  }
  Bernstein<double, 5> result{};
  for (std::size_t k = 0; k < 6; ++k) result[k] = c[k];
  return result;
}

ValueSlope<double> evaluate(const Bernstein<double, 5>& c, double t) {
  Bernstein<double, 5> b = c;
  for (std::size_t n = 5; n > 1; --n)
    for (std::size_t k = 0; k < n; ++k) b[k] += t * (b[k + 1] - b[k]);
  return {b[0] + t * (b[1] - b[0]), 5 * (b[1] - b[0])};
}

}  // namespace

TEST_CASE("every separate root in [0, 1] is found once, with its sense, and polished to round-off") {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> wide(-1, 2);
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> roots(5);
    for (double& r : roots) r = wide(random);
    std::sort(roots.begin(), roots.end());
    bool separate = true;
    for (std::size_t k = 0; k < 5; ++k) {
      if (k > 0 && roots[k] - roots[k - 1] < 1e-3) separate = false;
      if (std::abs(roots[k]) < 1e-6 || std::abs(roots[k] - 1) < 1e-6) separate = false;
    }
    if (!separate) continue;
    const auto c = with_roots(roots, i % 2 ? 1 : -1);
    std::vector<double> found;
    for_each_sign_change(c, [&](const SignChange<double>& change) {
      const double t = polish_root(change, [&](double at) { return evaluate(c, at); });
      REQUIRE((t >= change.low && t <= change.high));
      REQUIRE(change.rising == (evaluate(c, t).slope > 0));
      found.push_back(t);
    });
    std::sort(found.begin(), found.end());
    std::vector<double> expected;
    for (const double r : roots)
      if (r > 0 && r < 1) expected.push_back(r);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) REQUIRE(std::abs(found[k] - expected[k]) < 1e-9);
  }
}

TEST_CASE("roots that coincide cost bounded work and are found where the sign changes") {
  for (const double r : {0.1, 0.3333, 0.5, 0.77}) {
    const auto count = [](const Bernstein<double, 5>& c) {
      int changes = 0;
      for_each_sign_change(c, [&](const SignChange<double>& change) {
        changes += change.rising ? 1 : -1;
        const double t = polish_root(change, [&](double at) { return evaluate(c, at); });
        CHECK(std::abs(evaluate(c, t).value) < 1e-12);
      });
      return changes;
    };
    CHECK(count(with_roots({r, r, r, -1, 2}, 1)) == -1);
    CHECK(count(with_roots({r, r, r, r, r}, 1)) == 1);
    CHECK(count(with_roots({r, r, -1, -1, -1}, 1)) == 0);
    CHECK(count(with_roots({r, r, r, r, -1}, 1)) == 0);
  }
  int visits = 0;
  for_each_sign_change(Bernstein<double, 5>{}, [&](const SignChange<double>&) { ++visits; });
  CHECK(visits == 0);
}

TEST_CASE("Newton is kept in its bracket") {
  // One sign change, and slopes that throw Newton far out, or are zero.
  const SignChange<double> bracket{0, 1, 0.05, true};
  const double root = 0.6;
  const double found = polish_root(bracket, [&](double t) {
    const double x = 50 * (t - root);
    return ValueSlope<double>{std::atan(x), 50 / (1 + x * x)};
  });
  CHECK(found == Approx(root).epsilon(1e-12));
  const double flat = polish_root(bracket, [&](double t) {
    return ValueSlope<double>{t < root ? -1.0 : 1.0, 0};
  });
  CHECK(flat == Approx(root).epsilon(1e-7));
}

TEST_CASE("a root on the border of two intervals counts once") {
  // -, 0 | 0, + : zero is positive.
  int left = 0, right = 0;
  for_each_sign_change(Bernstein<double, 1>{-1, 0}, [&](const SignChange<double>&) { ++left; });
  for_each_sign_change(Bernstein<double, 1>{0, 1}, [&](const SignChange<double>&) { ++right; });
  CHECK(left + right == 1);
}
