// A device, and the body that is touched through it and can be changed while it runs.
//
// The device's thread calls the relay; everything here is for one other thread.
#pragma once

#include <memory>

#include "body.hpp"
#include "device.hpp"
#include "hand.hpp"
#include "options.hpp"
#include "relay.hpp"
#include "tape.hpp"

namespace phantom {

class Session {
 public:
  /// The newest tick; the body stays until the next call of picture().
  struct Picture {
    const hapbeam::ServoRecord& record;
    const hapbeam::ServoRecord* second;  ///< of the second hand, or null
    const DrawnBody& body;
    bool swings;  ///< it has mass
  };

  /// @param trained  as for make_body   @param hand, tape  kept by reference
  /// @throws as connect and make_body
  Session(const Options& options, std::shared_ptr<const Trained> trained, Hand& hand, Tape& tape);
  ~Session() { stop(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start() { device_->start(relay_); }  ///< in real time, on the device's thread
  void stop() noexcept { device_->stop(); }
  void run(double duration) noexcept { device_->run(relay_, duration); }  ///< [s] in lock step; goes on

  /// Another body: within 0.4 s, or after that where a change is on its way; then the last that was asked for.
  /// @param from [m] device axes: beside it   @throws as make_body; then all stays as it is
  void change(const Options& options, std::shared_ptr<const Trained> trained, const Eigen::Vector3d& from);
  /// Once a picture: takes the newest tick, begins the change that waits and drops what is touched no longer.
  void update();

  // Of the newest tick that was taken.
  Body& body() noexcept;                                    ///< that is felt
  int changes() const noexcept { return newest_.changes; }  ///< until it was
  Picture picture() noexcept {
    const Options& options = body().options();
    return {newest_.record, options.hands == 2 ? &newest_.second : nullptr, body().drawn(),
            options.element == ElementChoice::with_mass};
  }

  const Device& device() const noexcept { return *device_; }

 private:
  std::unique_ptr<Device> device_;
  std::unique_ptr<Body> body_, next_, waiting_;
  Eigen::Vector3d waiting_from_{0, 0, 0};
  int begun_ = 0;  // changes
  Relay relay_;
  Relay::Newest newest_;
};

}  // namespace phantom
