// SPDX-License-Identifier: MIT
// How an end of a rod that a hand leads goes from pose to pose, and turns.
//
//   x(t) = x0 + t Δ + t (t - 1) ρ/(1 + ρ) (Δ - ρ Δ₋)         ρ: length of the step in units of the one before
//
// is the parabola through this pose and the two before: the acceleration of the hand.  Rotations alike, by their rotation vectors.
//
// Ends of a rod in motion that hands lead, held by clamps or springs, and dampers beside these.
//
//   F = K g + B (g - g0)/τ          g = x - h of the end x against the hand h
//
// in each stage of length τ, as of hands that touch (contact/coupled_contacts.hpp).  The damper is springs B/τ without force at the pose, against the hand,
// in which the stage begins: with a hand at rest each stage dissipates.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <cstddef>

#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// d1, d2 and tangent of a node, which is unit.
template <typename S>
Eigen::Matrix<S, 3, 3> axes_of(const RodNode<S>& node) noexcept {
  Eigen::Matrix<S, 3, 3> axes;
  axes << node.director, cross3(node.tangent, node.director), node.tangent;
  return axes;
}
/// From one node to another, by no more than half a turn [rad].
template <typename S>
VectorOf<S, 3> rotation_between(const RodNode<S>& from, const RodNode<S>& to) noexcept {
  using Vector3 = VectorOf<S, 3>;
  const Eigen::Matrix<S, 3, 3> R = axes_of(to) * axes_of(from).transpose();
  // 4 (cos α/2, sin α/2 n) times one of its own components, the largest: four ways to write it, of which one has all digits.
  const Vector3 twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  S most = 1 + R.trace(), w = most;
  Vector3 v = twice;
  for (int k = 0; k < 3; ++k) {
    const S own = 1 - R.trace() + 2 * R(k, k);
    if (!(own > most)) continue;
    most = own;
    w = twice[k];
    v = R.col(k) + R.row(k).transpose();
    v[k] = own;
  }
  const S sine = std::sqrt(v.squaredNorm());
  return sine > 0 ? Vector3(v * (2 * std::copysign(S(1), w) * std::atan2(sine, std::abs(w)) / sine))
                  : Vector3::Zero();
}
/// By what a director that is carried from the unit vector `from` to the direction of a tangent turns as that moves.
template <typename S>
VectorOf<S, 3> holonomy(const VectorOf<S, 3>& from, const VectorOf<S, 3>& tangent) noexcept {
  const S i = 1 / std::sqrt(tangent.squaredNorm());
  const VectorOf<S, 3> u = i * tangent;
  return cross3(from, u) * (i / (1 + from.dot(u)));
}
/// Its symmetric derivative.
template <typename S>
Eigen::Matrix<S, 3, 3> holonomy_change(const VectorOf<S, 3>& from, const VectorOf<S, 3>& tangent) noexcept {
  const S i = 1 / std::sqrt(tangent.squaredNorm());
  const VectorOf<S, 3> u = i * tangent, k = holonomy(from, tangent),
                       q = i * ((from + u) / (1 + from.dot(u)) + u);
  return (k * q.transpose() + q * k.transpose()) / 2;
}
/// A node that goes by so much, and turns by a rotation vector.
template <typename S>
RodNode<S> gone(const RodNode<S>& node, const VectorOf<S, 3>& by, const VectorOf<S, 3>& turn) noexcept {
  RodNode<S> to = NaturalRod<S>::along(node, turn, 1);
  to.s = node.s, to.r = node.r + by;
  return to;
}

template <typename S>
class EndPath {
  using Vector3 = VectorOf<S, 3>;

 public:
  using Node = RodNode<S>;

  /// At rest there.
  void stay(const Node& at) noexcept { from_ = to_ = next_ = at, way_ = turn_ = {}, span_ = 0; }
  /// Where the next step leads, and those after it.
  void lead(const Node& to) noexcept { next_ = to; }
  /// Whether this step does not move it.
  bool rests() const noexcept { return way_.rests() && turn_.rests(); }
  /// A step of so long [s]: from where the last one has led.
  void begin(S dt) noexcept {
    const S ratio = span_ > 0 ? dt / span_ : S(1), bend = ratio / (1 + ratio);
    span_ = dt, from_ = to_, to_ = next_;
    const Vector3 by = to_.r - from_.r, turn = rotation_between(from_, to_);
    way_.bend = bend * (by - ratio * way_.by), turn_.bend = bend * (turn - ratio * turn_.by);
    way_.by = by, turn_.by = turn;
  }
  /// @param t  of the step, 0 to 1
  Node at(S t) const noexcept { return t == 1 ? to_ : gone(from_, way_.at(t), turn_.at(t)); }

