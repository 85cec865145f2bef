#include "scenes.hpp"

#include <limits>

#include "scene_file.hpp"

namespace phantom {

namespace {

struct NamedScene {
  const char* label;  ///< of the scene and of its beam
  ElementChoice element;
  Script script;
  double place;  ///< [m]; not a number: the middle
  double depth;  ///< [m, device]
  double scale;
  const char* feels;  ///< what one feels, and why
  double exaggeration = 1;
  int beams = 1;
  double radius = 0.005;  ///< [m] of the avatar
  double pitch = 0.012;   ///< [m] from one beam to the next
  Avatar avatar = Avatar::ball;
  int elements = 16;
};

constexpr double middle = std::numeric_limits<double>::quiet_NaN();

// docs/scenes.md says the same at more length, and what is measured.  No hand presses so hard for so long that the device
// cuts the force: what is felt is the beam.
constexpr NamedScene scenes[] = {
    {"thesis", ElementChoice::stability_functions, Script::slide, middle, 0.014, 1,
     "a wall that gives a little: the bar is stiffer than the device, and what moves is the coupling", 20},
    {"ruler", ElementChoice::corotational, Script::press, 0.15, 0.08, 3,
     "it resists, turns, and lets the hand slide down along it: the force falls while the hand goes on, "
     "until it "
     "slips off"},
    {"strip", ElementChoice::stability_functions, Script::press, middle, 0.028, 0.2,
     "nothing, then more and more, then a wall: it bends like paper and stretches like steel, with the cube "
     "of the depth",
     10},
    {"string", ElementChoice::stability_functions, Script::slide, middle, 0.03, 0.5,
     "a spring that is soft in the middle and hard at the ends: its tension, not its stiffness, pushes back",
     5},
    {"arch", ElementChoice::corotational, Script::press, middle, 0.04, 0.5,
     "a click: it resists, tilts, gives way under the finger and is gone, to stand on the other side"},
    {"comb", ElementChoice::corotational, Script::press, 0.096, 0.05, 1.6,
     "tooth after tooth: each bends, two or three push back together, and one after the other slips off", 1,
     9, 0.005, 0.008},
    {"needle", ElementChoice::round_rod, Script::around, 0.11, 0.022, 0.5,
     "the same spring from every side: pressed deeper than the ball's radius, it slips around the ball", 1, 1,
     0.01},
    {"hook", ElementChoice::twisted_rod, Script::around, 0.17, 0.014, 0.5,
     "a spring that is another one from each side: from the front its stem twists", 1, 1, 0.01},
    {"fishing-rod", ElementChoice::round_rod, Script::around, 0.9, 0.02, 3,
     "soft at the tip and hard at the butt, and a weight on its line that comes along", 1, 1, 0.06},
    {"probe", ElementChoice::round_rod, Script::slide, middle, 0.03, 1,
     "two springs in a row: the rod that the needle meets, and the needle, which near a clamp bends alone", 1,
     1, 0.001, 0.012, Avatar::needle},
    {"catheter", ElementChoice::round_rod, Script::push, 0, 0.1, 1.5,
     "it pushes back while the vessel bends it farther, and slides on: there is no friction", 1, 1, 0.001,
     0.012, Avatar::end},
    {"knot", ElementChoice::round_rod, Script::push, 0, 0.08, 2.5,
     "it pulls back more and more as the loop closes: half as far open it pulls four times as much", 1, 1,
     0.002, 0.012, Avatar::knot, 64},
};

const char* name(const NamedScene& scene) { return scene.label; }

}  // namespace

void set_scene(Options& o, const std::string& label) {
  if (is_scene_file(label)) return read_scene(o, label);
  const NamedScene& scene = cli::one_of(scenes, "--scene", label);
  cli::set_beam(o.beam, label);
  o.scene = label, o.scene_file.clear();
  o.feels = scene.feels;
  o.exaggeration = scene.exaggeration;
  o.element = scene.element;
  o.script = scene.script;
  o.place = scene.place;
  o.depth = scene.depth;
  o.scale = scene.scale;
  o.beams = scene.beams;
  o.avatar = scene.avatar;
  o.radius = scene.radius;
  o.pitch = scene.pitch;
  o.elements = scene.elements;
}

std::string scene_names() { return cli::names(scenes); }

}  // namespace phantom
