// A scene whose beam has several sections: no model among which choose() chooses takes it.
#include <string>

#include "once_training.hpp"
#include "support/catch.hpp"
#include <hapbeam/scene/choose.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("choose() and build() reject a beam whose section changes, and name the model to take",
          "[scene][taper]") {
  Beam beam(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::clamped, Support::free);
  beam.section([](double s) { return Section::rectangle(0.025, 0.003 - 0.005 * s); });
  const Scene scene = Scene::anywhere(beam, 0.005);
  const std::string models =
      "take FemModel<Tapered<>>, or FemModel<Corotational<Tapered<>>> for finite rotation";
  CHECK_THROWS_WITH(choose(scene), ContainsSubstring("scene beam sections = 1") && ContainsSubstring(models));
  const Beam shears =
      Beam(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::clamped, Support::free)
          .shear(5e6);
  CHECK_THROWS_WITH(choose(Scene::anywhere(shears, 0.005)),
                    ContainsSubstring("scene beam shear stiffness") && ContainsSubstring(models));
  CHECK_THROWS_WITH(build(scene, {Kinematics::von_karman, Reduction::none, 8}), ContainsSubstring(models));
}
