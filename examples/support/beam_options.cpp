#include "beam_options.hpp"

#include <cstdio>
#include <stdexcept>

namespace cli {

namespace {

using hapbeam::Support;

struct NamedBeam {
  const char* label;
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

const char* name(const NamedBeam& beam) { return beam.label; }

void set(BeamOptions& o, const NamedBeam& beam) {
  o.name = beam.label;
  o.length = beam.length, o.width = beam.width, o.height = beam.height, o.young = beam.young;
  o.left = beam.left, o.right = beam.right;
}

void set_ends(BeamOptions& o, const std::string& value) {
  const std::size_t dash = value.find('-');
  const Support* left = find(supports, value.substr(0, dash));
  const Support* right = dash == std::string::npos ? nullptr : find(supports, value.substr(dash + 1));
  if (!left || !right) refuse("--ends", value, "LEFT-RIGHT, each one of " + names(supports));
  o.left = *left, o.right = *right;
}

/// The same, for a beam that is then no longer the named one.
Entry customised(BeamOptions& beam, Entry entry) {
  entry.set = [&beam, set = entry.set](const std::string& value) {
    set(value);
    beam.name = "custom";
  };
  return entry;
}

}  // namespace

BeamOptions::BeamOptions() { set(*this, beams[0]); }

hapbeam::Beam BeamOptions::make() const {
  try {
    return {length, hapbeam::Section::rectangle(width, height), hapbeam::Material{young}, left, right};
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--ends: ") + error.what());
  }
}

std::string ends(Support left, Support right) {
  return std::string(hapbeam::name(left)) + "-" + hapbeam::name(right);
}

std::string describe(const BeamOptions& b) {
  char text[200];
  std::snprintf(text, sizeof text, "%s: %g m, section %g x %g mm, E = %g GPa, %s", b.name.c_str(), b.length,
                b.width * 1e3, b.height * 1e3, b.young / 1e9, ends(b.left, b.right).c_str());
  return text;
}

Entries beam_entries(BeamOptions& b) {
  return {
      {"--beam", "NAME",
       "thesis (default): steel, 2.54 m, 25.4 mm square, pinned;  ruler: steel, 0.3 m x 25 mm x 1 mm, "
       "clamped-free",
       [&b](const std::string& v) { set(b, one_of(beams, "--beam", v)); }, true},
      customised(b, figure("--length", "M", "length of the beam [m]", b.length, 1e-3, 100, "m")),
      customised(
          b, figure("--width", "M", "width of its section, out of the plane [m]", b.width, 1e-6, 10, "m")),
      customised(b, figure("--height", "M", "height of its section, in the plane of bending [m]", b.height,
                           1e-6, 10, "m")),
      customised(b, figure("--young", "PA", "Young's modulus [Pa]", b.young, 1, 1e13, "Pa")),
      customised(b, {"--ends", "LEFT-RIGHT",
                     "how the ends are held: free, clamped, pinned, roller or guided, for example "
                     "clamped-free",
                     [&b](const std::string& v) { set_ends(b, v); }}),
  };
}

}  // namespace cli
