// FemModel as a ForceModel: each element, scalar and kind of size; those of any rotation in corotational.cpp.
#include <string>

#include "conformance/force_model_suite.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr int any = Eigen::Dynamic;

using Default = FemModel<>;
using Full = FemModel<VonKarman<FullIntegration>>;
using Reduced = FemModel<VonKarman<ReducedIntegration>>;
using LinearModel = FemModel<Linear>;
using Float = FemModel<VonKarman<>, float>;
using LinearFloat = FemModel<Linear, float>;
using Fixed = FemModel<VonKarman<>, double, 8>;
using Bounded = FemModel<VonKarman<>, double, any, 12>;
using FixedFloat = FemModel<VonKarman<ReducedIntegration>, float, 8>;

using Turning = FemModel<Corotational<>>;

}  // namespace

TEMPLATE_TEST_CASE("FemModel keeps the contract of a ForceModel between hinges", "[contract]", Default, Full,
                   Reduced, LinearModel, Float, LinearFloat, Fixed, Bounded, FixedFloat) {
  check_force_model([] { return TestType(thesis_beam(Support::pinned, Support::pinned), 8); });
}

TEMPLATE_TEST_CASE("FemModel keeps the contract of a ForceModel on other supports", "[contract]", Default,
                   Turning) {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::clamped, Support::clamped},
                                                               {Support::clamped, Support::free},
                                                               {Support::roller, Support::guided},
                                                               {Support::guided, Support::pinned}}));
  const Support one = left, other = right;
  check_force_model([one, other] { return TestType(thesis_beam(one, other), 8); });
}
