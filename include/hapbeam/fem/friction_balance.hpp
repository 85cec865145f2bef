// What contacts dissipate in a tick, so that the energy is balanced.
//
// FrictionLaw::leave() takes a trapezoid for each contact, D = ½ (T before + T) · slip.  Their sum is
//
//   Σ D = Σ ½ (F before + F) · Δx - ΔV        F: on the beam, x: centre or axis of what touches it, V: energy of the beam and of sheared skins
//
// to third order of the step where nothing happens within the tick.  A contact that gives way or turns back makes forces fall at once, and nodes of the
// mesh that follow contacts change V by more or less than friction takes.  All of them then take by the same factor more or less, so that what the
// hands give, by trapezoids, is in V or was dissipated.  While all of them stick V is what they give, and need not be computed.
//
// No factor is farther than a quarter from one: what is beyond is left for the next tick.  So is a tick in which all turns back, whose force is zero in the
// mean and whose slip is not.  Where more than 0.003 of V is missing besides, the beam fell or the step is too long for trapezoids: it is not counted.
// Real-time: noexcept, no allocation, O(elements) where something slides, else O(contacts).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Round  Circle<Scalar> | Capsule<Scalar>   @tparam Most  bodies
template <class Round, typename Scalar, int D, int Most>
class FrictionBalance {
 public:
  using Vector = VectorOf<Scalar, D>;

  /// To be called where the beam moves otherwise.
  void forget() noexcept { known_ = false; }

  /// To be called where a push was answered, before touches().
  void begin() noexcept {
    work_ = 0;
    touched_ = touching_;
    touching_ = {};
  }
  /// With each body that touches.  @param pushed  of it   @param friction  on the beam [N]
  void touches(int i, const Round& round, const Pushed<Scalar, D>& pushed, const Vector& friction) noexcept {
    Body& body = bodies_[of(i)];
    const Vector force = pushed.force * pushed.normal + friction;
    if (body.round.reach != round.reach) forget();
    else
      work_ += (body.force.dot(moved(body.round, round, body.point)) +
                force.dot(moved(body.round, round, pushed.point))) /
               2;
    body.round = round, body.force = force, body.point = pushed.point;
    body.place.normal.setZero();
    touching_[of(i)] = true;
  }
  /// The same of a place of the beam that is held, and does not move.
  void holds(int i, const Push<Scalar, D>& place) noexcept {
    Body& body = bodies_[of(i)];
    if (body.place.s != place.s || body.place.d != place.d || body.place.normal != place.normal) forget();
    body.place = place;
    body.round.reach = 0;
    touching_[of(i)] = true;
  }
  /// @param potential  () -> V of the answer [J]   @param taken  Σ D [J]   @param slides  whether any of them slides now, or did before
  /// @return the factor; 1 where what touches is not what touched before
  template <class Potential>
  Scalar factor(Potential&& potential, Scalar taken, bool slides) noexcept {
    const bool known = known_ && touching_ == touched_;
    const Scalar given = stored_ + work_ - taken;
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

  struct Body {
    Round round{};
    Vector force = Vector::Zero(), point = Vector::Zero();
    Push<Scalar, D> place{0, 0, Vector::Zero()};
  };
  static std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }
  /// How far the centre has gone, or the axis beside a point.
  static Vector moved(const Round& from, const Round& to, const Vector& point) noexcept {
    if constexpr (D == 2) return to.centre - from.centre;
    else return to.axis.tip - from.axis.tip + to.axis.nearest(point) * (to.axis.way - from.axis.way);
  }

  std::array<Body, Most> bodies_{};
  std::array<bool, Most> touching_{}, touched_{};
  Scalar work_ = 0, stored_ = 0;
  bool known_ = false;
};

}  // namespace hapbeam::detail
