// Scenes worth touching: a beam, the least model that is right for it, and a hand that shows what there is to feel.
#pragma once

#include <string>

#include "options.hpp"

namespace phantom {

/// Where neither a scene nor a beam is asked for.
constexpr const char* opening_scene = "strip";

/// Sets what a scene chooses.   @param label  its name, or that of its file, which ends in .json
/// @throws cli::UsageError, or as read_scene
void set_scene(Options& options, const std::string& label);
/// Their names.
std::string scene_names();

}  // namespace phantom
