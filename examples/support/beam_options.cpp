#include "beam_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <hapbeam/shapes.hpp>

namespace cli {

namespace {

using hapbeam::Support;

struct NamedBeam {
  const char* label;
  double length, width, height, young;
  Support left, right;
  bool round = false;
  double rise = 0, tension = 0;
  RodShape rod = RodShape::none;
  double hanging = 0;
};

// thesis: the textbook beam of its chapter 3, 100 in long, 1 in square, E = 30e6 psi.
// ruler: a steel ruler of 30 cm held at one end; soft enough for the device.
// strip: steel, so thin that stretching stiffens it at once.  string: steel wire under the tension of a guitar's.
// arch: a strip of steel, bent by nature, that snaps through.  comb: one of its teeth, of nylon.
// needle: for knitting.  hook: of spring wire.  fishing-rod: of glass fibre, with 100 g on its line.
constexpr NamedBeam beams[] = {
    {"thesis", 2.54, 0.0254, 0.0254, 206.8427e9, Support::pinned, Support::pinned},
    {"ruler", 0.3, 0.025, 0.001, 200e9, Support::clamped, Support::free},
    {"strip", 0.4, 0.02, 0.0005, 200e9, Support::pinned, Support::pinned},
    {"string", 0.65, 0.0008, 0.0008, 200e9, Support::pinned, Support::pinned, true, 0, 80},
    {"arch", 0.2, 0.01, 0.0005, 200e9, Support::pinned, Support::pinned, false, 0.012},
    {"comb", 0.1, 0.003, 0.003, 3e9, Support::clamped, Support::free, true},
    {"needle", 0.15, 0.0025, 0.0025, 200e9, Support::clamped, Support::free, true, 0, 0, RodShape::straight},
    {"hook", 0.2, 0.0025, 0.0025, 200e9, Support::clamped, Support::free, true, 0, 0, RodShape::hook},
    {"fishing-rod", 1.2, 0.008, 0.008, 40e9, Support::clamped, Support::free, true, 0, 0, RodShape::tapered,
     1},
};
constexpr Support supports[] = {Support::free, Support::clamped, Support::pinned, Support::roller,
                                Support::guided};

const char* name(const NamedBeam& beam) { return beam.label; }

void set(BeamOptions& o, const NamedBeam& beam) {
  o.name = beam.label;
  o.length = beam.length, o.width = beam.width, o.height = beam.height, o.young = beam.young;
  o.left = beam.left, o.right = beam.right;
  o.round = beam.round, o.rise = beam.rise, o.tension = beam.tension;
  o.rod = beam.rod, o.hanging = beam.hanging;
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

void set_beam(BeamOptions& options, const std::string& label) {
  set(options, one_of(beams, "--beam", label));
}

BeamOptions::BeamOptions() { set(*this, beams[0]); }

hapbeam::Beam BeamOptions::make() const {
  if (in_space()) refuse("--beam", name, "one that bends in a plane: this is a rod in space");
  const hapbeam::Material material{young};
  try {
    const auto section =
        round ? hapbeam::Section::circle(height) : hapbeam::Section::rectangle(width, height);
    if (rise == 0) return hapbeam::tensioned({length, section, material, left, right}, tension);
    if (left != right) refuse("--ends", ends(left, right), "the same on both sides of an arch");
    if (!(rise < length / 2))
      refuse("--rise", digits(rise), "less than half the length, " + digits(length) + " m");
    return hapbeam::tensioned(hapbeam::arch(length, rise, section, material, left), tension);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--ends: ") + error.what());
  }
}

double BeamOptions::rest(double x) const {
  if (rise == 0) return 0;
  const double radius = (length * length / 4 + rise * rise) / (2 * rise);
  const double from_middle = std::clamp(x, 0.0, length) - length / 2;
  return std::sqrt(radius * radius - from_middle * from_middle) - (radius - rise);
}

std::string ends(Support left, Support right) {
  return std::string(hapbeam::name(left)) + "-" + hapbeam::name(right);
}

std::string describe(const BeamOptions& b) {
  char text[200];
  std::snprintf(text, sizeof text, "%s: %g m, section %g x %g mm, E = %g GPa, %s", b.name.c_str(), b.length,
                b.width * 1e3, b.height * 1e3, b.young / 1e9, ends(b.left, b.right).c_str());
  std::string line = text;
  if (b.round)
    line.replace(line.find("section"), line.find(", E") - line.find("section"),
                 "round, " + digits(b.height * 1e3) + " mm");
  if (b.rod == RodShape::tapered) line += ", tapered to " + digits(b.height / 4 * 1e3) + " mm";
  if (b.rod == RodShape::hook) line += ", naturally bent to a hook";
  if (b.hanging != 0) line += ", with " + digits(b.hanging) + " N hanging from its tip";
  if (b.rise != 0) line += ", an arch that rises " + digits(b.rise * 1e3) + " mm";
  if (b.tension != 0) line += ", under " + digits(b.tension) + " N";
  return line;
}

Entries beam_entries(BeamOptions& b) {
  return {
      {"--beam", "NAME",
       "thesis: steel, 2.54 m, 25.4 mm square, pinned;  ruler: steel, 0.3 m x 25 mm x 1 mm, "
       "clamped-free;  strip: 0.4 m x 20 mm x 0.5 mm, pinned;  string: 0.65 m of 0.8 mm wire under 80 N;  "
       "arch: "
       "0.2 m wide, 12 mm high, 10 mm x 0.5 mm, pinned;  comb: a tooth of nylon, 0.1 m x 3 mm, round, "
       "clamped-free.  Rods in space, round and clamped-free:  needle: steel, 0.15 m x 2.5 mm;  hook: steel "
       "wire, 0.2 m x "
       "2.5 mm, naturally bent;  fishing-rod: glass fibre, 1.2 m x 8 mm, tapered, 1 N on its line;  " +
           b.name + " by default",
       [&b](const std::string& v) { set_beam(b, v); }, true},
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
      customised(b,
                 figure("--rise", "M", "makes it an arch whose span is the length [m]", b.rise, 0, 50, "m")),
      customised(b,
                 figure("--tension", "N", "stretches it before it is touched [N]", b.tension, 0, 1e7, "N")),
  };
}

}  // namespace cli
