// SPDX-License-Identifier: MIT
// What touches in a World: its pairs, with their friction.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <hapbeam/world/jointed_rods.hpp>

namespace hapbeam::detail {

/// Base class of PairSystem.
template <class Element>
class WorldPairs : public JointedRods<Element> {
  using Base = JointedRods<Element>;

 public:
  using typename Base::Body;

  /// @throws std::invalid_argument as JointedRods and Friction
  WorldPairs(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid,
             const std::vector<Joint>& joints)
      : Base(rods, rigid, joints) {
    for (const WorldRod& rod : rods) rod.friction.check(), frictions_.push_back(rod.friction);
    for (const RigidBody& body : rigid) frictions_.push_back(body.friction());
    keep_rest();
  }

  /// All rests as it lies.
  void keep_rest() noexcept {
    for (Body& body : this->bodies()) body.keep_rest();
    rest_number_ = number_, rest_ = pairs_;
  }

  struct Pairs {
    std::array<RodPair, most_pairs> pair;
    int number;
  };
  Pairs kept_pairs() const noexcept { return {pairs_, number_}; }
  void set_pairs(const Pairs& kept) noexcept { pairs_ = kept.pair, number_ = kept.number; }
  /// As at rest.
  void clear() noexcept { number_ = rest_number_, pairs_ = rest_; }
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
  /// Whether a rod is drawn so taut where it touches that its cubics may be off by 1 %: it has no tension of its own, or touches on its stiffer side.  Or it is
  /// bent too sharply beside an end that is held.
  bool overdrawn() const noexcept {
    for (const Body& body : this->bodies())
      if (body.parts().overdrawn()) return true;
    return std::any_of(pairs_.begin(), pairs_.begin() + number_, [this](const RodPair& pair) {
      bool is = false;
      if (pair.kind == RodPair::Kind::rotation) return is;
      each_rod(pair, [&](std::size_t side) {
        const auto& system = this->body(pair.rod[side]).system();
        const double s = pair.s[side];
        is = is || system.parts().overdrawn(system.centreline().segment_at(s), s, pair.normal) ||
             (pair.kind == RodPair::Kind::contact && system.bent_beside_end(s, pair.force));
      });
      return is;
    });
  }
  /// Whether a pair is solved for.
  bool moves(const RodPair& pair) const noexcept { return this->body(pair.rod[0]).moves; }
  /// What moves moves all that it touches.
  void spread() noexcept {
    for (bool more = true; more;) {
      more = false;
      for (int k = 0; k < number_; ++k) {
        const PlacedBody* core = this->rigid(this->pair(k).rod[1]);
        Body& a = this->body(this->pair(k).rod[0]);
        const bool other = core ? core->moves : this->body(this->pair(k).rod[1]).moves;
        if (a.moves == other || (core && a.moves)) continue;
        a.moves = more = true;
        if (!core) this->body(this->pair(k).rod[1]).moves = true;
      }
    }
  }

  // Where they touch.

  /// Whether its first place stays, and not at an end: in a row of contacts along a line.
  bool is_pinned(const RodPair& pair) const noexcept {
    return pair.held[0] && pair.s[0] > 0 && pair.s[0] < this->length(pair.rod[0]);
  }
  /// Whether it touches a tube, along which a rod may lie: elsewhere it leaves the surface beside a contact.
  bool along_tube(const RodPair& pair) const noexcept {
    const PlacedBody* core = this->rigid(pair.rod[1]);
    return core && core->body().kind() == RigidBody::Kind::tube;
  }
  /// As between(), of the curves as nodes and tensions hold them, which those that are drawn are not where a rod is taut.
  auto unbent(const RodPair& pair) const noexcept {
    return apart(pair, [&](std::size_t side) -> Vector {
      return this->body(pair.rod[side]).point(pair.s[side], Vector::Zero(), false).r;
    });
  }
  /// Of the true curves along n, as RodPair::distance() [m].
  double distance(const RodPair& pair) const noexcept {
    return pair.distance(apart(pair, [&](std::size_t side) { return point(pair, side, along_n(pair)).r; }));
  }
  /// Whether they part to both sides of its first place, where the second follows: gap'' > 0.  To be called after a solution.
  bool parts(const RodPair& pair) const noexcept {
    using Plane = VectorOf<double, 2>;
    const RodPair::Bends& H = pair.bends;
    std::array<double, 2> second{0, 1};
    std::array<Plane, 2> along{Plane::Zero(), Plane::Zero()}, turns = along;
    each_rod(pair, [&](std::size_t side) {
      const auto touched = point(pair, side, along_n(pair));
      const Plane t(touched.tangent.dot(pair.axes[1]), touched.tangent.dot(pair.axes[2]));
      along[side] = t, turns[side] = Plane(H(1, 1) * t[0] - H(0, 1) * t[1], H(0, 0) * t[1] - H(1, 0) * t[0]) /
                                     (H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0));
      second[side] = sign(side) * touched.curvature.dot(pair.normal) + t.dot(turns[side]);
    });
    const double mixed = along[0].dot(turns[1]);
    return second[0] > mixed * mixed / second[1];
  }

