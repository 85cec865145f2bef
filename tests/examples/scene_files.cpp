// Scenes in files: what is saved and loaded gives the same forces to the last bit, and a file that is broken says where.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "../support/sanitized.hpp"
#include "phantom/body.hpp"
#include "phantom/hand.hpp"
#include "phantom/scene.hpp"
#include "phantom/scene_file.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace {

using phantom::Options;

constexpr const char* file = "scene_file.json";
int failures = 0;

void check(bool holds, const std::string& what) {
  if (holds) return;
  std::printf("FAILED: %s\n", what.c_str());
  ++failures;
}

void write(const std::string& text) { std::ofstream(file) << text; }
Options load() { return phantom::parse({"--scene", file}); }

/// Of a second under the scene's hand.
std::vector<Eigen::Vector3d> forces(Options options) {
  options.duration = 1;
  phantom::Hand hand(phantom::make_path(options));
  hapbeam::VirtualPhantom<phantom::Guided> device{phantom::Guided{&hand}};
  const std::unique_ptr<phantom::Body> body = phantom::make_body(options, nullptr, device.info());
  std::vector<Eigen::Vector3d> all(1000);
  for (Eigen::Vector3d& force : all) {
    const auto tick = [&](const hapbeam::DeviceState& state) noexcept { return force = body->tick(state); };
    device.step(tick);
  }
  return all;
}

/// @return the largest force [N]
double round_trip(const std::string& what, const Options& options) {
  const std::string text = phantom::write_scene(options);
  write(text);
  const Options again = load();
  check(phantom::write_scene(again) == text, what + ": saved again it is another file");
  const auto before = forces(options), after = forces(again);
  check(before == after, what + ": other forces");
  double largest = 0;
  for (const Eigen::Vector3d& force : before) largest = std::max(largest, force.norm());
  check(largest > 0.1, what + ": is not felt");
  return largest;
}

/// A beam and a rod that no option describes.
Options own(const char* scene) {
  Options options = phantom::parse({"--scene", scene});
  options.scene = "my own", options.feels = "what I have made";
  options.beam.name = options.scene;
  return options;
}

void own_bodies() {
  Options stepped = own("ruler");
  const double plain = round_trip("plain ruler", stepped);
  stepped.element = phantom::ElementChoice::tapered;
  stepped.beam.parts = {{0.15, 0.025, 0.001, 0.025, 0.001}, {0.3, 0.025, 0.0008, 0.02, 0.0005}};
  const double thinner = round_trip("stepped ruler", stepped);
  check(thinner < plain, "stepped ruler: as stiff as the plain one");
  Options loaded = own("ruler");
  loaded.beam.density = 7850;
  loaded.beam.forces = {{0.3, 0, -0.2, 0}};
  round_trip("loaded ruler", loaded);
  // q L⁴ / 8 EI + P L³ / 3 EI = 9.0 mm.
  const auto hangs =
      phantom::make_body(loaded, nullptr, hapbeam::VirtualPhantom<>(hapbeam::HandPath({0, 0})).info());
  const double tip = std::get<hapbeam::Centreline<double>>(hangs->rest()).at(0.3).w;
  check(std::abs(tip + 0.0090) < 1e-4, "loaded ruler: its tip hangs at " + std::to_string(tip) + " m");
  Options rod = own("hook");
  rod.beam.forces = {{0.2, 0, -0.5, 0.25}};
  rod.beam.density = 7850;
  round_trip("loaded hook", rod);
  const Options named = load();
  check(named.scene == "my own" && named.feels == "what I have made", "a body's own name and text are lost");
}

struct Broken {
  const char *from, *to, *message;
};

/// One change of a file that is right, and what is said of it.
void broken_files() {
  const std::string whole = phantom::write_scene(phantom::parse({"--scene", "fishing-rod"}));
  const Broken all[] = {
      {"\"length\": 1.2", "\"length\": -1.2", "body.length = -1.2 m: must be a number from 0.001 to 100"},
      {"\"length\": 1.2", "\"length\": \"long\"",
       "body.length = \"long\" m: must be a number from 0.001 to 100"},
      {"\"body.length\": \"m\"", "\"body.length\": \"mm\"",
       "the unit of body.length is \"mm\": must be \"m\""},
      {"\"length\": 1.2,", "", "body.length is missing"},
      {"\"length\": 1.2,", "\"length\": 1.2, \"colour\": 1,",
       "body.colour = 1 is no member of a file of this kind"},
      {"\"version\": 1", "\"version\": 2", "version = 2: must be a whole number from 1 to 1"},
      {"hapbeam scene", "hapbeam model", "format = \"hapbeam model\": must be \"hapbeam scene\""},
      {"\"bends\": \"rod\"", "\"bends\": \"rope\"", "body.bends = \"rope\": must be one of beam, rod"},
      {"\"left\": \"clamped\"", "\"left\": \"free\"", "supports = free, free: the rod is a mechanism"},
      {"\"end\": 1.2", "\"end\": 1.1", "part end = 1.1 m: must be the rod's length for the last part"},
      {"\"s\": 1.2", "\"s\": 1.3", "force s = 1.3 m: must be on the rod"},
      {"\"end_height\": 0.002", "\"end_height\": 0",
       "sections[0].end_height = 0 m: must be a number from 1e-06 to 10"},
      {"\"place\": 0.9", "\"place\": 1.9", "hand.place = 1.9 m: must be a number from 0 to 1.2"},
      {"\"script\": \"around\"", "\"script\": \"dance\"",
       "hand.script = \"dance\": must be one of slide, press, tap, around"},
      {"\"elements\": 16", "\"elements\": 16.5",
       "model.elements = 16.5: must be a whole number from 2 to 4096"},
      {"\"name\"", "name", "is no JSON: "},
  };
  for (const Broken& broken : all) {
    std::string text = whole, said = "nothing";
    const std::size_t at = text.find(broken.from);
    check(at != std::string::npos, std::string("the file has no ") + broken.from);
    if (at == std::string::npos) continue;
    write(text.replace(at, std::string(broken.from).size(), broken.to));
    try {
      load();
    } catch (const std::exception& error) {
      said = error.what();
    }
    check(said.find(std::string(file) + ": ") == 0 && said.find(broken.message) != std::string::npos,
          std::string(broken.message) + ": but it says " + said);
  }
  // Cut off anywhere it is no scene.
  for (std::size_t size = 0; size + 3 < whole.size(); size += 97) {
    write(whole.substr(0, size));
    bool rejected = false;
    try {
      load();
    } catch (const std::exception&) {
      rejected = true;
    }
    check(rejected, "cut off after " + std::to_string(size) + " bytes it is taken");
  }
}

}  // namespace

int main() {
  for (const char* scene :
       {"thesis", "ruler", "strip", "string", "arch", "comb", "needle", "hook", "fishing-rod", "probe"})
    round_trip(scene, phantom::parse({"--scene", scene}));
  if (!hapbeam::testing::sanitized)  // they take a minute there
    for (const char* scene : {"catheter", "knot"}) round_trip(scene, phantom::parse({"--scene", scene}));
  round_trip("two hands", phantom::parse({"--scene", "arch", "--hands", "2"}));
  round_trip("friction", phantom::parse({"--scene", "ruler", "--friction", "0.3"}));
  round_trip("a third", phantom::parse({"--beam", "needle", "--length", "0.133333333333333333"}));
  own_bodies();
  broken_files();
  std::remove(file);
  return failures == 0 ? 0 : 1;
}
