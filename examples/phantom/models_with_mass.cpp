#include <memory>
#include <utility>
#include <variant>

#include "couple.hpp"
#include "hands.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/dynamic_model.hpp>

namespace phantom {

std::unique_ptr<Body> couple_with_mass(Parts parts) {
  using namespace hapbeam;
  // Parts of 21 µs are heard, and the partials of a string are those of these elements.
  constexpr int parts_of_a_tick = 48;
  DynamicModel<Corotational<VonKarman<AssumedStrain>>> model(std::get<Beam>(parts.slender),
                                                             parts.options.elements, parts_of_a_tick);
  return couple<OneHand>(std::move(model), std::move(parts));
}

}  // namespace phantom
