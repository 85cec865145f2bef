#include <memory>
#include <utility>

#include "couple.hpp"
#include "hands.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace phantom {

std::unique_ptr<Body> couple_in_space(Parts parts) {
  if (parts.options.element == ElementChoice::round_rod)
    return couple_hands<hapbeam::RoundRod>(std::move(parts));
  return couple_hands<hapbeam::TwistedRod>(std::move(parts));
}

}  // namespace phantom
