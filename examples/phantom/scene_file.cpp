#include "scene_file.hpp"

#include <cctype>
#include <exception>
#include <filesystem>
#include <utility>

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE
#include <hapbeam/rom/file/json_reader.hpp>
#include <hapbeam/rom/file/replaced_file.hpp>
#endif

namespace phantom {

bool is_scene_file(const std::string& name) {
  constexpr const char* end = ".json";
  return name.size() > 5 && name.compare(name.size() - 5, 5, end) == 0;
}

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE

namespace {

using hapbeam::detail::JsonReader, hapbeam::detail::JsonWriter;

// The members, for JsonReader and JsonWriter alike.  The ranges are those of the command line.

template <class Fields>
void visit_part(Fields& f, cli::SectionPart& part) {
  f.real("end", "m", part.end, 1e-3, 100.0);
  f.real("width", "m", part.width, 1e-6, 10.0);
  f.real("height", "m", part.height, 1e-6, 10.0);
  f.real("end_width", "m", part.end_width, 1e-6, 10.0);
  f.real("end_height", "m", part.end_height, 1e-6, 10.0);
}

template <class Fields>
void visit_arc(Fields& f, hapbeam::RodArc& arc) {
  f.real("end", "m", arc.end, 1e-3, 100.0);
  f.real("curvature1", "1/m", arc.curvature1, -1e4, 1e4);
  f.real("curvature2", "1/m", arc.curvature2, -1e4, 1e4);
  f.real("twist", "1/m", arc.twist, -1e4, 1e4);
}

template <class Fields>
void visit_force(Fields& f, cli::PointForce& force) {
  f.real("s", "m", force.s, 0.0, 100.0);
  f.real("x", "N", force.x, -1e6, 1e6);
  f.real("y", "N", force.y, -1e6, 1e6);
  f.real("z", "N", force.z, -1e6, 1e6);
}

template <class Fields>
void visit_body(Fields& f, cli::BeamOptions& beam) {
  f.choice("body.bends", beam.bends, cli::Bends::in_space);
  f.real("body.length", "m", beam.length, 1e-3, 100.0);
  f.flag("body.round", beam.round);
  f.real("body.width", "m", beam.width, 1e-6, 10.0);
  f.real("body.height", "m", beam.height, 1e-6, 10.0);
  f.real("body.young", "Pa", beam.young, 1.0, 1e13);
  f.real("body.density", "kg/m³", beam.material_density, 1.0, 1e5);
  f.choice("body.left", beam.left, hapbeam::Support::guided);
  f.choice("body.right", beam.right, hapbeam::Support::guided);
  f.real("body.rise", "m", beam.rise, 0.0, 50.0);
  f.real("body.tension", "N", beam.tension, 0.0, 1e7);
  f.list("sections", beam.parts, visit_part<Fields>);
  f.list("arcs", beam.arcs, visit_arc<Fields>);
  f.list("forces", beam.forces, visit_force<Fields>);
  f.real("weight.density", "kg/m³", beam.density, 0.0, 1e5);
  f.real("weight.gravity", "m/s²", beam.gravity, -100.0, 100.0);
}

template <class Fields>
void visit_scene(Fields& f, Options& o) {
  int version = 1;
  f.constant("format", "hapbeam scene");
  f.count("version", version, 1, 1);
  f.units();
  f.word("name", o.scene);
  f.word("feels", o.feels);
  visit_body(f, o.beam);
  f.count("beams.count", o.beams, 1, 1000);
  f.real("beams.pitch", "m", o.pitch, 1e-6, 1.0);
  f.choice("model.element", o.element, ElementChoice::with_mass);
  f.count("model.elements", o.elements, 2, 4096);
  f.choice("hand.script", o.script, Script::push);
  f.real("hand.place", "m", o.place, 0.0, o.beam.length);
  f.real("hand.depth", "m", o.depth, 0.0, 0.1);
  f.real("hand.duration", "s", o.duration, 1.0, 86400.0);
  f.choice("hand.avatar", o.avatar, Avatar::knot);
  f.real("hand.radius", "m", o.radius, 0.0, 0.1);
  f.real("hand.friction", "1", o.friction, 0.0, 2.0);
  f.real("hand.scale", "1", o.scale, 1e-3, 1e3);
  f.count("hand.hands", o.hands, 1, 2);
  f.real("drawn.exaggeration", "1", o.exaggeration, 0.01, 1000.0);
  f.finish();
}

}  // namespace

std::string write_scene(const Options& options) {
  if (!options.model.empty())
    throw cli::UsageError("a scene cannot be saved of " + options.model + ", which does not say its section");
  Options written = options;
  if (written.scene.empty()) written.scene = written.beam.name;
  const std::string source = written.scene;
  JsonWriter fields(source);
  visit_scene(fields, written);
  return fields.readable();
}

void read_scene(Options& options, const std::string& path) {
  namespace detail = hapbeam::detail;
  const std::string text = detail::read_file(path);
  detail::check_size(text.size(), path);
  const detail::Json root = detail::parse_json(text.data(), text.size(), path, 1);
  JsonReader fields(root.get(), path);
  Options read = options;
  visit_scene(fields, read);
  read.beam.name = read.scene, read.scene_file = path;
  // Whether they make a beam is said here, where the file is known.
  try {
    if (read.beam.in_space()) read.beam.make_rod();
    else read.beam.make();
  } catch (const std::exception& error) {
    detail::fail(path, "%s", error.what());
  }
  options = std::move(read);
}

std::string save_scene(const Options& options) {
  const std::string text = write_scene(options);
  std::string name = options.scene.empty() ? options.beam.name : options.scene;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  std::string file = name + ".json";
  for (int k = 2; std::filesystem::exists(file); ++k) file = name + "_" + std::to_string(k) + ".json";
  hapbeam::detail::ReplacedFile written(file);
  written.write(text);
  written.replace();
  return file;
}

#else

namespace {

[[noreturn]] void no_files() {
  throw cli::UsageError(
      "a scene's file cannot be used: this program was built without jansson, which reads it");
}

}  // namespace

std::string write_scene(const Options&) { no_files(); }
void read_scene(Options&, const std::string&) { no_files(); }
std::string save_scene(const Options&) { no_files(); }

#endif

}  // namespace phantom
