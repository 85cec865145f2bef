// A push of a beam by a circle, or of a rod by a capsule. Place and direction of the contact are found with the
// equilibrium.
//
// The mesh has its node where the two were thought to touch, and follows where they do if that is not beside it.  A hand that goes on as it went finds
// a beam where it was foreseen.  Where the beam bends as sharply as the circle, or may, beside a support, a plane stands for the circle and turns
// from push to push.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free; a push takes at most the linear solves of AllDisplacements.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/contact_search.hpp>
#include <hapbeam/fem/contact_work.hpp>
#include <hapbeam/fem/continuation.hpp>
#include <hapbeam/fem/foresight.hpp>
#include <hapbeam/fem/friction_balance.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class Element, class System>
class RoundPush {
  using Scalar = typename System::Scalar;
  using Node = typename System::Node;
  using Mesh = typename System::Mesh;
  using Round = typename SystemOf<Element>::template Round<Scalar>;
  using RoundContact = typename SystemOf<Element>::template RoundContact<Scalar>;
  static constexpr int dimension = dimension_of<Element>;
  using Vector = VectorOf<Scalar, dimension>;
  using Result = Pushed<Scalar, dimension>;
  using Search = ContactSearch<Scalar, dimension>;
  using FrictionState = hapbeam::FrictionState<Scalar, dimension>;
  using Friction = typename System::Friction;

 public:
  /// Of the beam's length: so far from its node a contact is as exact as at it, to a few 1e-6 of the force.
  static constexpr Scalar beside = Scalar(1.5e-4);
  /// And so is the force, in units of the solver's tolerance.
  static constexpr int slack = 100;
  /// So often the node follows the contact in a push.
  static constexpr int most_meshes = 4;

  explicit RoundPush(const System& system) : foresight_(system) {}

  /// To be called where something else moves the beam.
  void forget() noexcept {
    foresight_.forget();
    sharp_ = false;
    forget_shape();
  }
  /// The same where what the hand did goes on.
  void forget_shape() noexcept {
    curved_ = -1;
    work_.forget(), continuation_.forget(), balance_.forget();
  }

  /// @param way  AllDisplacements, which settles the system   @param range  says where a node can be
  /// @param state  of friction, null: without
  template <class Way, class Extent>
  Result push(Way& way, const Round& request, const Extent& range, FrictionState* state) noexcept {
    System& system = way.system_;
    // What touches elsewhere does not continue where it was.
    if (std::abs(request.s - work_.round(0).s) > request.reach + system.length() / 10) continuation_.forget();
    const Round from = work_.round(0);
    Before& before = before_;
    const auto go = [&](Scalar t) {
      before.work = work_, before.balance = balance_, before.force = system.linear_reaction(),
      before.sharp = sharp_;
      if (state) before.friction = *state;
      return answer(way, between(from, request, t), range, state);
    };
    const auto judge = [&](const Result& pushed) {
      if (!(pushed.force < 0)) return Branch::same;
      return continuation_.judge(
          {potential_, work_.done() - taken_, loose(work_.size(), work_.change()), system.strain(),
           system.length(), system.mesh().node() == foresight_.mesh().node()},
          [&] {
            return Gone<Scalar>{work_.way(), farthest(system.view(foresight_.before()), system.centreline())};
          });
    };
    const auto keep = [&](const Result& pushed) {
      if (is_answer(pushed.status) && pushed.force < 0) continuation_.know(potential_);
      else continuation_.forget();
    };
    const auto back = [&] {
      foresight_.go_back(system, before.force);
      work_ = before.work, balance_ = before.balance, sharp_ = before.sharp, curved_ = -1;
      if (state) *state = before.friction;
    };
    const auto fall = [&] {
      back();
      way.descending_ = true;
    };
    return continuation_.follow(go, judge, keep, back, fall);
  }

 private:
  using Work = ContactWork<Round, Scalar, dimension, 1>;
  /// What answer() changes.
  struct Before {
    Work work;
    FrictionBalance<Scalar> balance;
    FrictionState friction;
    Scalar force;
    bool sharp;
  };

