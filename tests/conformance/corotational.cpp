// FemModel of any rotation as a ForceModel: each local part, scalar and kind of size.
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

using Turning = FemModel<Corotational<>>;
using TurningLinear = FemModel<Corotational<Linear>>;
using TurningReduced = FemModel<Corotational<VonKarman<ReducedIntegration>>>;
using TurningFull = FemModel<Corotational<VonKarman<FullIntegration>>>;
using TurningFloat = FemModel<Corotational<>, float>;
using TurningLinearFloat = FemModel<Corotational<Linear>, float>;
using TurningFixed = FemModel<Corotational<>, double, 8>;
using TurningBounded = FemModel<Corotational<>, float, any, 12>;

}  // namespace

TEMPLATE_TEST_CASE("FemModel of any rotation keeps the contract of a ForceModel between hinges", "[contract]",
                   Turning, TurningLinear, TurningReduced, TurningFull, TurningFloat, TurningLinearFloat,
                   TurningFixed, TurningBounded) {
  static_assert(takes_push<TestType>);
  check_force_model([] { return TestType(thesis_beam(Support::pinned, Support::pinned), 8); });
}
