// SPDX-License-Identifier: MIT
// A beam in the plane with mass: it swings, and what touches it meets its inertia.
//
//   M q" + α M q' + V'(q) + what is viscous = forces
//
// step() goes on by a time, alone or with a hand.  Each of its parts is a static solve with one term more, the inertia (dynamics.hpp): the elements, supports
// and contacts are those of FemModel, and the beam stays where that does.  A hand touches through its coupling, a spring and a damper, within the step: a
// massless avatar between them has no place of its own, so that no blow is infinite.  Where a part has no solution it is taken back and halved.
// Allocates and throws at construction.  Real-time: every other member is noexcept and allocation-free, at most 15 tries of each part, of two stages.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam {

/// @tparam Element  of finite rotation, as Corotational<>.  The mass is that of a cubic.  An element that bends otherwise under tension, as that one,
///                  has the partials of a string too low, with 16 elements by 3, 12 and 31 cents: Corotational<VonKarman<AssumedStrain>> has not
template <class Element = Corotational<>, typename ScalarType = double, int Elements = Eigen::Dynamic,
          int MaxElements = Elements>
class DynamicModel {
  static_assert(any_rotation<Element> && dimension_of<Element> == 2,
                "DynamicModel takes elements as Corotational<>");
  using System = BeamSystem<Element, ScalarType, Elements, MaxElements>;
  using Contact = typename System::Contact;
  using RoundContact = typename System::RoundContact;

 public:
  using Scalar = ScalarType;
  /// No step is longer: what a late tick has missed is left out [s].
  static constexpr Scalar longest = Scalar(2e-3);
  /// Times that a part is halved.
  static constexpr int most_halvings = 3;

  /// At rest under its dead loads.
  /// @param substeps  parts of a step, each of two solves
  /// @throws std::invalid_argument where the beam has no density, or as FemModel
  DynamicModel(const Beam& beam, int elements, int substeps = 4)
      : system_(beam, elements),
        inertia_(beam, elements, [this](int i) { return system_.node(i).s; }),
        steps_(elements),
        rest_(elements),
        before_(elements),
        substeps_(substeps),
        thickness_(static_cast<Scalar>(beam.thickness())),
        drag_(static_cast<Scalar>(beam.damping().drag)),
        viscosity_(beam, elements, [this](int e) { return system_.parts().properties()[e]; }) {
    if (substeps < 1) detail::reject("substeps", substeps, "", "1 or more");
    let_go_from(FemModel<Element, Scalar, Elements, MaxElements>(beam, elements).shape());
    system_.keep(rest_);
  }

  /// Back to rest.
  void reset() noexcept { begin(rest_); }
  /// Lets it go from another shape, without velocity.   @param shape  of the same beam, as of a FemModel
  void let_go_from(const Centreline<Scalar>& shape) noexcept {
    system_.keep(before_);
    for (int i = 0; i <= system_.elements(); ++i) {
      auto& node = before_.nodes[i];
      const Displacement<Scalar> at = shape.at(node.s);
      node.u = at.u, node.w = at.w, node.theta = at.theta;
    }
    system_.set_state(before_);
    system_.find_tensions();
    system_.keep(before_);
    begin(before_);
  }

  /// Goes on by a time.   @param dt [s], not negative
  /// @return ok | iteration_limit: it has stopped where a part had no solution | invalid_request: nothing has changed
  Status step(Scalar dt) noexcept { return go(dt, nullptr).status; }
  /// The same with a hand, which moves evenly from where it was.   @return force and place at the end of the step; not limited in size
  Pushed<Scalar> step(Scalar dt, const Coupled<Scalar>& hand) noexcept { return go(dt, &hand); }

