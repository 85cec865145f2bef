// What test_same_bits.py must feel, from the headers: a line for each case, its name and its numbers.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

using namespace hapbeam;

namespace {

template <class Vector>
void print(const char* name, const Vector& numbers, int count) {
  std::printf("%s", name);
  for (int k = 0; k < count; ++k) std::printf(" %.17g", numbers[k]);
  std::printf("\n");
}

template <class Model>
void press(const char* name, Model model) {
  Touch<Model> touch(model, 0.005);
  TouchResult<double> felt;
  for (int i = 0; i < 400; ++i) felt = touch.tick({0.2 + 1e-4 * i, 0.006 - 5e-5 * i});
  print(name, felt.force, 2);
  const Vector2<double> middle = model.shape().position(0.15);
  print("shape", middle, 2);
}

void press_rod() {
  const Rod wire(0.2, RodSection::circle(0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped,
                 RodSupport::free);
  FemModel<TwistedRod> model(wire, 8);
  Touch<FemModel<TwistedRod>> touch(model, 0.003);
  TouchResult<double, 3> felt;
  for (int i = 0; i < 400; ++i)
    felt = touch.tick({0.15, 0.004 - 2e-5 * i, 0.02}, VectorOf<double, 3>(0, 0, -0.05));
  print("rod", felt.force, 3);
}

void run_loop(const Beam& ruler) {
  FemModel<Corotational<>> model(ruler, 8);
  VirtualPhantom<> device(HandPath({0, 0.006}).press(0.02, 0.3));
  ServoOptions options;
  options.placement = Placement::in_plane({0.25, 0});
  Servo<FemModel<Corotational<>>> servo(model, device.info(), options);
  device.run(servo, 0.4);
  print("loop", servo.record().force, 3);
}

}  // namespace

int main() {
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free);
  press("linear", FemModel<Linear>(ruler, 8));
  press("von_karman", FemModel<>(ruler, 8));
  press("corotational", FemModel<Corotational<>>(ruler, 8));
  press_rod();
  run_loop(ruler);
}
