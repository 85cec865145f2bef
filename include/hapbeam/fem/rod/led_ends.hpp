// SPDX-License-Identifier: MIT
// Ends of a rod in motion that hands lead, held by clamps or springs, and dampers beside these.
//
//   F = K g + B (g - g0)/τ          g = x - h of the end x against the hand h
//
// in each stage of length τ, as of hands that touch (contact/coupled_contacts.hpp).  The damper is springs B/τ without force at the pose, against the hand,
// in which the stage begins: with a hand at rest each stage dissipates.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cstddef>

#include <hapbeam/fem/rod/end_path.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

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
