// SPDX-License-Identifier: MIT
// The equations of a straight beam without dead loads whose ends stand no closer than it is long: one unknown, the tension.
//
// Under one tension N the beam is linear.  The arc has to fit between the ends:
//
//   N L/EA = δ + ½ k'(N) d²          δ how far the ends are drawn apart, k(N) the stiffness at the contact
//
// The potential is convex: there is one equilibrium, it is stable, and N >= EA δ/L >= 0.  As k' falls like C/(N + a)², an
// iteration fits that function to the value and slope at the present N and solves a cubic; it converges from anywhere.  An end that slides
// leaves N = 0, and one iteration.
// Between its ends and the contact the beam is two pieces in closed form (taut_piece.hpp).  Nodes are where the shape is drawn.
// Allocates at construction; every other member is noexcept and allocation-free.  An iteration is O(1), the shape O(n).
// Source: the function is that of the secular equations of trust regions: Moré and Sorensen, Computing a trust region step,
// SIAM J. Sci. Stat. Comput. 4 (1983).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/mesh.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/fem/taut_piece.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/internal_forces.hpp>

namespace hapbeam {

/// Whether a beam is one for TautSystem.
inline bool is_taut(const Beam& beam) noexcept {
  const EndPlace &l = beam.left_place(), &r = beam.right_place();
  const bool drawn_apart = !fixes_u(beam.left()) || !fixes_u(beam.right()) || r.u >= l.u;
  return beam.uniform() && beam.arcs().empty() && beam.point_loads().empty() && !beam.transverse() &&
         !beam.axial() && l.w == 0 && l.theta == 0 && r.w == 0 && r.theta == 0 && drawn_apart;
}

template <typename ScalarType, int Elements, int MaxElements>
class TautSystem {
 public:
  using Scalar = ScalarType;
  using Node = CentrelineNode<Scalar>;

  /// @param segments  at whose ends the shape is drawn   @throws std::invalid_argument where they do not fit the type
  TautSystem(const Beam& beam, int segments)
      : nodes_(segments),
        left_(beam.left()),
        right_(beam.right()),
        supports_{beam.left(), beam.right()},
        length_(static_cast<Scalar>(beam.length())),
        force_unit_(static_cast<Scalar>(beam.bending_stiffness() / beam.length() / beam.length())),
        flexibility_(static_cast<Scalar>(beam.bending_stiffness() / beam.axial_stiffness() / beam.length() /
                                         beam.length())),
        between_ends_(fixes_u(beam.left()) && fixes_u(beam.right())),
        place_{static_cast<Scalar>(beam.left_place().u / beam.length()),
               static_cast<Scalar>(beam.right_place().u / beam.length())},
        drawn_(static_cast<Scalar>((beam.right_place().u - beam.left_place().u) / beam.length()) /
               flexibility_),
        mesh_(segments, length_) {
    rest();
  }

  Scalar length() const noexcept { return length_; }
  Centreline<Scalar> centreline() const noexcept { return {nodes_.data(), nodes_.size()}; }

  /// Untouched, drawn on the uniform mesh.
  void rest() noexcept {
    set_goal(ContactMesh<Scalar>(centreline().segments(), length_).s(), 0);
    tension_ = between_ends_ ? drawn_ : Scalar(0);
    known_ = before_ = {contact_s_, tension_, 0, 0};
    d_ = 0;
    condensed_ = condense();
    lay();
  }

  /// Where the path ends.  @param s  [m] of the contact, at which the shape has a node   @param d [m]
  void set_goal(Scalar s, Scalar d) noexcept {
    mesh_ = mesh_.at(s);
    contact_s_ = s;
    left_.set(s / length_);
    right_.set((length_ - s) / length_);
    goal_d_ = d / length_;
  }
  /// Back to the place of lay().
  void take_back() noexcept { set_goal(laid_s_, d_ * length_); }

  // Required by NewtonRaphson, in units of EI/L.

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
  int elements() const noexcept { return 2; }

  Iteration<Scalar> iterate() noexcept {
    const Condensed at = condensed_ = condense();
    const Scalar square = d_ * d_, longer = at.k1 * square / 2;
    const Scalar doubled = at.k * square - 2 * tension_ * longer + tension_ * tension_ * flexibility_;
    size_ = std::sqrt((std::max)(doubled, Scalar(0)));
    if (!(std::isfinite(doubled) && std::isfinite(at.k2))) return {Status::non_finite, 0};
    if (!between_ends_) return {Status::ok, 0};
    if (known_.s != contact_s_) before_ = known_;
    known_ = {contact_s_, tension_, at.k1 / 2, at.k2 < 0 ? -at.k2 / (2 * at.k1) : Scalar(0)};
    const Scalar change = fit(known_, d_);
    tension_ += change;
    return {std::isfinite(tension_) ? Status::ok : Status::non_finite,
            std::abs(change) * std::sqrt(flexibility_ + 2 * known_.beta * longer)};
  }

