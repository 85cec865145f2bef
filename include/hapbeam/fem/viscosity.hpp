// SPDX-License-Identifier: MIT
// What is viscous in a beam that moves: in a stage of its step an element beside the elastic one, stiffer or softer, that is bent by nature.
//
// Its strains are the stretch and the bending of an element, by the cubic (viscous_history.hpp).
// What a chain calls is virtual, as of Inertia.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(n).
#pragma once

#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/motion/viscous_history.hpp>

namespace hapbeam::detail {

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
