// SPDX-License-Identifier: MIT
// Which obstacles touch a beam or rod, and where: what a push knows of each, and what an equilibrium says of it.
//
// By an active set (active_set.hpp): where none of it would have to pull, the one that the beam lies deepest in is added.
// Two that are beside each other bend the beam with forces a thousand times their difference, so a new one takes the place of the one beside it, which
// comes back if the beam lies in it then.  An obstacle that has let go in this push is taken back only where it is deeper than the mesh can be wrong.
// Real-time: noexcept, no allocation, O(contacts · elements).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/contact/active_set.hpp>
#include <hapbeam/fem/contact/obstacle_gap.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class System>
class RowContacts {
  using Scalar = typename System::Scalar;
  using Contact = typename System::Contact;
  using RoundContact = typename System::RoundContact;
  static constexpr int most = System::Rows::most, dimension = System::dimension;
  using Round = RoundOf<Scalar, dimension>;
  using Vector = VectorOf<Scalar, dimension>;
  using State = InnerState<Scalar, dimension>;

 public:
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;

  /// Whether an obstacle has left the beam in a push.
  enum class Left {
    no,
    let_go,   ///< it would have had to pull, or another one took its place: it may come back
    crowded,  ///< too near another contact, or past an end that is held
  };
  /// Of an obstacle during a push.
  struct Slot : State {
    Left left = Left::no;
    Vector place = Vector::Zero();  ///< of the curve, as it was seen last [m]
    bool held =
        false;  ///< along its normal, where its place cannot be sought: the beam is bent too sharply, or a support is too near
    Vector normal = Vector::Zero();  ///< of that
    Scalar of = 0;                   ///< the place whose displacement it has then [m]
    Scalar depth = 0;                ///< [m]
    State begins;                    ///< from where its way begins anew
  };

