// A hand presses a beam through a simulated Phantom, at 1 kHz.
//
// The tick is in servo.hpp; here it is put together, started and watched.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <variant>
#include <vector>

#include "options.hpp"
#include "report.hpp"
#include "scene.hpp"
#include "servo.hpp"
#include "trained.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/virtual_phantom.hpp>
#include <hapbeam/rom/guarded.hpp>

namespace {

using namespace phantom;

volatile std::sig_atomic_t interrupted = 0;

extern "C" void interrupt(int) { interrupted = 1; }

/// Real time: the device ticks on its thread, this one prints a row a second.
template <typename Device, typename Tick>
void watch(Device& device, Tick& servo, const Notes& notes, double duration) {
  using Clock = std::chrono::steady_clock;
  device.start(servo);
  const auto begin = Clock::now();
  const auto at = [begin](double seconds) {
    return begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  double next_row = 1;
  while (!interrupted && Clock::now() < at(duration)) {
    std::this_thread::sleep_until(
        std::min(at(std::min(next_row, duration)), Clock::now() + std::chrono::milliseconds(50)));
    if (Clock::now() < at(next_row)) continue;
    print_row(notes, device.counts());
    next_row += 1;
  }
  device.stop();
}

/// Lock step: a row for each simulated second.
template <typename Device, typename Tick>
void simulate(Device& device, Tick& servo, const Notes& notes, double duration) {
  for (double left = duration; left > 0 && !interrupted; left -= 1) {
    device.run(servo, std::min(left, 1.0));
    print_row(notes, device.counts());
  }
}

template <typename Model>
int run(Model model, const Trained* trained, const Options& options, std::ofstream& report) {
  Notes notes;
  Servo<Model> servo(model, options, notes);
  hapbeam::VirtualPhantom<> device(make_path(options));

  print_scene(options, trained, device.info());
  if (options.lock_step) simulate(device, servo, notes, options.duration);
  else watch(device, servo, notes, options.duration);

  const Run result{options, trained, device.info(), notes, device.counts(), interrupted != 0};
  print_summary(result);
  if (options.report.empty()) return 0;
  if (report << json(result) << std::flush) return 0;
  std::fprintf(stderr, "phantom: %s: the report cannot be written\n", options.report.c_str());
  return 1;
}

template <typename Element>
int run_full(const Options& options, std::ofstream& report) {
  return run(hapbeam::FemModel<Element>(options.beam.make(), options.elements), nullptr, options, report);
}

/// The model is chosen once, here and below; a tick calls nothing virtual.
int run_full(const Options& options, std::ofstream& report) {
  using namespace hapbeam;
  switch (options.element) {
    case ElementChoice::linear: return run_full<Linear>(options, report);
    case ElementChoice::full: return run_full<VonKarman<FullIntegration>>(options, report);
    case ElementChoice::reduced: return run_full<VonKarman<ReducedIntegration>>(options, report);
    case ElementChoice::assumed_strain: break;
  }
  return run_full<VonKarman<AssumedStrain>>(options, report);
}

int run_trained(const Trained& trained, const Options& options, std::ofstream& report) {
  using Full = hapbeam::FemModel<>;
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!options.guarded) return run(fast, &trained, options, report);
        const Full full(trained.make_beam(), options.elements);
        return run(hapbeam::Guarded<Fast, Full>(fast, full), &trained, options, report);
      },
      trained.model);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (cli::wants_help(arguments)) return std::fputs(help().c_str(), stdout) < 0;
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  try {
    Options options = parse(arguments);
    std::optional<Trained> trained;
    if (!options.model.empty()) trained = load(options);
    std::ofstream report;
    if (!options.report.empty()) report.open(options.report);
    if (!report) {
      std::fprintf(stderr, "phantom: %s: the report cannot be written\n", options.report.c_str());
      return 1;
    }
    return trained ? run_trained(*trained, options, report) : run_full(options, report);
  } catch (const cli::UsageError& error) {
    std::fprintf(stderr, "phantom: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "phantom: %s\n", error.what());
    return 1;
  }
}
