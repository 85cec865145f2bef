// A coupling is called in each tick: what it throws would end the program.
// expect: a coupling has: tick\(touch, hand, dt\) noexcept -> CoupledForce
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

#ifdef HAPBEAM_REPAIRED
#define PROMISE noexcept
#else
#define PROMISE
#endif

struct Coupling {
  static Coupling for_device(const hapbeam::DeviceInfo&, int) { return {}; }
  Coupling in_scene(double) const noexcept { return {}; }
  void reset() noexcept {}
  template <typename Touch>
  hapbeam::CoupledForce<typename Touch::Scalar> tick(Touch&, const hapbeam::Vector2<double>&,
                                                     double) PROMISE {
    return {};
  }
};

using Servo = hapbeam::Servo<hapbeam::FemModel<>, Coupling>;
static_assert(sizeof(Servo) > 0, "");
