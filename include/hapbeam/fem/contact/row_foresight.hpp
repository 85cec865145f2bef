// SPDX-License-Identifier: MIT
// Extrapolated initial guess of a lasting push: nodes, places and forces go on as in a push before.
//
//   x₊ = x + r (x - x₋)            r: the hands' step in units of the step before
//
// From there the error is of second order in the step, and Newton's method takes one solve less.  Two hands that move by turns go on as in the push
// before the last.  Hands that turn aside or hurry have nothing foreseen.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(elements).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/contact/active_set.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// Where a hand is: its centre, or both ends of its axis [m].
template <typename Scalar>
Vector2<Scalar> hand_of(const Circle<Scalar>& circle) noexcept {
  return circle.centre;
}
template <typename Scalar>
VectorOf<Scalar, 6> hand_of(const Capsule<Scalar>& capsule) noexcept {
  VectorOf<Scalar, 6> ends;
  ends << capsule.axis.tip, capsule.axis.at(1);
  return ends;
}

template <class System>
class RowForesight {
  using Scalar = typename System::Scalar;
  using State = typename System::State;
  static constexpr int most = System::Rows::most, dimension = System::dimension;

 public:
  using Contact = InnerState<Scalar, dimension>;

  explicit RowForesight(const System& system)
      : RowForesight(system.elements(), std::make_index_sequence<like_most>()) {}

  /// To be called before each push.   @return whether the hands go on as they went, and touch what they touched
  bool look(const ActiveSet<System>& active) noexcept {
    Hands hands = Hands::Zero();
    bool same = active.size() == count_;
    for (int i = 0; i < active.size(); ++i) {
      hands.template segment<each>(each * i) = hand_of(active[i].round);
      same = same && active[i].touching == touched_[i] && active[i].kind == kind_[i];
    }
    const Hands step = hands - hands_;
    hands_ = hands;
    like_ = 0;
    ratio_ = 0;
    forth_ = false;
    for (int k = 1; k <= like_most && like_ == 0 && !forth_; ++k) {
      const Hands& then = step_[k - 1];
      ratio_ = step.dot(then) / then.squaredNorm();
      const bool straight_on = std::abs(ratio_) < fastest &&
                               (step - ratio_ * then).squaredNorm() <= aside * aside * step.squaredNorm();
      forth_ = straight_on && ratio_ > 0;
      if (same && straight_on && known_ > k) like_ = k;
    }
    step_[1] = step_[0], step_[0] = step;
    return like_ > 0;
  }
  /// Whether the hands go on and do not turn back, whatever they touch.
  bool forth() const noexcept { return forth_; }
  /// What is foreseen of contact i.
  Contact ahead(int i) const noexcept {
    Contact next = all_[0][i];
    next.go_on(all_[like_ - 1][i], all_[like_][i], ratio_);
    return next;
  }

  /// To be called once in each push, before it moves the system: which goes on if hands do.
  void go_on(System& system) noexcept {
    newest_ = (newest_ + 1) % like_most;
    State &older = before_[(newest_ + 1) % like_most], &newer = before_[newest_];
    if (like_ == 0) return system.keep(newer);
    if (like_ == 2) system.carry(newer, older);
    else if (like_most > 1) newer = older;
    system.go_on(newer, ratio_);
  }
  /// Where the system was before the push.
  const State& before() const noexcept { return before_[newest_]; }
  /// To be called after each push.   @param found  whether it was answered on the branch on which the beam was
  /// @param contact  (i) -> what is left of contact i
  template <class EachContact>
  void know(bool found, const ActiveSet<System>& active, EachContact&& contact) noexcept {
    for (int i = 0; i < active.size(); ++i) {
      found = found && (active.size() != count_ || active[i].touching == touched_[i]);
      touched_[i] = active[i].touching, kind_[i] = active[i].kind;
      for (int k = like_most; k > 0; --k) all_[k][i] = all_[k - 1][i];
      all_[0][i] = contact(i);
    }
    count_ = active.size();
    known_ = found ? (std::min)(known_ + 1, 3) : 0;
  }
  void forget() noexcept { known_ = 0; }
  /// Of hands that have never been anywhere.
  void reset() noexcept {
    forget();
    count_ = 0;
    hands_.setZero();
    for (Hands& step : step_) step.setZero();
  }

 private:
  static constexpr int each = dimension == 2 ? 2 : 6;  // numbers of a hand
  using Hands = VectorOf<Scalar, each * most>;

  template <std::size_t... K>
  RowForesight(int elements, std::index_sequence<K...>) : before_{((void)K, State(elements))...} {}
  static constexpr int like_most = most > 1 ? 2 : 1;  // pushes before, of those that may go on
  static constexpr Scalar fastest = 2,
                          aside = Scalar(0.1);  // of a step, in units of the one before and of itself

  State before_[like_most];  // the last push, and the one before
  int newest_ = 0;
  int count_ = 0;  // of bodies in the last push, and what touched
  bool touched_[most] = {};
  ObstacleKind kind_[most] = {};
  Hands hands_ = Hands::Zero();  // 0 where there is none [m]
  Hands step_[2] = {Hands::Zero(), Hands::Zero()};
  Contact all_[like_most + 1][most] = {};  // after the last pushes
  Scalar ratio_ = 0;
  bool forth_ = false;
  int like_ = 0;   // the push that goes on: the last one or the one before; 0: none
  int known_ = 0;  // pushes without a break, as far as they matter
};

}  // namespace hapbeam::detail
