#include "instructions/strokes.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

void hapbeam::testing::straight() {
  const Vector2<double> top(1, 0.0227);
  const auto touched = [&](const std::string& name, auto model) {
    press_and_slide(name, model, 0.01, top, 0.04, 0.1);
  };
  touched("bar 8 elements", FemModel<>(pinned(), 8));
  touched("bar 64 elements", FemModel<>(pinned(), 64));
  touched("bar 8 elements in float", FemModel<VonKarman<>, float>(pinned(), 8));
  Beam loaded = pinned();
  touched("loaded bar 8 elements", FemModel<>(loaded.transverse(-20), 8));
}