  template <class Way, class Extent>
  Result answer(Way& way, const Round& request, const Extent& range, FrictionState* state) noexcept {
    System& system = way.system_;
    taken_ = 0;
    const auto count = [&](const Result& pushed, const Vector& rubs) {
      if (!is_answer(pushed.status)) return work_.forget();
      work_.begin();
      work_.touches(0, request, pushed, rubs);
    };
    if (!state) {
      balance_.forget();
      const Result pushed = find(way, request, range, nullptr);
      count(pushed, Vector::Zero());
      potential_ = system.foreseen_potential();
      return pushed;
    }
    Friction friction(*state, RoundContact{request}, system, -system.linear_reaction(), true);
    system.set_friction(&friction);
    const Result pushed = find(way, request, range, &friction);
    // What is no answer says nothing of where they touch: friction begins anew.
    if (is_answer(pushed.status) && pushed.force < 0) {
      const Scalar before = state->dissipated;
      const bool slid = state->slides;
      system.look_at_friction();
      friction.leave(*state, -pushed.force);
      count(pushed, state->force);
      potential_ = system.foreseen_potential() - friction.potential() + friction.held(*state);
      taken_ = state->dissipated - before;
      if (friction.falls() || pushed.status != Status::ok) {
        balance_.forget();
      } else {
        const auto potential = [&] { return system.total_potential() + friction.held(*state); };
        taken_ *= balance_.factor(work_, potential, taken_, slid || state->slides);
        state->dissipated = before + taken_;
      }
    } else {
      state->let_go();
      work_.forget(), balance_.forget();
    }
    system.forget_friction();
    return pushed;
  }

  /// @param friction  null: none
  template <class Way, class Extent>
  Result find(Way& way, const Round& request, const Extent& range, Friction* friction) noexcept {
    System& system = way.system_;
    const RoundContact round{request};
    // On a curve that is too sharp for it the law holds at the node alone.
    const Scalar closely = beside * system.length(), exactly = Scalar(1e-5) * request.reach;
    Search search;
    Vector normal = Vector::Zero();
    Scalar s = request.s;
    bool snapped = false;
    for (int meshes = 1;; ++meshes) {
      Trial trial{s, normal, meshes == 1};
      Result pushed = push_at(way, request, range, trial, friction);
      snapped = snapped || pushed.status == Status::snapped;
      const Scalar off = (std::max)(std::abs(trial.ahead), trial.miss);
      const bool there = off <= (trial.by_plane ? exactly : closely);
      if (there || meshes == most_meshes || !is_answer(pushed.status) || pushed.force >= 0) {
        pushed.miss = there ? Scalar(0) : off;
        if (snapped && pushed.status == Status::ok) pushed.status = Status::snapped;
        foresight_.know(pushed.status == Status::ok);
        return pushed;
      }
      typename Search::Aim next{s + trial.ahead, normal};
      if (trial.by_plane)
        next =
            search.after({next.s, pushed.normal}, round.residual(trial.ahead, trial.normal, pushed.normal));
      s = std::clamp(next.s, Scalar(0), system.length());
      normal = next.normal;
    }
  }

  struct Trial {
    Scalar s;  ///< [m] where the node goes
    Vector
        normal;  ///< in: of the plane that stands for the circle, zero: of the node;  out: the one that was taken
    bool first;             ///< of its push
    bool by_plane = false;  ///< whether a plane stood for the circle
    Scalar ahead = 0;       ///< [m] from there to the contact
    Scalar miss = 0;        ///< [m] from the circle's centre to where it should be
  };

