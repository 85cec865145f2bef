// phantom in a window: the beam is seen, and pressed with the mouse.
#pragma once

#include <csignal>
#include <memory>
#include <string>

#include "../options.hpp"
#include "../trained.hpp"
#include "display.hpp"

namespace phantom {

/// Runs until the window is closed, or the duration, screenshot or tour that was asked for is done.
/// @param trained  of options.model, or null   @param interrupted  nonzero: close   @return the report
/// @throws std::runtime_error where a file cannot be written
std::string run_window(Display& display, const Options& options, std::shared_ptr<const Trained> trained,
                       const volatile std::sig_atomic_t& interrupted);

}  // namespace phantom