  /// To be called where a push begins.  @param all  in: where they are and whether they touched
  template <class Extent>
  void begin(const System& system, Obstacle* all, int count, const Extent& range) noexcept {
    active.take(all, count);
    const auto where = range.range();
    left_support_ = where.left_support, right_support_ = where.right_support;
    least_ = (std::max)(where.s_min, Scalar(0)), most_ = (std::min)(where.s_max, range.length());
    for (int i = 0; i < count; ++i) {
      const bool round = all[i].kind == ObstacleKind::round;
      // What had no answer at an end that has been pushed past it slips off.
      const bool off = round && all[i].pushed.past_end && !is_answer(all[i].pushed.status);
      all[i].touching = all[i].valid && !off && (all[i].touching || all[i].kind == ObstacleKind::support);
      Slot& now = slots[i];
      if (!all[i].touching) static_cast<State&>(now) = {};
      now.force = force_of(all[i]);
      now.sharp = round && now.force != 0 && now.sharp;
      const bool was_held = now.sharp && now.held;
      // One that jumps touches where it is nearest now: the way along the beam from where it was is long.
      const bool lasts = round && now.force != 0 && (now.sharp || !now.held) &&
                         jumped(i, all[i].round) <= all[i].round.reach;
      now.moves = true, now.held = false, now.left = off ? Left::crowded : Left::no;
      if (!round) now.s = std::clamp(all[i].place.s, Scalar(0), range.length()), now.moves = false;
      else if (was_held) hold(system, i);
      else this->place(system, i, lasts ? now.s : all[i].round.s);
    }
  }
  /// Whether one that touched does so elsewhere now, which begins anew.
  bool elsewhere(const System& system, const Obstacle& obstacle) const noexcept {
    return obstacle.kind == ObstacleKind::round && obstacle.touching &&
           std::abs(obstacle.round.s - obstacle.pushed.s) > obstacle.round.reach + system.length() / 10;
  }
  /// λ of an obstacle by what it was pushed with.
  static Scalar force_of(const Obstacle& obstacle) noexcept {
    return obstacle.kind == ObstacleKind::round ? -obstacle.pushed.force : obstacle.pushed.force;
  }
  /// Where the beam has been set to rest, at the place that is nearest there.
  void begin_at_rest(System& system) noexcept {
    system.draw();
    const auto line = system.drawn();
    for (int i = 0; i < active.size(); ++i) {
      slots[i].force = 0;
      if (active[i].kind != ObstacleKind::round) continue;
      const RoundContact round{active[i].round};
      Scalar s = round.request().s;
      for (int k = 0; k < 4; ++k) {
        s = std::clamp(s, Scalar(0), system.length());
        s += round.look(line.node_at(s), 0).ahead;
      }
      place(system, i, std::abs(s - round.request().s) < system.length() ? s : round.request().s);
    }
  }
  /// Where an obstacle is touched first.
  void place(const System& system, int i, Scalar s) noexcept {
    Slot& now = slots[i];
    now.s = std::clamp(s, least_, most_);
    now.moves = now.s > least_ && now.s < most_, now.held = false;
    // Nearer to a support the last place has the displacement that this one should have.
    if ((s < least_ && least_ > 0) || (s > most_ && most_ < system.length())) hold_along(system, i, s);
  }
  /// Holds each that touches where the beam is too sharp for its place to be sought.   @return whether there is any
  bool hold_sharp(const System& system) noexcept {
    bool any = false;
    for (int i = 0; i < active.size(); ++i)
      if (active[i].touching && slots[i].sharp && !slots[i].held) hold(system, i), any = true;
    return any;
  }
  /// Where no place is nearest, the one that was goes with the hand, along the normal that the beam had there.
  void hold(const System& system, int i) noexcept {
    const RoundContact round{active[i].round};
    const Scalar s = active[i].round.s;
    Slot& now = slots[i];
    const auto node = system.drawn().node_at(s);
    const Vector at = node.position(), centre = round.centre(at), way = centre - centre_before(i, at);
    place(system, i, s + round.along(node, Vector(way + returns * (centre - at))));
    if (!now.moves) return;
    hold_along(system, i, s);
    now.of = now.s;
  }
  /// How far what is round has come since the push before [m].
  Scalar jumped(int i, const Round& round) noexcept {
    const Vector& at = slots[i].place;
    return std::sqrt((RoundContact{round}.centre(at) - centre_before(i, at)).squaredNorm());
  }
  /// Where it is, along the normal that the beam has there.
  void hold_along(const System& system, int i, Scalar there) noexcept {
    const RoundContact round{active[i].round};
    Slot& now = slots[i];
    const auto node = system.drawn().node_at(there);
    now.normal = -round.facing(round.tangent(node));
    now.place = node.position();
    now.held = true, now.moves = false, now.of = there;
  }
  Contact contact(int i) noexcept {
    const Slot& now = slots[i];
    Contact contact;
    static_cast<State&>(contact) = now;
    contact.least = least_, contact.most = most_;
    // Between places of one body the beam is nearly as sharp as that: they are sought where the gaps are closed.  So they are where a hand has jumped: the circle
    // that has passed the beam says nothing of the place.
    const bool is_round = active[i].kind == ObstacleKind::round;
    const bool jumps = is_round && now.force != 0 && jumped(i, active[i].round) > active[i].round.reach / 2;
    contact.waits = now.moves && ((jumps && dimension == 2) || twin(i) >= 0);
    if constexpr (dimension == 3) contact.seeks = twin(i) < 0;
    if (is_round) {
      const RoundContact round{active[i].round};
      round.set(contact);
      contact.reach = active[i].round.reach;
      if (now.held) {
        contact.kind = Contact::Kind::along;
        contact.normal = now.normal, contact.curvature = 1 / contact.reach;
        contact.reach += contact.normal.dot(round.centre(now.place) - round.place_at_rest(now.of));
      }
    } else {
      contact.kind = Contact::Kind::along;
      contact.normal = active[i].place.normal, contact.reach = active[i].place.d;
    }
    return contact;
  }
  /// What the system has found of those that touch.
  void take(System& system) noexcept {
    for (int i = 0; i < active.size(); ++i) {
      Slot& now = slots[i];
      const int goal = active.goal(i);
      if (goal < 0) continue;
      system.look(goal);
      const Contact& found = system.rows()[goal];
      static_cast<State&>(now) = found;
      now.place = found.place;
      auto& pushed = active[i].pushed;
      pushed.force = now.held ? -system.linear_reaction(goal) : system.linear_reaction(goal);
      pushed.point = found.place;
      if (active[i].kind != ObstacleKind::round) continue;
      const Scalar beyond = now.moves || now.held ? Scalar(0) : outward(active[i].round, found);
      pushed.past_end = beyond > 0 && (now.s == 0 || now.s == system.length());
      pushed.normal = -found.normal;
      pushed.s = beyond > 0 ? std::clamp(now.s == least_ ? now.s - beyond : now.s + beyond, Scalar(0),
                                         system.length())
                 : now.held ? now.of
                            : now.s;
    }
  }

