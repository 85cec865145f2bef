// The textbook's corotational element, which the benchmarks compare with the library's rods, is what it should be: exact derivatives, nothing
// for rigid motion and the natural shape, and the order of error that it is known for.
#include <cmath>

#include "../../benchmarks/support/crisfield.hpp"
#include "rod/elements.hpp"
#include "support/catch.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using hapbeam::benchmarks::CrisfieldRod;

namespace {

using Vector14 = CrisfieldRod::Vector14<Long>;
using Matrix14 = CrisfieldRod::Matrix14<Long>;

Long energy(const RandomElement& of, const Long (&x)[14]) {
  return CrisfieldRod::energy(of.p, moved(of.a, x, true), moved(of.b, x + 7, true), {});
}

}  // namespace

TEST_CASE("residual and tangent of the textbook's rod are the derivatives of its energy", "[rod]") {
  // Central differences of long double: h² beside fourth derivatives of order 10, and round-off of 1e-19/h².
  const Long h = 1e-4L;
  Random random(31);
  for (int trial = 0; trial < 10; ++trial) {
    const RandomElement of(random);
    CrisfieldRod::Inner<Long> inner;
    Vector14 r, gradient;
    Matrix14 K, hessian;
    const Long rest = CrisfieldRod::tangent(of.p, of.a, of.b, inner, r, K);
    const auto at = [&](int i, Long s, int j, Long t) {
      Long x[14] = {};
      x[i] += s, x[j] += t;
      return energy(of, x);
    };
    CHECK(std::abs(rest - at(0, 0, 0, 0)) <= 1e-16L * rest);
    for (int i = 0; i < 14; ++i) {
      gradient[i] = (at(i, h, i, 0) - at(i, -h, i, 0)) / (2 * h);
      for (int j = 0; j <= i; ++j)
        hessian(i, j) = hessian(j, i) =
            i == j ? (at(i, h, i, 0) - 2 * rest + at(i, -h, i, 0)) / (h * h)
                   : (at(i, h, j, h) - at(i, h, j, -h) - at(i, -h, j, h) + at(i, -h, j, -h)) / (4 * h * h);
    }
    CHECK((r - gradient).norm() <= 1e-6L * gradient.norm());
    CHECK((K - hessian).norm() <= 1e-6L * hessian.norm());
    CHECK((K - K.transpose()).norm() <= 1e-16L * K.norm());
  }
}

TEST_CASE("rigid motion and the natural shape cost the textbook's rod nothing", "[rod]") {
  Random random(32);
  for (int trial = 0; trial < 30; ++trial) {
    RandomElement of(random);
    const Axis axis = detail::unit(random_vector(random)), by = random_vector(random);
    const auto turned = [&](const RodNode<Long>& node) { return rotated(node, axis, 4.0L, by); };
    const Long before = CrisfieldRod::energy(of.p, of.a, of.b, {}),
               after = CrisfieldRod::energy(of.p, turned(of.a), turned(of.b), {});
    CHECK(std::abs(after - before) <= 1e-15L * before);
    of.a.tangent = detail::unit(of.a.tangent), of.b.tangent = detail::unit(of.b.tangent);
    CrisfieldRod::take_natural(of.a, of.b, 0.0L, of.p);
    CHECK(CrisfieldRod::energy(of.p, of.a, of.b, {}) <= 1e-30L);
  }
}

// Bathe and Bolourchi's bend, as in verification.cpp.
TEST_CASE("the textbook's rod is of second order on a 45-degree bend", "[rod]") {
  const double length = 100 * std::acos(-1.0) / 4, side = 100 * std::sqrt(0.5);
  const VectorOf<double, 3> start(side, 100 - side, 0), tip(47.1522, 15.6854, 53.4718);
  const auto error = [&](int elements) {
    Rod bend(length, RodStiffness{1e7, 1e7 / 12, 1e7 / 12, 5e6 / 6}, 1, RodSupport::clamped,
             RodSupport::free);
    bend.naturally({{length, 0, 0.01, 0}}).add({length, {0, 0, 600}});
    const FemModel<CrisfieldRod> model(bend, elements);
    REQUIRE(model.rest().status == Status::ok);
    return (model.shape().at(length).r - tip).norm() / (tip - start).norm();
  };
  const double coarse = error(8), fine = error(16);
  INFO(coarse << ", " << fine);
  CHECK(coarse <= 3e-3);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
}
