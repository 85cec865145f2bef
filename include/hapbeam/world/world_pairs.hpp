// SPDX-License-Identifier: MIT
// What there is in a World: its rods, its rigid bodies, and the pairs that touch, with their friction.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <hapbeam/world/rigid_body.hpp>
#include <hapbeam/world/rod_body.hpp>

namespace hapbeam {

/// A rod of a World.
struct WorldRod {
  Rod rod;
  int elements;  ///< 2 or more
  /// Of what touches the larger coefficients count.
  Friction friction = {};
};

namespace detail {

/// Base class of PairSystem.
template <class Element>
class WorldPairs {
 public:
  using Body = RodBody<Element>;

  /// @throws std::invalid_argument as RodBody, RigidBody and Friction
  WorldPairs(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid)
      : equations_(std::make_unique<PairEquations>()), rigid_(rigid.begin(), rigid.end()) {
    bodies_.reserve(rods.size());
    for (const auto& [rod, elements, friction] : rods) {
      friction.check();
      bodies_.emplace_back(rod, elements, *equations_);
      frictions_.push_back(friction);
    }
    for (const RigidBody& body : rigid) frictions_.push_back(body.friction());
  }

  std::vector<Body>& bodies() noexcept { return bodies_; }
  const std::vector<Body>& bodies() const noexcept { return bodies_; }
  Body& body(int i) noexcept { return bodies_[static_cast<std::size_t>(i)]; }
  const Body& body(int i) const noexcept { return bodies_[static_cast<std::size_t>(i)]; }

  std::vector<PlacedBody>& rigid() noexcept { return rigid_; }
  const std::vector<PlacedBody>& rigid() const noexcept { return rigid_; }

  // What is on either side of a pair: a rod or, numbered after those, a rigid body.

  const PlacedBody* rigid(int i) const noexcept {
    const std::size_t rods = bodies_.size();
    return at(i) < rods ? nullptr : &rigid_[at(i) - rods];
  }
  double length(int i) const noexcept { return rigid(i) ? rigid(i)->length() : body(i).length(); }
  /// No place on a rod goes farther at once [m].
  double stride(int i) const noexcept { return body(i).length() / body(i).elements(); }
  /// From the second side of a pair to the first [m].
  VectorOf<double, 3> between(const RodPair& pair) const noexcept {
    const PlacedBody* core = rigid(pair.rod[1]);
    return body(pair.rod[0]).line().at(pair.s[0]).r -
           (core ? core->at(pair.s[1]) : body(pair.rod[1]).line().at(pair.s[1]).r);
  }

  // The pairs that touch.

  int pairs() const noexcept { return number_; }
  RodPair& pair(int k) noexcept { return pairs_[at(k)]; }
  const RodPair& pair(int k) const noexcept { return pairs_[at(k)]; }
  void clear() noexcept { number_ = 0; }
  /// @return whether there was room
  bool add(const RodPair& pair) noexcept {
    if (number_ == most_pairs) return false;
    pairs_[at(number_)] = pair;
    give_friction(pairs_[at(number_++)]);
    return true;
  }
  void remove(int k) noexcept {
    for (--number_; k < number_; ++k) pairs_[at(k)] = pairs_[at(k + 1)];
  }
  /// Whether a pair is solved for.
  bool moves(const RodPair& pair) const noexcept { return body(pair.rod[0]).moves; }
  /// What moves moves all that it touches.
  void spread() noexcept {
    for (bool more = true; more;) {
      more = false;
      for (int k = 0; k < number_; ++k) {
        Body& a = body(pair(k).rod[0]);
        if (const PlacedBody* core = rigid(pair(k).rod[1])) {
          more = more || (core->moves && !a.moves);
          a.moves = a.moves || core->moves;
          continue;
        }
        Body& b = body(pair(k).rod[1]);
        if (a.moves == b.moves) continue;
        a.moves = b.moves = more = true;
      }
    }
  }

  // Friction.

