// What the hand touches: one model, one coupling and their servo, put together by name and driven without knowing which.
//
// A tick makes one virtual call.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "options.hpp"
#include "trained.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>
#include <hapbeam/haptics/servo/tick_times.hpp>
#include <hapbeam/internal_forces.hpp>
#include <hapbeam/rod.hpp>

namespace phantom {

/// Of what bends in its plane, or in space.
using Shape = std::variant<hapbeam::Centreline<double>, hapbeam::Centreline<double, 3>>;
using Slender = std::variant<hapbeam::Beam, hapbeam::Rod>;

/// One of the beams, as it is drawn.
struct DrawnBeam {
  Shape shape;
  double above;  ///< [m] of its axis, over that of the first
};
/// All that yields: the beams, or a rod and the needle in the hand.
struct DrawnBody {
  std::vector<DrawnBeam> beams;
  std::vector<Eigen::Vector3d> contacts;  ///< [m] of the needle with the rod
};

class Body {
 public:
  virtual ~Body() = default;
  /// From the servo's thread.  Real-time: as hapbeam::Servo.
  virtual Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept = 0;
  virtual const hapbeam::ServoRecord& record() const noexcept = 0;  ///< of the last tick, the same thread's
  virtual const hapbeam::ServoRecord* second() const noexcept = 0;  ///< the same of the second hand, or null
  virtual void reset() noexcept = 0;                                ///< while no tick runs
  /// Of the newest tick, from one other thread: wait-free.  It stays until the next call.
  virtual const DrawnBody& drawn() noexcept = 0;
  virtual Shape rest() const noexcept = 0;                           ///< one of them, before it is touched
  virtual const hapbeam::Placement& placement() const noexcept = 0;  ///< of the device in the scene
  /// How far the beam is pressed from where it rests there [m]; 0 where it is not.
  virtual double depth(const hapbeam::ServoRecord& record) const noexcept = 0;
  virtual double deepest() const noexcept = 0;  ///< [m] magnitude that was asked, as the report has it
  /// Largest strain of the run, as every eighth tick shows it; 0 where the model does not tell.
  virtual hapbeam::PeakStrain<double> peak() const noexcept = 0;
  /// Largest error of the last force, relative, as the model states it, from any thread; not a number where it states none.
  virtual double force_error() const noexcept = 0;
  /// From the servo's thread: how far the place that is heard is from where it rests [m]; 0 without mass.
  virtual double moved() const noexcept = 0;
  /// Adds what has been heard since the last call, from one other thread.   @return samples a second; 0 without mass
  virtual int hear(std::vector<float>& samples) = 0;
  virtual double dissipated() const noexcept = 0;  ///< [J] dissipated by friction, in all touches
  virtual const hapbeam::TickTimes& times() const noexcept = 0;
  virtual std::uint64_t full_answers() const noexcept = 0;  ///< of the full model of a guarded one
  virtual const Options& options() const noexcept = 0;      ///< the coupling's figures filled in
  virtual const Slender& slender() const noexcept = 0;
  virtual const Trained* trained() const noexcept = 0;  ///< or null: finite elements
};

/// @param trained  the model, where options.model is not of finite elements; also the beam, where it is from a file
/// @throws cli::UsageError or std::invalid_argument where the options do not go together
std::unique_ptr<Body> make_body(const Options& options, std::shared_ptr<const Trained> trained,
                                const hapbeam::DeviceInfo& device);

}  // namespace phantom
