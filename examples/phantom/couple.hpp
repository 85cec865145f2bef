// Models by the beam and the options, each with its servo.  The two units that define these compile for most of the time that phantom takes.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "body.hpp"

namespace phantom {

using Count = std::atomic<std::uint64_t>;

/// What all bodies are made of, but for the model.
struct Parts {
  Options options;
  Slender slender;
  std::shared_ptr<const Trained> trained;
  hapbeam::DeviceInfo device;
  std::unique_ptr<Count> full_answers = nullptr;
};

// Of the options' element and number of hands.   @throws std::invalid_argument where the model does not take the beam
std::unique_ptr<Body> couple_in_plane(Parts parts);
std::unique_ptr<Body> couple_in_space(Parts parts);
/// In the hand, or met by what is there.
std::unique_ptr<Body> couple_held(Parts parts);
/// Swinging.
std::unique_ptr<Body> couple_with_mass(Parts parts);
/// Below one another, of Corotational<>.
std::unique_ptr<Body> couple_many(Parts parts);
/// @param parts  with the trained model
std::unique_ptr<Body> couple_trained(Parts parts);

}  // namespace phantom
