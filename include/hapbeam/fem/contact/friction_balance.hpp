// SPDX-License-Identifier: MIT
// What contacts dissipate in a tick, so that the energy is balanced.
//
// FrictionLaw::leave() takes a trapezoid for each contact, D = ½ (T before + T) · slip.  Their sum is
//
//   Σ D = W - ΔV        W: what the hands give (contact_work.hpp), V: energy of the beam and of sheared skins
//
// to third order of the step where nothing happens within the tick.  A contact that gives way or turns back makes forces fall at once, and nodes of a
// rod that follow contacts change V by more or less than friction takes.  All of them then take by the same factor more or less, so that what the
// hands give, by trapezoids, is in V or was dissipated.  While all of them stick V is what they give, and need not be computed.
//
// No factor is farther than a quarter from one: what is beyond is left for the next tick.  So is a tick in which all turns back, whose force is zero in the
// mean and whose slip is not.  Where more than 0.003 of V is missing besides, the beam fell or the step is too long for trapezoids: it is not counted.
// Real-time: noexcept, no allocation, O(elements) where something slides, else O(1).
#pragma once

#include <algorithm>
#include <cmath>

namespace hapbeam::detail {

template <typename Scalar>
class FrictionBalance {
 public:
  /// To be called where the beam moves otherwise.
  void forget() noexcept { known_ = false; }

  /// To be called where a push was answered.  @param work  its ContactWork
  /// @param potential  () -> V of the answer [J]   @param taken  Σ D [J]   @param slides  whether any of them slides now, or did before
  /// @return the factor; 1 where what touches is not what touched before
  template <class Work, class Potential>
  Scalar factor(const Work& work, Potential&& potential, Scalar taken, bool slides) noexcept {
    const bool known = known_ && work.same();
    const Scalar given = stored_ + work.done() - taken;
    known_ = true;
    if (known && !slides) {
      known_ = !(taken > 0);  // what damps a skin that sticks
      stored_ = given;
      return 1;
    }
    stored_ = potential();
    const Scalar rest = given - stored_;
    if (!known || !(std::abs(rest) <= taken + loose * std::abs(stored_))) return 1;
    const Scalar more = std::clamp(rest, -part * taken, part * taken);
    stored_ += rest - more;  // left for the next tick
    return taken > 0 ? 1 + more / taken : Scalar(1);
  }

 private:
  static constexpr Scalar part = Scalar(0.25), loose = Scalar(3e-3);

  Scalar stored_ = 0;
  bool known_ = false;
};

}  // namespace hapbeam::detail
