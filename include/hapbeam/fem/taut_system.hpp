// The equations of a straight beam without dead loads whose ends stand no closer than it is long: one unknown, the tension.
//
// Without axial load the tension N is the same in all elements, and under N the beam is linear.  What is left is that the arc,
// as long as tension and slope make it, fits between the ends:
//
//   N L/EA = δ + ½ k'(N) d²          δ how far the ends are drawn apart, k(N) the stiffness at the contact
//
// The potential is convex: there is one equilibrium, it is stable, and N >= EA δ/L >= 0.  As k' falls like C/(N + a)², an
// iteration takes that function through the value and slope at the present N and solves for N what is then a cubic; it
// converges from anywhere.  An end that slides leaves N = 0, and one iteration.
// It takes the place of BeamSystem, whose iterations solve for u, w, θ of all nodes.
// Allocates at construction; every other member is noexcept and allocation-free, O(n).
// Source: the function is that of the secular equations of trust regions: Moré and Sorensen, Computing a trust region step,
// SIAM J. Sci. Stat. Comput. 4 (1983).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/beam_forces.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/fem/solver/two_spans.hpp>

namespace hapbeam {

/// Whether a beam is one for TautSystem.
inline bool is_taut(const Beam& beam) noexcept {
  const EndPlace &l = beam.left_place(), &r = beam.right_place();
  const bool drawn_apart = !fixes_u(beam.left()) || !fixes_u(beam.right()) || r.u >= l.u;
  return beam.parts().empty() && beam.arcs().empty() && beam.point_loads().empty() && !beam.transverse() &&
         !beam.axial() && l.w == 0 && l.theta == 0 && r.w == 0 && r.theta == 0 && drawn_apart;
}

/// @tparam Element  one whose membrane strain is one number: one_strain<Element>
template <class Element, typename ScalarType, int Elements, int MaxElements>
class TautSystem {
 public:
  using Scalar = ScalarType;
  using Node = CentrelineNode<Scalar>;

  /// @throws std::invalid_argument where elements does not fit the type
  TautSystem(const Beam& beam, int elements)
      : nodes_(elements),
        spans_(elements, beam.left(), beam.right()),
        length_(static_cast<Scalar>(beam.length())),
        force_unit_(static_cast<Scalar>(beam.bending_stiffness() / beam.length() / beam.length())),
        flexibility_(static_cast<Scalar>(beam.bending_stiffness() / beam.axial_stiffness() / beam.length() /
                                         beam.length())),
        between_ends_(fixes_u(beam.left()) && fixes_u(beam.right())),
        from_left_(fixes_u(beam.left())),
        place_{static_cast<Scalar>(beam.left_place().u / beam.length()),
               static_cast<Scalar>(beam.right_place().u / beam.length())},
        drawn_(static_cast<Scalar>((beam.right_place().u - beam.left_place().u) / beam.length()) /
               flexibility_) {
    rest();
  }

  int elements() const noexcept { return nodes_.size() - 1; }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return {nodes_.data(), nodes_.size()}; }
  const Node& node(int i) const noexcept { return nodes_[i]; }

  /// Untouched, on the uniform mesh.
  void rest() noexcept {
    const ContactMesh<Scalar> mesh(elements(), length_);
    set_goal(mesh, 0, 0);
    tension_ = between_ends_ ? drawn_ : Scalar(0);
    known_ = before_ = {contact_s_, tension_, 0, 0};
    d_ = 0;
    for (int i = 0; i <= elements(); ++i) nodes_[i].s = mesh.position(i);
    lay();
  }

  /// Where the path ends.  @param mesh with its node at or beside the contact   @param d [m]   @param lever [m] as in BeamSystem
  void set_goal(const ContactMesh<Scalar>& mesh, Scalar d, Scalar lever) noexcept {
    mesh_node_ = mesh.node();
    mesh_s_ = mesh.s();
    spans_.set(mesh_node_, elements() - mesh_node_, mesh_s_ / length_, lever / length_);
    contact_s_ = mesh_s_ + lever;
    goal_d_ = d / length_;
  }

  // What NewtonRaphson asks of a system, in units of EI/L.

  void set_target(Scalar t) noexcept {
    d_ = goal_d_;
    if (t < 1) {
      const Scalar start = centreline().at(contact_s_).w / length_;
      d_ = start + t * (goal_d_ - start);
    }
    if (between_ends_) tension_ = known_.tension + fit(foreseen(), d_);
  }
  void save() noexcept {
    saved_tension_ = tension_;
    saved_d_ = d_;
  }
  void restore() noexcept {
    tension_ = saved_tension_;
    d_ = saved_d_;
  }
  Scalar size() const noexcept { return size_; }
  Scalar unit() const noexcept { return 1; }

