#include "device.hpp"

#include <atomic>
#include <stdexcept>

#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/real_time.hpp>
#ifdef HAPBEAM_EXAMPLES_OPENHAPTICS
#include <hapbeam/haptics/hdapi/openhaptics.hpp>
#endif

namespace phantom {

namespace {

/// A servo whose first tick asks for a priority before the threads that draw.
struct Urgent {
  Relay* servo = nullptr;
  std::atomic<bool> asked{false};
  std::atomic<hapbeam::RealTime> priority{hapbeam::RealTime::not_supported};

  Eigen::Vector3d operator()(const hapbeam::DeviceState& state) noexcept {
    if (!asked.exchange(true)) priority = hapbeam::set_real_time_priority(80);
    return (*servo)(state);
  }
};

class Simulated final : public Device {
 public:
  explicit Simulated(Hand& hand) : device_(Guided{&hand}) {}
  void start(Relay& servo) override {
    urgent_.servo = &servo;
    device_.start(urgent_);
  }
  void stop() noexcept override { device_.stop(); }
  void run(Relay& servo, double duration) noexcept override { device_.run(servo, duration); }
  const hapbeam::DeviceInfo& info() const noexcept override { return device_.info(); }
  hapbeam::DeviceStatus status() const noexcept override { return device_.status(); }
  hapbeam::DeviceCounts counts() const noexcept override { return device_.counts(); }
  bool simulated() const noexcept override { return true; }
  hapbeam::RealTime priority() const noexcept override { return urgent_.priority; }

 private:
  Urgent urgent_;
  hapbeam::VirtualPhantom<Guided> device_;
};

#ifdef HAPBEAM_EXAMPLES_OPENHAPTICS

/// The figures that HDAPI does not tell are of the Phantom Premium 1.5/6DOF High Force (docs/haptics.md).
hapbeam::HdapiOptions premium() {
  hapbeam::HdapiOptions options;
  options.position_resolution = 7e-6, options.friction = 0.2, options.apparent_mass = 0.21;
  options.damping = 5;
  return options;
}

class Real final : public Device {
 public:
  Real() : device_(premium()) { device_.calibrate(); }
  void start(Relay& servo) override { device_.start(servo); }
  void stop() noexcept override { device_.stop(); }
  void run(Relay&, double) noexcept override {}
  const hapbeam::DeviceInfo& info() const noexcept override { return device_.info(); }
  hapbeam::DeviceStatus status() const noexcept override { return device_.status(); }
  hapbeam::DeviceCounts counts() const noexcept override { return device_.counts(); }
  bool simulated() const noexcept override { return false; }
  hapbeam::RealTime priority() const noexcept override { return hapbeam::RealTime::done; }

 private:
  hapbeam::Hdapi<hapbeam::OpenHaptics> device_;
};

std::unique_ptr<Device> connect_real() { return std::make_unique<Real>(); }

#else

std::unique_ptr<Device> connect_real() {
  throw std::runtime_error(
      "a Phantom: this program was built without OpenHaptics, its driver's developer kit");
}

#endif

}  // namespace

std::unique_ptr<Device> connect(DeviceChoice choice, Hand& hand) {
  return choice == DeviceChoice::phantom ? connect_real() : std::make_unique<Simulated>(hand);
}

}  // namespace phantom
