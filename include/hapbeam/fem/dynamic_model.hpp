// SPDX-License-Identifier: MIT
// A beam in the plane with mass: it swings, and what touches it meets its inertia.
//
//   M q" + α M q' + V'(q) + what is viscous = forces
//
// step() goes on by a time, alone or with a hand.  Each of its parts is a static solve with one term more, the inertia (dynamics.hpp): the elements, supports
// and contacts are those of FemModel, and the beam stays where that does.  A hand touches through its coupling, a spring and a damper, within the step: a
// massless avatar between them has no place of its own, so that no blow is infinite.  Where a part has no solution it is taken back and halved.
// A beam without density, of a material that is viscous, creeps: each part is static, and steps may be as long as they like.
// Allocates and throws at construction.  Real-time: every other member is noexcept and allocation-free, at most 15 tries of each part, of two stages.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/hermite.hpp>
#include <hapbeam/fem/contact/coupled_contacts.hpp>
#include <hapbeam/fem/fem_model.hpp>

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
  using Placed = typename Chain::Inertia::Placed;

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
  static constexpr Scalar longest = Scalar(2e-3);
  /// Times that a part is halved.
  static constexpr int most_halvings = 3;

  /// At rest under its dead loads.
  /// @param substeps  parts of a step, each of two solves
  /// @throws std::invalid_argument where the beam has no density and is not viscous, or shears, or as FemModel
  DynamicModel(const Body& beam, int elements, int substeps = 4)
      : system_(beam, elements),
        inertia_(beam, elements, [this](int i) { return system_.node(i).s; }),
        steps_(elements),
        rest_(elements),
        before_(elements),
        last_(elements),
        substeps_(substeps),
        massless_(!(beam.mass_per_length(beam.length() / 2) > 0)),
        thickness_(static_cast<Scalar>(beam.thickness())),
        drag_(Chain::drag(beam)),
        viscosity_(beam, elements, system_.parts()),
        contacts_(PressRange<Scalar>(beam).range(), detail::anchored(beam.left()),
                  detail::anchored(beam.right())) {
    if (substeps < 1) detail::reject("substeps", substeps, "", "1 or more");
    if (massless_ && viscosity_.none())
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
    if constexpr (dimension == 2) inertia_.draw(rest_.nodes);
  }

  /// Back to rest.
  void reset() noexcept { begin(rest_); }
  /// Lets it go from another shape, without velocity.   @param shape  of the same beam, as of a FemModel
  void let_go_from(const Centreline<Scalar, dimension>& shape) noexcept {
    system_.chain().lay(shape);
    system_.keep(before_);
    begin(before_);
  }
  /// The same, and thrown.   @param velocity  (s) -> that of the centreline there, and how that changes along it, below each other [m/s, 1/s]
  template <class Velocity>
  void let_go_from(const Centreline<Scalar, dimension>& shape, Velocity&& velocity) noexcept {
    let_go_from(shape);
    steps_.throw_at([&](int i) { return velocity(system_.node(i).s); });
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
      pushed[i] = contacts_.pushed(i);
      const bool taut = pushed[i].force != 0 && system_.overdrawn(pushed[i].s, pushed[i].normal);
      pushed[i].status = status == Status::ok && taut ? Status::out_of_range : status;
    }
    return status;
  }

  int elements() const noexcept { return system_.elements(); }
  int substeps() const noexcept { return substeps_; }
  Scalar thickness() const noexcept { return thickness_; }  ///< [m]
  Centreline<Scalar, dimension> shape() const noexcept { return system_.drawn(); }
  /// [m/s] at arc position s.
  Vector velocity(Scalar s) const noexcept {
    const auto line = system_.centreline();
    const int e = line.segment_at(s);
    const Scalar l = line[e + 1].s - line[e].s;
    const auto h = ShapeFunctions<Scalar>((s - line[e].s) / l, l).w;  // of θ, which is -w'
    const auto &a = steps_[e].v, &b = steps_[e + 1].v;
    return h[0] * a.template head<dimension>() - h[1] * a.template segment<dimension>(dimension) +
           h[2] * b.template head<dimension>() - h[3] * b.template segment<dimension>(dimension);
  }
  struct Energy {
    Scalar kinetic, strain, loads;  ///< [J], the last of the dead loads
    Scalar sum() const noexcept { return kinetic + strain + loads; }
  };
  Energy energy() const noexcept {
    const Scalar strain = system_.strain_energy();
    return {kinetic(), strain + viscosity_.energy(), system_.total_potential() - strain};
  }
  /// Leads an end of a rod to a pose in the next step, along the parabola of this pose and the two before.  The end is clamped, or on springs,
  /// of which the pose then is.  A step that has no answer leaves it where it has come to.   @param damper  beside those springs
  /// @return ok | invalid_request: it is held otherwise, or an argument makes no sense; nothing has changed
  template <class Side, class Pose, class Damper = HoldDamper>
  Status hold(Side side, const Pose& pose, const Damper& damper = {}) noexcept {
    const bool valid = ends_.lead(system_.chain(), static_cast<std::size_t>(side), pose, damper);
    return valid ? Status::ok : Status::invalid_request;
  }
  /// Of what holds an end on the body, inertia and viscosity taken into account: in the plane along x and w [N], and moment [N·m]; in space a
  /// HeldEnd, with moment about the end.   @param side  0 | RodSide::left, 1 | RodSide::right
  template <class Side>
  auto reaction(Side side) const noexcept {
    return system_.reaction(static_cast<std::size_t>(side), starts_ || massless_ ? nullptr : &inertia_,
                            starts_ || viscosity_.none() ? nullptr : &viscosity_);
  }

  /// Called at the end of each part of a step.   @param part  its length [s]
  using Listener = void (*)(void* who, const DynamicModel& model, Scalar part) noexcept;
  /// One at a time; null: none.  The model stays where it is meanwhile.
  void listen(void* who, Listener listener) noexcept { listens_ = who, listener_ = listener; }

  /// Linear solves of the last step.
  int solves() const noexcept { return solves_; }

 private:
  Scalar kinetic() const noexcept {
    return inertia_.energy([this](int i) -> const auto& { return steps_[i].v; });
  }
  void begin(const typename System::State& state) noexcept {
    system_.set_state(state);
    system_.keep(last_);
    inertia_.begin_stage(last_.nodes, [](int) { return Placed(Placed::Zero()); });
    stop();
    viscosity_.relax(system_.parts());
    contacts_.reset();
    ends_.stay(system_.chain());
    system_.set_goal();
    system_.set_target(1);  // all of the dead loads
    for (auto& curvature : curvature_) curvature = {};
    starts_ = true;
    system_.draw();
  }
  /// All velocity is gone.
  void stop() noexcept {
    const auto& at = inertia_.find(system_.parts().nodes());
    steps_.stop([&at](int i) { return at[i]; });
    viscosity_.stop();
  }
  /// From rest it has the accelerations and rates that a hundredth of the first part has.   @param end  of the way of the hands
  bool start(Scalar part, Scalar end, int halvings) noexcept {
    starts_ = false;
    if (!go_on(part / 100, 0, end, halvings)) return false;
    steps_.start_again();
    viscosity_.start_again();
    system_.set_state(before_);
    return true;
  }

  Status go(Scalar dt, const Hand* hands, int count) noexcept {
    solves_ = 0;
    bool valid = dt >= 0 && std::isfinite(dt) && count >= 0 && count <= contacts;
    for (int i = 0; valid && i < count; ++i)
      valid = is_finite(hands[i].hand) && hands[i].stiffness > 0 && hands[i].damping >= 0;
    if (!valid) return Status::invalid_request;
    if (!(dt > 0)) return Status::ok;
    system_.chain().move_with(massless_ ? nullptr : &inertia_, viscosity_.none() ? nullptr : &viscosity_);
    const Scalar all = massless_ ? dt : (std::min)(dt, longest), part = all / Scalar(substeps_);
    const bool stood = starts_ && !massless_;
    if (stood) contacts_.begin(system_, nullptr, 0), (void)start(part, 1, most_halvings);
    contacts_.begin(system_, hands, count);
    ends_.begin(all);
    // Without mass it takes its load at once, and creeps on.
    bool found = !starts_ || (go_on(part / 1000000, 0, 0, 0) && (stop(), start(part, 0, 0)));
    int parts = 0;
    const auto go_far = [&] {
      for (; parts < substeps_ && found; parts += found) {
        found = go_on(part, Scalar(parts) / Scalar(substeps_), Scalar(parts + 1) / Scalar(substeps_), 0);
        if (found && listener_) listener_(listens_, *this, part);
      }
    };
    go_far();
    const Status status = found ? Status::ok : Status::iteration_limit;
    contacts_.end();
    // The next one begins as after a reset, where the beam has stopped.  Where one has begun so it goes on without hands, away from there.
    if (!found) contacts_.reset();
    if (!found && stood && count > 0) found = true, contacts_.begin(system_, nullptr, 0), go_far();
    if (!found) stop(), starts_ = true, ends_.stop(system_.chain());
    system_.chain().move_with(nullptr, nullptr);
    system_.draw();
    return status;
  }
  /// A part of a step.  @param begin, end  of the way of the hands in it
  bool go_on(Scalar dt, Scalar begin, Scalar end, int halvings) noexcept {
    system_.keep(before_);
    const auto touched = contacts_.kept();
    steps_.begin(dt, drag_);
    viscosity_.begin(steps_.rate());
    inertia_.set_scale(kinetic());
    bool found = true;
    Scalar from = begin;
    for (int stage = 0; stage < steps_.stages && found; ++stage) {
      const Scalar to = begin + steps_.end(stage) * (end - begin);
      ends_.aim(system_.chain(), from, to, steps_.length(stage));
      found = solve(stage, to, !massless_ && halvings == 0), from = to;
    }
    if (found) return ends_.settle(system_.chain(), end), true;
    system_.set_state(before_);
    steps_.take_back();
    viscosity_.take_back();
    contacts_.take_back(touched);
    const Scalar middle = (begin + end) / 2;
    return halvings < most_halvings && go_on(dt / 2, begin, middle, halvings + 1) &&
           go_on(dt / 2, middle, end, halvings + 1);
  }
  /// One stage.   @param way  of the hands   @param foresees  whether nodes begin where their accelerations lead, else where they are:
  /// beyond a sudden change those lead far off
  bool solve(int stage, Scalar way, bool foresees) noexcept {
    steps_.aim(stage, inertia_);
    viscosity_.aim(stage);
    contacts_.draw(system_);
    // Tensions go on as they went, and nodes as their accelerations say.
    const Scalar onward = foresees ? steps_.onward(stage) : Scalar(0);
    system_.go_on(last_, onward);
    inertia_.begin_stage(last_.nodes, [&](int i) { return steps_.start(stage, i).q; });
    if (foresees)
      system_.place([&](int i) {
        return Chain::moved(last_.nodes[i], steps_.start(stage, i).q, steps_.foreseen(stage, i));
      });
    const bool found = contacts_.solve(system_, steps_.length(stage), way, onward, [&](bool touched) {
      NewtonRaphson solver;
      solver.pairs_differ = massless_;
      if (!touched) solver.relative_tolerance = free_tolerance;
      const auto report = solver.solve(system_, Scalar(1), &curvature_[stage]);
      solves_ += report.solves;
      return report.status == Status::ok;
    });
    if (!found) return false;
    const auto& found_at = inertia_.find(system_.parts().nodes());
    for (int i = 0; i <= system_.elements(); ++i) steps_.know(stage, i, found_at[i]);
    viscosity_.know(stage, system_.parts());
    return true;
  }

  static constexpr double free_tolerance = 1e-9;  // errors of steps add up where no hand is

  System system_;
  typename Chain::Inertia inertia_;
  TrBdf2<Scalar, Elements, MaxElements, Placed::RowsAtCompileTime> steps_;
  typename System::State rest_, before_, last_;  // at rest, before a part, and before the last stage
  Curvature<Scalar> curvature_[2];               // of both stages
  int substeps_, solves_ = 0;
  bool massless_, starts_ = true;
  Scalar thickness_;
  Scalar drag_;
  typename Chain::Viscosity viscosity_;
  detail::CoupledContacts<System, contacts> contacts_;
  typename Chain::LedEnds ends_;
  void* listens_ = nullptr;
  Listener listener_ = nullptr;
};

}  // namespace hapbeam
