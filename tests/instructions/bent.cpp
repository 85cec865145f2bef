#include "instructions/strokes.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

void hapbeam::testing::bent() {
  using Model = FemModel<Corotational<>>;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free),
      bow = arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), Material{200e9}, Support::pinned);
  press_and_slide("ruler 8 elements", Model(ruler, 8), 0.005, {0.11, 0.0055}, 0.1, 0.1);
  press_and_slide("arch 8 elements", Model(bow, 8), 0.005, {0.085, 0.01698}, 0.009, 0.03);
}
