// SPDX-License-Identifier: MIT
// What hands give to a beam from one answer to the next: the work of its contacts, by trapezoids.  And what of it friction takes.
//
//   W = Σ ½ (F before + F) · Δx        F: on the beam, friction included; x: centre of a circle, or of the axis of a capsule what is beside the contact
//
// A body that grows by Δr gives -½ (f before + f) Δr, f < 0 its force along the normal.  A place that is led along its normal by Δd gives
// ½ (f before + f) Δd.  W is the change of the beam's energy and of what friction has taken, to third order of the step.
//
// FrictionLaw::leave() takes a trapezoid for each contact, D = ½ (T before + T) · slip.  Their sum is
//
//   Σ D = W - ΔV        V: energy of the beam and of sheared skins
//
// to third order of the step where nothing happens within the tick.  A contact that gives way or turns back makes forces fall at once, and nodes of a
// rod that follow contacts change V by more or less than friction takes.  All of them then take by the same factor more or less, so that what the
// hands give, by trapezoids, is in V or was dissipated.  While all of them stick V is what they give, and need not be computed.
// Real-time: noexcept, no allocation, O(1) for each body; O(elements) where something slides.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Most  bodies
template <typename Scalar, int D, int Most>
class ContactWork {
 public:
  using Round = RoundOf<Scalar, D>;
  using Vector = VectorOf<Scalar, D>;

  /// To be called where the beam moves otherwise.
  void forget() noexcept { known_ = balanced_ = false; }
  /// What is stored is known no more.
  void forget_stored() noexcept { balanced_ = false; }
  /// To be called where a push was answered, before what follows.
  void begin() noexcept {
    work_ = size_ = change_ = ahead_ = way_ = turned_ = 0;
    strange_ = false;
    same_ = known_;
    known_ = true;
    for (Body& body : bodies_) {
      body.touched = std::exchange(body.touching, false);
      body.placed = body.placed && same_;
    }
  }
  /// With each body that touches.  @param pushed  of it   @param friction  on the beam [N]
  void touches(int i, const Round& round, const Pushed<Scalar, D>& pushed, const Vector& friction) noexcept {
    Body& body = bodies_[i];
    const Vector force = pushed.force * pushed.normal + friction;
    body.touching = true;
    if (!std::exchange(body.placed, true)) {
      body.take(round, force, pushed);
      return;
    }
    const Scalar grown = round.reach - body.round.reach;
    const Vector way = moved(body.round, round, pushed.point);
    add(body.force.dot(moved(body.round, round, body.point)) - body.push * grown,
        force.dot(way) - pushed.force * grown);
    way_ = (std::max)(way_, way.squaredNorm() + grown * grown);
    if (body.push != 0) turned_ = (std::max)(turned_, (pushed.normal - body.normal).squaredNorm());
    body.take(round, force, pushed);
  }
  /// With each body that does not touch, or not any more.
  void apart(int i, const Round& round) noexcept {
    Body& body = bodies_[i];
    if (body.touched && body.placed) {
      const Scalar grown = round.reach - body.round.reach;
      const Vector way = moved(body.round, round, body.point);
      add(body.force.dot(way) - body.push * grown, 0);
      way_ = (std::max)(way_, way.squaredNorm() + grown * grown);
    }
    body.round = round, body.force.setZero(), body.push = 0;
    body.placed = true;
  }
  /// With each body that is nowhere.
  void absent(int i) noexcept {
    bodies_[i].force.setZero(), bodies_[i].push = 0;
    bodies_[i].placed = false;
  }
  /// The same of a place of the beam that is held.   @param force  along its normal, on the beam [N]
  void holds(int i, const Push<Scalar, D>& place, Scalar force) noexcept {
    Held& last = held_[i];
    const bool stays = last.place.s == place.s && last.place.normal == place.normal;
    same_ = same_ && stays && last.place.d == place.d;
    if (bodies_[i].touched && stays) {
      const Scalar by = place.d - last.place.d;
      add(last.force * by, force * by);
      way_ = (std::max)(way_, by * by);
    }
    strange_ = strange_ || (bodies_[i].touched && !stays);
    last = {place, force};
    bodies_[i].force.setZero(), bodies_[i].push = 0;
    bodies_[i].touching = true;
  }

