// What the user sees: the scene in words, a table row a second, the summary, and the summary as JSON.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "options.hpp"
#include "session.hpp"
#include "trained.hpp"
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>
#include <hapbeam/haptics/servo/tick_times.hpp>
#include <hapbeam/internal_forces.hpp>

namespace phantom {

/// What was run, and how it went.
struct Run {
  /// @param session  one that has stopped; kept by reference
  /// @param pictures  times from one picture to the next; none headless
  static Run of(Session& session, bool interrupted, const hapbeam::TimeSummary& pictures = {});

  const Options& options;
  const Trained* trained;  ///< or null: finite elements alone
  const hapbeam::DeviceInfo& device;
  const hapbeam::ServoRecord record;
  const std::optional<hapbeam::ServoRecord> second;  ///< of the second hand, if there is one
  const hapbeam::TickTimes& times;
  double deepest;  ///< [m]
  hapbeam::PeakStrain<double> peak;
  double dissipated;  ///< [J] dissipated by friction
  hapbeam::DeviceCounts counts;
  std::uint64_t full_answers;  ///< of the full model of a guarded one
  hapbeam::RealTime priority;  ///< of the servo's thread
  bool interrupted;
  hapbeam::TimeSummary pictures;
};

/// @param trained  or null
void print_scene(const Options& options, const Trained* trained, const hapbeam::DeviceInfo& device);
/// Of the newest tick that the session took.
void print_row(Session& session);
void print_summary(const Run& run);
std::string json(const Run& run);

/// The file of a report, opened before the run, so that a wrong path is noticed then.
class ReportFile {
 public:
  /// @param path  or empty: none   @throws std::runtime_error where it cannot be written
  explicit ReportFile(const std::string& path);
  bool write(const std::string& text);  ///< else says so

 private:
  std::string path_;
  std::ofstream file_;
};

}  // namespace phantom
