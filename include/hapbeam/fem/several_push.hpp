// A beam is laid on several circles, a rod on several capsules: places, directions and which of them touch are found with the equilibrium.
//
// Each contact is that of RoundPush, with a node of its own.  Which obstacles touch is a small complementarity problem,
//
//   force >= 0,  gap >= 0,  force · gap = 0        for each obstacle
//
// solved by an active set (active_set.hpp) of equilibria.  It begins with those that touched in the push before, which mostly is the last one:
// then there is one solution.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, at most most_passes solutions, and the linear solves of
// AllDisplacements in all.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <hapbeam/fem/active_set.hpp>
#include <hapbeam/fem/contact_tilt.hpp>
#include <hapbeam/fem/contact_work.hpp>
#include <hapbeam/fem/continuation.hpp>
#include <hapbeam/fem/friction_balance.hpp>
#include <hapbeam/fem/round_push.hpp>
#include <hapbeam/fem/several_foresight.hpp>
#include <hapbeam/fem/several_friction.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class Element, class System>
class SeveralPush : private ActiveSet<Element, System> {
  using Set = ActiveSet<Element, System>;
  using Set::all_;
  using Set::count_;
  using Set::end_at;
  using Set::mesh_;
  using Set::most;
  using Set::of;
  using Set::order_;
  using Set::ordered_;
  using Set::slot;
  using typename Set::Mesh;
  using typename Set::Node;
  using typename Set::Obstacle;
  using typename Set::RoundContact;
  using typename Set::Scalar;
  using typename Set::Single;
  using typename Set::Slot;
  using Vector = typename Set::Vector;
  using Friction = SeveralFriction<System, Obstacle, RoundContact, most>;
  using Law =
      decltype(std::declval<const RoundContact&>().beside(std::declval<const System&>().centreline(), 0, 0));

 public:
  /// Solutions of a push: so often nodes follow their contacts, and each obstacle touches or lets go.
  static constexpr int most_passes = Single::most_meshes + 2 * most;

  /// Linear solves in which an equilibrium that is near is found, with friction.
  static constexpr int most_solves = 16;

  /// @throws std::invalid_argument where there are too few elements for so many contacts
  explicit SeveralPush(const System& system) : foresight_(system), tilts_(system) {
    if (system.elements() < most + 1)
      throw std::invalid_argument("elements = " + std::to_string(system.elements()) + ": must be at least " +
                                  std::to_string(most + 1) + " for " + std::to_string(most) + " contacts");
  }

  /// To be called where something else moves the beam.
  void forget() noexcept { foresight_.forget(), tilts_.forget(), forget_shape(); }
  /// To be called between two pushes, where the beam is as it was built.
  void reset() noexcept {
    forget();
    for (int i = 0; i < most; ++i) slot(i).sharp = false;
  }
  /// As RoundPush::forget_shape().
  void forget_shape() noexcept { work_.forget(), balance_.forget(), continuation_.forget(); }

  /// @param way  AllDisplacements, which settles the system   @param range  says where a node can be
  /// @param all  in: where they are and whether they touched;  out: whether they touch, and their forces
  /// @return the worst Status of those that touch | iteration_limit where the passes have ended before the changes
  template <class Way, class Extent>
  Status push(Way& way, Obstacle* all, int count, const Extent& range) noexcept {
    System& system = way.system_;
    struct Answer {
      Status status;
    };
    Before& before = before_;
    for (int i = 0; i < count; ++i) to_[of(i)] = all[i].round;
    bool whole = true;  // the first answer, for all of the way
    const auto go = [&](Scalar t) {
      for (int i = 0; i < count; ++i) {
        before.pushed[of(i)] = all[i].pushed, before.touching[of(i)] = all[i].touching;
        if (all[i].friction) before.friction[of(i)] = *all[i].friction;
        if (!whole) all[i].round = from_.knows(i) ? between(from_.round(i), to_[of(i)], t) : to_[of(i)];
      }
      before.work = work_, before.balance = balance_, before.force = system.linear_reaction();
      return Answer{answer(way, all, count, range)};
    };
    const auto judge = [&](const Answer&) {
      if (!began_ || work_.strange()) return Branch::same;
      return continuation_.judge(
          {potential_, work_.done() - taken_, loose(work_.size(), work_.change()), system.strain(),
           system.length(), foresight_.same_mesh(system.mesh())},
          [&] {
            return Gone<Scalar>{work_.way(), farthest(system.view(foresight_.before()), system.centreline())};
          });
    };
    const auto keep = [&](const Answer& found) {
      if (is_answer(found.status) && work_.any()) continuation_.know(potential_);
      else continuation_.forget();
    };
    const auto back = [&] {
      if (whole) from_ = before.work;
      whole = false;
      foresight_.go_back(system, before.force);
      for (int i = 0; i < count; ++i) {
        all[i].pushed = before.pushed[of(i)], all[i].touching = before.touching[of(i)];
        if (all[i].friction) *all[i].friction = before.friction[of(i)];
      }
      work_ = before.work, balance_ = before.balance;
    };
    const auto fall = [&] {
      back();
      way.descending_ = true;
    };
    return continuation_.follow(go, judge, keep, back, fall).status;
  }

