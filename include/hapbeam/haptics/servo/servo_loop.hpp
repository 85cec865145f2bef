// SPDX-License-Identifier: MIT
// A device and a model make a loop that runs until it is told to stop.
//
//   FemModel<> model(beam, 16);
//   VirtualPhantom<> device(path);                   // or an Hdapi device
//   ServoLoop loop(device, model);                   // coupling and limits from the device's own figures
//   loop.start();
//   while (…) draw(loop.picture().shape());          // graphics, at its own pace
//   loop.stop();                                     // no tick runs any more, the force is zero
//
// Building allocates and throws; what runs each period is Servo::tick().
#pragma once

#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

namespace hapbeam {

template <typename Device, typename Model, typename Coupling = typename CouplingOf<Model>::Type>
class ServoLoop {
 public:
  using Picture = typename Servo<Model, Coupling>::Picture;

  /// @param device, model  kept by reference; both outlive the loop   @throws as Servo
  ServoLoop(Device& device, Model& model, const ServoOptions& options = {})
      : device_(checked(device)), servo_(model, device.info(), options) {}
  ServoLoop(Device& device, Model& model, const ServoOptions& options, const Coupling& coupling)
      : device_(checked(device)), servo_(model, device.info(), options, coupling) {}
  ~ServoLoop() { stop(); }
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Begins anew: nothing is touched, counts are zero.  @throws what the device throws
  void start() {
    if (!running()) stop(), servo_.reset();
    device_.start(servo_);
  }
  /// Blocks until the last tick has returned.
  void stop() noexcept { device_.stop(); }
  bool running() const noexcept { return device_.running(); }  ///< wait-free; false where the device ended it

  /// The newest record and shape, from one reader: wait-free.
  const Picture& picture() noexcept { return servo_.picture(); }
  const TickTimes& times() const noexcept { return servo_.times(); }
  Servo<Model, Coupling>& servo() noexcept { return servo_; }  ///< for a device in lock step

 private:
  static Device& checked(Device& device) noexcept {
    require_device<Device>();
    return device;
  }

  Device& device_;
  Servo<Model, Coupling> servo_;
};

}  // namespace hapbeam
