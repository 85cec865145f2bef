#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>

namespace phantom {

namespace {

using hapbeam::Support;

struct NamedBeam {
  const char* name;
  double length, width, height, young;
  Support left, right;
};

// thesis: the textbook beam of its chapter 3, 100 in long, 1 in square, E = 30e6 psi.
// ruler: a steel ruler of 30 cm held at one end; soft enough for the device.
constexpr NamedBeam beams[] = {
    {"thesis", 2.54, 0.0254, 0.0254, 206.8427e9, Support::pinned, Support::pinned},
    {"ruler", 0.3, 0.025, 0.001, 200e9, Support::clamped, Support::free},
};
constexpr Support supports[] = {Support::free, Support::clamped, Support::pinned, Support::roller,
                                Support::guided};
constexpr ElementChoice elements[] = {ElementChoice::linear, ElementChoice::full, ElementChoice::reduced,
                                      ElementChoice::assumed_strain};
constexpr Script scripts[] = {Script::slide, Script::press, Script::tap};

const char* name(const NamedBeam& beam) { return beam.name; }

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& allowed) {
  throw UsageError(option + " " + value + ": must be " + allowed);
}

/// The one of a list that bears a name, or null.
template <typename T, std::size_t N>
const T* find(const T (&list)[N], const std::string& wanted) {
  for (const T& candidate : list)
    if (wanted == name(candidate)) return &candidate;
  return nullptr;
}

template <typename T, std::size_t N>
std::string names(const T (&list)[N]) {
  std::string text;
  for (const T& entry : list) text += (text.empty() ? "" : ", ") + std::string(name(entry));
  return text;
}

template <typename T, std::size_t N>
const T& one_of(const T (&list)[N], const std::string& option, const std::string& value) {
  if (const T* found = find(list, value)) return *found;
  refuse(option, value, "one of " + names(list));
}

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

double number(const std::string& option, const std::string& value, double low, double high,
              const std::string& unit) {
  char* end = nullptr;
  const double parsed = std::strtod(value.c_str(), &end);
  // Not NaN either.
  if (!value.empty() && *end == '\0' && parsed >= low && parsed <= high) return parsed;
  refuse(option, value, digits(low) + " to " + digits(high) + (unit.empty() ? "" : " " + unit));
}

struct Entry {
  const char* option;
  const char* argument;  // empty: a flag
  const char* text;
  std::function<void(Options&, const std::string& value)> set;
};

void set_beam(Options& o, const NamedBeam& beam) {
  o.beam = beam.name;
  o.length = beam.length, o.width = beam.width, o.height = beam.height, o.young = beam.young;
  o.left = beam.left, o.right = beam.right;
}

void set_ends(Options& o, const std::string& value) {
  const std::size_t dash = value.find('-');
  const Support* left = find(supports, value.substr(0, dash));
  const Support* right = dash == std::string::npos ? nullptr : find(supports, value.substr(dash + 1));
  if (!left || !right) refuse("--ends", value, "LEFT-RIGHT, each one of " + names(supports));
  o.left = *left, o.right = *right;
  o.beam = "custom";
}

std::function<void(Options&, const std::string&)> figure(const char* option, double Options::*field,
                                                         double low, double high, const char* unit,
                                                         bool of_beam) {
  return [=](Options& o, const std::string& value) {
    o.*field = number(option, value, low, high, unit);
    if (of_beam) o.beam = "custom";
  };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = {
      {"--beam", "NAME",
       "thesis (default): steel, 2.54 m, 25.4 mm square, pinned;  ruler: steel, 0.3 m x 25 mm x 1 mm, "
       "clamped-free",
       [](Options& o, const std::string& v) { set_beam(o, one_of(beams, "--beam", v)); }},
      {"--length", "M", "length of the beam [m]", figure("--length", &Options::length, 1e-3, 100, "m", true)},
      {"--width", "M", "width of its section, out of the plane [m]",
       figure("--width", &Options::width, 1e-6, 10, "m", true)},
      {"--height", "M", "height of its section, in the plane of bending [m]",
       figure("--height", &Options::height, 1e-6, 10, "m", true)},
      {"--young", "PA", "Young's modulus [Pa]", figure("--young", &Options::young, 1, 1e13, "Pa", true)},
      {"--ends", "LEFT-RIGHT",
       "how the ends are held: free, clamped, pinned, roller or guided, for example clamped-free", set_ends},
      {"--elements", "N", "number of finite elements, 2 to 4096; 16 by default",
       [](Options& o, const std::string& v) {
         const double n = number("--elements", v, 2, 4096, "");
         if (n != std::floor(n)) refuse("--elements", v, "a whole number, 2 to 4096");
         o.elements = static_cast<int>(n);
       }},
      {"--element", "KIND", "linear, or von Karman with a membrane: full, reduced, assumed-strain (default)",
       [](Options& o, const std::string& v) { o.element = one_of(elements, "--element", v); }},
      {"--script", "NAME",
       "what the hand does: slide (default): press, slide to and fro, let go;  press;  tap",
       [](Options& o, const std::string& v) { o.script = one_of(scripts, "--script", v); }},
      {"--place", "M", "where it presses, from the beam's left end [m]; the middle by default",
       figure("--place", &Options::place, 0, 100, "m", false)},
      {"--depth", "M", "how far below the beam's surface the hand aims [m], 0 to 0.1; 0.03 by default",
       figure("--depth", &Options::depth, 0, 0.1, "m", false)},
      {"--duration", "S", "of the whole script [s], 1 to 86400; 10 by default",
       figure("--duration", &Options::duration, 1, 86400, "s", false)},
      {"--radius", "M", "of the avatar [m]; 0.005 by default",
       figure("--radius", &Options::radius, 0, 0.1, "m", false)},
      {"--scale", "X",
       "metres of the scene for one metre of the device; 1 by default.  Forces are never scaled",
       figure("--scale", &Options::scale, 1e-3, 1e3, "", false)},
      {"--lock-step", "",
       "simulated time, as fast as the machine can and the same every time; else real time",
       [](Options& o, const std::string&) { o.lock_step = true; }},
      {"--headless", "", "no window, a table row a second; this build has no window and is always so",
       [](Options&, const std::string&) {}},
      {"--report", "FILE", "writes the summary as JSON",
       [](Options& o, const std::string& v) {
         if (v.empty()) refuse("--report", "''", "the name of a file");
         o.report = v;
       }},
      {"--help", "", "prints this", [](Options&, const std::string&) {}},
  };
  return list;
}

}  // namespace

