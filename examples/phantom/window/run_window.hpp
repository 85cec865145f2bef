// phantom in a window: the beam is seen, and pressed with the mouse.
#pragma once

#include <memory>

#include "../options.hpp"
#include "../report.hpp"
#include "../trained.hpp"
#include "display.hpp"

namespace phantom {

/// Runs until the window is closed, or the duration, screenshot or tour that was asked for is done.
/// @param trained  of options.model, or null   @return the exit status
/// @throws std::runtime_error where a screenshot or a recording cannot be written
int run_window(Display& display, const Options& options, std::shared_ptr<const Trained> trained,
               ReportFile& report);

}  // namespace phantom
