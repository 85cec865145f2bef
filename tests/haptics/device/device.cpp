// The device contract: who fulfils it, and what may be sent to the motors.
#include <limits>
#include <random>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

using namespace hapbeam;

namespace {

struct Good {
  Eigen::Vector3d operator()(const DeviceState&) noexcept { return Eigen::Vector3d::Zero(); }
};
struct MayThrow {
  Eigen::Vector3d operator()(const DeviceState&) { return Eigen::Vector3d::Zero(); }
};
struct ReturnsExpression {
  auto operator()(const DeviceState& state) noexcept { return state.position.cwiseAbs(); }
};
struct WantsPosition {
  Eigen::Vector3d operator()(const Eigen::Vector3d& position) noexcept { return position; }
};
static_assert(is_servo<Good>);
static_assert(!is_servo<const Good>, "its call is not const");
static_assert(!is_servo<MayThrow>);
static_assert(!is_servo<ReturnsExpression>);
static_assert(!is_servo<WantsPosition>);

struct StopMayThrow {
  DeviceInfo info() const;
  template <typename Servo>
  void start(Servo&);
  void stop();
  bool running() const noexcept;
  DeviceStatus status() const noexcept;
  DeviceCounts counts() const noexcept;
};
struct Device : StopMayThrow {
  void stop() noexcept;
};
static_assert(is_device<VirtualPhantom<>>);
static_assert(is_device<Device>);
static_assert(!is_device<StopMayThrow>);
static_assert(!is_device<Good>);

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a force below the peak is sent as it is, to the bit", "[device]") {
  for (const Eigen::Vector3d& wanted : {Eigen::Vector3d(1, -2, 3), Eigen::Vector3d(0, 0, 0),
                                        Eigen::Vector3d(37.5, 0, 0), Eigen::Vector3d(5e-324, 0, 0)}) {
    Eigen::Vector3d sent = wanted;
    CHECK(limit_force(sent, 37.5) == ForceCut::none);
    CHECK(sent == wanted);
  }
}

TEST_CASE("a force beyond the peak keeps its direction and has the length of the peak", "[device]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> component(-1, 1), exponent(2, 308);
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(component(random), component(random), component(random)).normalized();
    Eigen::Vector3d sent = direction * std::pow(10, exponent(random)) / 2;
    REQUIRE(limit_force(sent, 37.5) == ForceCut::peak);
    // Two roundings of a length and one of a quotient.
    REQUIRE((sent - 37.5 * direction).norm() <= 37.5 * 8 * std::numeric_limits<double>::epsilon());
  }
}

TEST_CASE("a force that is not finite becomes zero", "[device]") {
  for (const double bad : {not_a_number, inf, -inf})
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d sent(1, 1, 1);
      sent[axis] = bad;
      CHECK(limit_force(sent, 37.5) == ForceCut::not_finite);
      CHECK(sent == Eigen::Vector3d::Zero());
    }
}

TEST_CASE("each status of a device has a name of its own, and says whether the loop goes on", "[device]") {
  using Status = DeviceStatus;
  const Status all[] = {Status::stopped,      Status::running,           Status::warm,
                        Status::force_error,  Status::calibrating,       Status::calibration_needed,
                        Status::device_fault, Status::communication_lost};
  int running = 0;
  for (const Status a : all) {
    running += is_running(a);
    CHECK(std::string(name(a)) != "unknown");
    for (const Status b : all) CHECK((std::string(name(a)) == name(b)) == (a == b));
  }
  CHECK(running == 4);
}
