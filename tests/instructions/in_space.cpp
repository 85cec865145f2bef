#include "instructions/strokes.hpp"
#include "rod/rods.hpp"

namespace hapbeam::testing {
namespace {

template <class Model>
void push(const std::string& name, Model model, const PressedRod& pressed, double depth) {
  volatile double felt = 0;
  const double rest = model.shape().at(pressed.s).r.dot(pressed.normal);
  count(name, [&](int k) {
    felt = model.push({pressed.s, rest - depth * out_and_back(k), pressed.normal}).force;
  });
  static_cast<void>(felt);
}

}  // namespace

void in_space() {
  const PressedRod wire = pressed_rod("wire_under_load"), strip = pressed_rod("strip_askew");
  push("RoundRod 8 elements: in and out", FemModel<RoundRod>(wire.rod, 8), wire, 0.02);
  push("TwistedRod 8 elements: in and out", FemModel<TwistedRod>(strip.rod, 8), strip, 0.02);
}

}  // namespace hapbeam::testing
