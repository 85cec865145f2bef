// A hand presses a beam through a simulated Phantom, at 1 kHz.
//
// Model, coupling and device make a ServoLoop; here it is put together, started and watched.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <variant>
#include <vector>

#include "counted.hpp"
#include "options.hpp"
#include "report.hpp"
#include "scene.hpp"
#include "trained.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo_loop.hpp>
#include <hapbeam/haptics/virtual_phantom.hpp>

namespace {

using namespace phantom;

volatile std::sig_atomic_t interrupted = 0;

extern "C" void interrupt(int) { interrupted = 1; }

using Device = hapbeam::VirtualPhantom<>;

/// Real time: the device ticks on its thread, this one prints a row a second.
template <typename Loop>
void watch(Loop& loop, const Device& device, double duration) {
  using Clock = std::chrono::steady_clock;
  loop.start();
  const auto begin = Clock::now();
  const auto at = [begin](double seconds) {
    return begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  double next_row = 1;
  while (!interrupted && Clock::now() < at(duration)) {
    std::this_thread::sleep_until(
        std::min(at(std::min(next_row, duration)), Clock::now() + std::chrono::milliseconds(50)));
    if (Clock::now() < at(next_row)) continue;
    print_row(loop.picture().record, loop.times(), device.counts());
    next_row += 1;
  }
  loop.stop();
}

/// Lock step: a row for each simulated second.
template <typename Loop>
void simulate(Loop& loop, Device& device, double duration) {
  for (double left = duration; left > 0 && !interrupted; left -= 1) {
    device.run(loop.servo(), std::min(left, 1.0));
    print_row(loop.picture().record, loop.times(), device.counts());
  }
}

/// Whose full model, if it has one, answered how often.
using FullAnswers = std::atomic<std::uint64_t>;

template <typename Coupling, typename Model>
int run(Model& model, const Coupling& coupling, Device& device, const FullAnswers& full_answers,
        const Trained* trained, const Options& options, std::ofstream& report) {
  hapbeam::ServoOptions servo;
  servo.placement = placement(options);
  servo.avatar_radius = options.radius;
  hapbeam::ServoLoop<Device, Model, Coupling> loop(device, model, servo, coupling);

  print_scene(options, trained, device.info());
  if (options.lock_step) simulate(loop, device, options.duration);
  else watch(loop, device, options.duration);

  const Run result{options,      trained,         device.info(),       loop.picture().record,
                   loop.times(), device.counts(), full_answers.load(), interrupted != 0};
  print_summary(result);
  if (options.report.empty()) return 0;
  if (report << json(result) << std::flush) return 0;
  std::fprintf(stderr, "phantom: %s: the report cannot be written\n", options.report.c_str());
  return 1;
}

template <typename Model>
int run(Model model, const FullAnswers& full_answers, const Trained* trained, Options options,
        std::ofstream& report) {
  Device device(make_path(options));
  if (options.coupling == CouplingChoice::direct)
    return run(model, hapbeam::Direct(), device, full_answers, trained, options, report);
  const hapbeam::CouplingFigures safe = hapbeam::safe_coupling(device.info());
  if (std::isnan(options.stiffness)) options.stiffness = safe.stiffness;
  if (std::isnan(options.damping)) options.damping = safe.damping;
  const hapbeam::VirtualCoupling coupling({options.stiffness, options.damping}, device.info().period);
  return run(model, coupling, device, full_answers, trained, options, report);
}

template <typename Element>
int run_full(const Options& options, std::ofstream& report) {
  return run(hapbeam::FemModel<Element>(options.beam.make(), options.elements), FullAnswers{0}, nullptr,
             options, report);
}

/// The model is chosen once, here and below; a tick calls nothing virtual.
int run_full(const Options& options, std::ofstream& report) {
  using namespace hapbeam;
  switch (options.element) {
    case ElementChoice::linear: return run_full<Linear>(options, report);
    case ElementChoice::full: return run_full<VonKarman<FullIntegration>>(options, report);
    case ElementChoice::reduced: return run_full<VonKarman<ReducedIntegration>>(options, report);
    case ElementChoice::corotational: return run_full<Corotational<>>(options, report);
    case ElementChoice::assumed_strain: break;
  }
  return run_full<VonKarman<AssumedStrain>>(options, report);
}

int run_trained(const Trained& trained, const Options& options, std::ofstream& report) {
  using Full = hapbeam::FemModel<>;
  FullAnswers full_answers{0};
  return std::visit(
      [&](const auto& fast) {
        using Fast = std::decay_t<decltype(fast)>;
        if (!options.guarded) return run(fast, full_answers, &trained, options, report);
        const Full full(trained.make_beam(), options.elements);
        return run(Counted<Fast, Full>(fast, full, full_answers), full_answers, &trained, options, report);
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
