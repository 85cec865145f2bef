// SPDX-License-Identifier: MIT
// The equations of rods and of the pairs that touch, as NewtonRaphson solves them.  The second side of a pair may be a rigid body: it has no columns.
//
// Each rod that moves is factored by itself; what is left is one dense symmetric system of all pairs (pair_sides.hpp).  Its inertia and that of the rods
// tell whether an equilibrium is stable (RodPair::negative()).
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hapbeam/world/pair_bounds.hpp>
#include <hapbeam/world/world_pairs.hpp>

namespace hapbeam::detail {

template <class Element>
class PairSystem : public WorldPairs<Element> {
  using Base = WorldPairs<Element>;

 public:
  using Scalar = double;
  using Base::length, Base::moves, Base::pairs, Base::stride;
  using typename Base::Body;

  using Base::Base;

  /// How far along their path, 0 to 1, the next step takes all ends.
  void aim(double t) noexcept { goal_ = t; }

  // Required by NewtonRaphson.

  /// A step is not divided.
  void set_target(double) noexcept {
    each([&](Body& body) { body.set_target(goal_); });
    for (PlacedBody& core : rigid_) core.set_target(goal_);
    this->lead_joints(goal_);
  }
  double size() const noexcept { return size_; }
  double unit() const noexcept {
    double square = 0;
    each([&](const Body& body) { square += body.system().unit() * body.system().unit(); });
    return std::sqrt(square);
  }
  int elements() const noexcept {
    int most = 0;
    each([&](const Body& body) { most = (std::max)(most, body.elements()); });
    return most;
  }
  double round_off() const noexcept {
    double sum = 0;
    each([&](const Body& body) { sum += body.system().round_off(); });
    return sum;
  }
  Iteration<double> iterate() noexcept {
    const Status status = factor(0);
    if (status == Status::ok) advance();
    return {status, increment()};
  }

  // For a fall, in addition.

  /// How places of pairs may go.
  enum class Places { free, slow };
  /// @param shift  as of ChainSystem   @return ok | singular | non_finite | iteration_limit
  Status factor(double shift, Places places = Places::free) noexcept {
    lay_out();
    double measured = 0, inner = 0;
    negative_ = 0;
    Status status = Status::ok;
    each([&](Body& body) {
      const auto of = body.assemble(shift);
      measured += of.measured, inner += of.inner;
      negative_ += body.negative_pivots();
      if (worse(of.status, status)) status = of.status;
    });
    // A round rod that is bowed between two ends on one axis may roll about it.
    if (status == Status::singular && shift == 0) return factor(Body::System::neutral(), places);
    if (status != Status::ok) return status;
    each([](Body& body) { body.eliminate(); });
    if (places == Places::slow) slow_down();
    hold_still();
    negative_ += equations_->solve() - own_negative_;
    // A place where least distance has no slope yet, and which would go to where that has none either.
    if (negative_ < 0 && places == Places::free) return factor(shift, Places::slow);
    if (rough_) follow_bounds();
    size_ = std::sqrt(2 * measured);
    double square = 0;
    each([&](Body& body) { square += body.substitute(); });
    increment_ = std::sqrt(std::abs(square) + std::abs(inner));
    return std::isfinite(increment_) ? Status::ok : Status::non_finite;
  }
  void advance() noexcept {
    const PairEquations& u = *equations_;
    each_pair([&](RodPair& pair, int row) {
      if (pair.kind != RodPair::Kind::contact)
        pair.pull_by(u[row] * pair.axes[0] + u[row + 1] * pair.axes[1] + u[row + 2] * pair.axes[2] -
                     taken_back(pair));
      else if (pair.rough())
        pair.rub(pair.friction.increment(pair.axes, {u[row], u[row + 1], u[row + 2], u[row + 3], u[row + 4]},
                                         pair.force));
      else pair.push(u[row], u[row + 1], u[row + 2]);
      if (!pair.fresh)
        each_rod(pair, [&](std::size_t side) {
          const double most = stride(pair.rod[side]);
          pair.slide(side, std::clamp(u[row + 3 + static_cast<int>(side)], -most, most),
                     length(pair.rod[side]));
        });
    });
    each([](Body& body) { body.advance(); });
  }
  double increment() const noexcept { return increment_; }
  int negative_pivots() const noexcept { return negative_; }
  /// Whether friction acts.
  bool rough() const noexcept { return rough_; }
  /// V - f · x of what moves, as it lies [J].
  double potential() const noexcept {
    double sum = 0;
    each([&](const Body& body) { sum += body.system().total_potential(); });
    return sum;
  }
  double turn() const noexcept {
    double largest = 0;
    each([&](const Body& body) { largest = (std::max)(largest, body.turn()); });
    return largest;
  }

 private:
  using Base::at, Base::each, Base::each_pair, Base::each_rod, Base::equations_, Base::look, Base::rigid_;

