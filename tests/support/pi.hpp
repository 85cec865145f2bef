#pragma once

namespace hapbeam::testing {

inline constexpr double pi = 3.141592653589793238462643;

}  // namespace hapbeam::testing
