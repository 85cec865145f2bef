// SPDX-License-Identifier: MIT
// What choose() found, in numbers and in words.
//
// Plain data.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/scene/candidate.hpp>

namespace hapbeam {

/// What became of one family of models.
struct Verdict {
  Candidate candidate;  ///< its least size that is accurate enough; where none is, the best that was tried
  double error;  ///< [-] largest relative error of the force that was seen; infinite where it did not answer
  double tick;   ///< [s] expected time of a press
  bool right;    ///< whether the error is small enough
  std::string refusal;  ///< reason why it could not be built, or empty
};

struct Choice {
  std::optional<Candidate> candidate;  ///< empty where no model is admissible
  std::vector<Verdict> verdicts;       ///< of every family
  double force_error;                  ///< [-] that was allowed
  double tick;                         ///< [s] that was allowed
  std::string advice;                  ///< what to relax, where no model is admissible

  /// @throws std::runtime_error with the advice, where no model is admissible
  const Candidate& model() const {
    if (!candidate) throw std::runtime_error(advice);
    return *candidate;
  }

  /// The choice, and a line for each family: which bound rejected it, or what it would cost.
  std::string text() const {
    std::string out = candidate ? "chosen: " + candidate->text() + "\n" : advice + "\n";
    for (const Verdict& verdict : verdicts)
      out += "  " + verdict.candidate.text() + ": " + reason(verdict) + "\n";
    return out;
  }

  std::string reason(const Verdict& verdict) const {
    if (!verdict.refusal.empty()) return "not built: " + verdict.refusal;
    char text[160];
    const double percent = 100 * verdict.error, micro = 1e6 * verdict.tick;
    const bool elements = verdict.candidate.reduction == Reduction::none;
    if (!std::isfinite(verdict.error)) std::snprintf(text, sizeof text, "does not answer all presses");
    else if (!verdict.right)
      std::snprintf(text, sizeof text, "force error %.2g %% %s; allowed %.2g %%", percent,
                    elements ? "with any number of elements" : "at best", 100 * force_error);
    else if (verdict.tick > tick)
      std::snprintf(text, sizeof text, "force within %.2g %%, but %.2g us a press; allowed %.2g us", percent,
                    micro, 1e6 * tick);
    else std::snprintf(text, sizeof text, "force within %.2g %%, %.2g us a press", percent, micro);
    return text;
  }
};

}  // namespace hapbeam
