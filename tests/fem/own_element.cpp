// Elements of a user that inherit from the library's and answer differently: it is they who are asked.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <typename S>
CoreResponse<S> doubled(const CoreResponse<S>& c) {
  return {2 * c.energy,
          2 * c.s,
          2 * c.r,
          2 * c.t1,
          2 * c.t2,
          {2 * c.k.ss, 2 * c.k.sr, 2 * c.k.s1, 2 * c.k.s2, 2 * c.k.rr, 2 * c.k.r1, 2 * c.k.r2, 2 * c.k.t11,
           2 * c.k.t12, 2 * c.k.t22}};
}

/// Twice as stiff as its base, by tangent() alone; the closed form of its base is not that of it.
template <class Base>
struct DoubledTangent : Base {
  template <typename S>
  static S tangent(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r,
                   Matrix6<S>& K) noexcept {
    const S energy = Base::tangent(p, d, r, K);
    r *= 2;
    K *= 2;
    return 2 * energy;
  }
};

/// The same by respond(), of which ElementFromCore makes the rest.
template <class Base>
struct DoubledResponse : Base, ElementFromCore<DoubledResponse<Base>> {
  using Core = ElementFromCore<DoubledResponse<Base>>;
  using Core::energy;
  using Core::residual;
  using Core::tangent;
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e) noexcept {
    return doubled(Base::respond(p, e));
  }
};

/// A membrane twice as stiff as its base, which bends as it did.
struct DoubledMembrane : AssumedStrain {
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e) noexcept {
    return doubled(AssumedStrain::respond(p, e));
  }
};

Beam stiffer(double area, double inertia) {
  const Section section{area * inch * inch, inertia * inch * inch * inch * inch / 12, inch};
  return Beam(thesis_length, section, Material{thesis_young}, Support::pinned, Support::clamped);
}

template <class Element>
double force(const Beam& beam) {
  FemModel<Element> model(beam, 8, tight_solver());
  double sum = 0;
  for (const double d : {0.005, 0.02, 0.05}) {
    const Response<double> response = model.press({1.0, d});
    CHECK(response.status == Status::ok);
    sum += response.force;
  }
  return sum;
}

}  // namespace

TEST_CASE("only the type itself that says so is exact under tension", "[element]") {
  STATIC_REQUIRE(exact_under_tension<VonKarman<>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<VonKarman<AssumedStrain>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<VonKarman<ReducedIntegration>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<Linear>);
  STATIC_REQUIRE_FALSE(exact_under_tension<Corotational<>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<DoubledTangent<VonKarman<>>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<DoubledResponse<VonKarman<>>>);
  STATIC_REQUIRE_FALSE(exact_under_tension<DoubledMembrane>);
  STATIC_REQUIRE_FALSE(exact_under_tension<VonKarman<DoubledMembrane>>);
}

TEMPLATE_TEST_CASE("an element that inherits and answers twice as much takes twice the force", "[element]",
                   VonKarman<>, VonKarman<AssumedStrain>, Linear) {
  const double once = force<TestType>(stiffer(1, 1));
  CHECK(relative_error(force<DoubledTangent<TestType>>(stiffer(1, 1)), 2 * once) <= 1e-12);
  CHECK(relative_error(force<DoubledResponse<TestType>>(stiffer(1, 1)), 2 * once) <= 1e-12);
}

TEST_CASE("a membrane that inherits and answers twice as much is that of twice the area", "[element]") {
  CHECK(relative_error(force<VonKarman<DoubledMembrane>>(stiffer(1, 1)),
                       force<VonKarman<AssumedStrain>>(stiffer(2, 1))) <= 1e-12);
}
