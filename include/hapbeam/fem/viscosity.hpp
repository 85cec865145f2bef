// SPDX-License-Identifier: MIT
// What viscous material keeps of its past, and what it makes of that in a stage of a step.
//
//   σ = E (ε + τ ε' + Σ g_i h_i),   h_i' = ε' - h_i/τ_i         ε: strains of an element
//
// With r of the step (tr_bdf2.hpp) a stage has
//   ε' = r (ε - ε^),   h_i = (h^_i + ε - ε^)/(1 + 1/(r τ_i))
// so that all of it is E κ (ε - ε°), with κ = τ r + Σ g_i/(1 + 1/(r τ_i)) and ε° from what was: an element that is bent by nature.
//
// Of a beam in the plane that is an element beside the elastic one, stiffer or softer.  Its strains are the stretch and the bending of an element, by
// the cubic.  What a chain calls is virtual, as of Inertia.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(n).
#pragma once

#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/motion/tr_bdf2.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/section.hpp>

namespace hapbeam::detail {

/// @tparam Size  strains of an element
template <typename S, int Size, int Elements, int MaxElements>
class ViscousHistory {
 public:
  using Strain = Eigen::Matrix<S, Size, 1>;

  ViscousHistory(const Damping& damping, int elements)
      : viscosity_(static_cast<S>(damping.viscosity)),
        size_(damping.viscous() ? elements : 0),
        now_(elements),
        between_(elements),
        before_(elements),
        from_(elements) {
    for (const Relaxation& branch : damping.branches)
      if (branch.share > 0)
        branches_[count_++] = {static_cast<S>(branch.share), static_cast<S>(branch.time), 0};
  }

  bool none() const noexcept { return size_ == 0; }
  /// Whether a load bends it at once, as a part of a step sees it: no damper takes a thousandth of that [s].
  bool leaps(S part) const noexcept { return viscosity_ < part / 1000; }
  /// Its rates are zero from here on.
  void stop() noexcept {
    for (int e = 0; e < size_; ++e) now_[e].rate.setZero();
  }
  /// A part of a step.
  void begin() noexcept {
    for (int e = 0; e < size_; ++e) before_[e] = now_[e];
  }
  void take_back() noexcept {
    for (int e = 0; e < size_; ++e) now_[e] = before_[e];
  }
  /// Back to the state before the last part, with the rates behind it.
  void start_again() noexcept {
    for (int e = 0; e < size_; ++e)
      now_[e].strain = before_[e].strain, now_[e].branches = before_[e].branches;
  }

 protected:
  /// Number of elements; 0 without viscosity.
  int size() const noexcept { return size_; }
  /// κ
  S stiffer() const noexcept { return stiffer_; }
  /// In equilibrium for long.   @param strain  (e), here and below
  template <class Find>
  void relax_at(Find&& strain) noexcept {
    for (int e = 0; e < size_; ++e) now_[e] = {}, now_[e].strain = strain(e);
  }
  /// Sets κ of a stage.   @param set  (e, κ ε°)
  template <class Step, class Set>
  void aim_at(int stage, const Step& step, Set&& set) noexcept {
    r_ = step.rate(), stiffer_ = viscosity_ * r_;
    for (int i = 0; i < count_; ++i) {
      Branch& branch = branches_[i];
      branch.left = 1 / (1 + 1 / (r_ * branch.time));
      stiffer_ += branch.share * branch.left;
    }
    for (int e = 0; e < size_; ++e) {
      const State &x = now_[e], &y = between_[e];
      State& from = from_[e];
      from.strain = step.counted_from(stage, x.strain, x.rate, y.strain);
      Strain pulls = viscosity_ * r_ * from.strain;
      for (int i = 0; i < count_; ++i) {
        const Strain h = x.branches.col(i);
        from.branches.col(i) =
            step.counted_from(stage, h, Strain(x.rate - h / branches_[i].time), Strain(y.branches.col(i)));
        pulls += branches_[i].share * branches_[i].left * (from.strain - from.branches.col(i));
      }
      set(e, pulls);
    }
  }
  /// To be called where the stage has been solved.
  template <class Find>
  void know_at(int stage, Find&& strain) noexcept {
    for (int e = 0; e < size_; ++e) {
      const Strain now = strain(e), change = now - from_[e].strain;
      State& to = (stage == 0 ? between_ : now_)[e];
      to.strain = now, to.rate = r_ * change;
      for (int i = 0; i < count_; ++i)
        to.branches.col(i) = branches_[i].left * (from_[e].branches.col(i) + change);
    }
  }
  const Strain& strain_of(int e) const noexcept { return now_[e].strain; }
  /// What the branches of an element hold [J].   @param energy  (h) of the elastic element
  template <class Energy>
  S stored(int e, Energy&& energy) const noexcept {
    S sum = 0;
    for (int i = 0; i < count_; ++i) sum += branches_[i].share * energy(Strain(now_[e].branches.col(i)));
    return sum;
  }