  int elements() const noexcept { return system_.elements(); }
  int substeps() const noexcept { return substeps_; }
  Scalar thickness() const noexcept { return thickness_; }  ///< [m]
  Centreline<Scalar> shape() const noexcept { return system_.drawn(); }
  /// [m/s] at arc position s.
  Vector2<Scalar> velocity(Scalar s) const noexcept {
    const Centreline<Scalar> line = system_.centreline();
    const int e = line.segment_at(s);
    const Scalar l = line[e + 1].s - line[e].s, t = (s - line[e].s) / l, u = 1 - t;
    const auto &a = steps_[e].v, &b = steps_[e + 1].v;
    return u * u * (1 + 2 * t) * a.template head<2>() + l * t * u * u * a.template tail<2>() +
           t * t * (3 - 2 * t) * b.template head<2>() - l * t * t * u * b.template tail<2>();
  }
  struct Energy {
    Scalar kinetic, strain, loads;  ///< [J], the last of the dead loads
    Scalar sum() const noexcept { return kinetic + strain + loads; }
  };
  Energy energy() const noexcept {
    const Scalar strain = system_.strain_energy();
    return {kinetic(), strain + viscosity_.energy(), system_.total_potential() - strain};
  }
  /// Of what holds an end on the beam, inertia and viscosity taken into account: along x and w [N], and moment [N·m].   @param k  0: left, 1: right
  Vector3<Scalar> reaction(int k) const noexcept {
    const int e = k == 0 ? 0 : system_.elements() - 1;
    Vector6<Scalar> r = system_.nodal_forces(e);
    if (!starts_) {
      Matrix6<Scalar> K;
      K.setZero();
      (void)inertia_.add(e, system_.node(e), system_.node(e + 1), r, K);
      if (!viscosity_.none()) (void)viscosity_.add(e, system_.parts().displacements(e), r, K);
    }
    return r.template segment<3>(3 * k);
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
    stop();
    viscosity_.relax(bent());
    penetration_ = 0, contact_ = {}, known_ = touches_ = false;
    starts_ = true;
    system_.draw();
  }
  /// All velocity is gone.
  void stop() noexcept {
    for (int i = 0; i <= system_.elements(); ++i) {
      steps_[i] = {};
      steps_[i].q = detail::placed(system_.node(i));
    }
    viscosity_.stop();
  }
  /// Displacements of the nodes of an element.
  auto bent() const noexcept {
    return [this](int e) { return system_.parts().displacements(e); };
  }
  /// What pulls at it accelerates it: as it does within a hundredth of the first part.
  void accelerate(Scalar part) noexcept {
    starts_ = false;
    const auto* const hand = std::exchange(hand_, nullptr);
    if (go_on(part / 100, 0, 1, most_halvings)) {
      steps_.start_again();
      viscosity_.take_back();
      system_.set_state(before_);
    }
    hand_ = hand;
  }

