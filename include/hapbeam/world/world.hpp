// SPDX-License-Identifier: MIT
// Rods that touch each other, themselves and rigid bodies, and hands that lead their ends.
//
//   World<RoundRod> world({{tool, 16}, {wire, 16}}, {RigidBody::sphere({0, 0, 0}, 0.01)});
//   world.hold(0, RodSide::left, pose);                  // as often as there are hands
//   const Status status = world.tick();
//   const HeldEnd<double> hand = world.held(0, RodSide::left);      // the hand feels -hand.force, -hand.moment
//
// A tick takes the ends to where they are held, finds who touches whom, and solves for all rods that move and for all that these touch.  The tick goes on in
// shorter steps where rods that may meet move against each other by more than half of their reach, so that none passes another.  Where no
// equilibrium goes on, the rods fall to the next stable one.
// Allocates and throws at construction.  Real-time: all else is noexcept and allocation-free; at most max_solves linear solves a tick.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/world/pair_motion.hpp>

namespace hapbeam {

/// @tparam Element  RoundRod | TwistedRod
template <class Element>
class World {
 public:
  static constexpr int most_contacts = detail::most_pairs;

  /// Joints draw their rods together from where those rest without them, and rods that begin through points fall from there.
  /// @throws std::invalid_argument where there is no rod, a rod, a body or a joint makes no sense, a rod has no shape at rest, or lies in another or in a body
  /// there, or they do not come to rest together
  explicit World(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& bodies = {},
                 const std::vector<Joint>& joints = {}, const NewtonRaphson& solver = {});

  int rods() const noexcept { return static_cast<int>(system().bodies().size()); }
  /// As it lies.
  Centreline<double, 3> shape(int rod) const noexcept { return system().body(rod).line(); }

  /// Where an end of a rod is to be from the next tick on.   @param rod  0 to rods() - 1
  /// @param damper  beside the springs of an end, in step()
  /// @return ok | invalid_request, where the end is neither clamped nor on springs, or an argument makes no sense: nothing has changed
  [[nodiscard]] Status hold(int rod, RodSide side, const RodPose& pose,
                            const HoldDamper& damper = {}) noexcept {
    const bool placed = 0 <= rod && rod < rods() &&
                        system().body(rod).place_end(static_cast<std::size_t>(side), pose, damper);
    return placed ? Status::ok : Status::invalid_request;
  }
  /// Where a body is to be from the next tick on.   @param body  0-based   @param pose  of the frame in which it was built
  /// @return ok | invalid_request, where the pose is none: nothing has changed
  [[nodiscard]] Status place(int body, const RodPose& pose) noexcept {
    auto& all = system().rigid();
    return at(body) < all.size() && all[at(body)].place(pose) ? Status::ok : Status::invalid_request;
  }
  /// Once a period.
  /// @return ok | snapped | out_of_range, where there are more contacts than most_contacts, where one bends an element by half of its reach or too sharply
  ///         beside an end that is held, where a rod that has no tension of its own is drawn too taut for its elements, and where a held end would come
  ///         into a body: then nothing has moved | iteration_limit, where the ends or a fall are on their way: the next tick goes on | singular, also where
  ///         something holds a joint open | non_finite.  No rod has passed another.  After 32 ticks that have led nowhere all rods begin anew at rest.
  Status tick() noexcept;
  /// What holds an end.
  HeldEnd<double> held(int rod, RodSide side) const noexcept {
    const auto& [force, moment] = equilibrium_.held(at(rod), static_cast<std::size_t>(side));
    return {force, moment, status_};
  }
  /// Of a joint on its first rod [N].
  VectorOf<double, 3> joint_force(int k) const noexcept {
    return system().pair(k).force * system().pair(k).normal;
  }
  /// Of a hinge or a weld on its first rod, about its place [N·m]; of a ball joint 0.
  VectorOf<double, 3> joint_moment(int k) const noexcept {
    const detail::RodPair* pair = system().rotation_of(k);
    return pair ? Vector(pair->force * pair->normal) : Vector::Zero();
  }
  int contacts() const noexcept { return system().pairs() - system().joints(); }
  RodContact contact(int k) const noexcept {
    const detail::RodPair& pair = system().pair(system().joints() + k);
    const Vector at = shape(pair.rod[0]).at(pair.s[0]).r;
    const double apart = system().rigid(pair.rod[1]) ? system().body(pair.rod[0]).radius() : pair.reach;
    return {pair.rod,
            pair.s,
            pair.force * pair.normal + pair.friction.kept(),
            pair.friction.kept(),
            pair.friction.slid(),
            {at, at - apart * pair.normal}};
  }
  /// Of all rods, the springs that hold them, what contacts bend beside nodes, and their skins [J].
  double strain_energy() const noexcept;
  /// What friction has taken since the start or reset() [J].
  double dissipated() const noexcept { return equilibrium_.dissipated(); }
  /// Linear solves of the last tick.
  int solves() const noexcept { return equilibrium_.solves(); }
  /// Everything is as after construction.
  void reset() noexcept;

  // Rods with mass.

