// SPDX-License-Identifier: MIT
// What is viscous in a beam that moves, as a stage of its step sees it: an element beside the elastic one, stiffer or softer, that is bent
// by nature.
//
//   σ = E (ε + τ ε' + Σ g_i h_i),   h_i' = ε' - h_i/τ_i
//
// ε are the strain and the bending of an element, by the cubic.  With r of the step (motion/tr_bdf2.hpp) a stage has
//   ε' = r (ε - ε^),   h_i = (h^_i + ε - ε^)/(1 + 1/(r τ_i))
// so that all of it is E κ (ε - ε°), with κ = τ r + Σ g_i/(1 + 1/(r τ_i)) and ε° from what was.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(n).
#pragma once

#include <array>
#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/motion/tr_bdf2.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

template <class Element, typename S, int Elements, int MaxElements>
class Viscosity {
  using Prismatic = VonKarman<AssumedStrain>;
  using Local = std::conditional_t<tapers<Element>, Tapered<Prismatic>, Prismatic>;
  using Viscous = Corotational<Local>;
  using Step = TrBdf2<S, Elements, MaxElements>;
  using Strain = Eigen::Matrix<S, 3, 1>;  // l θ1, l θ2 against the chord, and l ε [m]
  static constexpr int most = std::tuple_size<decltype(Damping::branches)>::value;

 public:
  /// @param parts  BeamElements, elastic, here and below
  template <class Parts>
  Viscosity(const Beam& beam, int elements, const Parts& parts)
      : viscosity_(static_cast<S>(beam.damping().viscosity)),
        elastic_(elements),
        viscous_(elements),
        now_(elements),
        between_(elements),
        before_(elements) {
    for (const Relaxation& branch : beam.damping().branches)
      if (branch.share > 0)
        branches_[count_++] = {static_cast<S>(branch.share), static_cast<S>(branch.time), 0};
    for (int e = 0; e < elements; ++e) elastic_[e] = parts.properties()[e];
  }

  bool none() const noexcept { return viscosity_ == 0 && count_ == 0; }

  /// At rest in the present shape.
  template <class Parts>
  void relax(const Parts& parts) noexcept {
    for (int e = 0; e < size(); ++e) now_[e] = {}, now_[e].strain = strain(e, parts.displacements(e));
  }
  /// Its rates are zero from here on.
  void stop() noexcept {
    for (int e = 0; e < size(); ++e) now_[e].rate.setZero();
  }
  /// A part of a step.   @param r [1/s]
  void begin(S r) noexcept {
    r_ = r, stiffer_ = viscosity_ * r;
    for (int i = 0; i < count_; ++i) {
      Branch& branch = branches_[i];
      branch.left = 1 / (1 + 1 / (r * branch.time));
      stiffer_ += branch.share * branch.left;
    }
    for (int e = 0; e < size(); ++e) before_[e] = now_[e];
  }
  void take_back() noexcept {
    for (int e = 0; e < size(); ++e) now_[e] = before_[e];
  }
  /// Back to the state before the last part, with the rates behind it.
  void start_again() noexcept {
    for (int e = 0; e < size(); ++e)
      now_[e].strain = before_[e].strain, now_[e].branches = before_[e].branches;
  }
  /// Sets κ and ε° of a stage.
  void aim(int stage) noexcept {
    for (int e = 0; e < size(); ++e) {
      const Strain from = strain_from(stage, e);
      Strain pulls = viscosity_ * r_ * from;
      for (int i = 0; i < count_; ++i)
        pulls += branches_[i].share * branches_[i].left * (from - branch_from(stage, e, i));
      const Strain natural = pulls / stiffer_;
      auto p = elastic_[e];
      for (S ElementProperties<S>::*stiffness :
           {&ElementProperties<S>::axial_stiffness, &ElementProperties<S>::axial_per_length,
            &ElementProperties<S>::bending_per_length3, &ElementProperties<S>::taper11,
            &ElementProperties<S>::taper12, &ElementProperties<S>::taper22})
        p.*stiffness *= stiffer_;
      p.natural_a = natural[0], p.natural_b = natural[1];
      p.natural_stretch = natural[2] - longer(p, natural[0], natural[1]);
      viscous_[e] = p;
    }
  }
  /// Adds its part of an element's residual and tangent.   @param d  displacements of its nodes   @return [J]
  S add(int e, const Vector6<S>& d, Vector6<S>& r, Matrix6<S>& K) const noexcept {
    Vector6<S> force;
    Matrix6<S> stiffness;
    const S energy = Viscous::tangent(viscous_[e], d, force, stiffness);
    r += force, K += stiffness;
    return energy;
  }
  /// To be called where the stage has been solved.
  template <class Parts>
  void know(int stage, const Parts& parts) noexcept {
    for (int e = 0; e < size(); ++e) {
      const Strain now = strain(e, parts.displacements(e)), change = now - strain_from(stage, e);
      State state;
      state.strain = now, state.rate = r_ * change;
      for (int i = 0; i < count_; ++i)
        state.branches.col(i) = branches_[i].left * (branch_from(stage, e, i) + change);
      (stage == 0 ? between_ : now_)[e] = state;
    }
  }
  /// What the branches hold [J].
  S energy() const noexcept {
    S sum = 0;
    for (int e = 0; e < size() && count_ > 0; ++e) {
      auto p = elastic_[e];
      p.natural_a = p.natural_b = p.natural_stretch = 0;
      for (int i = 0; i < count_; ++i) {
        const Strain h = now_[e].branches.col(i);
        const Deformation<S> alone(h[2] - longer(p, h[0], h[1]), h[0], h[1]);
        sum += branches_[i].share * Local::respond(p, alone).energy;
      }
    }
    return sum;
  }

 private:
  struct State {
    Strain strain = Strain::Zero(), rate = Strain::Zero();
    Eigen::Matrix<S, 3, most> branches = Eigen::Matrix<S, 3, most>::Zero();  // h
  };
  struct Branch {
    S share, time, left;  // g, τ [s], 1/(1 + 1/(r τ))
  };
  using States = PerNode<State, Elements, MaxElements>;
  using Properties = PerNode<ElementProperties<S>, Elements, MaxElements>;

  /// Number of elements; 0 without viscosity.
  int size() const noexcept { return none() ? 0 : elastic_.size() - 1; }
  /// By how much a bent element is longer than its chord [m].
  static S longer(const ElementProperties<S>& p, S a, S b) noexcept {
    return (2 * a * a - a * b + 2 * b * b) * (p.inverse_length / 30);
  }
  Strain strain(int e, const Vector6<S>& d) const noexcept {
    ElementProperties<S> p = elastic_[e];
    p.natural_stretch = 0;
    const Deformation<S> is = Viscous::deformation(p, d);
    return {is.a, is.b, is.stretch + longer(p, is.a, is.b)};
  }
  Strain strain_from(int stage, int e) const noexcept {
    return Step::counted_from(stage, now_[e].strain, now_[e].rate, between_[e].strain, r_);
  }
  Strain branch_from(int stage, int e, int i) const noexcept {
    const Strain h = now_[e].branches.col(i);
    return Step::counted_from(stage, h, Strain(now_[e].rate - h / branches_[i].time),
                              Strain(between_[e].branches.col(i)), r_);
  }

  S viscosity_, r_ = 1, stiffer_ = 0;  // τ [s], r [1/s], κ
  Branch branches_[most] = {};
  int count_ = 0;
  Properties elastic_, viscous_;
  States now_, between_, before_;
};

}  // namespace hapbeam::detail
