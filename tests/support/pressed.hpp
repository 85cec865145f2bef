// The force of a press on a new model, which answers it.
#pragma once

#include "support/catch.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

template <class Model>
double pressed(const Beam& beam, int elements, double s, double d) {
  Model model(beam, elements);
  const auto response = model.press({s, d});
  CHECK(response.status == Status::ok);
  return response.force;
}

}  // namespace hapbeam::testing
