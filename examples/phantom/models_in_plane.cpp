#include <memory>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "counted.hpp"
#include "couple.hpp"
#include "hands.hpp"
#ifdef HAPBEAM_EXAMPLES_WINDOW
#include "window/press_curve.hpp"
#endif
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace phantom {

namespace {

template <typename Element>
std::unique_ptr<Body> couple_full(Parts parts) {
  auto model = make_model<hapbeam::FemModel<Element>>(parts);
  return couple_any(std::move(model), std::move(parts));
}

}  // namespace

std::unique_ptr<Body> couple_in_plane(Parts parts) {
  using namespace hapbeam;
  switch (parts.options.element) {
    case ElementChoice::linear: return couple_full<Linear>(std::move(parts));
    case ElementChoice::full: return couple_full<VonKarman<FullIntegration>>(std::move(parts));
    case ElementChoice::reduced: return couple_full<VonKarman<ReducedIntegration>>(std::move(parts));
    case ElementChoice::corotational: return couple_hands<Corotational<>>(std::move(parts));
    case ElementChoice::tapered: return couple_full<Corotational<Tapered<>>>(std::move(parts));
    case ElementChoice::stability_functions:
    case ElementChoice::round_rod:
    case ElementChoice::twisted_rod:
    case ElementChoice::with_mass: break;
  }
  return couple_full<VonKarman<>>(std::move(parts));
}

std::unique_ptr<Body> couple_many(Parts parts) {
  const Options& options = parts.options;
  std::vector<hapbeam::BeamPlace> places;
  for (int i = 0; i < options.beams; ++i) places.push_back({{0, -options.pitch * i}, 0, 0});
  using Tooth = Touchable<hapbeam::Corotational<>>;
  auto array = std::make_unique<hapbeam::BeamArray<Tooth>>(*make_model<Tooth>(parts), places);
  return couple<OneHand>(std::move(array), std::move(parts));
}

// In this unit it shares what its loop is made of.
std::unique_ptr<Body> couple_with_mass(Parts parts) {
  using namespace hapbeam;
  constexpr int parts_of_a_tick = 48;  // of 21 µs: they are heard
  auto model = std::make_unique<DynamicModel<>>(std::get<Beam>(parts.slender), parts.options.elements,
                                                parts_of_a_tick);
  return couple<OneHand>(std::move(model), std::move(parts));
}

std::unique_ptr<Body> couple_trained(Parts parts) {
  using Full = hapbeam::FemModel<>;
  const std::shared_ptr<const Trained> trained = parts.trained;
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!parts.options.guarded) return couple_any(std::make_unique<Fast>(fast), std::move(parts));
        parts.full_answers = std::make_unique<Count>(0);
        auto guarded = std::make_unique<Counted<Fast, Full>>(
            fast, Full(std::get<hapbeam::Beam>(parts.slender), parts.options.elements), *parts.full_answers);
        return couple_any(std::move(guarded), std::move(parts));
      },
      trained->model);
}

#ifdef HAPBEAM_EXAMPLES_WINDOW
std::vector<Curve> curves_in_plane(const hapbeam::Beam& beam, const PressLine& line) {
  using namespace hapbeam;
  std::vector<Curve> curves;
  add_curve<FemModel<Linear>>(curves, "linear", beam, line);
  add_curve<FemModel<>>(curves, "von Karman", beam, line);
  add_curve<Touchable<Corotational<>>>(curves, "corotational", beam, line);
  return curves;
}
#endif

}  // namespace phantom
