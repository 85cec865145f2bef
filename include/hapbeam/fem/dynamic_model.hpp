// SPDX-License-Identifier: MIT
// A beam in the plane with mass: it swings, and what touches it meets its inertia.
//
//   M q" + α M q' + V'(q) + what is viscous = forces
//
// step() goes on by a time, alone or with a hand.  Each of its parts is a static solve with one term more, the inertia (motion/tr_bdf2.hpp): the elements, supports
// and contacts are those of FemModel, and the beam stays where that does.  A hand touches through its coupling, a spring and a damper, within the step: a
// massless avatar between them has no place of its own, so that no blow is infinite.  Where a part has no solution it is taken back and halved.
// A beam without density, of a material that is viscous, creeps: each part is static, and steps may be as long as they like.
// Allocates and throws at construction.  Real-time: every other member is noexcept and allocation-free, at most 15 tries of each part, of two stages.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/contact/coupled_contacts.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/motion/chain_motion.hpp>

namespace hapbeam {

/// @tparam Element  of finite rotation.  Mass and bending of the default and of rods are those of one cubic.  Corotational<> is exact under tension and
///                  bends otherwise: with 16 of them partials 1, 3 and 5 of a string are 3, 32 and 134 cents too low
template <class Element = Corotational<VonKarman<AssumedStrain>>, typename ScalarType = double,
          int Elements = Eigen::Dynamic, int MaxElements = Elements>
class DynamicModel {
  static_assert(any_rotation<Element>,
                "DynamicModel takes elements of finite rotation, as Corotational<> and RoundRod");
  using System = typename detail::SystemOf<Element>::template System<ScalarType, Elements, MaxElements>;
  using Chain = typename System::Chain;
  using Motion = detail::ChainMotion<System, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using Body = typename Chain::Body;
  static constexpr int dimension = dimension_of<Element>;
  using Vector = VectorOf<Scalar, dimension>;
  using Hand = Coupled<Scalar, dimension>;
  using Felt = Pushed<Scalar, dimension>;
  /// Hands that may touch it at once.
  static constexpr int contacts = contacts_of<Element>;
  /// No step is longer: what a late tick has missed is left out [s].
  static constexpr Scalar longest = static_cast<Scalar>(longest_step);

  /// At rest under its dead loads.
  /// @param substeps  parts of a step, each of two solves
  /// @throws std::invalid_argument where the beam has no density and is not viscous, or shears, or as FemModel
  DynamicModel(const Body& beam, int elements, int substeps = 4);

  /// Back to rest.
  void reset() noexcept { begin(rest_); }
  /// Lets it go from another shape, without velocity.   @param shape  of the same beam, as of a FemModel
  void let_go_from(const Centreline<Scalar, dimension>& shape) noexcept {
    system_.chain().lay(shape);
    system_.keep(shape_);
    begin(shape_);
  }
  /// The same, and thrown.   @param velocity  (s) -> that of the centreline there, and how that changes along it, below each other [m/s, 1/s]
  template <class Velocity>
  void let_go_from(const Centreline<Scalar, dimension>& shape, Velocity&& velocity) noexcept {
    let_go_from(shape);
    motion_.step.throw_at([&](int i) { return velocity(system_.node(i).s); });
  }

  /// Goes on by a time.   @param dt [s], not negative
  /// @return ok | iteration_limit: it has stopped where a part had no solution, or gone on without hands where it had stopped before |
  ///         invalid_request: nothing has changed
  Status step(Scalar dt) noexcept { return go(dt, nullptr, 0); }
  /// The same with a hand, which moves evenly from where it was.   @return force and place at the end of the step; not limited in size.  out_of_range: as of
  /// FemModel::push()
  Felt step(Scalar dt, const Hand& hand) noexcept {
    Felt pushed;
    (void)step(dt, &hand, 1, &pushed);
    return pushed;
  }
  /// The same with several hands, each with its number in every step.   @param count  of them, no more than contacts   @param pushed  out, of each
  Status step(Scalar dt, const Hand* hands, int count, Felt* pushed) noexcept {
    const Status status = go(dt, hands, count);
    for (int i = 0; i < count && i < contacts; ++i) {
      pushed[i] = contacts_.pushed(system_, i);
      if (pushed[i].force != 0 && system_.too_coarse(pushed[i].s, pushed[i].force * pushed[i].normal))
        pushed[i].status = Status::out_of_range;
      if (status != Status::ok) pushed[i].status = status;
    }
    return status;
  }