  /// Whether another place is held than before: what that gives is not known.
  bool strange() const noexcept { return strange_; }
  /// Whether the same touches that touched before, and its work is known.
  bool same() const noexcept {
    return same_ && std::all_of(bodies_, bodies_ + Most,
                                [](const Body& body) { return body.touching == body.touched; });
  }
  /// Whether anything touches.
  bool any() const noexcept {
    return std::any_of(bodies_, bodies_ + Most, [](const Body& body) { return body.touching; });
  }
  /// Whether a round body has touched last.
  bool knows(int i) const noexcept { return known_ && bodies_[i].touching && bodies_[i].push != 0; }
  /// That touched last.
  const Round& round(int i) const noexcept { return bodies_[i].round; }
  /// W [J]
  Scalar done() const noexcept { return work_; }
  /// What the last forces would have given [J].
  Scalar ahead() const noexcept { return ahead_; }
  /// Its parts without their signs [J].
  Scalar size() const noexcept { return size_; }
  /// By how much they change [J].
  Scalar change() const noexcept { return change_; }
  /// Whether the normal of any of them has turned by more than 10 degrees.
  bool turned() const noexcept { return turned_ > most_turned; }
  /// How far any of them has gone [m].
  Scalar way() const noexcept { return std::sqrt(way_); }

  /// To be called where a push was answered, after that.  No factor is farther than a quarter from one: what is beyond is left for the next tick.  So is
  /// a tick in which all turns back, whose force is zero in the mean and whose slip is not.  Where more than 0.003 of V is missing besides, the beam
  /// fell or the step is too long for trapezoids: it is not counted.
  /// @param potential  () -> V of the answer [J]   @param taken  Σ D [J]   @param slides  whether any of them slides now, or did before
  /// @return by which friction takes; 1 where what touches is not what touched before
  template <class Potential>
  Scalar factor(Potential&& potential, Scalar taken, bool slides) noexcept {
    const bool known = balanced_ && same();
    const Scalar given = stored_ + work_ - taken;
    balanced_ = true;
    if (known && !slides) {
      balanced_ = !(taken > 0);  // what damps a skin that sticks
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

  static Round nowhere() noexcept {
    if constexpr (D == 2) return {0, Vector::Zero(), 0, 1};
    else return {0, {Vector::Zero(), Vector::Zero()}, 0, Vector::Zero()};
  }
  struct Body {
    Round round = nowhere();
    Vector force = Vector::Zero(), point = Vector::Zero(), normal = Vector::Zero();
    Scalar push = 0;                         // along the normal [N]
    bool touching = false, touched = false;  // now, and before
    bool placed = false;                     // where it was is known

    void take(const Round& now, const Vector& felt, const Pushed<Scalar, D>& pushed) noexcept {
      round = now, force = felt, point = pushed.point, normal = pushed.normal, push = pushed.force;
    }
  };
  struct Held {
    Push<Scalar, D> place{0, 0, Vector::Zero()};
    Scalar force = 0;  // along its normal [N]
  };
  void add(Scalar before, Scalar now) noexcept {
    work_ += (before + now) / 2;
    ahead_ += before;
    size_ += std::abs(before) + std::abs(now);
    change_ += std::abs(now - before);
  }
  /// How far the centre has gone, or the axis beside a point.
  static Vector moved(const Round& from, const Round& to, const Vector& point) noexcept {
    if constexpr (D == 2) return to.centre - from.centre;
    else return to.axis.tip - from.axis.tip + to.axis.nearest(point) * (to.axis.way - from.axis.way);
  }

  Body bodies_[Most];
  Held held_[Most];
  Scalar work_ = 0, size_ = 0, change_ = 0, ahead_ = 0, way_ = 0, turned_ = 0;  // [J], [m²], of normals: [1]
  static constexpr Scalar most_turned = Scalar(0.03);                           // square of 10 degrees
  bool known_ = false, same_ = false, strange_ = false;
  Scalar stored_ = 0;      // V, and what is left for the next tick [J]
  bool balanced_ = false;  // it is known
};

}  // namespace hapbeam::detail