  Pushed<Scalar> go(Scalar dt, const Coupled<Scalar>* hand) noexcept {
    Pushed<Scalar> pushed{0, Status::ok};
    solves_ = 0;
    const bool valid = dt >= 0 && std::isfinite(dt) &&
                       (!hand || (is_finite(hand->hand) && hand->stiffness > 0 && hand->damping >= 0));
    if (!valid) return {0, Status::invalid_request};
    if (!(dt > 0)) return pushed;
    system_.chain().move_with(&inertia_, viscosity_.none() ? nullptr : &viscosity_);
    hand_ = hand;
    if (hand && !touches_) contact_.s = hand->hand.s;
    if (hand && !known_) {
      // One that comes from nowhere has its spring bent as it lies, and a damper at rest.
      from_ = hand->hand.centre;
      penetration_ = (std::max)(hand->hand.reach - gap(hand->hand), Scalar(0));
    }
    known_ = hand != nullptr;
    const Scalar all = (std::min)(dt, longest), part = all / Scalar(substeps_);
    if (starts_) accelerate(part);
    for (int k = 0; k < substeps_ && pushed.status == Status::ok; ++k) {
      const Scalar begin = Scalar(k) / Scalar(substeps_), end = Scalar(k + 1) / Scalar(substeps_);
      if (!go_on(part, begin, end, 0)) pushed.status = Status::iteration_limit;
      else if (listener_) listener_(listens_, *this, part);
    }
    system_.chain().move_with(nullptr, nullptr);
    // The next one begins as after a reset, where the beam has stopped.
    if (pushed.status != Status::ok) stop(), starts_ = true, known_ = touches_ = false;
    if (hand) from_ = hand->hand.centre;
    system_.draw();
    if (touches_) {
      const Contact& found = system_.rows()[0];
      pushed.force = -contact_.force;
      pushed.s = found.s, pushed.point = found.place, pushed.normal = -found.normal;
    }
    return pushed;
  }
  /// A part of a step.  @param begin, end  of the hand's way in it
  bool go_on(Scalar dt, Scalar begin, Scalar end, int halvings) noexcept {
    system_.keep(before_);
    const auto contact = contact_;
    const Scalar penetration = penetration_;
    const bool touches = touches_;
    steps_.begin(dt, drag_);
    viscosity_.begin(steps_.rate());
    inertia_.set_scale(kinetic());
    bool found = true;
    for (int stage = 0; stage < steps_.stages && found; ++stage)
      found = solve(stage, begin + steps_.end(stage) * (end - begin));
    if (found) return true;
    system_.set_state(before_);
    steps_.take_back();
    viscosity_.take_back();
    contact_ = contact, penetration_ = penetration, touches_ = touches;
    const Scalar middle = (begin + end) / 2;
    return halvings < most_halvings && go_on(dt / 2, begin, middle, halvings + 1) &&
           go_on(dt / 2, middle, end, halvings + 1);
  }
  /// One stage.   @param way  of the hand
  bool solve(int stage, Scalar way) noexcept {
    const int n = system_.elements();
    steps_.aim(stage, inertia_);
    viscosity_.aim(stage);
    system_.move([&](int i) {
      const auto q = steps_.foreseen(stage, i);
      const auto& now = system_.node(i);
      const auto at = detail::placed(now);
      // As the tangent turns from where it is.
      const Scalar turn = std::atan2(at[2] * q[3] - at[3] * q[2], at[2] * q[2] + at[3] * q[3]);
      return Vector3<Scalar>(q[0] - at[0], q[1] - at[1], -turn);
    });
    if (!equilibrium(steps_.length(stage), way)) return false;
    for (int i = 0; i <= n; ++i) steps_.know(stage, i, detail::placed(system_.node(i)));
    viscosity_.know(stage, bent());
    return true;
  }
  /// With or without the hand, whichever has an answer.   @param time  of the stage [s]
  bool equilibrium(Scalar time, Scalar way) noexcept {
    if (!hand_) {
      touches_ = false;
      return newton();
    }
    const Scalar by_time = hand_->damping / time, whole = hand_->stiffness + by_time,
                 lasting = by_time * penetration_ / whole;
    Circle<Scalar> circle = hand_->hand;
    circle.centre = from_ + way * (hand_->hand.centre - from_);
    bool let_go = false;
    for (int pass = 0; pass < most_passes; ++pass) {
      if (!touches_) {
        contact_.force = 0;
        system_.set_goal();
        if (!newton()) return false;
        // What has let go in this stage is at its edge.
        if (let_go || !(gap(circle) < circle.reach - lasting)) {
          penetration_ = lasting;
          return true;
        }
        touches_ = true;
      }
      // From where the avatar is about: on the beam, and not in it as far as the hand.
      const auto view = look(circle);
      const Scalar ahead = (std::max)(circle.reach - view.distance, Scalar(0));
      const Circle<Scalar> avatar{contact_.s, circle.centre + ahead * view.normal,
                                  circle.reach + ahead - lasting, circle.side};
      Contact contact = contact_;
      RoundContact{avatar}.set(contact);
      contact.reach = avatar.reach, contact.compliance = 1 / whole;
      contact.least = 0, contact.most = system_.length();
      contact.moves = true, contact.waits = contact.force == 0;
      system_.set_goal();
      system_.add_goal(contact, nullptr);
      if (!newton()) return false;
      const Scalar force = -system_.linear_reaction();
      system_.look(0);
      static_cast<typename Contact::InnerState&>(contact_) = system_.rows()[0];
      contact_.force = force;
      if (force > 0) {
        penetration_ = lasting + force / whole;
        return true;
      }
      touches_ = false, let_go = true;
    }
    return false;
  }
  bool newton() noexcept {
    if (!hand_ || !touches_) system_.set_goal();
    NewtonRaphson solver;
    solver.smallest_step = 1;  // a part of a step is halved, not its path
    const auto report = solver.solve(system_);
    solves_ += report.solves;
    return report.status == Status::ok;
  }
  /// How the circle lies beside the beam, which is nearest to it at contact_.s then; past an end, beside its tangent.
  auto look(const Circle<Scalar>& circle) noexcept {
    const auto line = system_.centreline();
    const auto view = [&] { return RoundContact{circle}.look(RoundContact::node_at(line, contact_.s), 0); };
    for (int k = 0; k < 4; ++k)
      contact_.s = std::clamp(contact_.s + view().ahead, Scalar(0), system_.length());
    return view();
  }
  /// From the beam to the centre of the circle, negative behind it; past an end from its last point [m].
  Scalar gap(const Circle<Scalar>& circle) noexcept {
    const auto view = look(circle);
    const bool beyond =
        (contact_.s <= 0 && view.ahead < 0) || (contact_.s >= system_.length() && view.ahead > 0);
    return beyond ? std::hypot(view.distance, view.ahead) : view.distance;
  }

  static constexpr int most_passes = 4;

  System system_;
  typename System::Chain::Inertia inertia_;
  TrBdf2<Scalar, Elements, MaxElements> steps_;
  typename System::State rest_, before_;
  int substeps_, solves_ = 0;
  Scalar thickness_;
  Scalar drag_;
  typename System::Chain::Viscosity viscosity_;
  const Coupled<Scalar>* hand_ = nullptr;
  void* listens_ = nullptr;
  Listener listener_ = nullptr;
  Vector2<Scalar> from_ = Vector2<Scalar>::Zero();  // where the hand was
  Scalar penetration_ = 0;                          // of the hand in the beam, as it lasts in the damper [m]
  Contact contact_{};
  bool known_ = false, touches_ = false, starts_ = true;
};

}  // namespace hapbeam
