// The column on the right: what runs, in words, and what can be changed.
#pragma once

#include <string>

#include "../options.hpp"
#include "../trained.hpp"
#include "running.hpp"

namespace phantom {

/// What the user asked for in this picture.
struct Wish {
  bool change = false;  ///< to a body of these options
  Options options;
  bool play = false;  ///< the script
  bool save = false;  ///< the scene
};

/// @param own  the options that the program was started with, where they are of no named scene, or null
/// @param note  a line to show, or empty
Wish draw_controls(Running& running, const Options* own, const std::string& note);

/// One sentence for one who feels it.
const char* in_words(const hapbeam::ServoRecord& record);

}  // namespace phantom
