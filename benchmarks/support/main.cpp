// The main of every benchmark: a result without machine, compiler, flags and commit cannot be compared.
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>

#include "commit.hpp"

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("compiler", HAPBEAM_COMPILER);
  benchmark::AddCustomContext("flags", HAPBEAM_FLAGS);
  benchmark::AddCustomContext("commit", HAPBEAM_COMMIT);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
