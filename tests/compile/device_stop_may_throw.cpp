// A device whose stop() may throw leaves a loop running that nobody can end.
// expect: a device has: info\(\) const -> DeviceInfo
#include <hapbeam/haptics/device/device.hpp>

#ifdef HAPBEAM_REPAIRED
#define PROMISE noexcept
#else
#define PROMISE
#endif

struct Device {
  hapbeam::DeviceInfo info() const;
  template <typename Servo>
  void start(Servo&);
  void stop() PROMISE;
  bool running() const noexcept;
  hapbeam::DeviceStatus status() const noexcept;
  hapbeam::DeviceCounts counts() const noexcept;
};

void check() { hapbeam::require_device<Device>(); }
