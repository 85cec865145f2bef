#include "body.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "couple.hpp"
#include <hapbeam/haptics/stability/coupling_limits.hpp>

namespace phantom {

namespace {

/// The coupling's figures, where none were asked for.
Options filled_in(Options options, const hapbeam::DeviceInfo& device) {
  if (options.coupling == CouplingChoice::direct) return options;
  const hapbeam::CouplingFigures safe = hapbeam::safe_coupling(device);
  if (std::isnan(options.stiffness)) options.stiffness = safe.stiffness;
  if (std::isnan(options.damping)) options.damping = safe.damping;
  return options;
}

void check_two_hands(const Options& options) {
  if (options.beams > 1) cli::refuse("--beams", std::to_string(options.beams), "1 with --hands 2");
  if (options.model_choice != ModelChoice::finite_elements)
    throw cli::UsageError("--hands 2: a trained model is pressed by one hand");
  const bool in_space = options.beam.in_space();
  if (in_space ? !bends_in_space(options.element) : options.element != ElementChoice::corotational)
    cli::refuse("--element", name(options.element),
                in_space ? "round-rod or twisted-rod for two hands on a rod in space"
                         : "corotational for two hands on a beam");
}

void check_with_mass(const Options& options) {
  const auto check = [](bool allowed, const char* what) {
    if (!allowed) throw cli::UsageError(std::string("--element with-mass: ") + what);
  };
  check(options.beams == 1, "is a single beam");
  check(options.coupling == CouplingChoice::virtual_coupling, "is touched through a virtual coupling");
}

void check_in_space(const Options& options) {
  if (options.beams > 1) cli::refuse("--beams", std::to_string(options.beams), "1 for a rod in space");
  if (options.model_choice != ModelChoice::finite_elements)
    throw cli::UsageError("a rod in space has no trained model");
  if (!bends_in_space(options.element))
    cli::refuse("--element", name(options.element), "round-rod or twisted-rod for a rod in space");
}

void check_held(const Options& options) {
  if (options.hands != 1) cli::refuse("--hands", "2", "1 with a rod in the hand");
  if (options.element != ElementChoice::round_rod)
    cli::refuse("--element", name(options.element), "round-rod for a rod in the hand");
  if (options.coupling == CouplingChoice::direct)
    cli::refuse("--coupling", name(options.coupling), "virtual for a rod in the hand");
  if (holds_end(options.avatar) && options.place != 0)
    cli::refuse("--place", cli::digits(options.place), "0 where the hand holds the end");
}

}  // namespace

std::unique_ptr<Body> make_body(const Options& options, std::shared_ptr<const Trained> trained,
                                const hapbeam::DeviceInfo& device) {
  if (options.hands == 2) check_two_hands(options);
  if (options.beam.in_space()) {
    check_in_space(options);
    if (options.avatar != Avatar::ball) {
      check_held(options);
      return couple_held({filled_in(options, device), options.beam.make_rod(), nullptr, device});
    }
    return couple_in_space({filled_in(options, device), options.beam.make_rod(), nullptr, device});
  }
  if (options.avatar != Avatar::ball)
    cli::refuse("--beam", options.beam.name, "a rod in space, for what the hand holds");
  if (bends_in_space(options.element))
    cli::refuse("--element", name(options.element), "one of a beam that bends in its plane");
  const bool of_file = !options.model.empty() && options.hands == 1;
  Parts parts{filled_in(options, device), of_file ? trained->make_beam() : options.beam.make(), nullptr,
              device};
  const bool finite_elements = options.model_choice == ModelChoice::finite_elements;
  if (finite_elements && options.element == ElementChoice::with_mass) {
    check_with_mass(options);
    return couple_with_mass(std::move(parts));
  }
  if (options.beams > 1) {
    // Teeth that bend far slip off the hand; other elements are for small turns.
    if (!finite_elements || options.element != ElementChoice::corotational)
      throw cli::UsageError("--beams " + std::to_string(options.beams) +
                            ": must be of --element corotational");
    return couple_many(std::move(parts));
  }
  if (!finite_elements) {
    parts.trained = std::move(trained);
    return couple_trained(std::move(parts));
  }
  if (of_file && trained->loaded)
    throw cli::UsageError("finite elements: " + options.model +
                          " was trained under dead loads, which the file does not say");
  return couple_in_plane(std::move(parts));
}

}  // namespace phantom