  /// Goes on by a time, no more than longest_step at once; ends and bodies go evenly to where they are to be.  After tick() or reset() rods start without velocity.
  /// @param dt [s], not negative   @param parts  of the step, each of two stages
  /// @return ok | out_of_range, as of tick() | iteration_limit: all has stopped where a part had no answer | invalid_request: rods have no density, or an argument makes no
  /// sense, and nothing has changed
  Status step(double dt, int parts = 4) noexcept;
  /// Gives a rod with mass a velocity.   @param velocity  (s) -> that of the centreline there, and how that changes along it, below each other [m/s, 1/s]
  template <class Velocity>
  void throw_rod(int rod, Velocity&& velocity) noexcept {
    equilibrium_.throw_rod(at(rod), velocity);
  }
  /// Of a rod with mass at arc position s [m/s]; without 0.
  VectorOf<double, 3> velocity(int rod, double s) const noexcept {
    const Body& body = system().body(rod);
    return body.motion ? body.motion->velocity(body.system(), s) : VectorOf<double, 3>(0, 0, 0);
  }
  EnergyInMotion<double> energy() const noexcept {
    double work = 0;
    for (const Body& body : system().bodies()) work += body.parts().work(1);
    return {equilibrium_.kinetic(), strain_energy(), -work};
  }

 private:
  enum class Course {
    follows,     ///< the hands, on a branch of equilibria
    falls,       ///< to the next stable equilibrium
    has_fallen,  ///< which no status has told yet
  };
  using Outcome = detail::Outcome;
  using Equilibrium = detail::PairMotion<Element>;
  using Body = typename Equilibrium::Body;
  using Vector = VectorOf<double, 3>;
  using Pairs = std::array<detail::RodPair, std::size_t(most_contacts)>;

  static constexpr double shortest = 1.0 / 32, nothing = 1e-3;  // steps of a path
  static constexpr int patience = 32;

  typename Equilibrium::System& system() noexcept { return equilibrium_.system(); }
  const typename Equilibrium::System& system() const noexcept { return equilibrium_.system(); }

  // A tick.

  /// @return whether anything moves
  bool begin() noexcept {
    equilibrium_.begin(), equilibrium_.rest();
    system().spread(), system().begin_joints();
    double along = 0, square = 0, before = 0;
    bool moving = false;
    const auto begin_path = [&](auto& body) {
      body.begin_path();
      const auto step = body.take_step();
      along += step[0], square += step[1], before += step[2];
      moving = moving || body.moves;
    };
    for (Body& body : system().bodies()) begin_path(body);
    for (detail::PlacedBody& body : system().rigid()) begin_path(body);
    foresee(along, square, before);
    return moving;
  }
  /// Whether an end is led where a body keeps it out.
  bool leads_into_body() noexcept {
    constexpr double touches = 1 - Equilibrium::nothing;
    for (int i = 0; i < rods(); ++i) {
      Body& body = system().body(i);
      for (std::size_t k = 0; k < 2; ++k) {
        const auto& end = body.chain().ends()[k];
        for (int j = rods(); end.holds_place() && j < rods() + int(system().rigid().size()); ++j) {
          const detail::PlacedBody& core = *system().rigid(j);
          if (!system().joined(i, j) &&
              core.distance_at_goal(end.goal().r) < touches * core.reach(body.radius()))
            return true;
        }
      }
    }
    return false;
  }
  /// Where hands go on as they went, so does all that moves.   @param along  product of both steps   @param square, before  of each
  void foresee(double along, double square, double before) noexcept {
    constexpr double fastest = 2, aside = 0.1;
    const double ratio = before > 0 ? along / before : 0;
    // The way aside is |step - ratio · before|².
    const bool on = known_ > 1 && course_ == Course::follows && ratio > 0 && ratio < fastest &&
                    square - ratio * along <= aside * aside * square;
    for (Body& body : system().bodies())
      if (body.moves) body.go_on(on ? ratio : 0);
    for (int k = 0; k < system().pairs(); ++k) {
      detail::RodPair& pair = system().pair(k);
      const detail::RodPair now = pair;
      if (on && system().moves(pair)) pair.go_on(before_[at(k)], ratio);
      before_[at(k)] = now;
    }
    ++known_;
  }
  /// Nothing moves until a hand does.
  void rest() noexcept {
    for (Body& body : system().bodies()) body.moves = false;
    for (detail::PlacedBody& body : system().rigid()) body.moves = false;
  }
  /// From rest to where hands wait.
  void restart() noexcept {
    system().clear();
    for (Body& body : system().bodies()) body.restart();
    for (detail::PlacedBody& body : system().rigid()) body.restart();
    restart_path();
    system().save();
  }
  void restart_path() noexcept { course_ = Course::follows, known_ = unmoved_ = 0, step_ = 1; }

  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  /// From the shapes with which they begin to that which they have together.
  void come_to_rest() {
    constexpr int most = 200;
    for (int k = 0; k < most; ++k)
      if (tick() == Status::ok) break;
    if (status_ != Status::ok)
      throw std::invalid_argument(std::string("rods: they do not come to rest together, ") + name(status_));
    system().keep_rest();
    reset();
  }
  /// @throws std::invalid_argument where rods lie in each other or in bodies
  void look_at_rest() {
    reset();
    const detail::Look look = detail::look_around(system());
    if (look.least >= Equilibrium::closest) return;
    const auto named = [&](int i) {
      return i < rods() ? "rod " + std::to_string(i) : "body " + std::to_string(i - rods());
    };
    throw std::invalid_argument(named(look.pair.rod[0]) + " and " + named(look.pair.rod[1]) + " = " +
                                std::to_string(look.least) +
                                " of their reach apart at rest: must be half of it or more");
  }

