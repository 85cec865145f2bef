// A beam is laid on several circles, a rod on several capsules: places, directions and which of them touch are found with the equilibrium.
//
// Each contact is that of RoundPush, with a node of its own.  Which obstacles touch is a small complementarity problem,
//
//   force >= 0,  gap >= 0,  force · gap = 0        for each obstacle
//
// solved by an active set.  It begins with those that touched in the push before.  Of those that would have to pull the worst lets go; where none
// would, the one that the beam lies deepest in is added; and each node follows its contact.  Two that are beside each other bend the beam with
// forces a thousand times their difference, so a new one takes the place of the one beside it, which comes back if the beam lies in it then.  An
// obstacle that has let go in this push is taken back only where it is deeper than the mesh can be wrong.  The last tick's set mostly is this one's: then there is one solution.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, at most most_passes solutions, and the linear solves of
// AllDisplacements in all.   Source: active sets, Nocedal and Wright, Numerical Optimization, 16.5.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <hapbeam/fem/contact_search.hpp>
#include <hapbeam/fem/obstacle_gap.hpp>
#include <hapbeam/fem/round_push.hpp>
#include <hapbeam/fem/several_foresight.hpp>
#include <hapbeam/fem/several_friction.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class Element, class System>
class SeveralPush {
  using Scalar = typename System::Scalar;
  using Node = typename System::Node;
  using Mesh = typename System::Mesh;
  using RoundContact = typename SystemOf<Element>::template RoundContact<Scalar>;
  static constexpr int dimension = dimension_of<Element>;
  static constexpr bool planar = dimension == 2;
  static constexpr int most = contacts_of<Element>;
  using Vector = VectorOf<Scalar, dimension>;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  using Search = ContactSearch<Scalar, dimension>;
  using Single = RoundPush<Element, System>;
  using Friction = SeveralFriction<System, Obstacle, RoundContact, most>;
  using Law =
      decltype(std::declval<const RoundContact&>().beside(std::declval<const System&>().centreline(), 0, 0));

 public:
  /// Solutions of a push: so often nodes follow their contacts, and each obstacle touches or lets go.
  static constexpr int most_passes = Single::most_meshes + 2 * most;

  /// Linear solves in which an equilibrium that is near is found, with friction.
  static constexpr int most_solves = 16;

  /// @throws std::invalid_argument where there are too few elements for so many contacts
  explicit SeveralPush(const System& system) : foresight_(system) {
    if (system.elements() < most + 1)
      throw std::invalid_argument("elements = " + std::to_string(system.elements()) + ": must be at least " +
                                  std::to_string(most + 1) + " for " + std::to_string(most) + " contacts");
  }

  /// To be called where something else moves the beam.
  void forget() noexcept { foresight_.forget(); }

  /// @param way  AllDisplacements, which settles the system   @param range  says where a node can be
  /// @param all  in: where they are and whether they touched;  out: whether they touch, and their forces
  /// @return the worst Status of those that touch | iteration_limit where the passes have ended before the changes
  template <class Way, class Extent>
  Status push(Way& way, Obstacle* all, int count, const Extent& range) noexcept {
    System& system = way.system_;
    all_ = all, count_ = count;
    for (int i = 0; i < count; ++i) begin(i, range);
    const bool goes_on = foresight_.look(all, count);
    if (goes_on)
      for (int i = 0; i < count; ++i)
        if (all[i].touching && all[i].kind == ObstacleKind::round)
          slot(i).s = std::clamp(foresight_.place(i), Scalar(0), range.length());
    for (int i = 0; i < count; ++i)
      if (all[i].touching && !(all[i].pushed.force < 0) && beside_a_touch(i)) all[i].touching = false;
    Friction friction(system, all, count);
    if (goes_on && foresight_.forth()) friction.go_on();
    began_ = false;
    Status status = Status::ok;
    bool snapped = false;
    int meshes = 1;
    for (int pass = 1;; ++pass) {
      choose_nodes(system, range);
      status = solve(way, range, pass == 1, friction);
      snapped = snapped || status == Status::snapped;
      if (!is_answer(status)) break;
      if (!review(system, range, meshes, friction)) break;
      if (pass == most_passes) {
        status = Status::iteration_limit;
        break;
      }
    }
    if (snapped && status == Status::ok) status = Status::snapped;
    for (int i = 0; i < count; ++i) end(system, i, status);
    friction.leave(system, is_answer(status), [this](int i) { return slot(i).goal; });
    foresight_.know(all, count, status == Status::ok);
    return status;
  }

