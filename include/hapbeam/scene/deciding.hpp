// SPDX-License-Identifier: MIT
// What all choosers share: judging candidates, the fewest elements that are enough, and the cheapest of what is.
//
// Offline: allocates.
#pragma once

#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include <hapbeam/scene/choice.hpp>

namespace hapbeam::detail {

class Deciding {
 public:
  /// The pilot's presses do not meet the worst press of all, so a model has to do better on them than is tolerated.
  /// Finite elements are at their worst at the corners of the range, which the pilot meets, and interpolation is between.
  static constexpr double elements_margin = 0.85, trained_margin = 0.6;
  /// Where no candidate is that much better, one is taken whose error on the pilot is just below the tolerated one.
  static constexpr double elements_least = 0.97, trained_least = 0.85;

 protected:
  Deciding(double force_error, double tick) { choice_.force_error = force_error, choice_.tick = tick; }

  /// Finite elements: the fewest that are accurate enough, if many are.
  /// @param most  of the reference   @param least, multiple  that a model can have   @param judge  number -> Verdict
  template <class Judge>
  void fewest(int most, int least, int multiple, Judge&& judge) {
    Verdict verdict = judge(most);
    for (const int n : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384}) {
      if (!barely_right(verdict) || n >= most) break;
      if (n < least || n % multiple != 0) continue;
      const Verdict fewer = judge(n);
      if (!fewer.right) continue;
      verdict = fewer;
      break;
    }
    choice_.verdicts.push_back(verdict);
  }

  /// @param tick  [s] expected of a press   @param error_of  builds the model and presses it; may throw
  template <class ErrorOf>
  Verdict judge(const Candidate& candidate, double tick, ErrorOf&& error_of) {
    Verdict verdict{candidate, std::numeric_limits<double>::infinity(), tick, false, {}};
    try {
      verdict.error = error_of();
      verdict.right = verdict.error + own_error_ <= wanted(candidate);
    } catch (const std::exception& why) {
      verdict.refusal = why.what();
    }
    if (tick <= choice_.tick && verdict.error < in_time_.error) in_time_ = verdict;
    if (tick <= choice_.tick && barely_right(verdict) && (!barely_ || tick < barely_->tick))
      barely_ = verdict;
    return verdict;
  }

  bool barely_right(const Verdict& verdict) const noexcept {
    const bool trained = verdict.candidate.reduction != Reduction::none;
    return verdict.error + own_error_ <= (trained ? trained_least : elements_least) * choice_.force_error;
  }

  double wanted(const Candidate& candidate) const noexcept {
    return (candidate.reduction == Reduction::none ? elements_margin : trained_margin) * choice_.force_error;
  }

  void decide() {
    const Verdict* least = nullptr;
    for (const Verdict& verdict : choice_.verdicts)
      if (verdict.right && (!least || verdict.tick < least->tick)) least = &verdict;
    if (least && least->tick <= choice_.tick) {
      choice_.candidate = least->candidate;
      return;
    }
    if (barely_) {
      barely_->right = true;
      choice_.candidate = barely_->candidate;
      choice_.verdicts.push_back(*barely_);
      return;
    }
    // A twentieth more than that, for it is written with two digits.
    char text[400], slower[150] = "", coarser[150] = "";
    if (least)
      std::snprintf(slower, sizeof slower, "a tick of %.2g us (%s)", 1.05e6 * least->tick,
                    least->candidate.text().c_str());
    const double enough = 1.05 * (in_time_.error + own_error_) / trained_margin;
    if (enough < 1)
      std::snprintf(coarser, sizeof coarser, "%sa force error of %.2g %% (%s)", least ? ", or " : "",
                    100 * enough, in_time_.candidate.text().c_str());
    std::snprintf(text, sizeof text, "no model is within %.2g %% of the force in %.2g us: %s%s%s",
                  100 * choice_.force_error, 1e6 * choice_.tick,
                  least || *coarser ? "allow " : "press less deep or in a smaller range", slower, coarser);
    choice_.advice = text;
  }

  Choice choice_;
  double own_error_ = 0;  // of the pilot's reference

 private:
  Verdict in_time_{{},
                   std::numeric_limits<double>::infinity(),
                   0,
                   false,
                   {}};            // the least error of all that are fast enough
  std::optional<Verdict> barely_;  // the cheapest that is fast enough and barely_right()
};

}  // namespace hapbeam::detail
