// SPDX-License-Identifier: MIT
// One of several contacts beside or past an end that holds w.
//
// Such an end does not yield, and no push lays the beam on a circle that reaches over it.  As Touch does, the beam is pressed across there, no
// farther than its range, and past the end as by the same depth in range (press_contact.hpp, support_contact.hpp).  To the model the avatar is
// then a stop.
// Real-time: noexcept, no allocation.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/contact/find_rod_contact.hpp>
#include <hapbeam/contact/press_contact.hpp>
#include <hapbeam/contact/support_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
class EndContact {
 public:
  /// @param model  before it is touched
  template <class Model>
  void begin(const Model& model) noexcept {
    support_.begin(model);
  }

  /// @param pressing  since the tick before   @return whether the end takes part in this tick
  template <class Model>
  bool holds(const Model& model, const Contact<Scalar>& contact, const Avatar<Scalar>& avatar, Scalar reach,
             bool pressing) noexcept {
    const bool held_on = holds_ && pressing;
    past_ = support_.past(contact, model);
    const Scalar around = (std::max)(reach, beside * model.shape().length());
    holds_ = past_ || support_.over(model, avatar, around) ||
             model.range().nearest({contact.s, 0}).s != contact.s || (held_on && contact.depth > reach);
    if (holds_ && !held_on) presser_.begin(contact);
    return holds_;
  }
  /// Whether the end was beneath the avatar in the last tick.
  [[nodiscard]] bool past() const noexcept { return past_; }

  /// @param contact  in and out, as PressContact::aim()   @param stop  out
  /// @return false where it is not touched, or has slid away
  template <class Model>
  bool aim(const Model& model, Contact<Scalar>& contact, const Avatar<Scalar>& avatar, Scalar reach,
           bool pressing, Push<Scalar>& stop) noexcept {
    Press<Scalar> asked{0, 0};
    if (past_) {
      if (!contact.touching || support_.slid(contact, model, far_away)) return false;
      asked = support_.aim(contact);
    } else if (!presser_.aim(model, contact, avatar.position, reach, pressing, asked)) {
      return false;
    }
    const Press<Scalar> in_range = model.range().nearest(asked);
    const Scalar up = static_cast<Scalar>(contact.side);
    stop = {in_range.s, up * in_range.d, {0, up}};
    factor_ = past_ ? Scalar(1) : presser_.along_normal(contact);
    return true;
  }
  /// Along the contact's normal, in units of that on the stop.
  Scalar factor() const noexcept { return factor_; }

 private:
  /// Of the length.  So near to the end a thin avatar bends the beam more sharply than the mesh can show.
  static constexpr Scalar beside = Scalar(3e-3);
  /// Of the length.  A touch bends the beam beside the end, which may slide: farther than that others have drawn it.
  static constexpr Scalar far_away = Scalar(1e-3);

  SupportContact<Scalar> support_;
  PressContact<Scalar> presser_;
  Scalar factor_ = 1;
  bool holds_ = false, past_ = false;
};

template <typename Scalar>
class EndContact<Scalar, 3> {
 public:
  template <class Model>
  void begin(const Model& model) noexcept {
    support_.begin(model);
  }
  template <class Model>
  bool holds(const Model& model, const Contact<Scalar, 3>& contact, const Avatar<Scalar, 3>& avatar,
             Scalar reach, bool) noexcept {
    return support_.past(contact, model, avatar, reach);
  }
  static constexpr bool past() noexcept { return false; }
  template <class Model>
  bool aim(const Model& model, Contact<Scalar, 3>& contact, const Avatar<Scalar, 3>&, Scalar, bool,
           Push<Scalar, 3>& stop) noexcept {
    return support_.aim(model, contact, stop, factor_);
  }
  Scalar factor() const noexcept { return factor_; }

 private:
  SupportContact<Scalar, 3> support_;
  Scalar factor_ = 1;
};

}  // namespace hapbeam::detail
