// phantom in a window: the beam is seen, and pressed with the mouse.
#pragma once

#include <csignal>

#include "../options.hpp"
#include "../trained.hpp"
#include "display.hpp"

namespace phantom {

/// Runs until the window is closed, or the duration, screenshot or tour that was asked for is done.
/// @param trained  or null   @param interrupted  nonzero: close
/// @throws std::runtime_error where a file cannot be written
void run_window(Display& display, const Options& options, const Trained* trained,
                const volatile std::sig_atomic_t& interrupted);

}  // namespace phantom
