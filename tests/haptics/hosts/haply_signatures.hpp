// Haply's HardwareAPI for C++, as far as the page uses it: names, types and what a call does, stated anew from its reference.
#pragma once

#include "haptics/hosts/pressing_hand.hpp"

namespace Haply::HardwareAPI {
namespace IO {
struct SerialStream {
  explicit SerialStream(const char*) {}
};
}  // namespace IO
namespace Devices {
class Inverse3 {
 public:
  struct EndEffectorForceRequest {
    float force[3]{0, 0, 0};
  };
  struct EndEffectorStateResponse {
    float position[3]{0, 0, 0}, velocity[3]{0, 0, 0};
  };
  explicit Inverse3(IO::SerialStream*) {}
  int DeviceWakeup() { return 0; }
  EndEffectorStateResponse EndEffectorForce(const EndEffectorForceRequest& request) {
    auto& hand = hapbeam::testing::pressing_hand;
    hand.feel(static_cast<double>(request.force[2]));
    hand.time += 1e-3;
    EndEffectorStateResponse response;
    response.position[2] = static_cast<float>(hand.height());
    response.velocity[2] = static_cast<float>(hand.climb());
    return response;
  }
};
}  // namespace Devices
}  // namespace Haply::HardwareAPI
