// SPDX-License-Identifier: MIT
// The rods and rigid bodies of a World, and the joints that hold them together: the first of its pairs.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <hapbeam/friction.hpp>
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

/// Base class of WorldPairs.
template <class Element>
class JointedRods {
 public:
  using Body = RodBody<Element>;

  /// @throws std::invalid_argument as RodBody, RigidBody and Joint
  JointedRods(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid,
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
      if (at(away[i]) > rods.size() && !(jointed[i].mass_per_length(jointed[i].length() / 2) > 0))
        jointed[i].check_held();
      bodies_.emplace_back(jointed[i], rods[i].elements, *equations_, rods[i].through);
    }
    for (const Joint& joint : joints) add(joint, RodPair::Kind::place, away);
    for (const Joint& joint : joints)
      if (joint.kind != JointKind::ball) {
        add(joint, RodPair::Kind::rotation, away);
        hold_rotation(joint, static_cast<int>(&joint - joints.data()));
      }
    joined_ = held_together(joints);
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
  /// Whether a joint has not come together after a solution: something else holds its place.
  bool is_open() const noexcept {
    constexpr double round_off = 1e-6;  // of the length
    for (int k = 0; k < joints(); ++k)
      if (pair(k).kind == RodPair::Kind::place) {
        const double length = body(pair(k).rod[0]).length();
        if ((between(pair(k)) - pair(k).on).squaredNorm() > round_off * round_off * length * length)
          return true;
      }
    return false;
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
  int pairs() const noexcept { return number_; }
  RodPair& pair(int k) noexcept { return pairs_[at(k)]; }
  const RodPair& pair(int k) const noexcept { return pairs_[at(k)]; }

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

  std::unique_ptr<PairEquations> equations_;
  std::vector<PlacedBody> rigid_;
  std::vector<HeldPlaces> held_;
  std::array<RodPair, most_pairs> pairs_;
  int number_ = 0;

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
  std::vector<Body> bodies_;
  std::vector<std::pair<int, int>> joined_;
};

}  // namespace detail

}  // namespace hapbeam