  /// ½ κ (r₁ + r₂) of a joint in the last increment [N], or of rotations [N·m].
  VectorOf<double, 3> taken_back(const RodPair& pair) noexcept {
    const auto& joint = this->joint_of(pair);
    VectorOf<double, 3> sum = VectorOf<double, 3>::Zero();
    each_rod(pair, [&](std::size_t side) {
      const Body& body = this->body(pair.rod[side]);
      sum += pair.kind == RodPair::Kind::place ? body.moved(joint.node[side]) : body.turned(joint.node[side]);
    });
    return pair.lent / 2 * (sum - pair.axis.dot(sum) * pair.axis);
  }

  static bool rubs(const RodPair& pair) noexcept { return !pair.friction.none() && !pair.fresh; }
  /// Gives each pair its rows, and each rod its sides.
  void lay_out() noexcept {
    each([](Body& body) { body.sides.clear(); });
    rows_ = 0, own_negative_ = 0, rough_ = false;
    double exceeds = 0;
    each_pair([&](RodPair& pair, int) {
      rows_ += pair_unknowns;
      const PlacedBody* core = this->rigid(pair.rod[1]);
      const bool joint = pair.kind != RodPair::Kind::contact;
      if (core && !joint) {
        if (core->moves && rubs(pair) && pair.friction.begins())
          pair.carry([&](auto& v) { v = core->carried(v); });
        lead(*core, this->body(pair.rod[0]).line().at(pair.s[0]).r, pair);
      } else {
        pair.look();
      }
      if (rubs(pair)) look(pair), exceeds = (std::max)(exceeds, pair.friction.exceeds());
    });
    PairEquations& dense = *equations_;
    dense.resize(rows_);
    each_pair([&](RodPair& pair, int row) {
      const PlacedBody* core = this->rigid(pair.rod[1]);
      const double times = rubs(pair) ? pair.friction.exceeds() : 0;
      if (times > 0 && times < exceeds / 2) pair.friction.stick();
      VectorOf<double, 3> off = VectorOf<double, 3>::Zero();
      if (pair.kind == RodPair::Kind::rotation) off = -this->look_at_rotation(pair);
      else if (core) off = core->at(pair.s[1]);
      for (int c = 0; c < 3; ++c) dense[row + c] -= pair.offset(at(c)) + pair.axes[at(c)].dot(off);
      if (pair.rough()) {
        pair.friction.add(pair.axes, pair.bends, pair.force, row, dense);
        rough_ = true;
      } else if (!pair.fresh && pair.kind == RodPair::Kind::contact) {
        for (int c = 1; c < 3; ++c)
          for (int d = 1; d <= c; ++d) dense(row + c, row + d) = pair.bends(c - 1, d - 1) / pair.force;
      }
      own_negative_ += pair.negative();
      each_rod(pair, [&](std::size_t side) {
        Body& body = this->body(pair.rod[side]);
        body.sides.add(pair, side, row, body.line().segment_at(pair.s[side]));
      });
    });
  }
  /// No place goes farther uphill, to a least distance, than a part of an element.
  void slow_down() noexcept {
    constexpr double part = 0.25;
    each_pair([&](RodPair& pair, int row) {
      each_rod(pair, [&](std::size_t side) {
        const int here = row + 3 + static_cast<int>(side);
        (*equations_)(here, here) -= std::abs(pair.pull[side]) / (part * stride(pair.rod[side]));
      });
    });
  }
  /// After the symmetric equations are solved.
  void follow_bounds() noexcept {
    bounds_.clear();
    each_pair([&](const RodPair& pair, int row) {
      if (pair.rough() && pair.friction.slides()) bounds_.add(pair.friction, row, pair.held, pair.force);
    });
    each([&](Body& body) {
      body.sides.visit_dragged(
          [&](const PairEquations::Unknowns& v, int unknown) { bounds_.add(v, unknown); });
    });
    negative_ = bounds_.follow(*equations_, at(rows_), negative_);
  }
  /// What is new keeps its direction, a hinge has no moment about its axis, and there is no second place on a body.
  void hold_still() noexcept {
    each_pair([&](const RodPair& pair, int row) {
      for (int c = 1; c < 3 && pair.fresh; ++c) equations_->hold(row + c, 1);
      if (pair.forces < 3) equations_->hold(row + 2, -1);
      if (this->rigid(pair.rod[1])) equations_->hold(row + 4, -1);
    });
  }

  PairBounds<PairEquations> bounds_{3 * most_pairs};
  bool rough_ = false;               // whether friction acts
  int rows_ = 0, own_negative_ = 0;  // of the pairs that are solved for: unknowns, eigenvalues
  double goal_ = 1;
  double size_ = 0, increment_ = 0;
  int negative_ = 0;
};

}  // namespace hapbeam::detail
