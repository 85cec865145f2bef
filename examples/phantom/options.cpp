#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scenes.hpp"

namespace phantom {

namespace {

using cli::count, cli::figure, cli::file, cli::flag, cli::one_of;

constexpr Script scripts[] = {Script::slide,  Script::press, Script::tap,
                              Script::around, Script::pluck, Script::push};
constexpr CouplingChoice couplings[] = {CouplingChoice::direct, CouplingChoice::virtual_coupling};
constexpr DeviceChoice devices[] = {DeviceChoice::simulated, DeviceChoice::phantom};

cli::Entries entries(Options& o) {
  cli::Entries list{{"--scene", "NAME",
                     "a beam, the model that it needs and a hand that shows what there is to feel: " +
                         scene_names() + ", or a FILE.json that the window has written;  " + opening_scene +
                         " by default, and none beside --beam or --model.  Any other option changes it",
                     [&o](const std::string& v) { set_scene(o, v); }, true}};
  const cli::Entries beam = cli::beam_entries(o.beam);
  list.insert(list.end(), beam.begin(), beam.end());
  const cli::Entries own = {
      count("--elements", "number of finite elements, 2 to 4096; 16 by default", o.elements, 2, 4096),
      {"--element", "KIND",
       "linear, or von Karman with a membrane: full, reduced, stability-functions (default), or right at any "
       "rotation: "
       "corotational, and tapered for sections that change.  Of a rod in space: round-rod, which no one "
       "twists (its default where it is straight), "
       "or twisted-rod.  with-mass: as corotational, and it swings, twangs and is heard, touched by one hand "
       "without friction",
       [&o](const std::string& v) { o.element = one_of(element_choices, "--element", v); }},
      file("--model",
           "a model that train has made takes the place of finite elements; the beam is the file's", o.model),
      flag("--guarded", "with --model: finite elements answer what is out of the trained range", o.guarded),
      count("--beams",
            "so many beams below one another, 1 to 1000, with --element corotational; the scene's by "
            "default, or 1",
            o.beams, 1, 1000),
      figure("--pitch", "M", "from one of them to the next [m]; the scene's by default, or 0.012", o.pitch,
             1e-6, 1, "m"),
      count("--hands",
            "1 (default), or 2: a second simulated Phantom holds the beam from below, nearer to its left "
            "end; of "
            "beams of finite rotation and rods",
            o.hands, 1, 2),
      {"--script", "NAME",
       "what the hand does, the scene's by default:  slide: press, slide to and fro, let go;  press;  tap;  "
       "around: press a "
       "rod in space from above, from the front and from below;  pluck: press and let go at once, the "
       "default where what has "
       "mass is held at both ends;  push: push what is held along, and pull it back",
       [&o](const std::string& v) { o.script = one_of(scripts, "--script", v); }},
      figure("--place", "M",
             "where it presses, from the beam's left end [m]; by default the middle of the beam, or of the "
             "trained range",
             o.place, 0, 100, "m"),
      figure("--depth", "M",
             "how far below the beam's surface the hand aims [m], 0 to 0.1; the scene's by default, or 0.012",
             o.depth, 0, 0.1, "m"),
      figure("--duration", "S", "of the whole script [s], 1 to 86400; 10 by default", o.duration, 1, 86400,
             "s"),
      figure("--radius", "M", "of the avatar [m]; 0.005 by default", o.radius, 0, 0.1, "m"),
      figure("--friction", "MU",
             "coefficient of friction between avatar and beam, 0 to 2; 0 by default.  Of beams of finite "
             "rotation and rods",
             o.friction, 0, 2, ""),
      figure("--scale", "X",
             "metres of the scene for one metre of the device; the scene's by default, or 1.  Forces are "
             "never scaled",
             o.scale, 1e-3, 1e3, ""),
      {"--coupling", "KIND",
       "virtual (default): a spring and a damper that the device can render tie the hand to the beam;  "
       "direct",
       [&o](const std::string& v) { o.coupling = one_of(couplings, "--coupling", v); }},
      figure("--stiffness", "X",
             "of the coupling [N/m], 1 to 1e6; by default what the device can render with a margin",
             o.stiffness, 1, 1e6, "N/m"),
      figure("--damping", "X", "of the coupling [N s/m], 0 to 1000; by default the same", o.damping, 0, 1000,
             "N s/m"),
      {"--device", "NAME",
       "virtual (default): a simulated Phantom and hand;  phantom: a real one, its arm in its inkwell or "
       "reset "
       "position when the program starts",
       [&o](const std::string& v) { o.device = one_of(devices, "--device", v); }},
      flag("--lock-step",
           "simulated time, as fast as the machine can and the same every time; else real time.  With a "
           "window only for a "
           "screenshot or a tour",
           o.lock_step),
      flag("--headless", "no window, a table row a second; so it is without a display, too", o.headless),
      file("--record", "writes a CSV row for each tick: time, hand, force, depth, status", o.record),
      file("--sound",
           "writes what is heard of a beam with mass as WAV: the velocity of its free right end, or the "
           "force on "
           "its right support",
           o.sound),
      file("--replay", "the hand repeats a recording, in lock step", o.replay),
      file("--screenshot", "writes a picture of the window as PNG and, unless a duration is given, closes it",
           o.screenshot),
      figure("--zoom", "X", "size of the window and of its text, 1 to 4; 1 by default, 1280 x 720 pixels",
             o.zoom, 1, 4, ""),
      figure("--at", "S", "when the screenshot is taken [s]; 3 by default, or the end of a shorter duration",
             o.at, 0, 86400, "s"),
      count("--frames",
            "so many screenshots, 0.05 s apart, 1 to 1000; FILE.png becomes FILE_000.png, FILE_001.png and "
            "so on",
            o.frames, 1, 1000),
      count(
          "--tour",
          "closes the window after so many switches of scene, model and coupling, one a picture, 1 to 100000",
          o.tour, 1, 100000),
      file("--report", "writes the summary as JSON", o.report),
      {"--help", "", "prints this", [](const std::string&) {}},
  };
  list.insert(list.end(), own.begin(), own.end());
  return list;
}

/// Before anything is asked for.
Options without_scene() {
  Options options;
  options.place = options.exaggeration = options.stiffness = options.damping =
      std::numeric_limits<double>::quiet_NaN();
  return options;
}
Options opening() {
  Options options = without_scene();
  set_scene(options, opening_scene);
  return options;
}

/// A rod that is named without a scene gets an element that can bend as it does, and the hand goes around a rod alone.
void suit_beam(Options& o, const std::vector<std::string>& given) {
  if (o.beam.in_space() && !cli::contains(given, "--element") && !bends_in_space(o.element))
    o.element = o.beam.arcs.empty() ? ElementChoice::round_rod : ElementChoice::twisted_rod;
  if (!o.beam.in_space() && o.script == Script::around)
    cli::refuse("--script", name(o.script), "one of slide, press, tap, pluck for what bends in a plane");
}

/// Only what is held is pushed along.
void suit_hold(const Options& o) {
  if (o.script == Script::push && !holds_end(o.avatar))
    cli::refuse("--script", name(o.script), "one of slide, press, tap, around, pluck for what is touched");
}

/// What is to be heard is let go at once; one with a free end lets go by itself.
void suit_mass(Options& o, const std::vector<std::string>& given) {
  if (o.element == ElementChoice::with_mass && o.beam.right != hapbeam::Support::free &&
      !cli::contains(given, "--script"))
    o.script = Script::pluck;
}

/// It is another beam than the scene's, which is felt and drawn otherwise.
void leave_scene(Options& o) {
  o.scene.clear(), o.scene_file.clear(), o.feels.clear();
  o.exaggeration = std::numeric_limits<double>::quiet_NaN();
}

/// What a file decides cannot be chosen as well.
void check_model(const Options& o, const std::vector<std::string>& given) {
  cli::exclude(given, "--scene", "--model", "whose file says which beam it is");
  cli::BeamOptions unused;
  for (const cli::Entry& entry : cli::beam_entries(unused))
    cli::exclude(given, entry.option, "--model", "whose file says which beam it is");
  cli::exclude(given, "--element", "--model", "which was trained with one");
  cli::exclude(given, "--beams", "--model", "which is of a single one");
  cli::exclude(given, "--hands", "--model", "which is pressed by one");
  if (o.guarded) return;
  cli::exclude(given, "--elements", "--model", "unless --guarded is given too");
}

/// The window closes after the duration, and the pictures come before.
void take_pictures_in_time(Options& o, const std::vector<std::string>& given) {
  const double latest = o.duration - 0.05 * o.frames;
  if (!cli::contains(given, "--at")) o.at = std::min(o.at, std::max(latest, 0.0));
  if (o.at <= latest) return;
  char text[128];
  std::snprintf(text, sizeof text, "--at %g: must be at most %g s with this duration", o.at, latest);
  throw cli::UsageError(text);
}

}  // namespace

const char* name(ElementChoice element) {
  switch (element) {
    case ElementChoice::linear: return "linear";
    case ElementChoice::full: return "full";
    case ElementChoice::reduced: return "reduced";
    case ElementChoice::stability_functions: return "stability-functions";
    case ElementChoice::corotational: return "corotational";
    case ElementChoice::tapered: return "tapered";
    case ElementChoice::round_rod: return "round-rod";
    case ElementChoice::twisted_rod: return "twisted-rod";
    case ElementChoice::with_mass: return "with-mass";
  }
  return "unknown";
}

const char* name(Script script) {
  switch (script) {
    case Script::slide: return "slide";
    case Script::press: return "press";
    case Script::tap: return "tap";
    case Script::around: return "around";
    case Script::pluck: return "pluck";
    case Script::push: return "push";
  }
  return "unknown";
}

const char* name(CouplingChoice coupling) {
  switch (coupling) {
    case CouplingChoice::direct: return "direct";
    case CouplingChoice::virtual_coupling: return "virtual";
  }
  return "unknown";
}

const char* name(DeviceChoice device) { return device == DeviceChoice::phantom ? "phantom" : "virtual"; }

const char* name(Avatar avatar) {
  switch (avatar) {
    case Avatar::ball: return "ball";
    case Avatar::needle: return "needle";
    case Avatar::end: return "end";
    case Avatar::knot: return "knot";
  }
  return "unknown";
}

void settle(Options& o, double from, double to) {
  o.from = from, o.to = to;
  if (std::isnan(o.place)) o.place = (from + to) / 2;
  // A straight beam of more than a metre moves by little of what is seen.
  if (std::isnan(o.exaggeration)) o.exaggeration = o.beam.rise == 0 && o.beam.length > 1 ? 20 : 1;
  if (o.place > o.beam.length)
    cli::refuse("--place", cli::digits(o.place), "0 to " + cli::digits(o.beam.length) + " m");
}

Options parse(const std::vector<std::string>& arguments) {
  const bool own = cli::contains(arguments, "--beam") || cli::contains(arguments, "--model");
  Options options = own ? without_scene() : opening();
  const std::vector<std::string> given = cli::read(arguments, entries(options));
  if (options.guarded && options.model.empty())
    throw cli::UsageError("--guarded: must stand beside --model, whose range it guards");
  check_model(options, given);
  suit_beam(options, given);
  suit_hold(options);
  suit_mass(options, given);
  if (!options.sound.empty() && options.element != ElementChoice::with_mass)
    throw cli::UsageError("--sound: must stand beside --element with-mass: no other is heard");
  cli::BeamOptions unused;
  for (const cli::Entry& entry : cli::beam_entries(unused))
    if (cli::contains(given, entry.option)) leave_scene(options);
  options.timed = cli::contains(given, "--duration");
  if (options.timed && !options.screenshot.empty()) take_pictures_in_time(options, given);
  if (!options.replay.empty()) {
    for (const char* path : {"--script", "--depth", "--duration"})
      cli::exclude(given, path, "--replay", "whose file says what the hand does");
    options.lock_step = true;
  }
  for (const char* shown : {"--screenshot", "--tour"})
    for (const char* other : {"--headless", "--replay"})
      cli::exclude(given, shown, other, "which shows no window");
  if (options.device == DeviceChoice::phantom)
    for (const char* simulated : {"--lock-step", "--replay", "--screenshot"})
      cli::exclude(given, simulated, "--device", "of which a real one has no simulated time");
  for (const char* figure : {"--stiffness", "--damping"})
    if (options.coupling == CouplingChoice::direct && cli::contains(given, figure))
      throw cli::UsageError(std::string(figure) +
                            ": must not stand beside --coupling direct, which has no spring");
  if (!options.model.empty()) return options;
  if (options.beam.in_space()) options.beam.make_rod();
  else options.beam.make();
  settle(options, 0, options.beam.length);
  return options;
}

std::string help() {
  Options unused = opening();
  return "phantom: a hand presses a beam through a simulated haptic device, a thousand times a second\n\n" +
         cli::describe(entries(unused)) +
         "\nCtrl-C ends the run with its summary.  Exit status: 0, 1 where the model cannot be read or the "
         "report cannot be written, 2 for a wrong option.\n";
}

}  // namespace phantom
