// A scene in a file: the beam or rod with its sections and loads, the model, the hand.  The window writes it, --scene FILE.json reads it.
//
//   {"format": "hapbeam scene", "version": 1, "units": {"body.length": "m", …}, "name": "ruler", "feels": "…",
//    "body": {"bends": "beam", "length": 0.3, …}, "sections": […], "arcs": […], "forces": […], "weight": {…},
//    "beams": {…}, "model": {…}, "hand": {…}, "drawn": {…}}
//
// A file has all members, in SI; nothing is guessed.  What is saved and loaded gives the same forces to the last bit.
// Without jansson there are no such files, and both functions throw cli::UsageError.
#pragma once

#include <string>

#include "options.hpp"

namespace phantom {

/// Whether a name is that of a file, which ends in .json.
bool is_scene_file(const std::string& name);

/// @param options  settled   @return the text of its file
/// @throws cli::UsageError where the beam is of a trained model's file, which does not say its section
std::string write_scene(const Options& options);
/// Sets what a file chooses.   @throws hapbeam::ModelFileError naming file, field, value, unit and range
void read_scene(Options& options, const std::string& path);
/// Writes it beside where the program runs, under the name of the scene and, where that is taken, a number.
/// @return the file's name   @throws as write_scene, and std::runtime_error where it cannot be written
std::string save_scene(const Options& options);

}  // namespace phantom
