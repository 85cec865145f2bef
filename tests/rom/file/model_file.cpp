// A model file brings back every bit, and what is not exactly such a file makes an error that says what is wrong.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

#include "rom/trained/hand_made_models.hpp"
#include "support/catch.hpp"
#include <hapbeam/rom/file/model_file.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

template <class Model>
Model hand_made();
template <>
PodModel<double> hand_made() {
  return PodModel<double>(hand_made_pod<double>());
}
template <>
PodModel<float> hand_made() {
  return PodModel<float>(hand_made_pod<float>(false));
}
template <>
PodModel<double, EquispacedNodes> hand_made() {
  return PodModel<double, EquispacedNodes>(hand_made_pod<double>());
}
template <>
GalerkinModel<double> hand_made() {
  return GalerkinModel<double>(hand_made_galerkin<double>());
}
template <>
GalerkinModel<float> hand_made() {
  return GalerkinModel<float>(hand_made_galerkin<float>());
}

template <typename S>
bool same_bits(const std::vector<S>& a, const std::vector<S>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(S)) == 0;
}

/// A name in the folder where tests run.
std::string scratch(const std::string& name) { return "model_file_test_" + name + ".json"; }

/// The text with its first `from` replaced, and the checksum of the result.
std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  const std::size_t line = text.find('\n') + 1;
  const std::size_t checksum = text.find("crc32:");
  if (checksum < line) text.replace(checksum, 14, detail::checksum(text.data() + line, text.size() - line));
  return text;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const ModelFileError& error) {
    return error.what();
  }
  return "no ModelFileError";
}

template <class Model = PodModel<>>
std::string message(const std::string& text) {
  return message_of([&] { read_model<Model>(text, "bar.json"); });
}

}  // namespace

TEST_CASE("CRC-32 has its published check value", "[model_file]") {
  CHECK(detail::crc32("123456789", 9) == 0xCBF43926u);
  CHECK(detail::crc32("", 0) == 0u);
}

TEMPLATE_TEST_CASE("A model comes back from its file bit by bit", "[model_file]", PodModel<double>,
                   PodModel<float>, (PodModel<double, EquispacedNodes>), GalerkinModel<double>,
                   GalerkinModel<float>) {
  using S = typename TestType::Scalar;
  auto model = hand_made<TestType>();
  const std::string path = scratch("round_trip");
  save_model(model, path);
  auto loaded = load_model<TestType>(path);
  std::remove(path.c_str());

  CHECK(write_model(loaded) == write_model(model));
  CHECK(same_bits(loaded.data().shape.basis, model.data().shape.basis));
  CHECK(same_bits(loaded.data().shape.coefficients, model.data().shape.coefficients));
  CHECK(same_bits(loaded.data().shape.rest, model.data().shape.rest));
  CHECK(loaded.errors().reference == model.errors().reference);
  CHECK(loaded.errors().regions.size() == 2);
  CHECK(loaded.errors().all.shape_median == 5e-324);
  CHECK(loaded.errors().force_bound == 0.25);
  CHECK(loaded.errors().reference_error == 1e-7);
  const S L = model.data().beam.length;
  for (int i = -1; i <= 41; ++i)
    for (int j = -30; j <= 30; ++j) {
      const Press<S> press{L * S(i) / 40, S(j) / 400};
      const auto a = model.press(press), b = loaded.press(press);
      if (a.force != b.force || a.status != b.status) FAIL("another force at " << press.s << ", " << press.d);
      for (int k = 0; k < model.shape().size(); ++k)
        if (std::memcmp(&model.shape()[k], &loaded.shape()[k], sizeof model.shape()[k]) != 0)
          FAIL("another shape at " << press.s << ", " << press.d);
    }
}