 private:
  using Work =
      ContactWork<typename SystemOf<Element>::template Round<Scalar>, Scalar, dimension_of<Element>, most>;
  using State = FrictionState<Scalar, dimension_of<Element>>;
  /// What answer() changes.
  struct Before {
    std::array<decltype(Obstacle::pushed), most> pushed{};
    std::array<bool, most> touching{};
    std::array<State, most> friction{};
    Work work;
    FrictionBalance<Scalar> balance;
    Scalar force = 0;
  };

  template <class Way, class Extent>
  Status answer(Way& way, Obstacle* all, int count, const Extent& range) noexcept {
    System& system = way.system_;
    this->begin(all, count, range);
    const bool goes_on = foresight_.look(all, count);
    if (goes_on)
      for (int i = 0; i < count; ++i)
        if (all[i].touching && all[i].kind == ObstacleKind::round)
          slot(i).s = std::clamp(foresight_.place(i), Scalar(0), range.length());
    for (int i = 0; i < count; ++i)
      if (all[i].touching && !(all[i].pushed.force < 0) && this->beside_a_touch(i)) all[i].touching = false;
    Friction friction(system, all, count);
    if (goes_on && foresight_.forth()) friction.go_on();
    began_ = false;
    Status status = Status::ok;
    bool snapped = false;
    int meshes = 1;
    for (int pass = 1;; ++pass) {
      this->choose_nodes(system, range, friction.any());
      status = solve(way, pass == 1, friction);
      snapped = snapped || status == Status::snapped;
      if (!is_answer(status)) break;
      if (!this->review(system, range, meshes, friction)) break;
      if (pass == most_passes) {
        status = Status::iteration_limit;
        break;
      }
    }
    if (snapped && status == Status::ok) status = Status::snapped;
    for (int i = 0; i < count; ++i) this->end(system, i, status);
    const auto goal = [this](int i) { return slot(i).goal; };
    const auto left = friction.leave(system, status, work_, balance_, goal);
    taken_ = left.taken;
    potential_ = system.foreseen_potential() + left.stored;
    if (is_answer(status)) friction.learn(system, tilts_, goal);
    foresight_.know(all, count, status == Status::ok);
    return status;
  }

  template <class Way>
  Status solve(Way& way, bool first, Friction& friction) noexcept {
    System& system = way.system_;
    int contacts = 0;
    for (int k = 0; k < ordered_; ++k)
      if (all_[order_[of(k)]].touching) ++contacts;
    if (contacts == 0) {
      if (!way.single_valued_) return way.let_go();
      way.to_rest();
      if (ordered_ > 0) system.remesh(mesh_);
      return Status::ok;
    }
    std::array<Scalar, most> force{};  // of the last tangent [N]
    for (int i = 0; i < count_; ++i) force[of(i)] = all_[i].pushed.force;
    bool foreseen = false;
    const auto aim = [&] {
      int goals = 0;
      for (int k = 0; k < ordered_; ++k)
        if (const int i = order_[of(k)]; all_[i].touching)
          set_goal(system, i, goals++, foreseen ? laws_[of(i)] : law_of(system, i), force[of(i)],
                   friction.of(i));
    };
    // As in RoundPush: with friction what is near is tried first.
    const bool rough = friction.any();
    const int few = rough ? most_solves : 6;
    bool all = !rough || way.descending_ || friction.falls();
    const auto agrees = [&](Status found) {
      if (!rough) return true;
      if (is_answer(found)) {
        if (friction.settled(system, [this](int i) { return slot(i).goal; })) return true;
        for (int i = 0; i < count_; ++i)
          if (slot(i).goal >= 0) force[of(i)] = system.linear_reaction(slot(i).goal);
      } else {
        if (all) return true;
        all = !friction.turn();
      }
      if (friction.torn() && began_) {
        foresight_.begin_again(system);
        system.remesh(mesh_);
      }
      return false;
    };
    if (first) {
      const Scalar last = system.linear_reaction();
      // What is foreseen has no second derivative.
      for (int k = 0; k < ordered_; ++k)
        if (const int i = order_[of(k)]; all_[i].touching) laws_[of(i)] = law_of(system, i);
      foreseen = foresight_.go_on(system, mesh_);
      began_ = true;
      if (foreseen) {
        Status status;
        do status = way.settle_at_once(Single::slack, aim, few).status;
        while (!agrees(status) && !all);
        if (status == Status::ok) return status;
        foresight_.go_back(system, last);
        foreseen = false;
        for (int i = 0; i < count_; ++i) slot(i).normal.setZero();
      }
    }
    system.remesh(mesh_);
    if (first && way.single_valued_ && nearer_at_rest(way)) {
      way.to_rest();
      system.remesh(mesh_);
    }
    const Scalar last = system.linear_reaction();
    Status status;
    do
      status =
          (all ? way.settle(last, Single::slack, aim) : way.settle_at_once(Single::slack, aim, few)).status;
    while (!agrees(status));
    return status;
  }

