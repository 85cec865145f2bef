// The curve of one model.
#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include "curves.hpp"
#include <hapbeam/force_model.hpp>

namespace phantom {

/// Down from where it rests, or along the direction.   @param model  at rest
template <typename Model>
Curve pressed(const char* name, Model& model, const PressLine& line) {
  constexpr int presses = 48;
  Curve curve{name, {}, {}};
  const auto at_rest = model.shape().at(line.place);
  for (int i = 1; i <= presses; ++i) {
    const double d = line.depth * i / presses;
    hapbeam::Response<double> response;
    if constexpr (Model::dimension == 2) {
      response = model.press({line.place, at_rest.w - d});
      response.force = -response.force;
    } else {
      response = model.push({line.place, line.along.dot(at_rest.r) + d, line.along});
    }
    if (response.status != hapbeam::Status::ok) break;
    if (i == 1) curve.depth.push_back(0), curve.force.push_back(0);
    curve.depth.push_back(static_cast<float>(d));
    curve.force.push_back(static_cast<float>(response.force));
  }
  return curve;
}

template <typename Model>
void add_curve(std::vector<Curve>& curves, const char* name, const typename Model::Body& body,
               const PressLine& line) {
  try {
    Model model(body, line.elements);
    Curve curve = pressed(name, model, line);
    if (!curve.depth.empty()) curves.push_back(std::move(curve));
  } catch (const std::exception&) {
    // A beam that this kinematics refuses has no curve.
  }
}

}  // namespace phantom
