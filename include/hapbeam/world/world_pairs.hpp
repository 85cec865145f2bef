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
#include <utility>
#include <vector>

#include <hapbeam/world/joint.hpp>
#include <hapbeam/world/placed_body.hpp>
#include <hapbeam/world/rod_body.hpp>

namespace hapbeam {

/// A rod of a World.
struct WorldRod {
  Rod rod;
  int elements;  ///< 2 or more
  /// Of what touches the larger coefficients count.
  Friction friction = {};
  /// Points from one end to the other [m], three or more: it begins bent through them, and falls to an equilibrium from there.  None: it begins at rest.
  std::vector<VectorOf<double, 3>> through = {};
};

namespace detail {

/// Base class of PairSystem.
template <class Element>
class WorldPairs {
 public:
  using Body = RodBody<Element>;

  /// @throws std::invalid_argument as RodBody, RigidBody, Friction and Joint
  WorldPairs(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid,
             const std::vector<Joint>& joints)
      : equations_(std::make_unique<PairEquations>()), rigid_(rigid.begin(), rigid.end()) {
    std::vector<Rod> jointed;
    for (const WorldRod& rod : rods) jointed.push_back(rod.rod);
    for (const Joint& joint : joints) {
      check_joint(joint, jointed, rigid);
      for (std::size_t side = 0; side < 2; ++side)
        if (at(joint.rod[side]) < rods.size())
          jointed[at(joint.rod[side])].join(joint.s[side], joint.kind != JointKind::ball);
    }
    std::vector<int> away;
    for (const Rod& rod : jointed)
      away.push_back(rod.held() && (!has_twist || rod.holds_own_twist()) ? 0
                                                                         : static_cast<int>(rods.size()) + 1);
    away = joints_away(std::move(away), joints);
    bodies_.reserve(rods.size());
    for (std::size_t i = 0; i < rods.size(); ++i) {
      rods[i].friction.check();
      if (at(away[i]) > rods.size() && !(jointed[i].mass_per_length(jointed[i].length() / 2) > 0))
        jointed[i].check_held();
      bodies_.emplace_back(jointed[i], rods[i].elements, *equations_, rods[i].through);
      frictions_.push_back(rods[i].friction);
    }
    for (const RigidBody& body : rigid) frictions_.push_back(body.friction());
    for (const Joint& joint : joints) add(joint, RodPair::Kind::place, away);
    for (const Joint& joint : joints)
      if (joint.kind != JointKind::ball) {
        add(joint, RodPair::Kind::rotation, away);
        hold_rotation(joint, static_cast<int>(&joint - joints.data()));
      }
    joined_ = held_together(joints);
    keep_rest();
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
  double length(int i) const noexcept { return rigid(i) ? 0 : body(i).length(); }
  /// No place on a rod goes farther at once [m].
  double stride(int i) const noexcept { return body(i).length() / body(i).elements(); }
  /// From the second side of a pair to the first [m].
  VectorOf<double, 3> between(const RodPair& pair) const noexcept {
    const PlacedBody* core = rigid(pair.rod[1]);
    return body(pair.rod[0]).line().at(pair.s[0]).r -
           (core ? core->at(pair.s[1]) : body(pair.rod[1]).line().at(pair.s[1]).r);
  }

  // The joints, and behind them the pairs that touch.

  int joints() const noexcept { return static_cast<int>(held_.size()); }
  /// Whether joints hold both together, at one place.
  bool joined(int i, int j) const noexcept {
    return std::find(joined_.begin(), joined_.end(), std::pair<int, int>(std::minmax(i, j))) != joined_.end();
  }
  /// Their paths begin where they are.
  void begin_joints() noexcept {
    for (int k = 0; k < joints(); ++k)
      held_[at(k)].apart =
          pair(k).kind == RodPair::Kind::place ? between(pair(k)) : look_at_rotation(pair(k));
  }
  /// The moment of a joint; null: it has none.
  const RodPair* rotation_of(int joint) const noexcept {
    for (int k = 0; k < joints(); ++k)
      if (pair(k).kind == RodPair::Kind::rotation && held_[at(k)].number == joint) return &pair(k);
    return nullptr;
  }
  /// So far along their paths, 0 to 1.
  void lead_joints(double t) noexcept {
    for (int k = 0; k < joints(); ++k) pair(k).on = (1 - t) * held_[at(k)].apart;
  }
  /// All rests as it lies.
  void keep_rest() noexcept {
    for (Body& body : bodies_) body.keep_rest();
    rest_number_ = number_, rest_ = pairs_;
  }

  struct Pairs {
    std::array<RodPair, most_pairs> pair;
    int number;
  };
  Pairs kept_pairs() const noexcept { return {pairs_, number_}; }
  void set_pairs(const Pairs& kept) noexcept { pairs_ = kept.pair, number_ = kept.number; }
  int pairs() const noexcept { return number_; }
  RodPair& pair(int k) noexcept { return pairs_[at(k)]; }
  const RodPair& pair(int k) const noexcept { return pairs_[at(k)]; }
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
  /// Whether a rod is drawn so taut where it touches that its cubics may be off by 1 %: it has no tension of its own, or touches on its stiffer side.
  bool overdrawn() const noexcept {
    return std::any_of(pairs_.begin(), pairs_.begin() + number_, [this](const RodPair& pair) {
      bool is = false;
      if (pair.kind == RodPair::Kind::rotation) return is;
      each_rod(pair, [&](std::size_t side) {
        is = is || body(pair.rod[side]).system().overdrawn(pair.s[side], pair.normal);
      });
      return is;
    });
  }
  /// Whether a pair is solved for.
  bool moves(const RodPair& pair) const noexcept { return body(pair.rod[0]).moves; }
  /// What moves moves all that it touches.
  void spread() noexcept {
    for (bool more = true; more;) {
      more = false;
      for (int k = 0; k < number_; ++k) {
        const PlacedBody* core = rigid(pair(k).rod[1]);
        Body& a = body(pair(k).rod[0]);
        const bool other = core ? core->moves : body(pair(k).rod[1]).moves;
        if (a.moves == other || (core && a.moves)) continue;
        a.moves = more = true;
        if (!core) body(pair(k).rod[1]).moves = true;
      }
    }
  }

  // Friction.

  /// As PairFriction::begin().   @return whether any begins another way than it went on
  bool begin_friction(PairFriction::Start start = PairFriction::Start::goes_on) noexcept {
    bool any = false;
    each_rough([&](RodPair& pair) { any = pair.friction.begin(start) || any; });
    return any;
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
      all = pair.friction.settled(pair.axes, pair.force) && all;
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
  using Vector = VectorOf<double, 3>;
  using Matrix = Eigen::Matrix<double, 3, 3>;
  static constexpr bool has_twist = Element::unknowns == 7;
  /// A joint beside its pair: nodes of its rods, where its path begins, and of directions: axes of the first in those of the second, axis of a hinge in those of the first.
  struct HeldPlaces {
    std::array<int, 2> node{};
    Vector apart = Vector::Zero(), axis = Vector::Zero();
    Matrix rest = Matrix::Identity();
    int number = 0;  // of the joint
  };
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
  /// Calls f(pair, row of its equations) of all that are solved for.
  template <class F>
  void each_pair(F&& f) noexcept {
    int row = 0;
    for (int k = 0; k < number_; ++k)
      if (moves(pair(k))) f(pair(k), row), row += pair_unknowns;
  }
  template <class F>
  void each_rough(F&& f) noexcept {
    each_pair([&](RodPair& pair, int) {
      if (!pair.friction.none()) f(pair);
    });
  }
  /// Calls f(side) of a pair where there is a rod.
  template <class F>
  void each_rod(const RodPair& pair, F&& f) const noexcept {
    for (std::size_t side = 0; side < 2; ++side)
      if (!rigid(pair.rod[side])) f(side);
  }
  const HeldPlaces& joint_of(const RodPair& pair) const noexcept {
    return held_[std::size_t(&pair - pairs_.data())];
  }
  /// d1, d2 and tangent where a joint holds a side, or axes that go with a body.
  Matrix axes(const RodPair& pair, std::size_t side) const noexcept {
    Matrix axes;
    if (const PlacedBody* core = rigid(pair.rod[side])) {
      for (int c = 0; c < 3; ++c) axes.col(c) = core->turned(Vector::Unit(c));
      return axes;
    }
    RodNode<double> node = body(pair.rod[side]).system().node(joint_of(pair).node[side]);
    node.tangent = unit(node.tangent);
    return axes_of(node);
  }
  /// How the first side is turned against where the second holds it [rad].  Sets the axes along which moments act.
  [[gnu::noinline]] Vector look_at_rotation(RodPair& pair) noexcept {
    const HeldPlaces& joint = joint_of(pair);
    const Matrix is = axes(pair, 0), belongs = axes(pair, 1) * joint.rest;
    if (!joint.axis.isZero(0)) {
      const Vector e = is * joint.axis;
      pair.look_along(e);
      return cross3<double>(belongs * joint.axis, e);
    }
    const auto node = [](const Matrix& of) {
      return RodNode<double>{0, Vector::Zero(), of.col(2), of.col(0)};
    };
    return rotation_between(node(belongs), node(is));
  }
  /// Where friction acts, as all lies.
  void look(RodPair& pair) noexcept {
    const Vector force = pair.force * pair.normal + pair.friction.force();
    // r' of the true curve of a rod.
    const auto tangent = [&](std::size_t side, const Vector& acts) -> Vector {
      if (rigid(pair.rod[side])) return Vector::Zero();
      const Body& body = this->body(pair.rod[side]);
      return Body::Sides::point(body.parts(), body.line().segment_at(pair.s[side]), pair.s[side], acts)
          .tangent;
    };
    pair.friction.look(pair.normal, pair.on, pair.s, {tangent(0, force), tangent(1, -force)}, pair.force);
  }

  std::unique_ptr<PairEquations> equations_;
  std::vector<PlacedBody> rigid_;
  std::vector<HeldPlaces> held_;

 private:
  /// @throws std::invalid_argument where there are too many, or a mesh has no node there
  [[gnu::cold]] void add(const Joint& joint, RodPair::Kind kind, const std::vector<int>& away) {
    if (number_ == most_pairs)
      reject("joints", number_ + 1.0, "", "at most 16, where hinges and welds are two each");
    RodPair& pair = pairs_[at(number_++)];
    pair.kind = kind, pair.fresh = false, pair.held = {true, true};
    pair.rod = joint.rod, pair.s = joint.s;
    HeldPlaces beside;
    std::array<int, 2> steps{};
    each_rod(pair, [&](std::size_t side) {
      const Body& body = this->body(joint.rod[side]);
      const auto line = body.line();
      int& node = beside.node[side];
      while (node < body.elements() && line[node].s < joint.s[side] - line[node + 1].s * 1e-9) ++node;
      if (std::abs(line[node].s - joint.s[side]) > 1e-6 * body.length())
        reject("joint s", joint.s[side], "m", "a node of the rod: take more elements");
      pair.s[side] = line[node].s, steps[side] = away[at(joint.rod[side])];
    });
    const double share = lent_share(steps[0], steps[1]);
    if (share != 0) {
      const Body& borrows = body(joint.rod[share > 0 ? 0 : 1]);
      const double unit = borrows.system().unit() / borrows.length();
      pair.lent = share * unit * unit;
      if (kind == RodPair::Kind::rotation) pair.lent *= borrows.length() * borrows.length();
    }
    held_.push_back(beside);
  }
  /// The last joint that was added holds directions as they are.
  /// @throws std::invalid_argument where the element has no twist to do so
  [[gnu::cold]] void hold_rotation(const Joint& joint, int number) {
    RodPair& pair = pairs_[at(number_ - 1)];
    HeldPlaces& joined = held_.back();
    const Matrix first = axes(pair, 0);
    joined.number = number, joined.rest = axes(pair, 1).transpose() * first;
    if (joint.kind == JointKind::hinge) joined.axis = first.transpose() * joint.axis.normalized();
    if (has_twist) return;
    // About its own tangent it turns freely.
    joined.axis = Vector::UnitZ();
    if (joint.kind == JointKind::hinge || (!rigid(joint.rod[1]) && 1 - std::abs(joined.rest(2, 2)) > 1e-9))
      throw std::invalid_argument(
          "joint kind: RoundRod has no twist, so it is welded to a body or to a rod that goes on straight; "
          "take "
          "TwistedRod");
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
  std::vector<std::pair<int, int>> joined_;
  std::vector<Friction> frictions_;  // of each rod and body
  std::array<RodPair, most_pairs> pairs_, saved_, rest_;
  int number_ = 0, saved_number_ = 0, rest_number_ = 0;
};

}  // namespace detail

}  // namespace hapbeam
