// The device that ticks, whichever it is: the simulated Phantom, or a real one where this was built with OpenHaptics.
#pragma once

#include <memory>

#include "hand.hpp"
#include "options.hpp"
#include "relay.hpp"
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/servo/real_time.hpp>

namespace phantom {

/// As hapbeam's device contract, for one servo.
class Device {
 public:
  virtual ~Device() = default;
  virtual void start(Relay& servo) = 0;
  virtual void stop() noexcept = 0;
  virtual void run(Relay& servo, double duration) noexcept = 0;  ///< [s] in lock step; only where simulated
  virtual const hapbeam::DeviceInfo& info() const noexcept = 0;
  virtual hapbeam::DeviceStatus status() const noexcept = 0;
  virtual hapbeam::DeviceCounts counts() const noexcept = 0;
  virtual bool simulated() const noexcept = 0;              ///< its hand can be led
  virtual hapbeam::RealTime priority() const noexcept = 0;  ///< of its thread in real time
};

/// The servo is asked in each tick: what its record says is so now.
inline bool asks(const Device& device) noexcept {
  const hapbeam::DeviceStatus status = device.status();
  return device.simulated() || (is_running(status) && status != hapbeam::DeviceStatus::calibrating);
}

/// @param hand  of the simulated one; kept by reference   @throws std::runtime_error saying why it cannot be had
std::unique_ptr<Device> connect(DeviceChoice choice, Hand& hand);

}  // namespace phantom