  int elements() const noexcept { return system_.elements(); }
  int substeps() const noexcept { return substeps_; }
  Scalar thickness() const noexcept { return thickness_; }  ///< [m]
  Centreline<Scalar, dimension> shape() const noexcept { return system_.drawn(); }
  /// [m/s] at arc position s.
  Vector velocity(Scalar s) const noexcept { return motion_.velocity(system_, s); }
  using Energy = EnergyInMotion<Scalar>;
  Energy energy() const noexcept {
    const Scalar strain = system_.strain_energy();
    return {motion_.kinetic(), strain + motion_.stored(), system_.total_potential() - strain};
  }
  /// Leads an end of a rod to a pose in the next step, along the parabola of this pose and the two before.  The end is clamped, or on springs,
  /// of which the pose then is.  A step that has no answer leaves it where it has come to.   @param damper  beside those springs
  /// @return ok | invalid_request: it is held otherwise, or an argument makes no sense; nothing has changed
  template <class Side, class Pose, class Damper = HoldDamper>
  Status hold(Side side, const Pose& pose, const Damper& damper = {}) noexcept {
    const bool valid = motion_.ends.lead(system_.chain(), static_cast<std::size_t>(side), pose, damper);
    return valid ? Status::ok : Status::invalid_request;
  }
  /// Of what holds an end on the body, inertia and viscosity taken into account: in the plane along x and w [N], and moment [N·m]; in space a
  /// HeldEnd, with moment about the end, ok | out_of_range as of FemModel::hold().   @param side  0 | RodSide::left, 1 | RodSide::right
  template <class Side>
  auto reaction(Side side) const noexcept {
    return system_.reaction(static_cast<std::size_t>(side), starts_ ? nullptr : motion_.inertia(),
                            starts_ ? nullptr : motion_.viscosity());
  }

  /// Called at the end of each part of a step.   @param part  its length [s]
  using Listener = void (*)(void* who, const DynamicModel& model, Scalar part) noexcept;
  /// One at a time; null: none.  The model stays where it is meanwhile.
  void listen(void* who, Listener listener) noexcept { listens_ = who, listener_ = listener; }

  /// Linear solves of the last step.
  int solves() const noexcept { return solves_; }

 private:
  using Step = typename Motion::Step;
  template <class Moving, typename S>
  friend bool detail::go_on(Moving&, S, S, S, int) noexcept;
  template <class Moving, typename S>
  friend bool detail::start(Moving&, S, S, int) noexcept;

  void begin(const typename System::State& state) noexcept;
  bool start(Scalar part, Scalar end, int halvings) noexcept {
    starts_ = false;
    return detail::start(*this, part, end, halvings);
  }

  Status go(Scalar dt, const Hand* hands, int count) noexcept;
  bool go_on(Scalar dt, Scalar begin, Scalar end) noexcept { return detail::go_on(*this, dt, begin, end, 0); }

  // Of its parts.

  auto begin_part(Scalar dt, Scalar) noexcept {
    motion_.begin_part(system_, dt);
    return contacts_.kept();
  }
  void end_part(Scalar end) noexcept { motion_.ends.settle(system_.chain(), end); }
  template <class Kept>
  void take_back(const Kept& kept) noexcept {
    motion_.take_back(system_);
    contacts_.take_back(kept);
  }
  void start_again() noexcept { motion_.start_again(system_); }
  /// One stage.   @param from, to  of the way of the hands   @param whole  the part has not been halved
  bool solve(int stage, Scalar from, Scalar to, bool whole) noexcept {
    const auto touched = contacts_.kept();
    if (!settle(stage, from, to, whole)) return false;
    // A blow on what is hard would be thrown back by the trapezoidal rule.
    if (motion_.step.rule() == Motion::Step::Rule::second_order && contacts_.struck()) {
      motion_.step.take_euler();
      contacts_.take_back(touched);
      if (!settle(stage, from, to, false)) return false;
    }
    motion_.know(system_, stage);
    return true;
  }
  bool settle(int stage, Scalar from, Scalar to, bool whole) noexcept {
    const bool foresees = whole && !motion_.massless();
    const Scalar time = motion_.step.length(stage);
    motion_.ends.aim(system_.chain(), from, to, time);
    contacts_.draw(system_);
    motion_.aim(system_, stage, foresees);
    const bool found = contacts_.solve(
        system_, time, to, foresees ? motion_.step.onward(stage) : Scalar(0), [&](bool touched) {
          NewtonRaphson solver;
          solver.pairs_differ = motion_.massless();
          if (!touched) solver.relative_tolerance = free_tolerance;
          const auto report =
              solver.solve(system_, Scalar(1), &motion_.curvature[static_cast<std::size_t>(stage)]);
          solves_ += report.solves;
          return report.status == Status::ok;
        });
    // No motion folds an element, only a step too far.
    return found && !system_.folded(rest_);
  }

