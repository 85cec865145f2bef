#include "beam_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sections.hpp"
#include <hapbeam/shapes.hpp>

namespace cli {

namespace {

using hapbeam::Support;

/// What a named rod in space is by nature.
enum class Shape { beam, straight, tapered, hook };

struct NamedBeam {
  const char* label;
  double length, width, height, young;
  Support left, right;
  bool round = false;
  double rise = 0, tension = 0;
  Shape shape = Shape::beam;
  double hanging = 0;     ///< [N] weight at the right end
  double density = 7850;  ///< [kg/m³] of its material
};

// thesis: the textbook beam of its chapter 3, 100 in long, 1 in square, E = 30e6 psi.
// ruler: a steel ruler of 30 cm held at one end; soft enough for the device.
// strip: steel, so thin that stretching stiffens it at once.  string: steel wire under the tension of a guitar's.
// arch: a strip of steel, bent by nature, that snaps through.  comb: one of its teeth, of nylon.
// needle: for knitting.  hook: of spring wire.  fishing-rod: of glass fibre, with 100 g on its line.  probe: what a needle meets, of nylon.  catheter: of nitinol.
// knot: a cord of soft polyethylene.
constexpr NamedBeam beams[] = {
    {"thesis", 2.54, 0.0254, 0.0254, 206.8427e9, Support::pinned, Support::pinned},
    {"ruler", 0.3, 0.025, 0.001, 200e9, Support::clamped, Support::free},
    {"strip", 0.4, 0.02, 0.0005, 200e9, Support::pinned, Support::pinned},
    {"string", 0.65, 0.0008, 0.0008, 200e9, Support::pinned, Support::pinned, true, 0, 80},
    {"arch", 0.2, 0.01, 0.0005, 200e9, Support::pinned, Support::pinned, false, 0.012},
    {"comb", 0.1, 0.003, 0.003, 3e9, Support::clamped, Support::free, true, 0, 0, Shape::beam, 0, 1150},
    {"needle", 0.15, 0.0025, 0.0025, 200e9, Support::clamped, Support::free, true, 0, 0, Shape::straight},
    {"hook", 0.2, 0.0025, 0.0025, 200e9, Support::clamped, Support::free, true, 0, 0, Shape::hook},
    {"fishing-rod", 1.2, 0.008, 0.008, 40e9, Support::clamped, Support::free, true, 0, 0, Shape::tapered, 1,
     1900},
    {"probe", 0.25, 0.003, 0.003, 3e9, Support::clamped, Support::clamped, true, 0, 0, Shape::straight, 0,
     1150},
    {"catheter", 0.24, 0.0012, 0.0012, 60e9, Support::clamped, Support::free, true, 0, 0, Shape::straight, 0,
     6450},
    {"knot", 0.6, 0.004, 0.004, 1e8, Support::clamped, Support::clamped, true, 0, 0, Shape::straight, 0, 920},
};
constexpr Support supports[] = {Support::free, Support::clamped, Support::pinned, Support::roller,
                                Support::guided};

const char* name(const NamedBeam& beam) { return beam.label; }

/// A straight stem, and two thirds of a circle in the plane of d1 that opens to the stem.
std::vector<hapbeam::RodArc> hook(double length) {
  constexpr double turn = 4 * 3.141592653589793 / 3;
  const double stem = 0.4 * length;
  return {{stem, 0, 0, 0}, {length, 0, turn / (length - stem), 0}};
}

void set(BeamOptions& o, const NamedBeam& beam) {
  o.name = beam.label;
  o.bends = beam.shape == Shape::beam ? Bends::in_plane : Bends::in_space;
  o.length = beam.length, o.width = beam.width, o.height = beam.height, o.young = beam.young;
  o.material_density = beam.density;
  o.left = beam.left, o.right = beam.right;
  o.round = beam.round, o.rise = beam.rise, o.tension = beam.tension;
  o.parts.clear(), o.arcs.clear(), o.forces.clear();
  if (beam.shape == Shape::tapered)
    o.parts = {{beam.length, beam.width, beam.height, beam.width / 4, beam.height / 4}};
  if (beam.shape == Shape::hook) o.arcs = hook(beam.length);
  if (beam.hanging > 0) o.forces = {{beam.length, 0, -beam.hanging, 0}};
  o.density = 0;
}

/// The same one, so long: what is along it goes with it.
void set_length(BeamOptions& o, double length) {
  const double factor = length / o.length;
  o.length = length;
  for (SectionPart& part : o.parts) part.end *= factor;
  for (PointForce& force : o.forces) force.s *= factor;
  for (hapbeam::RodArc& arc : o.arcs) {
    arc.end *= factor;
    arc.curvature1 /= factor, arc.curvature2 /= factor, arc.twist /= factor;
  }
}

/// One of the extents of its sections, which keep their proportions.
void set_extent(BeamOptions& o, double BeamOptions::*extent, double SectionPart::*begin,
                double SectionPart::*end, double value) {
  for (SectionPart& part : o.parts) part.*begin *= value / (o.*extent), part.*end *= value / (o.*extent);
  o.*extent = value;
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
  // Its vibration falls to a tenth in a second and a half.
  hapbeam::Damping air;
  air.drag = 3;
  const hapbeam::Material material{young, material_density, air};
  try {
    const Cut cut = cut_at(*this, length / 2);
    const auto section = section_of<hapbeam::Section>(*this, cut);
    if (rise == 0) {
      hapbeam::Beam made(length, section, material, left, right);
      if (!parts.empty()) made.sections(parts_of<hapbeam::BeamPart, hapbeam::Section>(*this));
      if (density > 0) made.weight(density, {0, gravity});
      for (const PointForce& force : forces) {
        if (force.z != 0) refuse("force z", digits(force.z) + " N", "0 for what bends in a plane");
        made.add(hapbeam::PointLoad{force.s, force.x, force.y, 0});
      }
      return hapbeam::tensioned(made, tension);
    }
    if (!parts.empty()) refuse("--rise", digits(rise), "0 for a beam with sections of its own");
    if (!forces.empty() || density > 0) refuse("--rise", digits(rise), "0 for a beam with loads");
    if (left != right) refuse("--ends", ends(left, right), "the same on both sides of an arch");
    if (!(rise < length / 2))
      refuse("--rise", digits(rise), "less than half the length, " + digits(length) + " m");
    return hapbeam::tensioned(hapbeam::arch(length, rise, section, material, left), tension);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

double BeamOptions::touched() const {
  const Cut cut = cut_at(*this, length / 2);
  return in_space() && !round ? std::min(cut.width, cut.height) : cut.height;
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
  if (b.parts.size() == 1) line += ", tapered to " + digits(b.parts[0].end_height * 1e3) + " mm";
  if (b.parts.size() > 1) line += ", of " + std::to_string(b.parts.size()) + " sections";
  if (!b.arcs.empty()) line += ", naturally bent";
  if (b.forces.size() == 1 && b.forces[0].x == 0 && b.forces[0].z == 0)
    line += ", with " + digits(std::abs(b.forces[0].y)) + " N " +
            (b.forces[0].y < 0 ? "hanging" : "pulling up") + " at " + digits(b.forces[0].s) + " m";
  else if (!b.forces.empty()) line += ", with " + std::to_string(b.forces.size()) + " forces";
  if (b.density != 0) line += ", with its weight";
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
       "2.5 mm, naturally bent;  fishing-rod: glass fibre, 1.2 m x 8 mm, tapered, 1 N on its line;  probe: "
       "nylon, 0.25 m x 3 mm, clamped at both ends;  catheter: nitinol wire, 0.24 m x 1.2 mm;  knot: "
       "polyethylene, 0.6 m x 4 mm, clamped at both ends;  " +
           b.name + " by default",
       [&b](const std::string& v) { set_beam(b, v); }, true},
      customised(b, {"--length", "M", "length of the beam [m]",
                     [&b](const std::string& v) { set_length(b, number("--length", v, 1e-3, 100, "m")); }}),
      customised(b, {"--width", "M", "width of its section, out of the plane [m]",
                     [&b](const std::string& v) {
                       set_extent(b, &BeamOptions::width, &SectionPart::width, &SectionPart::end_width,
                                  number("--width", v, 1e-6, 10, "m"));
                     }}),
      customised(b, {"--height", "M", "height of its section, in the plane of bending [m]",
                     [&b](const std::string& v) {
                       set_extent(b, &BeamOptions::height, &SectionPart::height, &SectionPart::end_height,
                                  number("--height", v, 1e-6, 10, "m"));
                     }}),
      customised(b, figure("--young", "PA", "Young's modulus [Pa]", b.young, 1, 1e13, "Pa")),
      customised(b, figure("--density", "KG/M3", "of its material, where it has mass [kg/m3]",
                           b.material_density, 1, 1e5, "kg/m3")),
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
