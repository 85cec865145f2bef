// SPDX-License-Identifier: MIT
// Rods with mass in a step of time: each stage is an equilibrium of rods, pairs and inertia, and who touches whom is found in it.
//
// Contacts are walls, from which the trapezoidal rule throws back.  So a stage in which rods meet or let go is solved anew by Euler's rule, by which a blow
// takes energy: those rods, and all that contacts and joints tie to them, go by that until the contact lasts.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/world/pair_equilibrium.hpp>

namespace hapbeam::detail {

template <class Element>
class PairMotion : public PairEquilibrium<Element> {
  using Base = PairEquilibrium<Element>;

 public:
  using Base::system;
  using typename Base::Body;
  using Motion = typename Body::Motion;
  using Step = typename Motion::Step;
  using Vector = VectorOf<double, 3>;

  /// @throws std::invalid_argument as PairSystem, and where there is no rod, or some have mass and others not
  PairMotion(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid,
             const std::vector<Joint>& joints, const NewtonRaphson& solver)
      : Base(rods, rigid, joints, solver), held_(2 * rods.size()) {
    if (rods.empty()) throw std::invalid_argument("rods = 0: must be 1 or more");
    for (std::size_t i = 0; i < rods.size(); ++i)
      if (system().bodies()[i].motion.has_value() != has_mass())
        throw std::invalid_argument("rod " + std::to_string(i) +
                                    " density: must be known for all rods of a World or for none");
  }
  bool has_mass() const noexcept { return system().bodies()[0].motion.has_value(); }

  /// What has been found is kept.
  void accept() noexcept {
    dissipated_ += system().leave_friction();
    system().save();
    std::size_t i = 0;
    for (Body& body : system().bodies()) {
      for (std::size_t k = 0; k < 2 && body.moves; ++k) held_[i + k] = body.held(k);
      i += 2;
    }
  }
  /// Force and moment at an end.
  const std::array<Vector, 2>& held(std::size_t rod, std::size_t side) const noexcept {
    return held_[2 * rod + side];
  }
  double dissipated() const noexcept { return dissipated_; }
  void reset() noexcept {
    rest();
    dissipated_ = 0;
    for (auto& hold : held_) hold = {Vector::Zero(), Vector::Zero()};
  }

  /// The next step begins without velocity.
  void rest() noexcept {
    if (course_ == Course::rests) return;
    each([](Body& body) { body.motion->begin(body.system()); });
    course_ = Course::rests;
  }
  /// As of World.
  template <class Velocity>
  void throw_rod(std::size_t rod, Velocity&& velocity) noexcept {
    if (!has_mass()) return;
    begin_motion();
    course_ = Course::starts;
    Body& body = system().bodies()[rod];
    body.motion->step.throw_at([&](int i) { return velocity(body.system().node(i).s); });
  }
  double kinetic() const noexcept {
    double sum = 0;
    for (const Body& body : system().bodies())
      if (has_mass() && course_ != Course::rests) sum += body.motion->kinetic();
    return sum;
  }
  /// @param dt [s]   @return whether all of it has an answer; else all has stopped where it had one last
  bool step(double dt, int parts) noexcept {
    begin_motion();
    Base::begin(2 + parts);
    system().begin_joints();
    for (PlacedBody& body : system().rigid()) body.begin_path();
    each([](Body& body) {
      body.moves = true;
      body.chain().move_with(body.motion->inertia(), nullptr);
    });
    const double part = dt / parts;
    if (course_ == Course::starts) {
      const Kept kept{system().kept_pairs(), dissipated_, 0};
      course_ = Course::goes_on, (void)detail::start(*this, part, 0., most_halvings);
      put_back(kept);
      // A blow there is none of the accelerations with which a contact goes on.
      for (int k = 0; k < system().pairs(); ++k) system().pair(k).stages = 0;
    }
    each([&](Body& body) { body.motion->ends.begin(dt); });
    bool found = true;
    for (int k = 0; k < parts && found; ++k)
      found = detail::go_on(*this, part, double(k) / parts, double(k + 1) / parts, 0);
    if (!found) stop();
    else
      for (PlacedBody& body : system().rigid()) body.moves = false;
    each([](Body& body) { body.chain().move_with(nullptr, nullptr); });
    return found;
  }
  /// All velocity is gone, and ends and bodies are where they have come.
  void stop() noexcept {
    if (course_ == Course::rests) return;
    each([](Body& body) { body.motion->stop(body.system()), body.motion->ends.stop(body.chain()); });
    for (PlacedBody& body : system().rigid()) body.moves = true;
    course_ = Course::starts;
  }

