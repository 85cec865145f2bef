// Reads damaged model files by the million: each must end in a ModelFileError, or in a model that is safe to press.
//
//   fuzz_model_file [mutations = 20000] [seed = 1] [folder of seed files]
//
// A mutation flips, inserts, deletes, repeats or cuts bytes, splices two files, or puts an extreme in place of a number.
// Nearly all would end at the checksum, so it is made right again in half of them; in the other half nothing whose model
// part has changed may be accepted.  What is accepted must pass check(), and press() must give a finite force with a
// status for every request, and read the same again after it is written.  Deterministic: the standard fixes the generator.
// The seed files are valid ones and those that once were accepted and gave what they must not.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <hapbeam/rom/file/model_file.hpp>

using namespace hapbeam;

namespace {

std::mt19937_64 generator;
std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(generator() % n); }

[[noreturn]] void violation(const std::string& text, const std::string& what) {
  std::ofstream("fuzz_model_file_found.json", std::ios::binary) << text;
  std::fprintf(stderr, "%s; written to fuzz_model_file_found.json\n", what.c_str());
  std::exit(1);
}

const char* const extremes[] = {
    "0",     "-0.0",  "-1",       "1",    "2",       "3",          "64",      "65",       "1e-320", "1e-300",
    "1e-30", "1e-8",  "0.5",      "1e8",  "1e30",    "1e300",      "1.7e308", "-1.7e308", "1e999",  "NaN",
    "null",  "true",  "[]",       "{}",   "\"\"",    "3.4e38",     "1e-45",   "700",      "-700",   "89",
    "1e9",   "16384", "99999999", "2.54", "2.53746", "2147483647", "1e154",   "-1e30",    "4",      "1024"};
const char* const words[] = {"free", "clamped",  "pinned", "roller", "guided",
                             "pod",  "galerkin", "double", "float"};

/// The number, or the word, at or after `from` gets another value.
void replace_value(std::string& text, std::size_t from) {
  if (below(8) == 0) {
    const char* const word = words[below(std::size(words))];
    const std::size_t at = text.find(std::string("\"") + words[below(std::size(words))] + "\"", from);
    if (at == std::string::npos) return;
    text.replace(at + 1, text.find('"', at + 1) - at - 1, word);
    return;
  }
  const char* const digits = "+-.0123456789eE";
  std::size_t at = text.find_first_of(":[,", from);
  if (at == std::string::npos) return;
  at = text.find_first_of("-0123456789", at);
  if (at == std::string::npos) return;
  std::size_t end = text.find_first_not_of(digits, at);
  if (end == std::string::npos) end = text.size();
  text.replace(at, end - at, extremes[below(std::size(extremes))]);
}

std::string mutated(const std::vector<std::string>& seeds, bool& numbers_alone) {
  std::string text = seeds[below(seeds.size())];
  // Of numbers alone in half of the cases: others hardly ever leave JSON.
  numbers_alone = below(2) == 0;
  for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
    const std::size_t at = below(text.size()), size = std::min<std::size_t>(below(40), text.size() - at);
    switch (numbers_alone ? 7 : below(8)) {
      case 0: text[at] = static_cast<char>(text[at] ^ (1 << below(8))); break;
      case 1: text.insert(at, 1, static_cast<char>(below(256))); break;
      case 2: text.erase(at, size); break;
      case 3: text.insert(at, text.substr(at, size)); break;
      case 4: text.resize(at); break;
      case 5: {
        const std::string& other = seeds[below(seeds.size())];
        text = text.substr(0, at) + other.substr(below(other.size()));
        break;
      }
      case 6: text[at] = "{}[]\",:0e.-\n"[below(12)]; break;
      default: replace_value(text, at);
    }
  }
  return text;
}

void repair_checksum(std::string& text) {
  const std::size_t line = text.find('\n'), at = text.find("crc32:");
  if (line == std::string::npos || at == std::string::npos || at + 14 > line) return;
  text.replace(at, 14, detail::checksum(text.data() + line + 1, text.size() - line - 1));
}

