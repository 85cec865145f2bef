// FemModel of any rotation as a ForceModel: each local part, scalar and kind of size.
#include "conformance/force_model_suite.hpp"
#include "conformance/touch_laws.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/tapered.hpp>
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
using TurningTapered = FemModel<Corotational<Tapered<>>>;
using TurningTaperedFloat = FemModel<Corotational<Tapered<>>, float>;
using TurningBounded = FemModel<Corotational<>, float, any, 12>;

}  // namespace

TEMPLATE_TEST_CASE("FemModel of any rotation keeps the contract of a ForceModel between hinges", "[contract]",
                   Turning, TurningLinear, TurningReduced, TurningFull, TurningFloat, TurningLinearFloat,
                   TurningFixed, TurningBounded) {
  static_assert(takes_push<TestType>);
  check_force_model([] { return TestType(thesis_beam(Support::pinned, Support::pinned), 8); });
}

TEMPLATE_TEST_CASE("FemModel of a taper keeps the contract of a ForceModel between hinges",
                   "[contract][taper]", FemModel<Tapered<>>, TurningTapered, TurningTaperedFloat) {
  check_force_model([] {
    Beam beam(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::pinned, Support::pinned);
    beam.section([](double s) { return Section::rectangle(0.025, 0.003 - 0.005 * s); });
    return TestType(beam, 8);
  });
}

TEMPLATE_TEST_CASE("a touch of a beam of any rotation keeps Coulomb's law", "[contract][friction]",
                   (FemModel<Corotational<>>), (FemModel<Corotational<>, float>),
                   (FemModel<Corotational<Linear>>), (FemModel<Corotational<>, double, 8>)) {
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free);
  check_friction([&] { return TestType(ruler, 8); }, typename TestType::Scalar(0.005));
}

TEST_CASE("a touch of a beam that is pressed across has no friction", "[contract][friction]") {
  check_friction([] { return FemModel<>(thesis_beam(Support::pinned, Support::pinned), 8); }, 0.005);
}
