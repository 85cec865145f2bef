// What reading a file takes in memory is bounded by the file's size, whatever is in it.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <string>

#include "rom/trained/hand_made_models.hpp"
#include "support/catch.hpp"
#include <hapbeam/rom/file/model_file.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

// Bytes that the parser holds, with 16 for the allocator's own note on each block.
std::size_t held = 0, most_held = 0;
constexpr std::size_t note = 16;

void* allocate(std::size_t size) {
  auto* const block = static_cast<std::max_align_t*>(std::malloc(size + sizeof(std::max_align_t)));
  if (!block) return nullptr;
  *reinterpret_cast<std::size_t*>(block) = size;
  held += size + note;
  most_held = std::max(most_held, held);
  return block + 1;
}
void release(void* pointer) {
  if (!pointer) return;
  auto* const block = static_cast<std::max_align_t*>(pointer) - 1;
  held -= *reinterpret_cast<std::size_t*>(block) + note;
  std::free(block);
}

/// Largest memory that the parser holds while a text of that payload is read.   @param taken  out: whether it is a model
std::size_t memory_of(const std::string& payload, bool& taken) {
  const std::string text =
      detail::model_file_text("pod", "double", payload, "test");  // a header with the right checksum
  held = most_held = 0;
  json_set_alloc_funcs(allocate, release);
  try {
    read_model<PodModel<>>(text);
    taken = true;
  } catch (const ModelFileError&) {
    taken = false;
  }
  json_set_alloc_funcs(std::malloc, std::free);
  CHECK(held == 0);
  return most_held;
}

std::string repeated(const std::string& part, std::size_t size) {
  std::string text;
  while (text.size() < size) text += part;
  return text;
}

}  // namespace

TEST_CASE("The parser takes at most 20 times the size of a file, and 64 kB", "[model_file]") {
  const std::size_t size = 1 << 20;
  int number = 0;
  const auto object_of = [&](const char* member) {
    std::string text = "{";
    while (text.size() < size) text += "\"" + std::to_string(++number) + "\":" + member + ",";
    return text + "\"a\":0}";
  };
  const auto array_of = [&](const char* part) { return "{\"a\":[" + repeated(part, size) + "0]}"; };
  const std::string payloads[] = {array_of("0,"),
                                  array_of("0.0,"),
                                  array_of("[],"),
                                  array_of("{},"),
                                  array_of("\"\","),
                                  array_of("[0.25],"),
                                  array_of("{\"a\":0},"),
                                  array_of("123,"),
                                  object_of("0"),
                                  object_of("[]"),
                                  object_of("{}"),
                                  repeated("[", 2000),
                                  repeated("[", size),
                                  "{\"a\":\"" + repeated("x", size) + "\"}",
                                  array_of("\"abc\","),
                                  "{\"a\":" + repeated("1", size) + "}",
                                  "{\"" + repeated("\\u00e9", size) + "\":0}"};
  for (const std::string& payload : payloads) {
    bool taken;
    const std::size_t memory = memory_of(payload + "\n", taken);
    INFO(payload.substr(0, 20) << " … of " << payload.size() << " bytes takes " << memory);
    CHECK_FALSE(taken);
    CHECK(memory <= 20 * payload.size() + (1 << 16));
  }
}

TEST_CASE("A model of nothing but zeros is within it", "[model_file]") {
  auto data = hand_made_pod<double>();
  data.shape.segments = 512, data.shape.modes = 32;
  data.shape.basis.assign(3 * 513 * 32, 0.0);
  data.shape.coefficients.assign(9 * 32, 0.0);
  data.shape.rest.assign(3 * 513, 0.0);
  data.errors.regions.assign(100, data.errors.regions.back());
  const std::string text = write_model(PodModel<>(data));
  bool taken;
  const std::size_t memory = memory_of(text.substr(text.find('\n') + 1), taken);
  INFO(memory << " bytes for " << text.size());
  CHECK(taken);
  CHECK(memory <= 20 * text.size() + (1 << 16));
}
