// What a scene chooses is a ForceModel, whichever it is.
#include "conformance/force_model_suite.hpp"
#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/scene/build.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("a scene's model keeps the contract of a ForceModel", "[contract][scene]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const auto check = [&](const Scene& scene, const Candidate& candidate) {
    check_force_model([&] { return build(scene, candidate); });
  };
  const Scene any = Scene::anywhere(beam, 0.05);
  SECTION("elements") { check(any, {Kinematics::von_karman, Reduction::none, 12}); }
  SECTION("POD, trained by elements of any rotation") {
    check(any, {Kinematics::corotational, Reduction::pod, 32, 12, 10});
  }
  SECTION("Galerkin") { check(any, {Kinematics::von_karman, Reduction::galerkin, 32, 12, 10}); }
}
