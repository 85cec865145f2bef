// What a servo tells those who watch it: the latest tick and what has happened since the start.
//
// Plain values.  No allocation, noexcept.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <hapbeam/centreline.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

/// What a tick was.  The first that applies, from the last to the first.
enum class LoopStatus : std::uint8_t {
  free,          ///< the hand touches nothing; the force is zero
  touching,      ///< the force is that of the beam, through the coupling
  out_of_range,  ///< the same, with a model that answers for the nearest press it knows (Status::out_of_range)
  engaging,      ///< the force is coming in, after a start, a failure or a pause
  limited,       ///< the guard or the device cut the force: what is felt is less than the beam
  continued,  ///< the model ran out of its budget, or was pressed from too far out: the last good force goes on along its
              ///< tangent
  no_answer,  ///< the model failed (ServoRecord::model says how): the force is zero and engages anew
  device,     ///< the device is warm, or recovers from a force error, or has asked to begin anew
};

/// Short lower-case name, for messages and reports.
constexpr const char* name(LoopStatus status) noexcept {
  switch (status) {
    case LoopStatus::free: return "free";
    case LoopStatus::touching: return "touching";
    case LoopStatus::out_of_range: return "out_of_range";
    case LoopStatus::engaging: return "engaging";
    case LoopStatus::limited: return "limited";
    case LoopStatus::continued: return "continued";
    case LoopStatus::no_answer: return "no_answer";
    case LoopStatus::device: return "device";
  }
  return "unknown";
}

struct ServoRecord {
  LoopStatus status = LoopStatus::free;
  Status model = Status::ok;                           ///< what the beam said
  double time = 0;                                     ///< [s] of the device's clock
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the hand, device axes
  Eigen::Vector3d hand =
      Eigen::Vector3d::Zero();  ///< [m] the same in the scene; a beam's plane is its x and y
  Eigen::Vector3d avatar = Eigen::Vector3d::
      Zero();  ///< [m] from where the beam is pressed; the hand, where free; a stylus' tip, a held end
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N] sent, device axes
  Eigen::Vector3d torque =
      Eigen::Vector3d::Zero();  ///< [N·m] sent, device axes; zero for a device of three axes
  Eigen::Vector3d shaft = Eigen::Vector3d::
      Zero();  ///< [m] from the avatar to the other end of its axis, in the scene; zero: a sphere
  Press<double> press{0, 0};  ///< asked of the model; zero where nothing was
  bool pressing = false;      ///< the hand holds the beam: it is touched, or its force goes on
  bool sliding = false;       ///< with friction: the contact slides, else it sticks
  Eigen::Vector3d friction =
      Eigen::Vector3d::Zero();  ///< [N] the tangential part of the beam's force, in the scene
  double dissipated = 0;        ///< [J] by friction, since the touch began
  double heat = 0;              ///< of the motors, 1: only the continuous force is left

  std::uint64_t ticks = 0;            ///< since the start
  std::uint64_t contact_ticks = 0;    ///< the beam was touched
  std::uint64_t touches = 0;          ///< contact began
  std::uint64_t saturated_ticks = 0;  ///< the guard or the device cut the force
  std::uint64_t continued_ticks = 0;  ///< without an answer to where the hand is, by the tangent
  std::uint64_t failed_ticks = 0;     ///< the force was zero because something failed
  double max_press = 0;               ///< [m] magnitude
  double max_force = 0;               ///< [N] sent
  double max_torque = 0;              ///< [N·m] sent
  double energy_generated = 0;        ///< [J] that nobody put in (energy_monitor.hpp)
  Status worst = Status::ok;          ///< of the model
};

}  // namespace hapbeam
