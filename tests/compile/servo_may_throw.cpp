// A servo that may throw would throw through the device's thread, or through a vendor's C code.
// expect: a servo is called as: Eigen::Vector3d servo\(const DeviceState&\) noexcept
#include <hapbeam/haptics/device/virtual_phantom.hpp>

#ifdef HAPBEAM_REPAIRED
#define PROMISE noexcept
#else
#define PROMISE
#endif

struct Servo {
  Eigen::Vector3d operator()(const hapbeam::DeviceState&) PROMISE { return Eigen::Vector3d::Zero(); }
};

void begin(hapbeam::VirtualPhantom<>& device, Servo& servo) { device.start(servo); }
