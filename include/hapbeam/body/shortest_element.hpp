// SPDX-License-Identifier: MIT
// How short an element may be.
#pragma once

#include <cmath>
#include <limits>

namespace hapbeam::detail {

/// Shortest element of a beam that round-off allows [m]: it costs 12 eps (L/l)² of the force beside a support that holds w and
/// up to 4 eps (L/l)³ beside a free end, here 1e-9 and 1e-6 in double, 1e-3 and 1e-2 in float.
template <typename S>
S shortest_element(S length) noexcept {
  using std::sqrt;
  const S by_round_off = 100 * sqrt(std::numeric_limits<S>::epsilon());
  return length * (by_round_off > S(1e-3) ? by_round_off : S(1e-3));
}

}  // namespace hapbeam::detail
