// What several contacts dissipate as one of them gives way: its force falls at once from what sticks to what slides.
//
// The hands stand still while it falls, so that friction dissipates what the potential of the beam falls by,
//
//   D = V(s) - V          s: the equilibrium in which it still sticks;  the other one is the answer
//
// FrictionLaw::leave() takes trapezoids, Σ ½ (T(s) + T) · (e - e(s)).  D differs from them where the beam stiffens on the way, because another
// contact begins to stick or turns back.  The contact that gives way has the difference.  Its force lies between those of both ends, which
// bounds it.  On a long way nodes follow their contacts, and V is that of two meshes: what they differ by is within that bound, too.
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
  /// @return what it has dissipated beyond its own trapezoid [J]
  template <class System, class Each>
  Scalar beyond_trapezoid(const System& system, const Friction& given_way, const Vector& force_before,
                          Scalar counted, Each&& each) const noexcept {
    const Stuck& stuck = stuck_[of(first_)];
    const Scalar from = size(stuck.force), to = size(given_way.acting()), before = size(force_before);
    if (!given_way.slides() || given_way.falls() || !(from > to && before > to)) return 0;
    Scalar rest = potential_ - system.total_potential();
    const bool digits = std::abs(rest) > 64 * std::numeric_limits<Scalar>::epsilon() * std::abs(potential_);
    each([&](int i, const Friction& friction) {
      const Stuck& last = stuck_[of(i)];
      const Vector force = friction.carried(last.force, last.place) + friction.acting();
      rest -= force.dot(friction.shear() - friction.carried(last.shear, last.place)) / 2;
    });
    // The tick begins with its force of before, and not with that of s.  What a trapezoid lacks grows with the cube of the way.
    const Scalar share = (std::min)((before - to) / (from - to), Scalar(1)),
                 most = (before - to) / 2 *
                        size(given_way.shear() - given_way.carried(stuck.shear, stuck.place));
    return std::clamp((digits ? share * share * share * rest : Scalar(0)) - counted, -most, most);
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
