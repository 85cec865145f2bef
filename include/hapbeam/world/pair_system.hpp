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
#include <limits>
#include <memory>
#include <vector>

#include <hapbeam/world/pair_bounds.hpp>
#include <hapbeam/world/rigid_body.hpp>
#include <hapbeam/world/rod_body.hpp>

namespace hapbeam {

/// A rod of a World.
struct WorldRod {
  Rod rod;
  int elements;  ///< 2 or more
  /// Of two rods that touch the larger coefficients count.
  Friction friction = {};
};

namespace detail {

template <class Element>
class PairSystem {
 public:
  using Scalar = double;
  using Body = RodBody<Element>;

  /// @throws std::invalid_argument as RodBody, RigidBody and Friction
  PairSystem(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid)
      : equations_(std::make_unique<PairEquations>()),
        rigid_(rigid.begin(), rigid.end()),
        bounds_(3 * most_pairs) {
    bodies_.reserve(rods.size());
    for (const auto& [rod, elements, friction] : rods) {
      friction.check();
      bodies_.emplace_back(rod, elements, *equations_);
      frictions_.push_back(friction);
    }
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

  /// A step begins.
  void begin_friction() noexcept {
    each_rough([](PairFriction& friction) { friction.begin(); });
  }
  /// It begins anew with all that slid as it sticks.   @return whether there is any
  bool stick() noexcept {
    bool any = false;
    each_rough([&](PairFriction& friction) {
      any = any || friction.slid();
      friction.begin(PairFriction::Start::sticks);
    });
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
  /// How far along their path, 0 to 1, the next step takes all ends.
  void aim(double t) noexcept { goal_ = t; }

  // Required by NewtonRaphson.

  /// A step is not divided.
  void set_target(double) noexcept {
    each([&](Body& body) { body.set_target(goal_); });
    for (PlacedBody& core : rigid_) core.set_target(goal_);
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
    each([](Body& body) { body.advance(); });
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      const PairEquations& u = *equations_;
      if (pair.rough())
        pair.rub(
            pair.friction.increment({u[row], u[row + 1], u[row + 2], u[row + 3], u[row + 4]}, pair.force));
      else pair.push(u[row], u[row + 1], u[row + 2]);
      for (std::size_t side = 0; side < 2 && !pair.fresh; ++side) {
        const double most = stride(rigid(pair.rod[side]) ? pair.rod[0] : pair.rod[side]);
        pair.slide(side, std::clamp(u[row + 3 + static_cast<int>(side)], -most, most),
                   length(pair.rod[side]));
      }
      row += pair_unknowns;
    }
  }
  double increment() const noexcept { return increment_; }
  int negative_pivots() const noexcept { return negative_; }
  double turn() const noexcept {
    double largest = 0;
    each([&](const Body& body) { largest = (std::max)(largest, body.turn()); });
    return largest;
  }

 private:
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
  /// Gives each pair its rows, and each rod its sides.
  void lay_out() noexcept {
    each([](Body& body) { body.sides.clear(); });
    int rows = 0;
    for (int k = 0; k < number_; ++k) rows += moves(pair(k));
    PairEquations& dense = *equations_;
    dense.resize(pair_unknowns * rows);
    own_negative_ = 0, rough_ = false;
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      const PlacedBody* core = rigid(pair.rod[1]);
      if (core) core->lead(pair);
      pair.look();
      own_negative_ += pair.negative();
      if (!pair.friction.none() && !pair.fresh) look(pair);
      if (pair.rough()) {
        dense[row] -= pair.reach;
        pair.friction.add(pair.axes, pair.force, row, dense);
        own_negative_ += pair.friction.negative();
        rough_ = true;
      } else {
        for (int c = 0; c < 3; ++c) {
          dense[row + c] -= pair.offset(at(c));
          for (int d = 1; d <= c && !pair.fresh; ++d) dense(row + c, row + d) = pair.bends(at(c), at(d));
        }
      }
      for (std::size_t side = 0; side < 2 && !(core && side == 1); ++side) {
        Body& body = this->body(pair.rod[side]);
        body.sides.add(pair, side, row, body.line().segment_at(pair.s[side]));
      }
      if (core) add(pair, *core, row);
      row += pair_unknowns;
    }
  }
  /// The side of a body, as PairSide::add().
  void add(RodPair& pair, const PlacedBody& core, int row) noexcept {
    PairEquations& dense = *equations_;
    const auto at_core = core.at(pair.s[1]);
    pair.pull[1] = core.length() > 0 ? pair.force * pair.normal.dot(core.axis()) : 0;
    dense[row + 4] -= pair.pull[1];
    for (int c = 0; c < 3; ++c) {
      dense[row + c] -= pair.axes[at(c)].dot(at_core);
      dense(row + 4, row + c) = pair.axes[at(c)].dot(core.axis());
    }
  }
  /// No place goes farther uphill, to a least distance, than a part of an element.
  void slow_down() noexcept {
    constexpr double part = 0.25;
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      const RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      for (std::size_t side = 0; side < 2 && !rigid(pair.rod[side]); ++side) {
        const int here = row + 3 + static_cast<int>(side);
        (*equations_)(here, here) -= std::abs(pair.pull[side]) / (part * stride(pair.rod[side]));
      }
      row += pair_unknowns;
    }
  }

