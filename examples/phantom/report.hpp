// What the user sees: the scene in words, a table row a second, the summary, and the summary as JSON.
#pragma once

#include <string>

#include "options.hpp"
#include "servo.hpp"
#include "trained.hpp"
#include <hapbeam/haptics/device.hpp>

namespace phantom {

/// What was run, and how it went.
struct Run {
  const Options& options;
  const Trained* trained;  ///< or null: finite elements alone
  const hapbeam::DeviceInfo& device;
  const Notes& notes;
  hapbeam::DeviceCounts counts;
  bool interrupted;
};

/// @param trained  or null
void print_scene(const Options& options, const Trained* trained, const hapbeam::DeviceInfo& device);
void print_row(const Notes& notes, const hapbeam::DeviceCounts& counts);
void print_summary(const Run& run);
std::string json(const Run& run);

}  // namespace phantom
