#include "history.hpp"

#include <algorithm>
#include <cmath>

namespace phantom {

double History::decades(double seconds) { return std::log10(std::max(seconds, 1e-9) / 1e-7); }

std::size_t History::bin(double seconds) {
  return static_cast<std::size_t>(std::clamp(decades(seconds) * 10, 0.0, static_cast<double>(bins - 1)));
}

}  // namespace phantom