  /// Whether all that touch are nearer to the shape at rest than to the present one.
  template <class Way>
  bool nearer_at_rest(const Way& way) noexcept {
    const System& system = way.system_;
    Scalar jump = 0, from_rest = 0;
    for (int k = 0; k < ordered_; ++k) {
      const int i = order_[of(k)];
      if (!all_[i].touching) continue;
      if (all_[i].kind != ObstacleKind::round) continue;
      const RoundContact round{all_[i].round};
      const auto off = [&](const Node& node) {
        return std::abs(round.distance(round.look(node, 0)) - round.request().reach);
      };
      jump = (std::max)(jump, off(system.node(slot(i).node)));
      from_rest = (std::max)(from_rest, off(round.node_at(system.view(way.rest_state_), slot(i).s)));
    }
    return jump > system.length() / 1000 && from_rest < jump;
  }

  Law law_of(const System& system, int i) noexcept {
    const int c = slot(i).node;
    Law law = RoundContact{all_[i].round}.beside(system.centreline(), c, end_at(system, c));
    if (all_[i].friction && all_[i].friction->tilt != 0) law.tilt(all_[i].friction->tilt);
    return law;
  }
  void set_goal(System& system, int i, int goal, const Law& law, Scalar force,
                typename Friction::Friction* friction) noexcept {
    Slot& now = slot(i);
    const RoundContact round{all_[i].round};
    const Scalar reach = round.request().reach;
    const int c = now.node, end = end_at(system, c);
    const auto set = [&](Scalar d, const auto&... as) {
      if (goal == 0) {
        if constexpr (sizeof...(as) == 0) system.set_goal(c, d, 0, up());
        else system.set_goal(c, d, as...);
      } else {
        if constexpr (sizeof...(as) == 0) system.add_goal(force, friction, c, d, Scalar(0), up());
        else system.add_goal(force, friction, c, d, as...);
      }
    };
    if (goal == 0) system.set_force(force), system.set_friction(friction);
    now.goal = goal;
    if (all_[i].kind != ObstacleKind::round) return set(all_[i].place.d, Scalar(0), all_[i].place.normal);
    now.by_plane = now.sharp || law.sharp(reach) || round.is_through(system.node(c), end);
    if (!now.by_plane) return set(-reach, law);
    if (now.normal.isZero(0)) now.normal = round.normal(round.look(system.node(c), end));
    set(round.plane(now.normal, now.s, system.node(c)), Scalar(0), now.normal);
  }
  static Vector up() noexcept {
    Vector w = Vector::Zero();
    w[1] = 1;
    return w;
  }

  bool began_ = false;  // foresight_ has the state before this push
  std::array<Law, most> laws_{};
  SeveralForesight<System, Obstacle, most> foresight_;
  ContactTilt<System, most> tilts_;
  Work work_, from_;
  Before before_;
  std::array<typename SystemOf<Element>::template Round<Scalar>, most> to_{};
  Continuation<Scalar> continuation_;
  FrictionBalance<Scalar> balance_;
  Scalar potential_ = 0, taken_ = 0;  // of the last answer, and by friction [J]
};

}  // namespace hapbeam::detail
