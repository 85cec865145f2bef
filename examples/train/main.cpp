// Trains a model of a beam and writes it to a file.
//
// Offline from end to end: nothing here is called in a servo tick.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "options.hpp"
#include "plot.hpp"
#include "report.hpp"
#include "training.hpp"
#include <hapbeam/rom/file/model_file.hpp>

namespace {

/// Set by whichever thread the signal finds, read by those that press.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first asks, at a place where nothing is half done; the second ends at once.
extern "C" void interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

/// Between two presses and between two stages; a file is written whole.
void stop_if_interrupted() {
  if (interrupted) throw std::runtime_error("interrupted, no model was written");
}

void run(const train::Options& options) {
  using Clock = std::chrono::steady_clock;
  train::print_plan(options);
  train::ProgressBar bar("presses");
  const train::Result result = train::run(options, [&bar](int done, int total) {
    stop_if_interrupted();
    bar.show(done, total);
  });
  stop_if_interrupted();
  train::print_result(options, result);

  const auto begin = Clock::now();
  std::visit([&options](const auto& model) { hapbeam::save_model(model, options.output); }, *result.model);
  const std::chrono::duration<double> seconds = Clock::now() - begin;
  train::print_file(options, result, std::filesystem::file_size(options.output), seconds.count());
  std::fflush(stdout);
  if (!options.plot.empty()) train::plot(options, result);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (cli::wants_help(arguments)) return std::fputs(train::help().c_str(), stdout) < 0;
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  try {
    run(train::parse(arguments));
    return 0;
  } catch (const cli::UsageError& error) {
    std::fprintf(stderr, "train: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "train: %s\n", error.what());
    return 1;
  }
}
