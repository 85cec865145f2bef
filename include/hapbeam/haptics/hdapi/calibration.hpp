// SPDX-License-Identifier: MIT
// Calibration of a device of HDAPI.
//
//   style            who calibrates, and when
//   automatic        the device itself while its servo loop runs, from the motion of the arm; again at any time
//   inkwell          the same, once the stylus stands in the inkwell
//   encoder reset    a person puts the arm into its reset position before the loop starts
//
// Of several styles the first in this list is used. In the loop the status is read within a frame. When the device is
// ready, the calibration is updated outside of a frame: elsewhere the first two styles never calibrate.
// Source: OpenHaptics Toolkit, programmer's guide (calibration) and the order of the calls in its example of that name.
// In a tick: no allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace hapbeam::detail {

template <typename Api>
class HdCalibration {
 public:
  static constexpr double interval = 0.1;  ///< [s] between two readings of the status

  /// @param styles  bits of the styles that the device has   @param rate [Hz] of the loop
  HdCalibration(unsigned styles, unsigned rate) noexcept
      : style_(best(styles)), ticks_((std::max)(1, static_cast<int>(std::lround(interval * rate)))) {}

  /// The device calibrates itself in the loop; else a person does, before it.
  bool automatic() const noexcept { return style_ != 0 && style_ != encoder_reset; }

  /// Before a loop: the first tick reads the status.
  void start() noexcept { wait_ = 0; }

  /// Once a tick, within a frame of the device.   @return whether it was calibrated at the last reading
  bool ask() noexcept {
    fresh_ = wait_ == 0;
    if (fresh_) answer_ = Api::check_calibration();
    wait_ = fresh_ ? ticks_ - 1 : wait_ - 1;
    return answer_ == Api::calibration_ok;
  }
  /// After that frame: updates the calibration when the device is ready for it.
  void update() noexcept {
    if (fresh_ && automatic() && answer_ == Api::calibration_needs_update) Api::update_calibration(style_);
  }

  /// Outside of the loop, for a device that a person calibrates: takes the arm's place for its reset position if the
  /// device asks for that. The device is current.   @return whether it is calibrated
  bool check(bool at_reset_position) const noexcept {
    if (at_reset_position && style_ == encoder_reset) Api::update_calibration(style_);
    return Api::check_calibration() == Api::calibration_ok;
  }

 private:
  static constexpr unsigned encoder_reset = Api::calibration_encoder_reset;

  static unsigned best(unsigned styles) noexcept {
    for (const unsigned style : {static_cast<unsigned>(Api::calibration_auto),
                                 static_cast<unsigned>(Api::calibration_inkwell), encoder_reset})
      if (styles & style) return style;
    return 0;
  }

  unsigned style_, answer_ = 0;
  int ticks_, wait_ = 0;
  bool fresh_ = false;  // asked in this tick
};

}  // namespace hapbeam::detail
