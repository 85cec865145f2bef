// A scene's model in a servo loop: one switch more than the model itself, and no heap.
#include <realtime/heap_watch.hpp>

#include "once_training.hpp"
#include "realtime/requests.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/scene/build.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

static_assert(is_force_model<SceneModel>);
static_assert(noexcept(std::declval<SceneModel&>().force(std::declval<const Press<double>&>())));

TEST_CASE("a scene's model touches no heap, whatever is asked, and every force is finite") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const Candidate candidate = GENERATE(Candidate{Kinematics::linear, Reduction::none, 8},
                                       Candidate{Kinematics::von_karman, Reduction::none, 8},
                                       Candidate{Kinematics::corotational, Reduction::none, 8},
                                       Candidate{Kinematics::corotational, Reduction::pod, 16, 1, 8},
                                       Candidate{Kinematics::von_karman, Reduction::galerkin, 16, 1, 8});
  SceneModel model = build(Scene::at(beam, thesis_length / 2, 0.02), candidate);
  const auto path = requests(model.range(), model.shape().length(), 1);
  int not_finite = 0;
  CHECK(heap_use([&] {
          for (const Press<double>& press : path) {
            not_finite += !std::isfinite(model.press(press).force);
            not_finite += !std::isfinite(model.force(press).force);
            for (const auto& node : model.shape()) not_finite += !std::isfinite(node.u + node.w + node.theta);
          }
          model.reset();
        }) == HeapUse{});
  CHECK(not_finite == 0);
}