 private:
  enum class Course {
    rests,    ///< in an equilibrium
    starts,   ///< has velocities and no accelerations yet
    goes_on,  ///< as the last step left it
  };
  template <class Moving, typename S>
  friend bool go_on(Moving&, S, S, S, int) noexcept;
  template <class Moving, typename S>
  friend bool start(Moving&, S, S, int) noexcept;

  template <class F>
  void each(F&& f) noexcept {
    for (Body& body : system().bodies()) f(body);
  }
  void begin_motion() noexcept {
    if (course_ != Course::rests) return;
    each([](Body& body) {
      body.motion->begin(body.system());
      body.motion->ends.take_over(body.chain());
    });
    course_ = Course::starts;
  }

  // Of parts of a step.

  struct Kept {
    typename Base::System::Pairs pairs;
    double dissipated, way;
  };
  Kept begin_part(double dt, double begin) noexcept {
    each([&](Body& body) { body.motion->begin_part(body.system(), dt); });
    (void)take_euler(lasting);
    return {system().kept_pairs(), dissipated_, begin};
  }
  void end_part(double end) noexcept {
    each([&](Body& body) { body.motion->ends.settle(body.chain(), end); });
  }
  void take_back(const Kept& kept) noexcept {
    each([](Body& body) { body.motion->take_back(body.system()); });
    put_back(kept);
  }
  /// All but the rods.
  void put_back(const Kept& kept) noexcept {
    system().set_pairs(kept.pairs);
    dissipated_ = kept.dissipated;
    system().aim(kept.way);
    system().set_target(1);
    system().save();
  }
  void start_again() noexcept {
    each([](Body& body) { body.motion->start_again(body.system()); });
  }
  bool solve(int stage, double from, double to, bool whole) noexcept {
    system().aim(to);
    for (bool free = true, smooth = false;;) {
      smooth = touches_smoothly();
      each([&](Body& body) {
        Motion& motion = *body.motion;
        const bool touched = motion.step.rule() == Step::Rule::euler;
        free = free && !touched && system().pairs() == system().joints();
        motion.ends.aim(body.chain(), from, to, motion.step.length(stage));
        motion.aim(body.system(), stage, whole && !touched);
      });
      this->begin_stage(stage, free);
      if (this->settle() != Outcome::settled || folded()) return false;
      if (!this->changed() || !(take_euler(lasting + 1) || smooth)) break;
      system().restore();
      (void)take_euler(lasting + 1);
    }
    for (int k = system().joints(); k < system().pairs(); ++k)
      if (int& lasted = system().pair(k).stages; lasted < lasting) ++lasted;
    each([&](Body& body) { body.motion->know(body.system(), stage); });
    accept();
    return true;
  }
  // No motion folds an element, only a step too far.
  bool folded() const noexcept {
    return std::any_of(system().bodies().begin(), system().bodies().end(),
                       [](const Body& body) { return body.folded(); });
  }
  /// Contacts of fewer stages, and what is tied to those, go on by Euler's rule.   @return whether any did not yet
  bool take_euler(int stages) noexcept {
    bool any = false;
    for (bool more = true; more;) {
      more = false;
      for (int k = 0; k < system().pairs(); ++k) {
        const RodPair& pair = system().pair(k);
        const auto step_of = [&](std::size_t side) -> Step& {
          return system().body(pair.rod[system().rigid(pair.rod[side]) ? 0 : side]).motion->step;
        };
        Step &a = step_of(0), &b = step_of(1);
        const bool first = a.rule() == Step::Rule::euler, second = b.rule() == Step::Rule::euler;
        const bool lasts = pair.kind != RodPair::Kind::contact || pair.stages >= stages;
        if ((first && second) || (lasts && !first && !second)) continue;
        a.take_euler(), b.take_euler();
        more = any = true;
      }
    }
    return any;
  }

  /// Whether a contact goes on by second order.
  bool touches_smoothly() noexcept {
    for (int k = system().joints(); k < system().pairs(); ++k)
      if (system().body(system().pair(k).rod[0]).motion->step.rule() == Step::Rule::second_order) return true;
    return false;
  }
  static constexpr int lasting = 2;  // stages after which a contact lasts

  std::vector<std::array<Vector, 2>> held_;  // force and moment at the ends, two a rod
  double dissipated_ = 0;                    // [J]
  Course course_ = Course::rests;
};

}  // namespace hapbeam::detail