const char* name(ElementChoice element) {
  switch (element) {
    case ElementChoice::linear: return "linear";
    case ElementChoice::full: return "full";
    case ElementChoice::reduced: return "reduced";
    case ElementChoice::assumed_strain: return "assumed-strain";
  }
  return "unknown";
}

const char* name(Script script) {
  switch (script) {
    case Script::slide: return "slide";
    case Script::press: return "press";
    case Script::tap: return "tap";
  }
  return "unknown";
}

hapbeam::Beam Options::make_beam() const {
  return {length, hapbeam::Section::rectangle(width, height), hapbeam::Material{young}, left, right};
}

bool wants_help(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument == "--help" || argument == "-h") return true;
  return false;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  set_beam(options, beams[0]);
  options.place = std::numeric_limits<double>::quiet_NaN();

  // A named beam comes first, wherever it stands, so that other options change it.
  for (const bool beam : {true, false})
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Entry* entry = nullptr;
      for (const Entry& candidate : entries())
        if (arguments[i] == candidate.option) entry = &candidate;
      if (!entry) throw UsageError(arguments[i] + ": no such option; --help lists them");
      const bool flag = *entry->argument == '\0';
      if (!flag && (i + 1 == arguments.size() || arguments[i + 1].rfind("--", 0) == 0))
        throw UsageError(arguments[i] + ": must be followed by " + entry->argument + "; --help says more");
      if (beam == (arguments[i] == "--beam")) entry->set(options, flag ? "" : arguments[i + 1]);
      if (!flag) ++i;
    }

  try {
    options.make_beam();
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--ends: ") + error.what());
  }
  if (std::isnan(options.place)) options.place = options.length / 2;
  if (options.place > options.length) number("--place", digits(options.place), 0, options.length, "m");
  return options;
}

std::string help() {
  std::string text =
      "phantom: a hand presses a beam through a simulated haptic device, a thousand times a second\n\n";
  for (const Entry& entry : entries()) {
    std::string left = std::string("  ") + entry.option + " " + entry.argument;
    left.resize(std::max<std::size_t>(left.size() + 2, 22), ' ');
    text += left + entry.text + "\n";
  }
  return text +
         "\nCtrl-C ends the run with its summary.  Exit status: 0, 1 where the report cannot be written, 2 "
         "for a "
         "wrong option.\n";
}

}  // namespace phantom
