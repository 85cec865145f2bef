// A servo that takes an orientation is called where one that does not would be.
// expect: a servo that takes an orientation is called as: Wrench servo\(const OrientedState&\) noexcept
#include <hapbeam/haptics/device/virtual_phantom.hpp>

#ifdef HAPBEAM_REPAIRED
#define PROMISE noexcept
#else
#define PROMISE
#endif

struct Servo {
  Eigen::Vector3d operator()(const hapbeam::DeviceState&) noexcept { return Eigen::Vector3d::Zero(); }
  hapbeam::Wrench operator()(const hapbeam::OrientedState&) PROMISE { return {}; }
};

void begin(hapbeam::VirtualPhantom<>& device, Servo& servo) { device.start(servo); }