  void give_friction(RodPair& pair) noexcept {
    if (rigid(pair.rod[1])) return;
    const Friction friction = friction_of(frictions_[at(pair.rod[0])], frictions_[at(pair.rod[1])]);
    if (friction.none()) return;
    const Body &a = body(pair.rod[0]), &b = body(pair.rod[1]);
    const auto skin = [](const Body& of) { return of.system().unit() / of.length(); };
    const double least = (std::min)(skin(a), skin(b));
    pair.friction.take(friction, pair.reach,
                       least * least / std::sqrt(std::numeric_limits<double>::epsilon()),
                       (std::min)(a.length(), b.length()));
  }
  void look(RodPair& pair) noexcept {
    const VectorOf<double, 3> force = pair.force * pair.normal + pair.friction.force();
    std::array<VectorOf<double, 3>, 2> along;
    for (std::size_t side = 0; side < 2; ++side) {
      const Body& body = this->body(pair.rod[side]);
      along[side] = Body::Sides::tangent(body.parts(), body.line().segment_at(pair.s[side]), pair.s[side],
                                         side == 0 ? force : -force);
    }
    pair.friction.look(pair.normal, pair.s, along, pair.force);
  }
  /// After the symmetric equations are solved.
  void follow_bounds() noexcept {
    int row = 0;
    bounds_.clear();
    each_pair([&](const RodPair& pair) {
      if (pair.rough() && pair.friction.slides()) bounds_.add(pair.friction, row, pair.held, pair.force);
      row += pair_unknowns;
    });
    each([&](Body& body) {
      body.sides.visit_dragged(
          [&](const PairEquations::Unknowns& v, int unknown) { bounds_.add(v, unknown); });
    });
    bounds_.follow(*equations_, at(row));
  }
  /// What is new keeps its direction, as does the force of a plane.  What is held on a body has no rod that says so.
  void hold_still() noexcept {
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      const RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      const PlacedBody* core = rigid(pair.rod[1]);
      const bool plane = core && core->kind() == RigidBody::Kind::half_space;
      for (int c = 1; c < 3 && (pair.fresh || plane); ++c)
        equations_->hold(row + c, c == 1 && pair.ring < 0 ? -1 : 1);
      if (core && (pair.fresh || pair.held[1])) equations_->hold(row + 4, -1);
      row += pair_unknowns;
    }
  }

  std::unique_ptr<PairEquations> equations_;
  std::vector<Body> bodies_;
  std::vector<PlacedBody> rigid_;
  std::vector<Friction> frictions_;  // of each rod
  PairBounds<PairEquations> bounds_;
  bool rough_ = false;  // whether friction acts
  std::array<RodPair, most_pairs> pairs_, saved_;
  int number_ = 0, saved_number_ = 0;
  int own_negative_ = 0;  // eigenvalues of the pairs that are solved for
  double goal_ = 1;
  double size_ = 0, increment_ = 0;
  int negative_ = 0;
};

}  // namespace detail

}  // namespace hapbeam
