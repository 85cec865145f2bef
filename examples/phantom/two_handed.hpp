// Two hands on one beam or rod: the first one is the device's, the second a simulated Phantom that holds it from below.
//
// A tick of the first hand is followed by one of the second, in simulated time: in lock step the forces of both are deterministic.
#pragma once

#include <memory>

#include "body.hpp"

namespace phantom {

/// @param options  the coupling's figures filled in
/// @throws cli::UsageError or std::invalid_argument where two hands do not go with the model
std::unique_ptr<Body> make_two_handed(const Options& options, const hapbeam::DeviceInfo& device);

}  // namespace phantom
