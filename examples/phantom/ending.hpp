// How a run ends. Whatever ends it, the loop is stopped first; then recording, sound, summary and report are written.
//
//   window closed, duration over          the caller ends
//   Ctrl-C, kill, terminal closed         a signal: interrupted()
//   nobody reads the output, disk full    no signal, but a write that fails: interrupted() after the row of that second
//   exception, exit() by a library        Ending: Xlib calls exit() where its server or window is lost
#pragma once

#include <cstdint>
#include <functional>
#include <thread>

#include "recording.hpp"
#include "report.hpp"
#include "session.hpp"
#include "sound_file.hpp"
#include <hapbeam/haptics/servo/tick_times.hpp>

namespace phantom {

/// From now on signals do not end the process.
void catch_signals();
/// A signal asked for the end, or the output cannot be written.
bool interrupted() noexcept;

/// Calls a function once: when it is told to, when its scope is left, or when its thread calls exit(). One at a time.
class Ending {
 public:
  /// @param finish  called with whether the run was interrupted; @return the exit status
  explicit Ending(std::function<int(bool interrupted)> finish);
  ~Ending();
  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

  int run(bool interrupted);

 private:
  static void exits() noexcept;

  std::function<int(bool)> finish_;
  const std::thread::id thread_ = std::this_thread::get_id();
};

/// Of a session that has stopped: closes the recording and the sound, prints the summary, unless it was only to draw pictures, and writes the report.
/// What cannot be written is said, and costs nothing else.
/// @param recording  or null   @param sound  or null   @param lost  ticks of the recording   @return the exit status
int finish(Session& session, Recording* recording, const SoundFile* sound, std::uint64_t lost,
           ReportFile& report, bool interrupted, const hapbeam::TimeSummary& pictures = {});

}  // namespace phantom