  static constexpr double free_tolerance = 1e-9;  // errors of steps add up where no hand is

  System system_;
  Motion motion_;
  typename System::State rest_, shape_;  // at rest, and what it was let go from
  int substeps_, solves_ = 0;
  bool starts_ = true;
  Scalar thickness_;
  detail::CoupledContacts<System> contacts_;
  void* listens_ = nullptr;
  Listener listener_ = nullptr;
};

// Outside of the class: only so does "extern template class DynamicModel<>;" keep a compiler from it.
template <class Element, typename ScalarType, int Elements, int MaxElements>
DynamicModel<Element, ScalarType, Elements, MaxElements>::DynamicModel(const Body& beam, int elements,
                                                                       int substeps)
    : system_(beam, elements),
      motion_(beam, elements, system_),
      rest_(elements),
      shape_(elements),
      substeps_(substeps),
      thickness_(static_cast<Scalar>(beam.thickness())),
      contacts_(PressRange<Scalar>(beam).range(), detail::anchored(beam.left()),
                detail::anchored(beam.right())) {
  if (substeps < 1) detail::reject("substeps", substeps, "", "1 or more");
  if (motion_.massless() && !motion_.viscosity())
    detail::reject("density", 0, "kg/m³", "known for a beam that moves: Material{young, density}");
  // Its sections would turn with a mass of their own.
  if constexpr (dimension == 2)
    if (beam.shear_stiffness() > 0)
      detail::reject("beam shear stiffness", beam.shear_stiffness(), "N", "none for a beam that moves");
  if constexpr (dimension == 3) system_.chain().parts().swing();
  let_go_from(FemModel<Element, Scalar, Elements, MaxElements>(beam, elements).shape());
  // Of elements that swing it is not quite that.
  if constexpr (dimension == 3) (void)NewtonRaphson().solve(system_);
  system_.keep(rest_);
  reset();
  if constexpr (dimension == 2) motion_.draw(system_);
}

template <class Element, typename ScalarType, int Elements, int MaxElements>
Status DynamicModel<Element, ScalarType, Elements, MaxElements>::go(Scalar dt, const Hand* hands,
                                                                    int count) noexcept {
  solves_ = 0;
  bool valid = dt >= 0 && std::isfinite(dt) && count >= 0 && count <= contacts;
  for (int i = 0; valid && i < count; ++i)
    valid = is_finite(hands[i].hand) && hands[i].stiffness > 0 && hands[i].damping >= 0;
  if (!valid) return Status::invalid_request;
  if (!(dt > 0)) return Status::ok;
  system_.chain().move_with(motion_.inertia(), motion_.viscosity());
  const bool massless = motion_.massless();
  const Scalar all = massless ? dt : (std::min)(dt, longest), part = all / Scalar(substeps_);
  const bool stood = starts_ && !massless;
  if (stood) contacts_.begin(system_, nullptr, 0), (void)start(part, 1, detail::most_halvings);
  contacts_.begin(system_, hands, count);
  motion_.ends.begin(all);
  // Without mass it takes its load at once, unless a damper holds it, and creeps on.
  bool found = true;
  if (starts_ && motion_.viscosity()->leaps(part)) found = go_on(part / 1000000, 0, 0), motion_.stop(system_);
  if (starts_) found = found && start(part, 0, 0);
  int parts = 0;
  const auto go_far = [&] {
    for (; parts < substeps_ && found; parts += found) {
      found = go_on(part, Scalar(parts) / Scalar(substeps_), Scalar(parts + 1) / Scalar(substeps_));
      if (found && listener_) listener_(listens_, *this, part);
    }
  };
  go_far();
  const Status status = found ? Status::ok : Status::iteration_limit;
  contacts_.end();
  // The next one begins as after a reset, where the beam has stopped.  Where one has begun so it goes on without hands, away from there.
  if (!found) contacts_.reset();
  if (!found && stood && count > 0) found = true, contacts_.begin(system_, nullptr, 0), go_far();
  if (!found) motion_.stop(system_), starts_ = true, motion_.ends.stop(system_.chain());
  system_.chain().move_with(nullptr, nullptr);
  system_.draw();
  return status;
}

template <class Element, typename ScalarType, int Elements, int MaxElements>
void DynamicModel<Element, ScalarType, Elements, MaxElements>::begin(
    const typename System::State& state) noexcept {
  system_.set_state(state);
  motion_.begin(system_);
  contacts_.reset();
  motion_.ends.stay(system_.chain());
  system_.set_goal();
  system_.set_target(1);  // all of the dead loads
  motion_.curvature = {};
  starts_ = true;
  system_.draw();
}

}  // namespace hapbeam
