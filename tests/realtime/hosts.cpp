// A beam in a host's loop: no heap and no lock, whatever the host asks, while another thread looks.
#include <limits>
#include <realtime/heap_watch.hpp>
#include <realtime/lock_watch.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/hosts/chai3d.hpp>
#include <hapbeam/hosts/hapi.hpp>
#include <hapbeam/hosts/sofa.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

static_assert(noexcept(std::declval<PlacedTouch<FemModel<>>&>().tick(
    std::declval<
        const Eigen::Vector3d&>())) && noexcept(std::declval<PlacedTouch<FemModel<VonKarman<>, float>>&>()
                                                    .picture()));

TEST_CASE("CHAI3D, HAPI, SOFA: 3 × 5000 ticks of touching, sliding and nonsense: no heap, no lock") {
  FemModel<> models[] = {{thesis_beam(Support::pinned, Support::pinned), 8},
                         {thesis_beam(Support::pinned, Support::pinned), 8},
                         {thesis_beam(Support::pinned, Support::pinned), 8}};
  Chai3dBeam<FemModel<>> chai3d_beam(models[0], 0.005);
  HapiBeam<FemModel<>> hapi_beam(models[1], 0.005, Placement());
  SofaBeam<FemModel<>> sofa_beam(models[2], 0.005, Placement());
  HAPI::HAPIHapticsDevice device;
  chai3d::cInteractionRecorder recorder;
  recorder.m_interactions.reserve(1);  // the host's own
  Random random(1);
  long touched = 0, not_finite = 0, locks = -1;
  const auto run = [&] {
    for (int tick = 0; tick < 5000; ++tick) {
      const double x = random(0.2, 2.3), w = tick % 100 == 99 ? std::numeric_limits<double>::quiet_NaN()
                                                              : 0.03 * std::cos(0.01 * tick);
      recorder.m_interactions.clear();
      const auto in_chai3d = chai3d_beam.computeInteractions({0, x, w}, {}, 0, recorder);
      device.position = {x, w, 0};
      const auto in_hapi = hapi_beam.calculateForces({&device, 1e-3}).force;
      double in_sofa[3];
      sofa_beam.computeForce(x, w, 0, 0, 0, 0, 1, in_sofa[0], in_sofa[1], in_sofa[2]);
      (void)chai3d_beam.touch().picture();
      touched += in_chai3d.z() != 0;
      not_finite += !std::isfinite(in_chai3d.z() + in_hapi.y + in_sofa[1]);
    }
  };
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(touched > 1000);
  CHECK(not_finite == 0);
}

TEST_CASE("a placed stylus: 5000 ticks of touching, turning and nonsense: no heap, no lock") {
  using Model = FemModel<RoundRod>;
  static_assert(noexcept(std::declval<PlacedTouch<Model>&>().tick(std::declval<const HandPose&>())));
  Model model(
      Rod(0.2, RodSection::circle(0.002), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free),
      8);
  PlacedTouch<Model> placed(model, 0.003, Placement(), {0.2, 0.1});
  long touched = 0, not_finite = 0, locks = -1;
  const auto run = [&] {
    for (int tick = 0; tick < 5000; ++tick) {
      const double t = 0.01 * tick, c = std::cos(0.2 * std::sin(t)), s = std::sin(0.2 * std::sin(t));
      HandPose hand{{0.14, 0.004 + 0.01 * std::cos(t), 0.02 * std::sin(0.3 * t)},
                    Eigen::Matrix3d::Identity()};
      hand.turn(1, 1) = hand.turn(2, 2) = c, hand.turn(1, 2) = -s, hand.turn(2, 1) = s;
      if (tick % 100 == 99) hand.turn(1, 2) = std::numeric_limits<double>::quiet_NaN();
      const Wrench felt = placed.tick(hand);
      (void)placed.picture();
      touched += !felt.torque.isZero(0);
      not_finite += !felt.force.allFinite() || !felt.torque.allFinite();
    }
  };
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(touched > 1000);
  CHECK(not_finite == 0);
}