TEMPLATE_TEST_CASE("The ends of the real numbers come back bit by bit", "[model_file]", double, float) {
  using limits = std::numeric_limits<TestType>;
  const std::vector<TestType> ends = {limits::denorm_min(), limits::min(),    limits::max(),
                                      TestType(-0.0),       limits::lowest(), 1 + limits::epsilon()};
  const std::string source = "test";
  detail::JsonWriter writer(source);
  writer.units();
  writer.table("ends", "1", ends);
  const std::string text = writer.text(limits::max_digits10);
  const detail::Json root = detail::parse_json(text.data(), text.size(), source, 1);
  detail::JsonReader reader(root.get(), source);
  reader.units();
  std::vector<TestType> found;
  reader.table("ends", "1", found);
  CHECK(same_bits(found, ends));

  auto data = hand_made_pod<TestType>();
  for (const std::size_t k : {0u, 1u, 3u, 5u}) data.shape.basis[k] = ends[k];
  data.shape.basis[2] = TestType(1e9);
  const auto loaded = read_model<PodModel<TestType>>(write_model(PodModel<TestType>(data)));
  CHECK(same_bits(loaded.data().shape.basis, data.shape.basis));
}

TEST_CASE("What would answer with what is not finite is no model", "[model_file]") {
  const std::string text = write_model(hand_made<PodModel<>>());
  SECTION("a shape beyond all lengths") {
    auto data = hand_made_pod<double>();
    data.shape.basis[2] = 1e10;
    CHECK_THROWS_WITH(PodModel<>(data),
                      ContainsSubstring("basis = 1e+10: must be within 1e9 in every entry"));
  }
  SECTION("a potential that falls to nothing between two positions") {
    auto data = hand_made_pod<double>();
    for (std::size_t k = 0; k < 3; ++k) data.potential[k] = 1e308, data.potential[6 + k] = 1e308;
    CHECK_THAT(message_of([&] { read_model<PodModel<>>(write_model(PodModel<>(data)), "bar.json"); }),
               ContainsSubstring("bar.json: is no model: its press at s = "));
  }
  SECTION("a stiffness that overflows") {
    auto data = hand_made_galerkin<double>();
    data.log_stiffness.assign(9, 720);
    CHECK_THAT(message_of([&] { read_model<GalerkinModel<>>(write_model(GalerkinModel<>(data))); }),
               ContainsSubstring("is no model: its press at s = "));
  }
  SECTION("a beam that is none") {
    CHECK_THAT(message(edited(text, "\"length\":2.54", "\"length\":1e20")),
               ContainsSubstring("length = 1e+20 m: must be from 1e-12 to 1e12"));
  }
}

TEST_CASE("A file says what is in it", "[model_file]") {
  const std::string path = scratch("describe");
  save_model(hand_made<GalerkinModel<float>>(), path);
  const ModelFileInfo info = describe_model_file(path);
  std::remove(path.c_str());
  CHECK(info.version == 2);
  CHECK(info.kind == "galerkin");
  CHECK(info.scalar == "float");
  CHECK(info.nodes == "chebyshev");
  CHECK(static_cast<float>(info.beam.length) == 2.54f);
  CHECK(info.beam.left == Support::pinned);
  CHECK(static_cast<float>(info.depth) == 0.05f);
}

TEST_CASE("Another writer's order, spaces and integers are the same model", "[model_file]") {
  const std::string text = write_model(hand_made<PodModel<>>());
  // jansson's own printer, sorted and indented
  const std::size_t line = text.find('\n') + 1;
  const detail::Json payload = detail::parse_json(text.data() + line, text.size() - line, "test", 1);
  char* const pretty = json_dumps(payload.get(), JSON_INDENT(2) | JSON_SORT_KEYS | JSON_REAL_PRECISION(17));
  std::string other =
      edited(text.substr(0, line) + pretty, "\"force_p95\": 0.10000000000000001", "\"force_p95\": 0");
  std::free(pretty);
  auto model = read_model<PodModel<>>(other);
  CHECK(model.errors().all.force_p95 == 0);
  CHECK(model.press({1.0, 0.01}).force == hand_made<PodModel<>>().press({1.0, 0.01}).force);
}

