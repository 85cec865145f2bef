// A hand presses a beam through a simulated Phantom, at 1 kHz.
//
// Model, coupling and device make a session; here it is started and watched.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ending.hpp"
#include "options.hpp"
#include "recording.hpp"
#include "report.hpp"
#include "scene.hpp"
#include "session.hpp"
#include "sound_file.hpp"
#include "trained.hpp"
#ifdef HAPBEAM_EXAMPLES_WINDOW
#include "window/run_window.hpp"
#endif

namespace {

using namespace phantom;

/// Real time: the device ticks on its thread, this one prints a row a second.
template <typename Write>
void watch(Session& session, double duration, const Write& write) {
  using Clock = std::chrono::steady_clock;
  session.start();
  const auto begin = Clock::now();
  const auto at = [begin](double seconds) {
    return begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  double next_row = 1;
  while (!interrupted() && Clock::now() < at(duration)) {
    std::this_thread::sleep_until(
        std::min(at(std::min(next_row, duration)), Clock::now() + std::chrono::milliseconds(50)));
    write();
    if (Clock::now() < at(next_row)) continue;
    session.update();
    print_row(session);
    next_row += 1;
  }
}

/// Lock step: a row for each simulated second.
template <typename Write>
void simulate(Session& session, double duration, const Write& write) {
  for (double left = duration; left > 0 && !interrupted(); left -= 1) {
    session.run(std::min(left, 1.0));
    write();
    session.update();
    print_row(session);
  }
}

int run(Options options, std::shared_ptr<const Trained> trained, ReportFile& report) {
  Hand hand(options.replay.empty() ? Way(make_path(options)) : Way(read_recording(options.replay)));
  if (!options.replay.empty()) options.duration = hand.duration();
  Tape tape;
  std::optional<Recording> recording;
  if (!options.record.empty()) recording.emplace(options.record);
  std::optional<SoundFile> sound;
  if (!options.sound.empty()) sound.emplace(options.sound);
  Session session(options, std::move(trained), hand, tape);
  const auto write = [&] {
    if (sound) sound->take(session.body());
    tape.take([&](const Tick& tick) {
      if (recording) recording->write(tick);
    });
  };
  Ending ending([&](bool cut_short) {
    session.stop();
    write();
    return finish(session, recording ? &*recording : nullptr, sound ? &*sound : nullptr, tape.lost(), report,
                  cut_short);
  });

  print_scene(session.body().options(), session.body().trained(), session.device().info());
  if (options.lock_step) simulate(session, options.duration, write);
  else watch(session, options.duration, write);
  return ending.run(interrupted());
}

/// @return the exit status, where there is a window in which it then has run; else nothing, and why
std::optional<int> run_in_window([[maybe_unused]] const Options& options,
                                 [[maybe_unused]] const std::shared_ptr<const Trained>& trained,
                                 [[maybe_unused]] ReportFile& report, std::string& why) {
#ifdef HAPBEAM_EXAMPLES_WINDOW
  if (const std::unique_ptr<Display> display = Display::open(options.zoom, why))
    return run_window(*display, options, trained, report);
#else
  why = "it was built without GLFW, OpenGL, Dear ImGui and stb";
#endif
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (cli::wants_help(arguments)) return std::fputs(help().c_str(), stdout) < 0;
  catch_signals();
  try {
    Options options = parse(arguments);
    std::shared_ptr<const Trained> trained;
    if (!options.model.empty()) trained = std::make_shared<const Trained>(load(options));
    ReportFile report(options.report);
    const bool needs_window = !options.screenshot.empty() || options.tour > 0;
    if (!options.headless && (!options.lock_step || needs_window)) {
      std::string why;
      if (const auto status = run_in_window(options, trained, report, why)) return *status;
      std::fprintf(needs_window ? stderr : stdout, "phantom: no window: %s%s\n", why.c_str(),
                   needs_window ? "" : "; runs headless");
      if (needs_window) return 1;
    }
    return run(options, std::move(trained), report);
  } catch (const cli::UsageError& error) {
    std::fprintf(stderr, "phantom: %s\n", error.what());
    return 2;
  } catch (const std::invalid_argument& error) {  // options that do not go together
    std::fprintf(stderr, "phantom: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "phantom: %s\n", error.what());
    return 1;
  }
}