  Iteration<Scalar> iterate() noexcept {
    using std::sqrt;
    const detail::Taylor<Scalar> k = spans_.stiffness(tension_);
    const Scalar square = d_ * d_, longer = k.c1 * square / 2;
    const Scalar doubled = k.c0 * square - 2 * tension_ * longer + tension_ * tension_ * flexibility_;
    size_ = sqrt((std::max)(doubled, Scalar(0)));
    if (!(std::isfinite(doubled) && std::isfinite(k.c2))) return {Status::non_finite, 0};
    if (!between_ends_) return {Status::ok, 0};
    if (known_.s != contact_s_) before_ = known_;
    known_ = {contact_s_, tension_, k.c1 / 2, k.c2 < 0 ? -k.c2 / k.c1 : Scalar(0)};
    const Scalar change = fit(known_, d_);
    tension_ += change;
    return {std::isfinite(tension_) ? Status::ok : Status::non_finite,
            std::abs(change) * sqrt(flexibility_ + 2 * known_.beta * longer)};
  }

  /// Computes the shape that belongs to tension and d, and its force.
  void lay() noexcept {
    const int last = elements();
    const auto place = [this](int i, Scalar distance, Scalar u, Scalar w, Scalar theta) {
      nodes_[i] = {mesh_s_ + distance, u, w, theta};
    };
    stiffness_ = spans_.lay(tension_, flexibility_, d_, length_, place);
    nodes_[0].s = 0;
    nodes_[last].s = length_;
    const Scalar shift =
        from_left_ ? place_[0] * length_ - nodes_[0].u : place_[1] * length_ - nodes_[last].u;
    for (Node& node : nodes_) node.u += shift;
    if (between_ends_) nodes_[last].u = place_[1] * length_;
  }
  /// That holds the contact in the shape of lay() [N].
  Scalar reaction() const noexcept { return force_unit_ * stiffness_ * d_; }

  /// Strain energy [J], of which ½ k d² less what tension has from shortening the chord is bending.
  Scalar strain_energy() const noexcept {
    const Scalar longer = between_ends_ ? (tension_ - drawn_) * flexibility_ : Scalar(0);
    return force_unit_ * length_ *
           ((stiffness_ * d_ * d_ + tension_ * tension_ * flexibility_) / 2 - tension_ * longer);
  }
  /// What the section at s carries, in element e of the shape of lay(), which holds s.   @param thickness [m]
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    const Scalar EI = force_unit_ * length_ * length_, EA = force_unit_ / flexibility_;
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    Vector6<Scalar> r;
    Element::residual(ElementProperties<Scalar>(b.s - a.s, EA, EI),
                      Vector6<Scalar>(a.u, a.w, a.theta, b.u, b.w, b.theta), r);
    const DeadLoads<Scalar>* const none = nullptr;
    return detail::cut_beam<Element>(centreline(), e, s, r, none, Scalar(0)).in_section(EA, EI, thickness);
  }

 private:
  /// How much longer than its chord the arc is, over d², as far as it is known: rate/(1 + β (ν - tension))².
  struct Longer {
    Scalar s, tension, rate, beta;
  };

  /// The predictor: the function of the last press, and where the hand slides on by at most as much again, its rate as it goes
  /// on from the last two.
  Longer foreseen() const noexcept {
    Longer longer = known_;
    const Scalar moved = contact_s_ - known_.s, way = known_.s - before_.s;
    if (moved != 0 && std::abs(moved) <= 2 * std::abs(way)) {
      const Scalar q = 1 + known_.beta * (known_.tension - before_.tension);
      const Scalar rate = known_.rate + moved / way * (known_.rate - before_.rate / (q * q));
      if (rate > 0) longer.rate = rate;
    }
    return longer;
  }

  /// Change of ν to where arc and chord fit:  (ν + δ - δ0)(1 + βδ)² = rate d²/flexibility.
  Scalar fit(const Longer& known, Scalar d) const noexcept {
    const Scalar above = known.tension - drawn_, wanted = known.rate * d * d / flexibility_,
                 beta = known.beta;
    // From 0 the first step may pass the root; from beyond it Newton's method comes back without passing again.
    Scalar change = 0;
    for (int k = 0; k < 60; ++k) {
      const Scalar q = 1 + beta * change, p = above + change;
      const Scalar step = (wanted - p * q * q) / (q * (q + 2 * beta * p));
      change += step;
      // What is left is of second order, as what the function has left out.
      if (beta * std::abs(step) <= Scalar(1e-2) * q) break;
    }
    return change;
  }

  detail::PerNode<Node, Elements, MaxElements> nodes_;
  detail::TwoSpans<Element, Scalar, Elements, MaxElements> spans_;
  Scalar length_, force_unit_, flexibility_;  // L, EI/L², EI/(EA L²)
  bool between_ends_, from_left_;
  Scalar place_[2];  // u of the ends [L]
  Scalar drawn_;     // ν at rest
  int mesh_node_ = 0;
  Scalar mesh_s_ = 0, contact_s_ = 0;
  Longer known_{0, 0, 0, 0}, before_{0, 0, 0, 0};  // of the last iteration, and at the place before
  Scalar tension_ = 0, saved_tension_ = 0, d_ = 0, saved_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, stiffness_ = 0;
};

}  // namespace hapbeam
