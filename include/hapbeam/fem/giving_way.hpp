// What several contacts dissipate as one of them gives way: its force falls at once from what sticks to what slides.
//
// The hands stand still while it falls, so that friction dissipates what the potential of the beam falls by,
//
//   D = V(s) - V          s: the equilibrium in which it still sticks;  the other one is the answer
//
// FrictionLaw::leave() takes trapezoids, Σ ½ (T(s) + T) · (e - e(s)).  D differs from them where the beam stiffens on the way, because another
// contact begins to stick or turns back.  The contact that gives way has the difference.  Its force lies between those of both ends, which
// bounds it; what is beyond that have those that have given way at it.  On a long way nodes follow their contacts, and V is that of two meshes:
// what they differ by is within these bounds, too.
// Real-time: noexcept, no allocation, O(elements) in a push in which a contact gives way, nothing in others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Friction  a FrictionLaw   @tparam Most  contacts
template <class Friction, int Most>
class GivingWay {
  using Vector = typename Friction::Vector;
  using Scalar = typename Vector::Scalar;

 public:
  /// To be called where an equilibrium was found in which a contact holds more than it can.
  /// @param each  calls its argument with the number and the law of each contact
  template <class System, class Each>
  void mark(int contact, const System& system, Each&& each) noexcept {
    if (first_ >= 0) return;
    first_ = contact;
    potential_ = system.total_potential();
    each([this](int i, const Friction& friction) {
      stuck_[of(i)] = {friction.acting(), friction.shear(), friction.place()};
    });
  }
  /// The contact, -1: none.
  int contact() const noexcept { return first_; }
  /// To be called in the equilibrium that is answered.
  /// @param given_way  the law of that contact   @param force_before  its force in the tick before [N]
  /// @param counted  what all of them have dissipated beyond trapezoids between both ticks [J]
  /// @return what they have dissipated beyond that [J]: of each contact as much as it can have (most)
  template <class System, class Each>
  Scalar beyond_trapezoids(const System& system, const Friction& given_way, const Vector& force_before,
                           Scalar counted, Each&& each) const noexcept {
    const Scalar from = size(stuck_[of(first_)].force), to = size(given_way.acting()),
                 before = size(force_before);
    if (!(most(first_, given_way, force_before) > 0)) return 0;
    Scalar rest = potential_ - system.total_potential();
    const bool digits = std::abs(rest) > 64 * std::numeric_limits<Scalar>::epsilon() * std::abs(potential_);
    each([&](int i, const Friction& friction) {
      const Stuck& last = stuck_[of(i)];
      const Vector force = friction.carried(last.force, last.place) + friction.acting();
      rest -= force.dot(friction.shear() - friction.carried(last.shear, last.place)) / 2;
    });
    // The tick begins with its force of before, and not with that of s.  What a trapezoid lacks grows with the cube of the way.
    const Scalar share = (std::min)((before - to) / (from - to), Scalar(1));
    return (digits ? share * share * share * rest : Scalar(0)) - counted;
  }
  /// @param force_before  of a contact that stuck in the tick before [N]
  /// @return what it has dissipated more or less than its trapezoid at most [J]; none where it has not given way
  Scalar most(int contact, const Friction& friction, const Vector& force_before) const noexcept {
    const Stuck& stuck = stuck_[of(contact)];
    const Scalar to = size(friction.acting()), before = size(force_before);
    if (!friction.slides() || friction.falls() || !(size(stuck.force) > to && before > to)) return 0;
    return (before - to) / 2 * size(friction.shear() - friction.carried(stuck.shear, stuck.place));
  }

 private:
  struct Stuck {
    Vector force = Vector::Zero(), shear = Vector::Zero();
    typename Friction::Place place;
  };
  static std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }
  static Scalar size(const Vector& v) noexcept { return std::sqrt(v.squaredNorm()); }

  int first_ = -1;
  Scalar potential_ = 0;
  std::array<Stuck, Most> stuck_;
};

}  // namespace hapbeam::detail