 private:
  /// What is known of an obstacle during a push.
  struct Slot {
    Scalar s = 0;   ///< [m] where its node is or would be
    int node = -1;  ///< of the mesh, -1: none
    int goal = -1;  ///< number of its contact in the system, -1: none
    bool by_plane = false, sharp = false, wall = false;
    bool short_of_it = false;  ///< the range ends before where its node would be
    bool let_go = false;       ///< in this push
    bool crowded = false;      ///< too near another contact to have a node
    bool close =
        false;          ///< the gap is small: it has a node, so that the mesh stays as it touches and lets go
    Scalar across = 1;  ///< component of the force that the beam takes
    Scalar ahead = 0, miss = 0, depth = 0;
    Vector normal = Vector::Zero();
    Search search;
  };
  Slot& slot(int i) noexcept { return slots_[static_cast<std::size_t>(i)]; }

  template <class Extent>
  void begin(int i, const Extent& range) noexcept {
    const bool sharp = slot(i).sharp && all_[i].touching;
    slot(i) = {};
    slot(i).sharp = sharp;
    const bool round = all_[i].kind == ObstacleKind::round;
    all_[i].touching = all_[i].valid && (all_[i].touching || all_[i].kind == ObstacleKind::support);
    slot(i).s = std::clamp(round ? all_[i].round.s : all_[i].place.s, Scalar(0), range.length());
    slot(i).close = all_[i].touching || (all_[i].valid && !round);
  }

