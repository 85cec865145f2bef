// Which obstacles touch a beam, and where, by an active set: of those that would have to pull the worst lets go; where none would, the one that
// the beam lies deepest in is added; and each node follows its contact.
//
// Two that are beside each other bend the beam with forces a thousand times their difference, so a new one takes the place of the one beside it, which
// comes back if the beam lies in it then.  An obstacle that has let go in this push is taken back only where it is deeper than the mesh can be wrong.
// Real-time: noexcept, no allocation, O(contacts · elements).   Source: Nocedal and Wright, Numerical Optimization, 16.5.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/body/shortest_element.hpp>
#include <hapbeam/fem/obstacle_gap.hpp>
#include <hapbeam/fem/obstacle_nodes.hpp>
#include <hapbeam/fem/round_push.hpp>

namespace hapbeam::detail {

/// Base class of SeveralPush.
template <class Element, class System>
class ActiveSet : protected ObstacleNodes<Element, System> {
 protected:
  using Nodes = ObstacleNodes<Element, System>;
  using Nodes::all_;
  using Nodes::beside;
  using Nodes::beside_a_touch;
  using Nodes::count_;
  using Nodes::end_at;
  using Nodes::slot;
  using Nodes::twin;
  using typename Nodes::Node;
  using typename Nodes::Obstacle;
  using typename Nodes::RoundContact;
  using typename Nodes::Scalar;
  using typename Nodes::Slot;
  using Mesh = typename Nodes::Mesh;
  using Search = typename Nodes::Search;
  using Single = RoundPush<Element, System>;

  /// What the equilibrium says of all of them.   @return whether there has to be another one
  template <class Extent, class Friction>
  bool review(System& system, const Extent& range, int& meshes, Friction& friction) noexcept {
    const Scalar length = system.length();
    int worst = -1;
    Scalar most_pull = 0;
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      if (!all_[i].touching) continue;
      all_[i].pushed.force = system.linear_reaction(now.goal);
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

 private:
  void let_go(int i) noexcept {
    all_[i].touching = false;
    all_[i].pushed.force = 0;
    slot(i).let_go = slot(i).close = true;
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
                        : Gap(system, round, slot(other).node, slot(other).s, 2 * shortest_element(length));
    Slot& now = slot(i);
    now.depth = gap.depth;
    if (std::isfinite(gap.depth)) now.s = gap.s;
    const auto answered = range.range();
    if (now.s < answered.s_min || now.s > answered.s_max)
      now.depth = -std::numeric_limits<Scalar>::infinity();
    now.close = now.depth > -length / 200;
  }
};

}  // namespace hapbeam::detail
