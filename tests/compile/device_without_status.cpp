// A device that does not say how it is leaves nobody a reason why its loop has ended.
// expect: status\(\) const noexcept -> DeviceStatus
#include <hapbeam/haptics/device/device.hpp>

struct Device {
  hapbeam::DeviceInfo info() const;
  template <typename Servo>
  void start(Servo&);
  void stop() noexcept;
  bool running() const noexcept;
#ifdef HAPBEAM_REPAIRED
  hapbeam::DeviceStatus status() const noexcept;
#endif
  hapbeam::DeviceCounts counts() const noexcept;
};

void check() { hapbeam::require_device<Device>(); }