  /// As PairFriction::begin().   @return whether any begins another way than it went on
  bool begin_friction(PairFriction::Start start = PairFriction::Start::goes_on) noexcept {
    bool any = false;
    each_rough([&](PairFriction& friction) { any = friction.begin(start) || any; });
    return any;
  }
  /// All that moves slides without friction until it has come to an equilibrium.
  void let_go() noexcept {
    each_rough([](PairFriction& friction) { friction.let_go(); });
  }
  /// To be called where an equilibrium was found.   @return whether it is one of Coulomb's law, too
  bool settled() noexcept {
    bool all = true;
    each_pair([&](RodPair& pair) {
      if (pair.friction.none()) return;
      look(pair);
      all = pair.friction.settled(pair.axes, pair.force) && all;
    });
    return all;
  }
  /// To be called where that is kept.   @return what friction has dissipated [J]
  double leave_friction() noexcept {
    double dissipated = 0;
    each_pair([&](RodPair& pair) {
      if (!pair.friction.none()) dissipated += pair.friction.leave(pair.force);
    });
    return dissipated;
  }

  void save() noexcept {
    each([](Body& body) { body.save(); });
    for (PlacedBody& core : rigid_) core.save();
    saved_number_ = number_;
    std::copy_n(pairs_.begin(), number_, saved_.begin());
  }
  void restore() noexcept {
    each([](Body& body) { body.restore(); });
    for (PlacedBody& core : rigid_) core.restore();
    number_ = saved_number_;
    std::copy_n(saved_.begin(), number_, pairs_.begin());
  }

 protected:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  template <class F>
  void each(F&& f) noexcept {
    for (Body& body : bodies_)
      if (body.moves) f(body);
  }
  template <class F>
  void each(F&& f) const noexcept {
    for (const Body& body : bodies_)
      if (body.moves) f(body);
  }
  template <class F>
  void each_pair(F&& f) noexcept {
    for (int k = 0; k < number_; ++k)
      if (moves(pair(k))) f(pair(k));
  }
  template <class F>
  void each_rough(F&& f) noexcept {
    each_pair([&](RodPair& pair) {
      if (!pair.friction.none()) f(pair.friction);
    });
  }
  /// Where friction acts, as all lies.
  void look(RodPair& pair) noexcept {
    using Vector = VectorOf<double, 3>;
    const Vector force = pair.force * pair.normal + pair.friction.force();
    const auto point = [&](std::size_t side, const Vector& acts) {
      const Body& body = this->body(pair.rod[side]);
      return Body::Sides::point(body.parts(), body.line().segment_at(pair.s[side]), pair.s[side], acts);
    };
    const RodPoint<double> first = point(0, force);
    const PlacedBody* core = rigid(pair.rod[1]);
    if (core) carry(pair, *core, first.r - core->at(0));
    pair.friction.look(pair.normal, pair.off(), pair.s,
                       {first.tangent, core ? core->tangent() : point(1, -force).tangent}, pair.force);
  }

  std::unique_ptr<PairEquations> equations_;
  std::vector<PlacedBody> rigid_;

 private:
  /// What a body that turns takes along, and where a new contact is on a plane.   @param w  from its tip
  void carry(RodPair& pair, const PlacedBody& core, const VectorOf<double, 3>& w) noexcept {
    if (pair.friction.begins() && core.moves) pair.carry([&](auto& v) { v = core.carried(v); });
    if (pair.curve > 1 && pair.friction.is_free()) pair.on = w - w.dot(pair.normal) * pair.normal;
  }
  void give_friction(RodPair& pair) noexcept {
    const Friction friction = friction_of(frictions_[at(pair.rod[0])], frictions_[at(pair.rod[1])]);
    if (friction.none()) return;
    const Body &a = body(pair.rod[0]), &b = rigid(pair.rod[1]) ? a : body(pair.rod[1]);
    const auto skin = [](const Body& of) { return of.system().unit() / of.length(); };
    const double least = (std::min)(skin(a), skin(b));
    pair.friction.take(friction, pair.reach,
                       least * least / std::sqrt(std::numeric_limits<double>::epsilon()),
                       (std::min)(a.length(), b.length()));
  }

  std::vector<Body> bodies_;
  std::vector<Friction> frictions_;  // of each rod and body
  std::array<RodPair, most_pairs> pairs_, saved_;
  int number_ = 0, saved_number_ = 0;
};

}  // namespace detail

}  // namespace hapbeam
