// SPDX-License-Identifier: MIT
// Two hands on one beam, each with a loop of its own: its device, coupling and guard.
//
//   FemModel<Several<Corotational<>, 2>> model(ruler, 16);
//   TwoHands hands(model);                                                 // and props: TwoHands hands(model, {peg})
//   Servo left(hands[0], left_device), right(hands[1], right_device);      // offline
//   left.tick(left_state), right.tick(right_state);                        // in one thread, each in its own time
//
// A hand is given to a Servo in place of the model. A tick of either hand finds the equilibrium under both, the other one where its own last tick
// has left it. The hands may tick at different rates. One thread ticks both: they share the beam, and nothing is locked.
// OpenHaptics calls the servos of all devices from one thread. In lock step the forces are deterministic.
// A hand whose loop has stopped is lifted off the beam after `patience` ticks of the other one.  Where it comes back its servo begins anew.
// A reset takes a hand off the beam.  Where nobody touches the beam without it, the scene is as it was built: beam, props and friction.
// Where the other hand does, that one keeps it, and the one that was reset comes back after the next tick of the other one.
// Real-time: ticks are noexcept, allocation-free and bounded, as those of TouchSeveral.  Constructors allocate and throw.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <initializer_list>
#include <optional>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>

namespace hapbeam {

template <class Model>
class TwoHands;

/// One of two hands, for Servo<Hand<Model>>.
template <class Model>
class Hand {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;

  Centreline<Scalar, dimension> shape() const noexcept { return hands_.model().shape(); }
  Scalar thickness() const noexcept { return hands_.model().thickness(); }
  const Model& model() const noexcept { return hands_.model(); }

 private:
  friend class TwoHands<Model>;
  friend class Touch<Hand<Model>>;
  Hand(TwoHands<Model>& hands, int index) noexcept : hands_(hands), index_(index) {}

  TwoHands<Model>& hands_;
  int index_;
};

/// A beam and the two hands that press it.  It stays where it is: hands refer to it.
/// @tparam Model  takes two contacts, and one more for each prop: FemModel<Several<Element, 2>>
template <class Model>
class TwoHands {
 public:
  using Scalar = typename Model::Scalar;
  using Prop = hapbeam::Prop<dimension_of<Model>>;
  static_assert(detail::takes_several<Model>,
                "TwoHands<Model>: Model must take several contacts: FemModel<Several<Element, 2>>");

  /// @param model  kept by reference   Allocates.   @throws std::invalid_argument naming what makes no sense
  explicit TwoHands(Model& model, std::initializer_list<Prop> props = {})
      : model_(model),
        touch_(model, {0.0, 0.0}, props),
        hands_{Hand<Model>(*this, 0), Hand<Model>(*this, 1)} {
    touch_.lift(0), touch_.lift(1);
  }
  TwoHands(const TwoHands&) = delete;
  TwoHands& operator=(const TwoHands&) = delete;

  /// @param index  0 | 1
  Hand<Model>& operator[](int index) noexcept { return hands_[static_cast<std::size_t>(index)]; }
  const Model& model() const noexcept { return model_; }

  /// Ticks of one hand after which the other one is taken for gone.
  static constexpr int patience = 100;

 private:
  friend class Touch<Hand<Model>>;

  using Result = typename TouchSeveral<Model>::Result;
  using Vector = typename TouchSeveral<Model>::Vector;

  enum class Presence {
    away,     ///< comes with its next tick
    waiting,  ///< was reset, and the beam may still lie as it was pressed
    here
  };
  struct Side {
    Presence presence = Presence::away;
    std::optional<Vector> meanwhile;  // on the hand, where there was an answer since its last tick [N]
    bool missed = false;              // the avatar has left the beam, in which the hand still is
    int silent = 0;                   // ticks of the other hand since the last one of this
    std::atomic<bool> reset{false};   // asked for, and not yet carried out

    void be(Presence now) noexcept {
      presence = now;
      meanwhile.reset();
      missed = false;
      silent = 0;
    }
  };

  Result tick(int hand, const Vector& position, const Vector& shaft) noexcept {
    carry_out_resets();
    // A position that is none is no tick: the hand stays where it was, as one whose loop has stopped.
    if (!touch_.is_place(position, shaft)) return touch_.tick(hand, position, shaft);
    const int other = 1 - hand;
    Side &own = side(hand), &others = side(other);
    own.be(own.presence == Presence::away ? Presence::here : own.presence);
    const Result result = here(hand) ? touch_.tick(hand, position, shaft) : touch_.solve();
    if (is_answer(result.status)) others.meanwhile = result.force(other) - result.friction(other);
    if (here(other) && ++others.silent == patience) take_off(other, Presence::away);
    // Without those who wait the beam lies as the other one holds it, if that one is there.
    const bool waits = own.presence == Presence::waiting || others.presence == Presence::waiting;
    if (waits && !leans(0) && !leans(1)) rebuild();
    else if (others.presence == Presence::waiting) others.presence = Presence::away;
    return result;
  }
  hapbeam::Contact<Scalar, dimension_of<Model>> contact_at(int hand, const Vector& position,
                                                           const Vector& shaft) noexcept {
    if (!here(hand)) return {};
    const auto contact = touch_.contact_at(hand, position, shaft);
    side(hand).missed = contact.touching;
    return contact;
  }
  bool here(int hand) const noexcept { return side(hand).presence == Presence::here; }
  void take_off(int hand, Presence presence) noexcept {
    place(hand).lift();
    side(hand).be(presence);
  }
  /// It touches, or does so but for its avatar.
  bool leans(int hand) noexcept { return place(hand).at.obstacle.touching || side(hand).missed; }

