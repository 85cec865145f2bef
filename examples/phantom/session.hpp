// One model, one coupling and one simulated Phantom, put together by name and driven without knowing which.
//
// What is virtual here is called sixty times a second; a tick calls nothing virtual.
#pragma once

#include <cstdint>
#include <memory>

#include "hand.hpp"
#include "options.hpp"
#include "tape.hpp"
#include "trained.hpp"
#include <hapbeam/centreline.hpp>
#include <hapbeam/haptics/device.hpp>
#include <hapbeam/haptics/tick_times.hpp>

namespace phantom {

class Session {
 public:
  /// The newest tick; the shape stays until the next call of picture().
  struct Picture {
    const hapbeam::ServoRecord& record;
    hapbeam::Centreline<double> shape;
  };

  virtual ~Session() = default;
  virtual void start() = 0;          ///< in real time, on a thread of its own, from the beginning
  virtual void stop() noexcept = 0;  ///< returns when the last tick has
  virtual void run(double duration) noexcept = 0;  ///< [s] in lock step; goes on from where it was
  virtual Picture picture() noexcept = 0;          ///< wait-free, from one thread
  virtual const hapbeam::TickTimes& times() const noexcept = 0;
  virtual const hapbeam::DeviceInfo& device() const noexcept = 0;
  virtual hapbeam::DeviceCounts counts() const noexcept = 0;
  virtual std::uint64_t full_answers() const noexcept = 0;  ///< of the full model of a guarded one
  virtual const Options& options() const noexcept = 0;      ///< the coupling's figures filled in
};

/// @param trained  or null: finite elements   @param hand, tape  kept by reference
/// @throws cli::UsageError or std::invalid_argument where the options do not go together
std::unique_ptr<Session> make_session(const Options& options, const Trained* trained, Hand& hand, Tape& tape);

}  // namespace phantom
