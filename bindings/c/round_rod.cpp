// SPDX-License-Identifier: MIT
// A stylus on a rod of RoundRod.
#include "stylus.hpp"
#include <hapbeam/element/rod.hpp>

namespace hapbeam::border {

std::unique_ptr<hapbeam_stylus> on_round_rod(const StylusRequest& request) {
  return std::make_unique<StylusOn<RoundRod>>(request);
}

}  // namespace hapbeam::border