 private:
  struct Way {
    Vector3 by = Vector3::Zero(), bend = Vector3::Zero();
    Vector3 at(S t) const noexcept { return t * (by + (t - 1) * bend); }
    bool rests() const noexcept { return by.isZero(0) && bend.isZero(0); }
  };
  Node from_, to_, next_;
  Way way_, turn_;
  S span_ = 0;  // of the last step [s], 0: none
};

/// @tparam Chain  RodChain
template <class Chain>
class LedEnds {
  using S = typename Chain::Scalar;
  using Node = RodNode<S>;

 public:
  /// They are where they belong at rest.
  void stay(Chain& chain) noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      auto& end = chain.ends()[k];
      end.place_home();
      end.place(end.goal(), 1, 1);
      led_[k].damper = {}, led_[k].path.stay(end.goal());
    }
  }
  /// They are where they have come to, and go on to their goals.
  void take_over(Chain& chain) noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      auto& end = chain.ends()[k];
      const Node goal = end.goal();
      led_[k].path.stay(end.target()), led_[k].path.lead(goal);
      place(end, end.target(), led_[k].damper);
    }
  }
  /// Where an end goes in the next step, and what of its springs is a damper.
  /// @return false where it is neither clamped nor on springs, or an argument makes no sense: nothing has changed
  bool lead(Chain& chain, std::size_t k, RodPose pose, const HoldDamper& damper) noexcept {
    const auto share = [](double part) { return part >= 0 && part < 1; };
    if (!(chain.takes(k, pose) && share(damper.place) && share(damper.turning) && damper.period > 0))
      return false;
    Led& led = led_[k];
    led.path.lead(
        {0, pose.at.template cast<S>(), pose.along.template cast<S>(), pose.director.template cast<S>()});
    led.damper = damper;
    return true;
  }
  /// A step of so long [s].
  void begin(S dt) noexcept {
    for (Led& led : led_) led.path.begin(dt);
    reached_ = 0;
  }
  /// For a stage.   @param from, to  of the step   @param time τ [s]
  void aim(Chain& chain, S from, S to, S time) const noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      const Led& led = led_[k];
      if (led.rests()) continue;
      const Node& node = chain.parts().nodes()[chain.ends().node(k)];
      const Node hand = led.path.at(from);
      Node at = node;
      at.tangent = unit(node.tangent);
      if (Chain::unknowns == 6)
        at.director = across<S>(carry(hand.director, hand.tangent, at.tangent), at.tangent);
      const Node there = led.path.at(to);
      auto& end = chain.ends()[k];
      place(end, there, led.damper);
      const S more = static_cast<S>(led.damper.period) / time;
      end.damp(gone<S>(there, node.r - hand.r, rotation_between(hand, at)),
               static_cast<S>(led.damper.place) * more, static_cast<S>(led.damper.turning) * more);
    }
  }
  /// Where it has come to, held by its springs alone.   @param at  of the step
  void settle(Chain& chain, S at) noexcept {
    reached_ = at;
    for (std::size_t k = 0; k < 2; ++k)
      if (!led_[k].rests()) place(chain.ends()[k], led_[k].path.at(at), led_[k].damper);
  }
  /// The step has no answer: they stay where they have come to.
  void stop(Chain& chain) noexcept {
    settle(chain, reached_);
    for (Led& led : led_) led.path.stay(led.path.at(reached_));
  }

 private:
  struct Led {
    EndPath<S> path;
    HoldDamper damper{};
    bool rests() const noexcept { return damper.place == 0 && damper.turning == 0 && path.rests(); }
  };
  /// Held by its springs alone.
  template <class End>
  static void place(End& end, const Node& at, const HoldDamper& damper) noexcept {
    end.place(at, static_cast<S>(1 - damper.place), static_cast<S>(1 - damper.turning));
  }
  S reached_ = 0;  // of the step
  Led led_[2];
};

}  // namespace hapbeam::detail
