// A program that has a loop already: it hands over position, velocity and the time since the last pass, and gets a force.
// docs/hosts.md has this for CHAI3D, Force Dimension, Haply, OpenHaptics, HAPI and SOFA.
#include <cmath>
#include <cstdio>

#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/device/known_devices.hpp>

int main() {
  using namespace hapbeam;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{210e9}, Support::clamped, Support::free);
  FemModel<Corotational<>> model(ruler, 8);
  ServoOptions options;
  options.placement = Placement::in_plane({0.25, 0});
  Servo<FemModel<Corotational<>>> servo(model, known_device("omega.3"), options);

  double time = 0, printed = 0;
  for (int pass = 0; time < 1; ++pass) {
    const double dt = 1e-3 * (1 + 0.3 * std::sin(2.3 * pass));  // [s] early and late
    time += dt;
    const Eigen::Vector3d position(0, 0.01 * std::cos(3 * time), 0),
        velocity(0, -0.03 * std::sin(3 * time), 0);
    const Eigen::Vector3d force = servo.tick(position, velocity, dt);
    const ServoRecord& record = servo.record();
    // The guard has looked at the status already: the force is zero where there was no answer.  Say so, or end the session.
    if (record.status == LoopStatus::no_answer) return std::printf("no answer: %s\n", name(record.model)), 1;
    if (time - printed >= 0.1)
      printed = time, std::printf("%4.0f ms  %6.3f N  %s\n", 1e3 * time, force.y(), name(record.status));
  }
}