  /// Computes the shape that belongs to tension and d, and its force.
  void lay() noexcept {
    // From the last iteration's tension a parabola leads to this one, unless a step was taken back.
    if (!(std::abs(tension_ - condensed_.tension) * known_.beta <= Scalar(1e-5))) condensed_ = condense();
    const Scalar by = tension_ - condensed_.tension, turn = (condensed_.turn + by * condensed_.turn1) * d_;
    stiffness_ = condensed_.k + by * (condensed_.k1 + by * condensed_.k2 / 2);
    left_.bend(tension_, d_, turn);
    right_.bend(tension_, d_, -turn);
    place_nodes();
    // Without tension the length of the arc says where an end that slides is.
    Scalar ends[2] = {place_[0], place_[1]};
    if (!between_ends_) {
      const Scalar span = left_.shortening() + right_.shortening();
      if (fixes_u(supports_[0])) ends[1] = ends[0] - span;
      else ends[0] = ends[1] + span;
    }
    const int last = nodes_.size() - 1, node = mesh_.node(),
              on_left = node + (mesh_.s() <= contact_s_ ? 1 : 0);
    lay(left_, on_left, ends[0], 1, [this](int j) -> Node& { return nodes_[j]; });
    lay(right_, last + 1 - on_left, ends[1], -1, [this, last](int j) -> Node& { return nodes_[last - j]; });
    if (mesh_.s() == contact_s_) nodes_[node].w = d_ * length_;
    for (const int k : {0, 1}) {
      Node& end = nodes_[k == 0 ? 0 : last];
      if (fixes_w(supports_[k])) end.w = 0;
      if (fixes_theta(supports_[k])) end.theta = 0;
    }
  }
  /// That holds the contact in the shape of lay() [N].
  Scalar reaction() const noexcept { return force_unit_ * stiffness_ * d_; }

  /// Strain energy [J], of which ½ k d² less what tension has from shortening the chord is bending.
  Scalar strain_energy() const noexcept {
    const Scalar longer = between_ends_ ? (tension_ - drawn_) * flexibility_ : Scalar(0);
    return force_unit_ * length_ *
           ((stiffness_ * d_ * d_ + tension_ * tension_ * flexibility_) / 2 - tension_ * longer);
  }
  /// What the section at s carries in the shape of lay(); at the contact, on the side of segment e.   @param thickness [m]
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    const Scalar at = (std::min)((std::max)(s, Scalar(0)), length_);
    const bool right = beyond(e + 1, at);
    const auto c = place(right, at);
    const Scalar moment = -c.bend * force_unit_ * length_, strain = tension_ * flexibility_;
    return {tension_ * force_unit_, (right ? c.shear : -c.shear) * force_unit_, moment, strain,
            std::abs(strain) + std::abs(c.bend) / length_ * thickness / 2};
  }

 private:
  void place_nodes() noexcept {
    const int node = mesh_.node(), last = nodes_.size() - 1;
    const Scalar s = mesh_.s(), on_left = node > 0 ? s / Scalar(node) : Scalar(0),
                 on_right = node < last ? (length_ - s) / Scalar(last - node) : Scalar(0);
    for (int i = 0; i < last; ++i)
      nodes_[i].s = i < node ? on_left * Scalar(i) : s + on_right * Scalar(i - node);
    nodes_[last].s = length_;
    laid_s_ = contact_s_;
  }

  /// The nodes of a piece.  @param end  u of its end [L]   @param side  1 on the left, -1 on the right   @param node  the j-th from the end
  template <class NodeAt>
  void lay(const detail::TautPiece<Scalar>& piece, int count, Scalar end, Scalar side,
           NodeAt&& node) noexcept {
    if (count == 0) return;
    struct Powers {
      Scalar &first, &second;
    };
    const Scalar spacing = count > 1 ? std::abs(node(1).s - node(0).s) / length_ : Scalar(0),
                 stretch = tension_ * flexibility_ * spacing;
    piece.visit(
        count, spacing,
        [&](int j) {
          return Powers{node(j).w, node(j).theta};
        },
        [&](int j, const auto& c) {
          Node& to = node(j);
          to.u = (end + side * (stretch * Scalar(j) - c.shortening)) * length_;
          to.w = c.w * length_;
          to.theta = -side * c.slope;
        });
  }