TEST_CASE("A damaged file is told by its checksum", "[model_file]") {
  const std::string text = write_model(hand_made<PodModel<>>());
  const std::size_t line = text.find('\n') + 1;
  for (std::size_t size = 0; size < text.size(); ++size)
    if (message(text.substr(0, size)) == "no ModelFileError") FAIL("accepted when cut off after " << size);
  CHECK_THAT(message(text.substr(0, 100)), ContainsSubstring("bar.json: checksum = \"crc32:") ||
                                               ContainsSubstring("bar.json: has one line"));
  CHECK_THAT(message(text.substr(0, line + 50)),
             ContainsSubstring("checksum = \"crc32:") && ContainsSubstring("cut off, damaged or changed"));
  for (std::size_t at = 0; at < text.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = text;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
      if (message(flipped) == "no ModelFileError")
        FAIL("accepted with bit " << bit << " of byte " << at << " flipped");
    }
  CHECK_THAT(message(text + " "), ContainsSubstring("checksum = "));
}

TEST_CASE("What is not a model of that type is told", "[model_file]") {
  const std::string pod = write_model(hand_made<PodModel<>>());
  CHECK_THAT(message<GalerkinModel<>>(pod),
             ContainsSubstring("bar.json: kind = \"pod\": must be \"galerkin\""));
  CHECK_THAT(message<PodModel<float>>(pod), ContainsSubstring("scalar = \"double\": must be \"float\""));
  CHECK_THAT((message<PodModel<double, EquispacedNodes>>(pod)),
             ContainsSubstring("nodes = \"chebyshev\": must be \"equispaced\""));
  CHECK_THAT(message(edited(pod, "\"version\":2", "\"version\":1")),
             ContainsSubstring("version = 1: must be 2"));
  CHECK_THAT(message(edited(pod, "\"version\":2", "\"version\":-1")),
             ContainsSubstring("version = -1: must be"));
  CHECK_THAT(message(edited(pod, "hapbeam model", "music")),
             ContainsSubstring("format = \"music\": must be \"hapbeam model\""));
  CHECK_THAT(message(edited(pod, "\"pod\"", "\"tensor\"")),
             ContainsSubstring("kind = \"tensor\": must be \"pod\""));
  CHECK_THAT(message(edited(pod, "{\"format\"", "{\"colour\":1,\"format\"")),
             ContainsSubstring("colour = 1 is no member"));
  CHECK_THAT(message(""), ContainsSubstring("bar.json: has one line"));
  CHECK_THAT(message("\n"), ContainsSubstring("line 1, column 0 is no JSON"));
  CHECK_THAT(message("[]\n{}"), ContainsSubstring("is an array of 0: must be an object"));
  CHECK_THAT(message(edited(pod, pod.substr(pod.find('\n') + 1), "[1]\n")),
             ContainsSubstring("is an array of 1: must be an object"));
  CHECK_THAT(message(edited(pod, "]}}\n", "]}}\n{}")), ContainsSubstring("end of file expected"));
}