  /// Where there is no equilibrium, what was at an end has been pushed past it, and what has touched first feels the last one.
  void lose(System& system) noexcept {
    const Scalar length = system.length(), close_by = length / 1000;
    for (int i = 0; i < active.size(); ++i) {
      if (!active[i].touching || active[i].kind != ObstacleKind::round) continue;
      auto& pushed = active[i].pushed;
      pushed.past_end =
          (least_ == 0 && slots[i].s < close_by) || (most_ == length && slots[i].s > length - close_by);
      const int goal = active.goal(i);
      if (pushed.force != 0 || goal < 0 || !(system.linear_reaction(goal) < 0)) continue;
      system.look(goal);
      const Contact& found = system.rows()[goal];
      pushed.force = system.linear_reaction(goal);
      pushed.point = found.place, pushed.normal = -found.normal, pushed.s = found.s;
    }
  }
  /// What the equilibrium says of all of them, after take().   @return whether there has to be another one
  bool review(System& system) noexcept {
    if (const int worst = active.worst(); worst >= 0) return let_go(worst), true;
    bool again = false;
    for (int i = 0; i < active.size(); ++i) {
      Slot& now = slots[i];
      if (active.goal(i) < 0 || active[i].kind != ObstacleKind::round) continue;
      // What lies beyond an end comes back where the end turns away.
      const Contact& found = system.rows()[active.goal(i)];
      if (!now.moves && !now.held && outward(active[i].round, found) < 0) now.moves = again = true;
    }
    if (again) return true;
    if (slip_off(system)) return true;
    // What is seen of it is asked for by all but the bodies that touch.
    const auto touches = [](const Obstacle& obstacle) {
      return obstacle.touching && obstacle.kind == ObstacleKind::round;
    };
    if (!std::all_of(&active[0], &active[0] + active.size(), touches)) system.draw();
    int deepest = -1;
    const Scalar length = system.length(), round_off = 16 * std::numeric_limits<Scalar>::epsilon();
    for (int i = 0; i < active.size(); ++i) {
      Slot& now = slots[i];
      if (active[i].touching || now.left == Left::crowded || !active[i].valid) continue;
      if (active[i].kind == ObstacleKind::round) seek(system, i);
      else
        now.depth = active[i].place.normal.dot(system.beside_drawn(now.s)) +
                    system.displacement(now.s, active[i].place.normal) - active[i].place.d;
      const Scalar fine = Scalar(1e-9) * length + round_off * (length + active[i].round.reach);
      const Scalar slack =
          now.left == Left::let_go || twin(i) >= 0 ? (std::max)(Scalar(1e-5) * length, fine) : fine;
      if (now.depth > slack && (deepest < 0 || now.depth > slots[deepest].depth)) deepest = i;
    }
    if (deepest < 0) return false;
    active[deepest].touching = true;
    slots[deepest].force = 0;
    slots[deepest].forget();
    slots[deepest].begins = slots[deepest];
    const int other = twin(deepest);
    if (other >= 0) active.meet_beside(system, deepest, other, slots[deepest].s);
    else active.meet(system, deepest);
    if constexpr (most > 1) spread(system, deepest);
    for (int i = 0; i < active.size() && slots[deepest].left == Left::no; ++i)
      if (active[i].touching && beside(i, deepest)) let_go(i);
    return true;
  }
  /// Two that are nearer than that are one: those of one body between them, else the one with the larger force.
  void part(const System& system) noexcept {
    const Scalar apart = shortest_element<Scalar>(most_);
    for (int i = 0; i < active.size(); ++i)
      for (int k = 0; k < i; ++k) {
        const bool twins = active[i].body == active[k].body;
        if (!active[i].touching || !active[k].touching ||
            std::abs(slots[i].s - slots[k].s) >= (twins ? 2 : 1) * apart)
          continue;
        if (twins) {
          place(system, k, (slots[i].s + slots[k].s) / 2);
          slots[k].force += slots[i].force, slots[k].forget(), slots[k].begins = slots[k];
          let_go(i);
          continue;
        }
        const int away = active[k].pushed.force <= active[i].pushed.force ? i : k;
        active[away].touching = false;
        slots[away].left = Left::crowded;
      }
  }
  void end(System& system, int i, Status status) noexcept {
    auto& pushed = active[i].pushed;
    before_[i] = active[i].round;
    pushed.status = !active[i].valid ? Status::invalid_request
                    : slots[i].left == Left::crowded ||
                            (status == Status::ok && (slots[i].held || touches_again(system, i)))
                        ? Status::out_of_range
                        : status;
    // Of round-off: the place of what does not press may be anywhere.
    const Scalar nothing =
        std::numeric_limits<Scalar>::epsilon() * system.unit() * system.unit() / system.length();
    if (!active[i].touching || std::abs(pushed.force) < nothing ||
        (pushed.force > 0 && active[i].kind != ObstacleKind::support))
      pushed.force = 0;
    if (active[i].kind != ObstacleKind::round) pushed.s = slots[i].s, pushed.normal = active[i].place.normal;
  }