  /// How much longer than its chord the arc is, over d², as far as it is known: rate/(1 + β (ν - tension))².
  struct Longer {
    Scalar s, tension, rate, beta;
  };
  /// Force at the contact over its displacement, k(ν), its derivatives, and the rotation there over the displacement.
  struct Condensed {
    Scalar tension, k, k1, k2, turn, turn1;
  };

  /// Both pieces meet at the contact, where w and θ are those of both.  The derivatives are those of the energy ½ k d², stationary in θ.
  Condensed condense() const noexcept {
    const auto l = left_.stiffness(tension_), r = right_.stiffness(tension_);
    const Scalar turning = 1 / (l.k.tt + r.k.tt), turn = (r.k.wt - l.k.wt) * turning;
    const auto along = [turn](const auto& a, const auto& b) {
      return a.ww + b.ww + turn * (2 * (a.wt - b.wt) + turn * (a.tt + b.tt));
    };
    const Scalar slide = l.k1.wt - r.k1.wt + turn * (l.k1.tt + r.k1.tt);
    const Scalar k = l.determinant + r.determinant + l.k.ww * r.k.tt + r.k.ww * l.k.tt + 2 * l.k.wt * r.k.wt;
    return {tension_, k * turning,     along(l.k1, r.k1), along(l.k2, r.k2) - 2 * slide * slide * turning,
            turn,     -slide * turning};
  }

  /// Whether a place is on the right of the contact; the contact itself, where its node is not the one given.
  bool beyond(int node, Scalar s) const noexcept {
    return s > contact_s_ || (s == contact_s_ && node > mesh_.node());
  }
  auto place(bool right, Scalar s) const noexcept {
    return right ? right_.at((length_ - s) / length_) : left_.at(s / length_);
  }

  /// The predictor: the function of the last press; its rate is extrapolated where the hand slides by at most as much again.
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
      // The rest is of second order, as is what the function leaves out.
      if (beta * std::abs(step) <= Scalar(1e-2) * q) break;
    }
    return change;
  }

  detail::PerNode<Node, Elements, MaxElements> nodes_;
  detail::TautPiece<Scalar> left_, right_;
  Support supports_[2];
  Scalar length_, force_unit_, flexibility_;  // L, EI/L², EI/(EA L²)
  bool between_ends_;
  Scalar place_[2];  // u of the ends [L]
  Scalar drawn_;     // ν at rest
  ContactMesh<Scalar> mesh_;
  Scalar contact_s_ = 0, laid_s_ = 0;
  Condensed condensed_{0, 0, 0, 0, 0, 0};          // of the last iteration
  Longer known_{0, 0, 0, 0}, before_{0, 0, 0, 0};  // of the last iteration, and at the place before
  Scalar tension_ = 0, saved_tension_ = 0, d_ = 0, saved_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, stiffness_ = 0;
};

/// A press of such a beam, from the last press on, with the members of AllDisplacements; at most solver.max_solves iterations.
template <typename ScalarType, int Elements, int MaxElements, class Solver>
class OneTension {
 public:
  using Scalar = ScalarType;

  /// @param beam  one that is_taut()
  OneTension(const Beam& beam, int elements, const Solver& solver)
      : system_(beam, elements), solver_(solver) {}

  Response<Scalar> press(const Push<Scalar>& request, bool valid) noexcept {
    const Scalar first_step = report_.step;
    report_ = {Status::invalid_request, 0, 0, 0, 0, first_step};
    if (!valid) return {0, Status::invalid_request};
    system_.set_goal(request.s, request.d);
    report_ = solver_.solve(system_, first_step);
    if (report_.steps > 0) system_.lay();
    else system_.take_back();
    const Scalar force = system_.reaction();
    if (!std::isfinite(force)) report_.status = Status::non_finite;
    return {force, report_.status};
  }

  Status release() noexcept {
    reset();
    return Status::ok;
  }
  void reset() noexcept {
    system_.rest();
    report_.step = 1;
  }

  int elements() const noexcept { return shape().segments(); }
  Centreline<Scalar> shape() const noexcept { return system_.centreline(); }
  Scalar strain_energy() const noexcept { return system_.strain_energy(); }
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    return system_.internal_forces(e, s, thickness);
  }
  const SolveReport<Scalar>& rest() const noexcept { return rest_; }
  const SolveReport<Scalar>& report() const noexcept { return report_; }

 private:
  TautSystem<Scalar, Elements, MaxElements> system_;
  Solver solver_;
  SolveReport<Scalar> rest_{Status::ok, 0, 1, 1, 0, 1}, report_ = rest_;
};

}  // namespace hapbeam