  // Friction.

  void begin_friction(const RubGuess& guess) noexcept {
    each_rough([&guess](RodPair& pair) { pair.friction.begin(guess); });
  }
  /// All that moves slides without friction until it has come to an equilibrium.
  void let_go() noexcept {
    each_rough([](RodPair& pair) { pair.friction.let_go(); });
  }
  /// To be called where an equilibrium was found.   @return whether it is one of Coulomb's law, too
  bool settled() noexcept {
    bool all = true;
    each_rough([&](RodPair& pair) {
      look(pair);
      all = pair.friction.settled(pair.force) && all;
    });
    return all;
  }
  /// To be called where that is kept.   @return what friction has dissipated [J]
  double leave_friction() noexcept {
    double dissipated = 0;
    each_rough([&](RodPair& pair) { dissipated += pair.friction.leave(pair.force); });
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
  using Base::at, Base::each, Base::each_rod, Base::number_, Base::pairs_, Base::rigid_;
  using typename Base::Vector;
  /// Calls f(pair, row of its equations) of all that are solved for.
  template <class F>
  void each_pair(F&& f) noexcept {
    int row = 0;
    for (int k = 0; k < number_; ++k)
      if (moves(this->pair(k))) f(this->pair(k), row), row += pair_unknowns;
  }
  template <class F>
  void each_rough(F&& f) noexcept {
    each_pair([&](RodPair& pair, int) {
      if (!pair.friction.none()) f(pair);
    });
  }
  /// Where friction acts, as all lies.
  void look(RodPair& pair) noexcept {
    // r' of the true curve of a rod.
    const auto tangent = [&](std::size_t side) -> Vector {
      if (this->rigid(pair.rod[side])) return Vector::Zero();
      return point(pair, side, along_n(pair) + pair.friction.force()).tangent;
    };
    pair.friction.look(pair.normal, pair.on, pair.s, {tangent(0), tangent(1)}, pair.force);
  }

 private:
  static double sign(std::size_t side) noexcept { return side == 0 ? 1 : -1; }
  /// @param place  (side) -> where that is
  template <class Place>
  Vector apart(const RodPair& pair, Place&& place) const noexcept {
    Vector w = Vector::Zero();
    if (const PlacedBody* core = this->rigid(pair.rod[1])) w -= core->at(pair.s[1]);
    each_rod(pair, [&](std::size_t side) { w += sign(side) * place(side); });
    return w;
  }
  static Vector along_n(const RodPair& pair) noexcept { return pair.force * pair.normal; }
  /// Of the true curve.   @param force  on the first rod, which acts with those of all pairs in the element
  auto point(const RodPair& pair, std::size_t side, const Vector& force) const noexcept {
    const Body& body = this->body(pair.rod[side]);
    auto sum = body.point(pair.s[side], sign(side) * force, pair.rough());
    for (int k = this->joints(); k < number_; ++k) {
      const RodPair& other = pairs_[at(k)];
      if (pair.yields_to(other))
        each_rod(other, [&](std::size_t i) {
          if (other.rod[i] != pair.rod[side]) return;
          Vector F = along_n(other);
          if (other.rough()) F += other.friction.force();
          body.bend(sum, pair.s[side], other.s[i], sign(i) * F, {pair.rough(), other.rough()});
        });
    }
    return sum;
  }
  void give_friction(RodPair& pair) noexcept {
    const Friction friction = friction_of(frictions_[at(pair.rod[0])], frictions_[at(pair.rod[1])]);
    if (friction.none()) return;
    const Body &a = this->body(pair.rod[0]), &b = this->rigid(pair.rod[1]) ? a : this->body(pair.rod[1]);
    // n² EI/L³
    const auto stiffness = [](const Body& of, int n) {
      const double root = n * of.system().unit() / of.length();
      return root * root;
    };
    const double k = (std::min)(stiffness(a, 1), stiffness(b, 1)),
                 q = (std::min)(stiffness(a, a.elements()), stiffness(b, b.elements()));
    pair.friction.take(friction, pair.reach, k / std::sqrt(std::numeric_limits<double>::epsilon()), q);
  }

  std::vector<Friction> frictions_;  // of each rod and body
  std::array<RodPair, most_pairs> saved_, rest_;
  int saved_number_ = 0, rest_number_ = 0;
};

}  // namespace hapbeam::detail