  /// Whether the beam is pressed by another body beside this one.
  bool beside_a_touch(int i) noexcept {
    for (int k = 0; k < active.size(); ++k)
      if (active[k].touching && active[k].pushed.force < 0 && beside(i, k)) return true;
    return false;
  }

  /// To be called where something else moves the beam.
  void forget_pieces() noexcept {
    for (Slot& slot : slots) slot.forget(), slot.sharp = slot.held = false;
  }

  /// Whether a place has run to an end in the equilibrium that was reviewed last: the beam is far from where it was.
  bool ran_away() noexcept { return std::exchange(ran_away_, false); }

  ActiveSet<System> active;
  Slot slots[most] = {};

 private:
  void let_go(int i) noexcept {
    active[i].touching = false;
    active[i].pushed.force = 0;
    slots[i].left = Left::let_go;
  }
  /// How far a centre lies beyond the end of what can be touched, negative: beside it [m].
  Scalar outward(const Round& round, const Contact& found) const noexcept {
    const Vector centre = RoundContact{round}.centre(found.place);
    const Scalar along = found.tangent.dot(centre - found.place) / std::sqrt(found.tangent.squaredNorm());
    return found.s <= least_ ? -along : found.s >= most_ ? along : Scalar(-1);
  }
  /// An end that holds w may slide away under an obstacle.   @return whether one has
  bool slip_off(const System& system) noexcept {
    bool any = false;
    for (int i = 0; i < active.size(); ++i) {
      const Slot& now = slots[i];
      if (active.goal(i) < 0 || now.moves || active[i].kind != ObstacleKind::round) continue;
      const bool right = now.s >= most_;
      if (!std::isfinite(right ? right_support_ : left_support_)) continue;
      // An end that holds w takes any force: what was beside it, and has run there, stays where it was.
      const Scalar began = now.begins.s;
      if (now.held && now.of > least_ && now.of < most_) continue;
      if (!now.held && (right ? most_ - began : began - least_) > active[i].round.reach / 4) {
        static_cast<State&>(slots[i]) = now.begins;
        hold_along(system, i, began);
        ran_away_ = any = true;
        continue;
      }
      const auto view =
          RoundContact{active[i].round}.look(system.node(right ? system.elements() : 0), right ? 1 : -1);
      if (!view.past_end) continue;
      any = true;
      active[i].touching = false;
      slots[i].left = Left::crowded;
    }
    return any;
  }
  /// Of what may touch at one place alone.
  bool touches_again(System& system, int i) noexcept {
    const Slot& now = slots[i];
    for (int k = 0; k < active.size(); ++k)
      if (k != i && active[k].body == active[i].body) return false;
    return active.goal(i) >= 0 && now.moves &&
           detail::touches_again(system, active[i].round, now.s, system.rows()[active.goal(i)].wraps);
  }
  /// Whether two bodies lie on the beam side by side.
  bool beside(int i, int k) noexcept {
    const auto &a = active[i], &b = active[k];
    return a.body != b.body && a.kind == ObstacleKind::round && b.kind == ObstacleKind::round &&
           std::abs(slots[i].s - slots[k].s) < (std::max)(a.round.reach, b.round.reach);
  }
  /// Another obstacle of the same body that touches, -1: none.
  int twin(int i) const noexcept {
    for (int k = 0; k < active.size(); ++k)
      if (k != i && active[k].body == active[i].body && active[k].touching) return k;
    return -1;
  }
  /// Where the beam is bent more sharply than a body, that touches it at more places.
  ///
  /// One becomes two at half of the way to where the beam is deepest in it, for forces F/2 that far apart turn the beam between them by as much as F
  /// does to there.  Of several those at the ends go outward, and the others lie evenly between them: from there the places find their own.
  /// @param last  that has come
  void spread(const System& system, int last) noexcept {
    int order[most] = {};
    int n = 0;
    Scalar force = 0;
    for (int i = 0; i < active.size(); ++i) {
      if (!active[i].touching || active[i].body != active[last].body) continue;
      int k = n++;
      for (; k > 0 && slots[i].s < slots[order[k - 1]].s; --k) order[k] = order[k - 1];
      order[k] = i, force += slots[i].force;
    }
    const auto at = [&](int k) -> Slot& { return slots[order[k]]; };
    bool sharp = false;
    for (int k = 0; k < n; ++k) sharp = sharp || (order[k] != last && at(k).sharp);
    if (!sharp) return;
    const int left = order[0] == last ? 1 : 0, right = order[n - 1] == last ? n - 2 : n - 1;
    const Scalar middle = (at(left).s + at(right).s) / 2,
                 wide = n == 2 ? at(1).s - at(0).s : (1 + wider / Scalar(n * n)) * (at(right).s - at(left).s);
    for (int k = 0; k < n; ++k) {
      Slot& now = at(k);
      place(system, order[k], middle + wide * (Scalar(k) / Scalar(n - 1) - Scalar(0.5)));
      now.force = force / Scalar(n), now.forget(), now.sharp = false;
      now.moves = now.moves && n == 2;  // the others once their forces are known
      now.begins = now;
    }
  }
  /// How deep the beam lies in what does not touch it, and where.
  void seek(const System& system, int i) noexcept {
    using Line = decltype(system.drawn());
    using Gap = ObstacleGap<Line, RoundContact>;
    const Line line = system.drawn();
    const RoundContact round{active[i].round};
    const int other = twin(i);
    const Scalar length = system.length();
    const Gap gap = other < 0 ? Gap(line, round)
                              : Gap(line, round, line.node_near(slots[other].s), slots[other].s,
                                    2 * shortest_element<Scalar>(length));
    Slot& now = slots[i];
    now.depth = gap.depth;
    if (!std::isfinite(gap.depth)) return;
    now.depth += round.facing(round.tangent(line.node_at(gap.s))).dot(system.beside_drawn(gap.s));
    place(system, i, gap.s);
    if (gap.s < least_ || gap.s > most_) now.depth = -std::numeric_limits<Scalar>::infinity();
  }

  // So much over n² longer is the way from the first to the last of n places of a body where the last one comes: a string lies on two and on three with
  // the same force where that is 1.16, by closed form; on three and on four it measures 1.09.
  static constexpr Scalar wider = Scalar(1.44);
  // In a push, of what a centre is off the normal of a place that is held.
  static constexpr Scalar returns = Scalar(0.02);

  /// Where the centre, or the axis beside a point, was in the push before [m].
  Vector centre_before(int i, const Vector& at) const noexcept { return RoundContact{before_[i]}.centre(at); }

  bool ran_away_ = false;  // a place, to an end that it was not at
  Scalar least_ = 0, most_ = 0, left_support_ = 0, right_support_ = 0;  // [m]
  Round before_[most] = {};                                             // in the push before
};

}  // namespace hapbeam::detail