  /// A push with the node at trial.s, or at the end beside it.  At an end that slides along a wall the wall takes what does not
  /// act along it.
  template <class Way, class Extent>
  Result push_at(Way& way, const Round& request, const Extent& range, Trial& trial,
                 Friction* friction) noexcept {
    using std::abs;
    System& system = way.system_;
    const RoundContact round{request};
    const Scalar s = range.range().nearest({trial.s, 0}).s, length = system.length();
    const Mesh mesh = way.uniform_.at(range.node(s));
    const int c = mesh.node(), end = c == 0 ? -1 : c == system.elements() ? 1 : 0;
    const Scalar last = system.linear_reaction();
    const auto node = [&] { return system.node(c); };
    const auto look = [&](const Node& seen) { return round.look(seen, end); };
    const auto law_at = [&](int i) { return round.beside(system.centreline(), i, end); };
    if (const int i = system.mesh().node(); i != curved_) curvature_ = system.centreline().curvature(i);
    const auto last_law = round.beside(system.node(system.mesh().node()), curvature_, end);
    bool foreseen = trial.first && foresight_.go_on(system, mesh, request);
    if (friction && foreseen && foresight_.forth()) friction->go_on();
    const auto aim = [&] {
      const auto law = foreseen ? last_law : law_at(c);  // what is foreseen has no second derivative
      trial.by_plane = sharp_ || law.sharp(request.reach) || round.is_through(node(), end);
      if (!trial.by_plane) return system.set_goal(c, -request.reach, law);
      if (trial.normal.isZero(0)) trial.normal = round.normal(round.look(node(), end));
      system.set_goal(c, round.plane(trial.normal, trial.s, node()), 0, trial.normal);
    };

    // With friction what is near is tried first; `all` of the way may be a fall.
    const int few = friction ? Friction::most_solves : 6;
    bool all = !friction || way.descending_ || friction->falls();
    // Whether Coulomb's law holds.
    const auto agrees = [&](const Response<Scalar>& found) {
      if (!friction) return true;
      if (is_answer(found.status)) {
        system.look_at_friction();
        if (friction->settled(-found.force)) return true;
      } else {
        if (all) return true;
        all = !friction->turn();
      }
      if (friction->torn()) {
        foresight_.begin_again(system);
        system.remesh(mesh);
      }
      return false;
    };

    Response<Scalar> response{0, Status::iteration_limit};
    bool past_end = false;
    if (foreseen) {
      do response = way.settle_at_once(slack, aim, few);
      while (!agrees(response) && !all);
      foreseen = response.status == Status::ok;
      if (!foreseen) {
        foresight_.go_back(system, last);
        trial.normal.setZero();
      }
    }
    if (!foreseen) {
      system.remesh(mesh);
      const auto start = look(node());
      past_end = start.past_end;
      const Scalar jump = abs(round.distance(start) - request.reach);
      if (way.single_valued_ && jump > length / 1000 &&
          abs(round.distance(look(round.node_at(system.view(way.rest_state_), mesh.s()))) - request.reach) <
              jump) {
        way.to_rest();
        system.remesh(mesh);
      }
      do response = all ? way.settle(last, slack, aim) : way.settle_at_once(slack, aim, few);
      while (!agrees(response));
    }

    const bool answer = is_answer(response.status);
    // It is that of the last shape for the next push, too.
    curved_ = answer ? c : -1;
    if (answer) curvature_ = system.centreline().curvature(c);
    sharp_ = answer && round.sharp(system.node(c), curvature_);
    // What is no answer may have left that mesh.
    const Node now = answer ? node() : round.node_at(system.centreline(), trial.s);
    const auto view = answer && !trial.by_plane ? system.contact() : look(now);
    Result pushed{response.force, response.status};
    pushed.past_end = answer ? view.past_end : past_end;
    pushed.point = round.point(view, now);
    pushed.normal = view.normal;
    const Scalar touched = std::clamp(now.s + round.ahead(view), Scalar(0), length);
    trial.ahead = touched - trial.s;
    pushed.s = trial.by_plane || !answer ? trial.s : touched;
    if (trial.by_plane) trial.miss = round.miss(trial.normal, now);
    return pushed;
  }

  Foresight<System, Round> foresight_;
  Work work_;
  Before before_{};
  Continuation<Scalar> continuation_;
  FrictionBalance<Scalar> balance_;
  Scalar potential_ = 0, taken_ = 0;  // of the last answer, and by friction [J]
  bool sharp_ = false;                // where the last circle touched
  typename RoundContact::Curvature curvature_{};
  int curved_ = -1;  // the node that has this curvature
};

/// Of a beam that is not pushed by circles.
struct NoRound {
  template <class System>
  explicit NoRound(const System&) noexcept {}
  void forget() noexcept {}
  void reset() noexcept {}
  void forget_shape() noexcept {}
};

}  // namespace hapbeam::detail
