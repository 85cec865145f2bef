// The command line: what can be chosen, in which unit.
#pragma once

#include <string>
#include <vector>

#include "support/beam_options.hpp"
#include "support/command_line.hpp"

namespace phantom {

enum class ElementChoice {
  linear,
  full,
  reduced,
  stability_functions,
  corotational,
  tapered,
  round_rod,
  twisted_rod,
  with_mass
};
inline constexpr ElementChoice element_choices[] = {
    ElementChoice::linear,       ElementChoice::full,
    ElementChoice::reduced,      ElementChoice::stability_functions,
    ElementChoice::corotational, ElementChoice::tapered,
    ElementChoice::round_rod,    ElementChoice::twisted_rod,
    ElementChoice::with_mass};
enum class Script { slide, press, tap, around, pluck, push };
enum class CouplingChoice { direct, virtual_coupling };
enum class ModelChoice { finite_elements, pod, galerkin };
enum class DeviceChoice { simulated, phantom };
/// What the hand touches with: a ball, or a flexible needle whose end it holds; or it holds the left end of the rod itself, which goes into a vessel or is
/// tied in a knot.
enum class Avatar { ball, needle, end, knot };

/// Everything in SI.
struct Options {
  std::string scene;       ///< its name; empty: a beam of one's own, without one
  std::string scene_file;  ///< it is from, or empty
  std::string feels;       ///< what one feels there, or empty
  cli::BeamOptions beam;
  ElementChoice element = ElementChoice::stability_functions;
  int elements = 16;
  ModelChoice model_choice = ModelChoice::finite_elements;
  std::string model;     ///< file of a trained model, whose beam it is, or empty
  bool guarded = false;  ///< finite elements where the trained model ends

  DeviceChoice device = DeviceChoice::simulated;

  int hands = 1;  ///< 2: the second one is simulated, and follows a script of its own
  Script script = Script::slide;
  int beams = 1;         ///< below one another, alike
  double pitch = 0.012;  ///< [m] from one to the next
  double place;          ///< [m] from the left end
  double from, to;       ///< [m] the hand slides in between
  double depth =
      0.012;  ///< [m] that the hand aims below the beam's surface; at 500 N/m no beam is too stiff then
  double duration = 10;  ///< [s]
  Avatar avatar = Avatar::ball;
  double radius = 0.005;  ///< [m] of the avatar
  double friction = 0;    ///< coefficient, between avatar and beam
  double scale = 1;       ///< metres of the scene for one of the device
  double exaggeration;    ///< of displacements, as they are drawn
  CouplingChoice coupling = CouplingChoice::virtual_coupling;
  double stiffness;        ///< [N/m] of the coupling; not a number: what the device can render
  double damping;          ///< [N·s/m] the same
  bool lock_step = false;  ///< simulated time, as fast as the machine can
  bool headless = false;   ///< no window
  bool timed = false;      ///< a duration was given; a window stays open without
  std::string report;      ///< file, or empty
  std::string record;      ///< file for each tick, or empty
  std::string sound;       ///< file of what is heard, or empty
  std::string replay;      ///< file whose hand is repeated, or empty
  std::string screenshot;  ///< file, or empty
  double zoom = 1;         ///< of the window and its text
  double at = 3;           ///< [s] when the screenshot is taken
  int frames = 1;          ///< so many, one a picture; more than one are numbered
  int tour = 0;            ///< switches of scene and model, one a picture, after which the window closes
};

/// Of a rod in space.
constexpr bool bends_in_space(ElementChoice element) {
  return element == ElementChoice::round_rod || element == ElementChoice::twisted_rod;
}

constexpr bool holds_end(Avatar avatar) { return avatar == Avatar::end || avatar == Avatar::knot; }

/// The scene is one of the program's own.
inline bool is_named_scene(const Options& o) { return !o.scene.empty() && o.scene_file.empty(); }
/// The same beam in the same place, whatever its model.
inline bool same_scene(const Options& a, const Options& b) {
  return a.scene == b.scene && a.scene_file == b.scene_file && a.beam.name == b.beam.name &&
         a.model == b.model;
}

/// Names as they are typed.
const char* name(ElementChoice element);
const char* name(Script script);
const char* name(CouplingChoice coupling);
const char* name(DeviceChoice device);
const char* name(Avatar avatar);

/// Lets the hand slide between two positions of the beam and, unless told otherwise, press midway.
/// @throws cli::UsageError where it was told to press beside the beam
void settle(Options& options, double from, double to);

/// Settled on the whole beam, unless a file says which beam it is.   @throws cli::UsageError
Options parse(const std::vector<std::string>& arguments);
std::string help();

}  // namespace phantom
