// SPDX-License-Identifier: MIT
// A stylus on a rod of TwistedRod.
#include "stylus.hpp"
#include <hapbeam/element/twisted_rod.hpp>

namespace hapbeam::border {

std::unique_ptr<hapbeam_stylus> on_twisted_rod(const StylusRequest& request) {
  return std::make_unique<StylusOn<TwistedRod>>(request);
}

}  // namespace hapbeam::border
