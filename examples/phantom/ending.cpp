#include "ending.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace phantom {

namespace {

volatile std::sig_atomic_t signalled = 0;
extern "C" void note_signal(int) { signalled = 1; }

std::atomic<Ending*> current{nullptr};

}  // namespace

void catch_signals() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
#ifdef SIGHUP
  std::signal(SIGQUIT, note_signal);
  std::signal(SIGPIPE, SIG_IGN);
  // What is told to outlive its terminal does.
  if (std::signal(SIGHUP, note_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
#endif
}

bool interrupted() noexcept { return signalled != 0 || std::ferror(stdout) != 0; }

Ending::Ending(std::function<int(bool)> finish) : finish_(std::move(finish)) {
  static const bool registered = std::atexit(exits) == 0;
  static_cast<void>(registered);
  current = this;
}

Ending::~Ending() {
  run(true);
  current = nullptr;
}

int Ending::run(bool interrupted) {
  const auto finish = std::exchange(finish_, nullptr);
  return finish ? finish(interrupted) : 0;
}

void Ending::exits() noexcept {
  Ending* const ending = current;
  // The servo's thread cannot wait for itself.
  if (ending && ending->thread_ == std::this_thread::get_id()) ending->run(true);
}

int finish(Session& session, Recording* recording, const SoundFile* sound, std::uint64_t lost,
           ReportFile& report, bool interrupted, const hapbeam::TimeSummary& pictures) {
  bool written = !recording || recording->close(lost);
  const Run run = Run::of(session, interrupted, pictures);
  if (run.options.screenshot.empty()) print_summary(run);
  if (sound) written &= sound->close();
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::fputs("phantom: the output cannot be written\n", stderr);
    written = false;
  }
  written &= report.write(json(run));
  return written ? 0 : 1;
}

}  // namespace phantom