 private:
  static constexpr int most = std::tuple_size<decltype(Damping::branches)>::value;
  struct State {
    Strain strain = Strain::Zero(), rate = Strain::Zero();
    Eigen::Matrix<S, Size, most> branches = Eigen::Matrix<S, Size, most>::Zero();  // h
  };
  struct Branch {
    S share, time, left;  // g, τ [s], 1/(1 + 1/(r τ))
  };
  using States = PerNode<State, Elements, MaxElements>;

  S viscosity_, r_ = 1, stiffer_ = 0;  // τ [s], r [1/s], κ
  Branch branches_[most] = {};
  int count_ = 0, size_;
  States now_, between_, before_, from_;  // the last: ε^ and h^
};

template <class Element, typename S, int Elements, int MaxElements>
class Viscosity : public ViscousHistory<S, 3, Elements, MaxElements> {
  using History = ViscousHistory<S, 3, Elements, MaxElements>;
  using Prismatic = VonKarman<AssumedStrain>;
  using Local = std::conditional_t<tapers<Element>, Tapered<Prismatic>, Prismatic>;
  using Viscous = Corotational<Local>;

 public:
  using typename History::Strain;  ///< l θ1, l θ2 against the chord, and l ε [m]

  /// @param parts  BeamElements, elastic, here and below
  template <class Parts>
  Viscosity(const Beam& beam, int elements, const Parts& parts)
      : History(beam.damping(), elements), elastic_(elements), viscous_(elements) {
    for (int e = 0; e < elements; ++e) elastic_[e] = parts.properties()[e];
  }

  /// At rest in the present shape.
  template <class Parts>
  void relax(const Parts& parts) noexcept {
    this->relax_at([&](int e) { return strain(e, parts.displacements(e)); });
  }
  /// Sets κ and ε° of a stage.
  template <class Step, class Parts>
  void aim(int stage, const Step& step, const Parts&) noexcept {
    this->aim_at(stage, step, [this](int e, const Strain& pulls) {
      const S stiffer = this->stiffer();
      const Strain natural = pulls / stiffer;
      auto p = elastic_[e];
      for (S ElementProperties<S>::*stiffness :
           {&ElementProperties<S>::axial_stiffness, &ElementProperties<S>::axial_per_length,
            &ElementProperties<S>::bending_per_length3, &ElementProperties<S>::taper11,
            &ElementProperties<S>::taper12, &ElementProperties<S>::taper22})
        p.*stiffness *= stiffer;
      p.natural_a = natural[0], p.natural_b = natural[1];
      p.natural_stretch = natural[2] - longer(p, natural[0], natural[1]);
      viscous_[e] = p;
    });
  }
  /// Adds its part of an element's residual and tangent.   @param d  displacements of its nodes   @return [J]
  virtual S add(int e, const Vector6<S>& d, Vector6<S>& r, Matrix6<S>& K) const noexcept {
    Vector6<S> force;
    Matrix6<S> stiffness;
    const S energy = Viscous::tangent(viscous_[e], d, force, stiffness);
    r += force, K += stiffness;
    return energy;
  }
  /// To be called where the stage has been solved.
  template <class Parts>
  void know(int stage, const Parts& parts) noexcept {
    this->know_at(stage, [&](int e) { return strain(e, parts.displacements(e)); });
  }
  /// What the branches hold [J].
  S energy() const noexcept {
    S sum = 0;
    for (int e = 0; e < this->size(); ++e) {
      auto p = elastic_[e];
      p.natural_a = p.natural_b = p.natural_stretch = 0;
      sum += this->stored(e, [&p](const Strain& h) {
        return Local::respond(p, Deformation<S>(h[2] - longer(p, h[0], h[1]), h[0], h[1])).energy;
      });
    }
    return sum;
  }

 private:
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

  PerNode<ElementProperties<S>, Elements, MaxElements> elastic_, viscous_;
};

}  // namespace hapbeam::detail
