// Whether a device of HDAPI knows where its arm is, and how it comes to know it.
//
//   style            who calibrates, and when
//   automatic        the device itself while its servo loop runs, from what it sees of the arm's way; again at any time
//   inkwell          the same, once the stylus stands in the inkwell
//   encoder reset    a person puts the arm into its reset position; then, before the loop, where it stands is taken for that
//
// Of several styles the first in this list is the device's.  In the loop the status is asked within a frame and, where the
// device says that it is ready for it, updated outside of one: elsewhere the first two styles never are.
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
  static constexpr double interval = 0.1;  ///< [s] from one question to the next

  /// @param styles  bits of the styles that the device has   @param rate [Hz] of the loop
  HdCalibration(unsigned styles, unsigned rate) noexcept
      : style_(best(styles)), ticks_((std::max)(1, static_cast<int>(std::lround(interval * rate)))) {}

  /// The device calibrates itself in the loop; else a person does, before it.
  bool automatic() const noexcept { return style_ != 0 && style_ != encoder_reset; }

  /// Before a loop: the first tick asks.
  void start() noexcept { wait_ = 0; }

  /// Once a tick, within a frame of the device.   @return whether it knew where its arm is when it was last asked
  bool ask() noexcept {
    fresh_ = wait_ == 0;
    if (fresh_) answer_ = Api::check_calibration();
    wait_ = fresh_ ? ticks_ - 1 : wait_ - 1;
    return answer_ == Api::calibration_ok;
  }
  /// After that frame: the device takes what it has seen for its calibration, where it has seen enough.
  void update() noexcept {
    if (fresh_ && automatic() && answer_ == Api::calibration_needs_update) Api::update_calibration(style_);
  }

  /// Not in the loop, where a person calibrates: whether the device knows, after taking where the arm stands for its reset
  /// position where that is so.  The device is current.
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
