// Runs on file: a CSV row for each tick, written while the loop runs and read again as a path for the hand.
//
//   time_s,hand_x_m,hand_y_m,hand_z_m,hand_vx_m_per_s,hand_vy_m_per_s,hand_vz_m_per_s,x_m,y_m,z_m,force_x_N,force_y_N,force_z_N,
//   place_m,depth_m,friction_x_N,friction_y_N,friction_z_N,slides,dissipated_J,status,model
//
// hand is where the hand wanted to be, x, y and z where the device was, depth the press asked of the model.  friction is the
// tangential force of the beam in the scene, slides 0 where the contact sticks, dissipated what friction has taken in this touch.  All digits are
// written, so that the same path through the same model gives the same forces to the bit, in lock step.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "hand.hpp"
#include "tape.hpp"

namespace phantom {

class Recording {
 public:
  /// @throws std::runtime_error where the file cannot be written
  explicit Recording(const std::string& path);
  void write(const Tick& tick);
  /// @param lost  ticks that were not taken from the tape   @return whether all else was written; says what is missing
  bool close(std::uint64_t lost);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// The hand's path of a recording, in memory that the file bounds; periods that the loop has missed keep the target before them.
/// @throws std::runtime_error naming file and line where it is no recording, and of a row that is not whole
Replay read_recording(const std::string& path);

}  // namespace phantom