  /// Sorts those that have a node along the beam, and moves the mesh.
  template <class Extent>
  void choose_nodes(System& system, const Extent& range) noexcept {
    const Scalar apart = Mesh::shortest(system.length());
    ordered_ = 0;
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      now.node = now.goal = -1;
      if (!all_[i].touching && !now.close) continue;
      const Scalar s = range.range().nearest({now.s, 0}).s;
      now.short_of_it = s != now.s;
      now.s = range.node(s);
      int k = ordered_++;
      for (; k > 0 && slot(order_[of(k - 1)]).s > now.s; --k) order_[of(k)] = order_[of(k - 1)];
      order_[of(k)] = i;
    }
    std::array<Scalar, most> s{};
    int nodes = 0;
    for (int k = 0; k < ordered_; ++k) {
      const int i = order_[of(k)];
      if (nodes > 0 && slot(i).s - s[of(nodes - 1)] < apart) {
        const int before = order_[of(nodes - 1)];
        const bool stays =
            all_[before].touching && (!all_[i].touching || all_[before].pushed.force <= all_[i].pushed.force);
        const int away = stays ? i : before;
        slot(away).crowded = all_[away].touching;
        all_[away].touching = slot(away).close = false;
        if (stays) continue;
        --nodes;
      }
      order_[of(nodes)] = i;
      s[of(nodes++)] = slot(i).s;
    }
    ordered_ = nodes;
    if (nodes == 0) return;
    mesh_ = system.mesh().at(s, nodes);
    for (int k = 0; k < nodes; ++k) slot(order_[of(k)]).node = mesh_.node(k);
  }

  template <class Way, class Extent>
  Status solve(Way& way, const Extent& range, bool first, Friction& friction) noexcept {
    System& system = way.system_;
    int contacts = 0;
    for (int k = 0; k < ordered_; ++k)
      if (all_[order_[of(k)]].touching) ++contacts;
    if (contacts == 0) {
      if (!way.single_valued_) return way.release();
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
          set_goal(system, range, i, goals++, foreseen ? laws_[of(i)] : law_of(system, i), force[of(i)],
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
    return RoundContact{all_[i].round}.beside(system.centreline(), c, end_at(system, c));
  }
  template <class Extent>
  void set_goal(System& system, const Extent& range, int i, int goal, const Law& law, Scalar force,
                typename Friction::Friction* friction) noexcept {
    using std::abs;
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
    now.by_plane = now.sharp || law.sharp(reach) || beside_support(range, now.s, reach);
    now.across = 1;
    if constexpr (planar) now.wall = range.on_wall(now.s);
    else now.by_plane = now.by_plane || round.is_through(system.node(c), end);
    now.by_plane = now.by_plane || now.wall;
    if (!now.by_plane) return set(-reach, law);
    if (now.normal.isZero(0) || now.wall) now.normal = round.normal(round.look(system.node(c), end));
    const Scalar d = round.plane(now.normal, now.s, system.node(c));
    if (!now.wall) return set(d, Scalar(0), now.normal);
    if constexpr (planar) {
      now.across = std::copysign((std::max)(Scalar(0.5), abs(now.normal.y())), now.normal.y());
      set((d - now.normal.x() * system.node(c).u) / now.across);
    }
  }
  static Vector up() noexcept {
    Vector w = Vector::Zero();
    w[1] = 1;
    return w;
  }

  /// What the equilibrium says of all of them.   @return whether there has to be another one
  template <class Extent>
  bool review(System& system, const Extent& range, int& meshes, Friction& friction) noexcept {
    const Scalar length = system.length();
    int worst = -1;
    Scalar most_pull = 0;
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      if (!all_[i].touching) continue;
      all_[i].pushed.force = system.linear_reaction(now.goal) / now.across;
      // What is touched by nothing pulls the least.
      if (all_[i].kind == ObstacleKind::support) continue;
      if (!(all_[i].pushed.force < 0) && (worst < 0 || all_[i].pushed.force > most_pull))
        worst = i, most_pull = all_[i].pushed.force;
    }
    if (worst >= 0) {
      let_go(worst);
      return true;
    }
    if (slip_off(system, range)) return true;
    bool moved = false;
    for (int i = 0; i < count_; ++i)
      if (all_[i].touching && all_[i].kind == ObstacleKind::round) moved = follow(system, i) || moved;
    moved = moved && ++meshes <= Single::most_meshes;
    int deepest = -1;
    const Scalar round_off = 16 * std::numeric_limits<Scalar>::epsilon();
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      if (all_[i].touching || now.crowded || !all_[i].valid) continue;
      if (all_[i].kind == ObstacleKind::round) seek(system, range, i);
      else now.depth = system.displacement(now.s, all_[i].place.normal) - all_[i].place.d;
      const Scalar fine = Scalar(1e-9) * length + round_off * (length + all_[i].round.reach);
      const Scalar slack = now.let_go || twin(i) >= 0 ? (std::max)(Scalar(1e-5) * length, fine) : fine;
      if (now.depth > slack && (deepest < 0 || now.depth > slot(deepest).depth)) deepest = i;
    }
    if (deepest >= 0) {
      all_[deepest].touching = true;
      all_[deepest].pushed.force = 0;
      friction.meet(system, deepest);
      for (int i = 0; i < count_ && !slot(deepest).let_go; ++i)
        if (all_[i].touching && beside(i, deepest)) let_go(i);
    }
    return moved || deepest >= 0;
  }

  void let_go(int i) noexcept {
    all_[i].touching = false;
    all_[i].pushed.force = 0;
    slot(i).let_go = slot(i).close = true;
  }
  /// Whether two bodies lie on the beam side by side.
  bool beside(int i, int k) noexcept {
    const auto &a = all_[i], &b = all_[k];
    return a.body != b.body && a.kind == ObstacleKind::round && b.kind == ObstacleKind::round &&
           std::abs(slot(i).s - slot(k).s) < (std::max)(a.round.reach, b.round.reach);
  }
  /// Whether the beam is pressed by another body beside this one.
  bool beside_a_touch(int i) noexcept {
    for (int k = 0; k < count_; ++k)
      if (all_[k].touching && all_[k].pushed.force < 0 && beside(i, k)) return true;
    return false;
  }

  /// An end that holds w may slide away under an obstacle.   @return whether one has
  template <class Extent>
  bool slip_off(const System& system, const Extent& range) noexcept {
    const auto where = range.range();
    bool any = false;
    for (int i = 0; i < count_; ++i) {
      if (!all_[i].touching || all_[i].kind != ObstacleKind::round) continue;
      const RoundContact round{all_[i].round};
      for (const bool right : {false, true}) {
        if (!std::isfinite(right ? where.right_support : where.left_support)) continue;
        const int last = right ? system.elements() : 0;
        const auto view = round.look(system.node(last), right ? 1 : -1);
        // Beside it the node keeps its distance from the end, which the contact has passed.
        if (!view.past_end || slot(i).node != system.mesh().node(right ? system.mesh().count() - 1 : 0))
          continue;
        if (slot(i).s > where.s_min && slot(i).s < where.s_max) continue;
        all_[i].touching = slot(i).close = false;
        slot(i).crowded = any = true;
      }
    }
    return any;
  }

  /// The node of a contact follows it.   @return whether it has to
  bool follow(System& system, int i) noexcept {
    Slot& now = slot(i);
    const RoundContact round{all_[i].round};
    const Node& node = system.node(now.node);
    auto& pushed = all_[i].pushed;
    const auto view = now.by_plane ? round.look(node, end_at(system, now.node)) : system.contact(now.goal);
    pushed.past_end = view.past_end;
    pushed.point = round.point(view, node);
    pushed.normal = view.normal;
    const Scalar touched = std::clamp(node.s + round.ahead(view), Scalar(0), system.length());
    now.sharp = round.beside(system.centreline(), now.node, 0).sharp(round.request().reach);
    now.ahead = touched - now.s;
    now.miss = now.by_plane ? round.miss(now.normal, node) : Scalar(0);
    pushed.s = now.by_plane ? now.s : touched;
    const Scalar off = (std::max)(std::abs(now.ahead), now.miss);
    const bool there =
        off <= (now.by_plane ? Scalar(1e-5) * (std::min)(round.request().reach, system.length() / 10)
                             : Single::beside * system.length());
    pushed.miss = there || now.short_of_it ? Scalar(0) : off;
    if (there) return false;
    typename Search::Aim next{now.s + now.ahead, now.normal};
    if (now.by_plane)
      next = now.search.after({next.s, pushed.normal}, round.residual(now.ahead, now.normal, pushed.normal));
    now.s = std::clamp(next.s, Scalar(0), system.length());
    now.normal = next.normal;
    return true;
  }

  /// How deep the beam lies in what does not touch it, and where.
  template <class Extent>
  void seek(const System& system, const Extent& range, int i) noexcept {
    using Gap = ObstacleGap<System, RoundContact>;
    const RoundContact round{all_[i].round};
    const int other = twin(i);
    const Scalar length = system.length();
    const Gap gap = other < 0
                        ? Gap(system, round)
                        : Gap(system, round, slot(other).node, slot(other).s, 2 * Mesh::shortest(length));
    Slot& now = slot(i);
    now.depth = gap.depth;
    if (std::isfinite(gap.depth)) now.s = gap.s;
    const auto answered = range.range();
    if (now.s < answered.s_min || now.s > answered.s_max)
      now.depth = -std::numeric_limits<Scalar>::infinity();
    now.close = now.depth > -length / 200;
  }
  /// Another obstacle of the same body that touches, -1: none.
  int twin(int i) const noexcept {
    for (int k = 0; k < count_; ++k)
      if (k != i && all_[k].body == all_[i].body && all_[k].touching) return k;
    return -1;
  }

  template <class Extent>
  static bool beside_support(const Extent& range, Scalar s, Scalar reach) noexcept {
    if constexpr (!planar) return false;
    const auto where = range.range();
    return s - where.left_support < 2 * reach || where.right_support - s < 2 * reach;
  }
  int end_at(const System& system, int node) const noexcept {
    return node == 0 ? -1 : node == system.elements() ? 1 : 0;
  }
  static std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }

  void end(const System& system, int i, Status status) noexcept {
    auto& pushed = all_[i].pushed;
    pushed.status = !all_[i].valid    ? Status::invalid_request
                    : slot(i).crowded ? Status::out_of_range
                                      : status;
    if (!all_[i].touching || (pushed.force > 0 && all_[i].kind != ObstacleKind::support)) pushed.force = 0;
    if (all_[i].kind == ObstacleKind::round) return;
    const Node node = RoundContact::node_at(system.centreline(), slot(i).s);
    pushed.s = slot(i).s;
    pushed.point = RoundContact::place_of(node);
    pushed.normal = all_[i].place.normal;
  }

  Obstacle* all_ = nullptr;
  int count_ = 0, ordered_ = 0;
  bool began_ = false;             // foresight_ has the state before this push
  std::array<int, most> order_{};  // of those that have a node, along the beam
  std::array<Slot, most> slots_{};
  std::array<Law, most> laws_{};
  Mesh mesh_{2, Scalar(1)};
  SeveralForesight<System, Obstacle, most> foresight_;
};

}  // namespace hapbeam::detail