  Equilibrium equilibrium_;
  Pairs before_;     // what touched in the tick before
  int known_ = 0;    // ticks in a row that went on with the same pairs
  int unmoved_ = 0;  // ticks in a row that have led nowhere
  double step_ = 1;  // of a path, to be tried first
  Course course_ = Course::follows;
  Status status_ = Status::ok;
};

// Outside of the class: only so does "extern template class World<…>;" keep a compiler from it.
template <class Element>
World<Element>::World(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& bodies,
                      const std::vector<Joint>& joints, const NewtonRaphson& solver)
    : equilibrium_(rods, bodies, joints, solver) {
  look_at_rest();
  const bool bent =
      std::any_of(rods.begin(), rods.end(), [](const WorldRod& rod) { return !rod.through.empty(); });
  if (bent) course_ = Course::falls, unmoved_ = 2;
  if (bent || !joints.empty()) come_to_rest();
}

template <class Element>
Status World<Element>::tick() noexcept {
  const bool moving = begin();
  // A fall goes on to where ends and bodies have come; one that has found nothing there, to where they go.
  double t = 0, step = course_ == Course::falls && unmoved_ < 2 ? 0 : step_, farthest = 1;
  Outcome outcome = leads_into_body() ? Outcome::full : Outcome::settled;
  while (t < 1 && moving && outcome != Outcome::full) {
    const double to = (std::min)(t + step, 1.0);
    system().aim(to);
    outcome = course_ == Course::falls ? equilibrium_.fall(t, to) : equilibrium_.settle();
    if (outcome == Outcome::settled) {
      t = to, step = step > 0 ? (std::min)(4 * step, farthest) : 1.0, unmoved_ = 0;
      if (course_ == Course::falls) course_ = Course::has_fallen;
      equilibrium_.accept();
      continue;
    }
    // A fall stays where it has come.
    if (course_ == Course::falls) {
      if (outcome != Outcome::too_far) course_ = Course::has_fallen;
      break;
    }
    system().restore();
    known_ = 0;
    if (outcome == Outcome::full || equilibrium_.left() <= 0) break;
    step = (to - t) / 8;
    if (outcome == Outcome::too_far) farthest = 4 * step;
    // What has fallen halfway is close to no equilibrium, however short the step.
    if (step < (outcome == Outcome::lost ? shortest : nothing)) course_ = Course::falls, step = to - t;
  }
  if (equilibrium_.changed()) known_ = 0;
  if (outcome == Outcome::settled) {
    rest();
    status_ = course_ == Course::has_fallen ? Status::snapped
              : system().overdrawn()        ? Status::out_of_range
                                            : Status::ok;
    course_ = Course::follows, step_ = 1;
    return status_;
  }
  known_ = 0, step_ = (std::min)(4 * step, 1.0);
  // The next path begins where this one has come.
  if (course_ != Course::falls) {
    system().aim(t);
    system().set_target(1);
  }
  unmoved_ = outcome == Outcome::full ? 0 : unmoved_ + 1;
  if (unmoved_ == patience) restart();
  return status_ = outcome == Outcome::full ? Status::out_of_range : equilibrium_.failure();
}

template <class Element>
double World<Element>::strain_energy() const noexcept {
  double energy = 0;
  for (const Body& body : system().bodies())
    energy += body.system().strain_energy() + (body.motion ? body.motion->stored() : 0);
  for (int k = system().joints(); k < system().pairs(); ++k) {
    const detail::RodPair& pair = system().pair(k);
    const Vector w = system().unbent(pair);
    energy += (pair.force * (pair.reach - pair.distance(w)) - pair.friction.kept().dot(w - pair.on)) / 2 +
              pair.friction.stored();
  }
  return energy;
}

template <class Element>
void World<Element>::reset() noexcept {
  restart();
  for (Body& body : system().bodies()) body.reset();
  for (detail::PlacedBody& body : system().rigid()) body.reset();
  status_ = Status::ok;
  equilibrium_.reset();
}

template <class Element>
Status World<Element>::step(double dt, int parts) noexcept {
  if (!equilibrium_.has_mass() || !(dt >= 0) || !std::isfinite(dt) || parts < 1)
    return Status::invalid_request;
  if (!(dt > 0)) return Status::ok;
  if (leads_into_body()) return equilibrium_.stop(), status_ = Status::out_of_range;
  restart_path();
  const bool found = equilibrium_.step((std::min)(dt, longest_step), parts);
  return status_ = !found                 ? Status::iteration_limit
                   : system().overdrawn() ? Status::out_of_range
                                          : Status::ok;
}

}  // namespace hapbeam