TEST_CASE("Each wrong member is told by name, value, unit and what is allowed", "[model_file]") {
  struct Fault {
    const char *from, *to, *expected;
  };
  const std::string text = write_model(hand_made<PodModel<>>());
  const Fault faults[] = {
      {"\"length\":2.54", "\"length\":-1", "length = -1 m: must be positive and finite"},
      {"\"length\":2.54", "\"length\":0", "length = 0 m: must be positive and finite"},
      {"\"length\":2.54", "\"length\":\"2.54\"", "beam.length = \"2.54\" m: must be a number from"},
      {"\"length\":2.54", "\"length\":null", "beam.length = null m: must be a number"},
      {"\"length\":2.54", "\"length\":NaN", "is no JSON: invalid token near 'NaN'"},
      {"\"length\":2.54", "\"length\":-Infinity", "is no JSON: invalid token"},
      {"\"length\":2.54", "\"length\":1e999", "is no JSON: real number overflow"},
      {"\"length\":2.54", "\"length\":1e300", "must be"},
      {"\"length\":2.54,", "", "beam.length is missing"},
      {"\"length\":2.54", "\"length\":2.54,\"length\":2.54", "is no JSON: duplicate object key"},
      {"\"length\":2.54", "\"length\":2.54,\"width\":1", "beam.width = 1 is no member"},
      {"\"length\":2.54", "\"length\":2.54,\"more\":{}", "beam.more = an object is no member"},
      {"\"nodes\":", "\"beam.length\":2.54,\"nodes\":", "beam.length = 2.54 is no member"},
      {"\"beam\":{", "\"beam\":5,\"other\":{", "beam.length is missing"},
      {"\"beam.length\":\"m\"", "\"beam.length\":\"in\"", "the unit of beam.length is \"in\": must be \"m\""},
      {"\"beam.length\":\"m\"", "\"beam.length\":1", "the unit of beam.length is 1: must be \"m\""},
      {"\"beam.length\":\"m\",", "", "units has none for beam.length: must be \"m\""},
      {"\"beam.length\":\"m\"", "\"beam.length\":\"m\",\"age\":\"s\"",
       "age = \"s\" has a unit, but is no real"},
      {"\"left\":\"pinned\"", "\"left\":\"glued\"",
       "beam.left = \"glued\": must be one of free, clamped, pinned, roller, guided"},
      {"\"left\":\"pinned\",\"right\":\"clamped\"", "\"left\":\"pinned\",\"right\":\"free\"",
       "the beam is a mechanism, it turns about its only hinge"},
      {"\"left\":\"pinned\",\"right\":\"clamped\"", "\"left\":\"roller\",\"right\":\"roller\"",
       "the beam is a mechanism, it slides"},
      {"\"left\":\"pinned\",\"right\":\"clamped\"", "\"left\":\"guided\",\"right\":\"guided\"",
       "the beam is a mechanism, it moves across"},
      {"\"s_min\":0.127", "\"s_min\":0", "s_min = 0 m: must be on the beam"},
      {"\"s_min\":0.127", "\"s_min\":2.5", "s_max = 2.413 m: must be s_min to the end"},
      {"\"depth\":0.050000000000000003", "\"depth\":0.6",
       "depth = 0.6 m: must be within the depths of the grid"},
      {"\"symmetric\":true", "\"symmetric\":1", "grid.symmetric = 1: must be true or false"},
      {"\"symmetric\":true", "\"symmetric\":\"true\"", "grid.symmetric = \"true\": must be true or false"},
      {"\"positions\":3", "\"positions\":1000000000", "positions = 1e+09: must be 1 to 64"},
      {"\"positions\":3", "\"positions\":1e9", "grid.positions = 1e9: must be a whole number from 0"},
      {"\"positions\":3", "\"positions\":4294967299", "grid.positions = 4294967299: must be a whole number"},
      {"\"positions\":3", "\"positions\":99999999999999999999", "is no JSON: too big integer"},
      {"\"positions\":3", "\"positions\":-3", "grid.positions = -3: must be a whole number"},
      {"\"positions\":3", "\"positions\":3.0", "grid.positions = 3.0: must be a whole number"},
      {"\"positions\":3", "\"positions\":4", "potential = 9"},
      {"\"depths\":3", "\"depths\":2", "potential = 9"},
      {"\"modes\":2", "\"modes\":3", "basis = 18"},
      {"\"modes\":2", "\"modes\":0", "modes = 0"},
      {"\"segments\":2", "\"segments\":2147483647", "segments = 2.14748e+09: must be 1 to 16384"},
      {"\"contact_node\":1", "\"contact_node\":3", "contact_node = 3"},
      {"\"potential\":[", "\"potential\":[[],", "potential[0] = an array of 0 N/m: must be a number"},
      {"\"potential\":[", "\"potential\":[1,", "potential = 10"},
      {"\"potential\":[", "\"potential\":[],\"p\":[", "p = an array of 9 is no member"},
      {"\"potential\":[", "\"potential\":{\"a\":1},\"p\":[", "potential = an object: must be an array"},
      {"\"potential\":[8", "\"potential\":[-8", "must be positive"},
      {"\"presses\":500", "\"presses\":-1", "errors.all.presses = -1: must be a whole number"},
      {"\"presses\":250", "\"presses\":true", "errors.regions[0].presses = true: must be a whole number"},
      {"\"presses\":250,", "", "errors.regions[0].presses is missing"},
      {"\"presses\":250", "\"presses\":250,\"by\":[]", "errors.regions[0].by = an array of 0 is no member"},
      {"\"regions\":[", "\"regions\":[3,", "errors.regions[0] = 3: must be an object"},
      {"\"all\":{", "\"all\":7,\"other\":{", "errors.all = 7: must be an object"},
      {"\"reference\":\"", "\"reference\":\"\\u0000", "is no JSON: \\u0000 is not allowed"},
      {"\"reference\":\"", "\"reference\":\"\xff", "is no JSON: unable to decode byte 0xff"},
      {"\"nodes\":\"chebyshev\"", "\"nodes\":[\"chebyshev\"]", "nodes = an array of 1: must be a string"},
  };
  for (const Fault& fault : faults) {
    INFO(fault.from << " -> " << fault.to);
    const std::string found = message(edited(text, fault.from, fault.to));
    CHECK_THAT(found, ContainsSubstring(fault.expected));
    CHECK_THAT(found, ContainsSubstring("bar.json: "));
  }
  const std::string single = write_model(hand_made<PodModel<float>>());
  CHECK_THAT(
      message<PodModel<float>>(edited(single, "\"length\":2.53999996", "\"length\":1e39")),
      ContainsSubstring("beam.length = 1e39 m: must be a number from -3.4028235e+38 to 3.4028235e+38"));
}