  /// From any thread: wait-free.
  void reset(int hand) noexcept { side(hand).reset.store(true, std::memory_order_release); }
  void carry_out_resets() noexcept {
    bool any = false;
    for (const int hand : {0, 1}) {
      std::atomic<bool>& asked = side(hand).reset;
      if (!asked.load(std::memory_order_relaxed) || !asked.exchange(false, std::memory_order_acquire))
        continue;
      take_off(hand, Presence::waiting);
      any = true;
    }
    if (any && !here(0) && !here(1)) rebuild();
  }
  /// The scene as it was built.
  void rebuild() noexcept {
    touch_.reset();
    for (Side& side : sides_) {
      if (side.presence == Presence::waiting) side.presence = Presence::away;
      side.meanwhile.reset();
    }
  }
  /// Each has one, in their order.
  auto& place(int hand) noexcept { return touch_.places_[static_cast<std::size_t>(hand)]; }
  Side& side(int hand) noexcept { return sides_[static_cast<std::size_t>(hand)]; }
  const Side& side(int hand) const noexcept { return sides_[static_cast<std::size_t>(hand)]; }

  Model& model_;
  TouchSeveral<Model> touch_;
  std::array<Hand<Model>, 2> hands_;
  std::array<Side, 2> sides_;
};

template <class Model>
TwoHands(Model&) -> TwoHands<Model>;
template <class Model>
TwoHands(Model&, std::initializer_list<Prop<dimension_of<Model>>>) -> TwoHands<Model>;

/// What one of the hands feels.
template <class Model>
class Touch<Hand<Model>> {
 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = dimension_of<Model>;
  using Vector = VectorOf<Scalar, dimension>;
  using Result = TouchResult<Scalar, dimension>;

  /// @param hand  kept by reference   @param avatar_radius [m]   @throws std::invalid_argument as TouchSeveral
  Touch(Hand<Model>& hand, Scalar avatar_radius, const Friction& friction = {})
      : hands_(hand.hands_), index_(hand.index_) {
    const RoundAvatar avatar(avatar_radius, 1, friction);
    avatar.check(hand.shape().length());
    hands_.place(index_).take(avatar);
    reset();
  }

  /// This hand leaves the beam; the other one stays.  The next tick of either carries it out.
  /// Real-time: wait-free, O(1), also while the other one ticks.
  void reset() noexcept {
    hands_.reset(index_);
    pressing_ = false;
  }
  bool pressing() const noexcept { return pressing_ && hands_.here(index_); }
  /// Whether ticks of the other hand have taken it off the beam that it pressed.
  bool lifted() const noexcept { return pressing_ && !hands_.here(index_); }
  /// As Touch.
  bool rough() const noexcept { return hands_.place(index_).at.friction.rough(); }
  void soften(Scalar stiffness, Scalar damping) noexcept { hands_.touch_.soften(index_, stiffness, damping); }
  /// The normal force on a hand that presses, at the place of its last tick, as ticks of the other one have left the beam [N].  Null where
  /// there were none.
  const Vector* meanwhile() const noexcept {
    const auto& force = hands_.side(index_).meanwhile;
    return pressing_ && force ? &*force : nullptr;
  }

  /// One tick.  @param position [m] of the avatar   @param shaft [m] in space, of a capsule: from there to the other end of its axis
  /// Real-time: noexcept, no allocation, bounded.
  [[nodiscard]] Result tick(const Vector& position, const Vector& shaft = Vector::Zero()) noexcept {
    const auto felt = hands_.tick(index_, position, shaft);
    Result result;
    result.status = felt.status;
    const auto& place = felt.places[static_cast<std::size_t>(index_)];
    if (felt.status != Status::invalid_request) result.status = place.status;
    result.pressing = place.touching;
    result.force = place.force;
    if (place.touching) describe(place, result);
    pressing_ = result.pressing;
    return result;
  }
  [[nodiscard]] hapbeam::Contact<Scalar, dimension> contact_at(
      const Vector& position, const Vector& shaft = Vector::Zero()) noexcept {
    return hands_.contact_at(index_, position, shaft);
  }

 private:
  void describe(const TouchPlace<Scalar, dimension>& place, Result& result) const noexcept {
    const auto shape = hands_.model().shape();
    auto& contact = result.contact;
    contact.touching = true;
    contact.segment = shape.segment_at(place.s);
    contact.depth = place.depth;
    detail::lay(contact, place.s, place.point, place.normal, hands_.model().thickness());
    result.friction = place.friction;
    result.sliding = place.sliding;
    result.dissipated = place.dissipated;
    result.press = {place.s, dimension == 2 ? place.point[1] : place.normal.dot(place.point)};
  }

  TwoHands<Model>& hands_;
  int index_;
  bool pressing_ = false;
};

}  // namespace hapbeam
