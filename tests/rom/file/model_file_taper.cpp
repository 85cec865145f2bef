// A model that was trained of a tapered beam, in a file: its tables hold the taper, its section is their unit.
#include <cmath>
#include <string>

#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/file/model_file.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {

/// With the checksum of what it says if it is to be a whole file.
std::string with_section(std::string text, const std::string& value, bool whole) {
  const std::string field = "\"bending_stiffness\":";
  const std::size_t at = text.find(field) + field.size();
  REQUIRE(at > field.size());
  text.replace(at, text.find(',', at) - at, value);
  const std::size_t line = text.find('\n') + 1;
  if (whole) text.replace(text.find("crc32:"), 14, detail::checksum(text.data() + line, text.size() - line));
  return text;
}

}  // namespace

TEST_CASE("a POD model of a taper comes back from its file with the forces that it had",
          "[model_file][taper]") {
  Beam beam(0.3, Section::rectangle(0.025, 0.003), Material{200e9}, Support::pinned, Support::pinned);
  beam.section([](double s) { return Section::rectangle(0.025, 0.003 - 0.005 * s); });
  FemModel<Corotational<Tapered<>>> full(beam, 32);
  PodModel<> model(train_pod(take_snapshots(beam, full, TrainingPlan::anywhere(beam, 0.006))));
  const std::string text = write_model(model);
  auto loaded = read_model<PodModel<>>(text);
  CHECK(write_model(loaded) == text);
  int answered = 0;
  for (int i = 1; i < 20; ++i)
    for (int k = -10; k <= 10; ++k) {
      const Press<double> press{0.3 * i / 20, 6e-4 * k};
      const auto before = model.press(press), after = loaded.press(press);
      CHECK(after.force == before.force);
      CHECK(after.status == before.status);
      answered += before.status == Status::ok;
    }
  CHECK(answered > 300);
  // The thin half yields more: a beam of the section that the file names would answer alike on both sides.
  const double thick = loaded.press({0.075, 1e-3}).force, thin = loaded.press({0.225, 1e-3}).force;
  CHECK(thin < 0.8 * thick);
  CHECK(std::abs(thin / full.press({0.225, 1e-3}).force - 1) < 1e-3);

  CHECK_THROWS_WITH(read_model<PodModel<>>(with_section(text, "11.0", false), "ruler.json"),
                    ContainsSubstring("ruler.json") && ContainsSubstring("checksum"));
  for (const char* const value : {"-11.25", "0.0", "null"})
    CHECK_THROWS_WITH(read_model<PodModel<>>(with_section(text, value, true), "ruler.json"),
                      ContainsSubstring("ruler.json") && ContainsSubstring("bending_stiffness"));
}