TEST_CASE("An error report that is not finite is not written", "[model_file]") {
  auto data = hand_made_pod<double>();
  data.errors.regions[1].errors.force_max = std::numeric_limits<double>::infinity();
  CHECK_THAT(message_of([&] { write_model(PodModel<>(data), "bar.json"); }),
             ContainsSubstring("bar.json: errors.regions.force_max = inf: must be finite"));
  data = hand_made_pod<double>();
  data.errors.reference = "\xc3";
  CHECK_THAT(message_of([&] { write_model(PodModel<>(data)); }),
             ContainsSubstring("errors.reference: must be UTF-8"));
}

TEST_CASE("What is no file is told, and a save that fails leaves what was there", "[model_file]") {
  CHECK_THAT(message_of([] { load_model<PodModel<>>("no/such.json"); }),
             ContainsSubstring("no/such.json: cannot be opened: No such file"));
  CHECK_THAT(message_of([] { load_model<PodModel<>>("."); }), ContainsSubstring(".: cannot be read: "));
  CHECK_THAT(message_of([] { describe_model_file("no/such.json"); }), ContainsSubstring("cannot be opened"));
  const auto model = hand_made<PodModel<>>();
  CHECK_THAT(message_of([&] { save_model(model, "no/such.json"); }),
             ContainsSubstring("no/such.json: cannot be written: No such file"));

  // Replaced as a whole.
  const std::string path = scratch("replaced");
  std::ofstream(path) << "old";
  save_model(model, path);
  CHECK(write_model(load_model<PodModel<>>(path)) == write_model(model));
  std::remove(path.c_str());
}

TEST_CASE("A file beyond the limit is refused before it is understood", "[model_file]") {
  CHECK_THAT(message(std::string(detail::largest_json_file + 1, ' ')),
             ContainsSubstring("size = 33554433 bytes: must be at most 33554432"));
  CHECK_THAT(message_of([] { load_model<PodModel<>>("/dev/zero"); }),
             ContainsSubstring("must be at most 33554432"));
}
