#include <memory>
#include <utility>
#include <variant>

#include "couple.hpp"
#include "hands.hpp"
#include <hapbeam/fem/dynamic_model.hpp>

namespace phantom {

std::unique_ptr<Body> couple_with_mass(Parts parts) {
  using namespace hapbeam;
  constexpr int parts_of_a_tick = 48;  // of 21 µs: they are heard
  DynamicModel<> model(std::get<Beam>(parts.slender), parts.options.elements, parts_of_a_tick);
  return couple<OneHand>(std::move(model), std::move(parts));
}

}  // namespace phantom
