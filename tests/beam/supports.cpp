// A pair of supports is refused exactly when the stiffness of the beam on it is singular.
#include "support/catch.hpp"
#include "support/eigenvalues.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

/// The table of supports in mechanics, said again: which of u, w, theta are zero.
struct Held {
  Support support;
  bool u, w, theta;
};
constexpr Held all[] = {{Support::free, false, false, false},
                        {Support::clamped, true, true, true},
                        {Support::pinned, true, true, false},
                        {Support::roller, false, true, false},
                        {Support::guided, true, false, true}};

/// Smallest over largest eigenvalue of the free part of a beam of two linear elements with EA = EI = l = 1:
/// 1e-3 or more where it is held, round-off where it is a mechanism.
double definiteness(const Held& left, const Held& right) {
  Matrix6<double> element;
  Vector6<double> r;
  Linear::tangent(ElementProperties<double>(1, 1, 1), Vector6<double>::Zero().eval(), r, element);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(9, 9);
  K.topLeftCorner<6, 6>() += element;
  K.bottomRightCorner<6, 6>() += element;
  const bool held[] = {left.u, left.w, left.theta, false, false, false, right.u, right.w, right.theta};
  std::vector<int> free;
  for (int k = 0; k < 9; ++k)
    if (!held[k]) free.push_back(k);
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd reduced(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      reduced(i, j) = K(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
  return 1 / Spectrum(reduced).condition();
}

}  // namespace

TEST_CASE("of the 25 pairs of supports those are refused whose stiffness is singular", "[beam]") {
  int mechanisms = 0;
  for (const Held& left : all)
    for (const Held& right : all) {
      const double smallest = definiteness(left, right);
      INFO(name(left.support) << ", " << name(right.support) << ": " << smallest);
      REQUIRE((smallest < 1e-13 || smallest > 1e-4));  // nothing in between
      if (smallest > 1e-4) {
        CHECK_NOTHROW(thesis_beam(left.support, right.support));
      } else {
        ++mechanisms;
        CHECK_THROWS_AS(thesis_beam(left.support, right.support), std::invalid_argument);
        CHECK_THROWS_WITH(thesis_beam(left.support, right.support),
                          ContainsSubstring("supports") && ContainsSubstring(name(left.support)) &&
                              ContainsSubstring(name(right.support)) && ContainsSubstring("mechanism"));
      }
    }
  CHECK(mechanisms == 9);
}

TEST_CASE("each support holds what its name says", "[beam]") {
  for (const Held& held : all) {
    INFO(name(held.support));
    CHECK(fixes_u(held.support) == held.u);
    CHECK(fixes_w(held.support) == held.w);
    CHECK(fixes_theta(held.support) == held.theta);
  }
}