template <class Model>
void press_everywhere(Model& model, const std::string& text) {
  using S = typename Model::Scalar;
  constexpr S infinity = std::numeric_limits<S>::infinity(), most = std::numeric_limits<S>::max();
  const auto range = model.range();
  const S L = model.data().beam.length;
  const S positions[] = {range.s_min,
                         range.s_max,
                         range.s_min / 2 + range.s_max / 2,
                         range.s_min * S(0.9) + range.s_max * S(0.1),
                         0,
                         L,
                         L / 3,
                         -L,
                         2 * L,
                         infinity,
                         std::numeric_limits<S>::quiet_NaN()};
  const S depths[] = {0,
                      range.depth,
                      -range.depth,
                      range.depth / 3,
                      -range.depth / 1000,
                      2 * range.depth,
                      -100 * range.depth,
                      L,
                      most,
                      -most,
                      std::numeric_limits<S>::denorm_min(),
                      -infinity,
                      std::numeric_limits<S>::quiet_NaN()};
  for (const S s : positions)
    for (const S d : depths) {
      const Response<S> response = model.press({s, d});
      if (!std::isfinite(response.force))
        violation(text, "press({" + std::to_string(s) + ", " + std::to_string(d) +
                            "}) gives a force that is not finite");
      for (const CentrelineNode<S>& node : model.shape())
        if (!is_finite(node))
          violation(text, "press({" + std::to_string(s) + ", " + std::to_string(d) +
                              "}) gives a shape that is not finite");
      if (model.shape().size() != model.data().shape.segments + 1)
        violation(text, "the shape has lost nodes");
    }
  model.reset();
}

/// Whether the text is a model of that type.
template <class Model>
bool accepted(const std::string& text) {
  try {
    Model model = read_model<Model>(text);
    check(model.data());
    press_everywhere(model, text);
    if (write_model(read_model<Model>(write_model(model))) != write_model(model))
      violation(text, "another model when it is written and read again");
    return true;
  } catch (const ModelFileError& error) {
    const std::string message = error.what();
    if (message.compare(0, 7, "model: ") != 0 || message.size() < 20)
      violation(text, "poor message: " + message);
    return false;
  } catch (const std::exception& error) {
    violation(text, std::string("is no ModelFileError: ") + error.what());
  }
}

bool accepted_by_any(const std::string& text) {
  return accepted<PodModel<double>>(text) || accepted<PodModel<float>>(text) ||
         accepted<PodModel<double, EquispacedNodes>>(text) || accepted<GalerkinModel<double>>(text) ||
         accepted<GalerkinModel<float>>(text);
}

}  // namespace

int main(int argc, char** argv) {
  const long mutations = argc > 1 ? std::atol(argv[1]) : 20000;
  generator.seed(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const std::string folder = argc > 3 ? argv[3] : HAPBEAM_TEST_DATA_DIR "/models";

  std::vector<std::string> names, seeds;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  long valid = 0;
  for (const std::string& name : names) {
    std::ifstream file(name, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    valid += accepted_by_any(seeds.back());
  }
  if (valid < 5) {
    std::fprintf(stderr, "%s: %ld valid seed files: must be 5 or more\n", folder.c_str(), valid);
    return 1;
  }

  long repaired = 0, taken = 0;
  for (long k = 0; k < mutations; ++k) {
    bool numbers_alone;
    std::string text = mutated(seeds, numbers_alone);
    if (k % 2 == 0) {
      repair_checksum(text);
      ++repaired;
      taken += accepted_by_any(text);
      continue;
    }
    const std::size_t line = text.find('\n');
    const std::string payload = line == std::string::npos ? "" : text.substr(line + 1);
    bool unchanged = false;
    for (const std::string& seed : seeds)
      unchanged = unchanged || payload == seed.substr(seed.find('\n') + 1);
    if (accepted_by_any(text) && !unchanged)
      violation(text, "accepted although its checksum is that of another file");
  }
  std::printf("%ld mutations of %zu files: %ld with a right checksum, %ld of them models; no violation\n",
              mutations, seeds.size(), repaired, taken);
  // A fuzzer whose files are all refused tests nothing but the refusal.
  return mutations >= 1000 && taken < mutations / 50;
}
