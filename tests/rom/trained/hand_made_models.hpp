// Small models with made-up numbers: what files, checks and interpolation do with them is exact, whatever they are.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam::testing {

/// Numbers without a short decimal form, in [1, 2).
template <typename S>
std::vector<S> irregular(std::size_t size, double scale = 1) {
  std::vector<S> values;
  for (std::size_t k = 0; k < size; ++k)
    values.push_back(
        static_cast<S>(scale * (1 + std::fmod(0.6180339887498949 * static_cast<double>(k + 1), 1.0))));
  return values;
}

template <typename S>
BeamData<S> hand_made_beam(Support left = Support::pinned, Support right = Support::clamped) {
  return {S(2.54), S(1.3344e8), S(7174.3), S(0.0254), left, right};
}

template <typename S>
ShapeData<S> hand_made_shape(std::size_t grid) {
  return {2, 1, 2, irregular<S>(18, 0.3), irregular<S>(2 * grid, -0.7), irregular<S>(9, 1e-9)};
}

inline ErrorReport hand_made_errors() {
  return {"finite elements, \"256\" of them: 10\u207b\u2074",
          {500, 1.1e-5, 0.1, 1.0 / 3, 5e-324, 1.7e308},
          {{0.127, 1.27, 0, 0.025, {250, 1e-5, 2e-5, 3e-5, 4e-5, 5e-5}},
           {1.27, 2.413, 0.025, 0.05, {0, 0, 0, 0, 0, 0}}},
          0.25,
          1e-7};
}

template <typename S>
TrainedData<S> hand_made(const BeamData<S>& beam) {
  return {beam, S(0.127), S(2.413), S(0.05), 3, hand_made_shape<S>(9), hand_made_errors()};
}

/// 3 positions × 3 depths, 2 modes, 2 segments.
template <typename S>
PodModelData<S> hand_made_pod(bool symmetric = true) {
  return {hand_made(hand_made_beam<S>()),
          symmetric,
          3,
          symmetric ? S(0) : S(-2.9),
          symmetric ? S(8.4) : S(2.9),
          irregular<S>(9, 500),
          irregular<S>(3, symmetric ? 0 : 1e-4)};
}

/// 3 positions × 3 tensions, 2 modes, 2 segments.
template <typename S>
GalerkinModelData<S> hand_made_galerkin() {
  std::vector<S> log_stiffness;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) log_stiffness.push_back(static_cast<S>(std::log(500 + 30.1 * i) + 0.3 * j));
  return {hand_made(hand_made_beam<S>(Support::pinned, Support::pinned)), 3, S(1e5), log_stiffness};
}

}  // namespace hapbeam::testing
