// SPDX-License-Identifier: MIT
// What is viscous in a rod that moves: in a stage of its step the elements themselves are stiffer, and bent by nature.
//
//   E (ε - ε0) + E κ (ε - ε°) = E (1 + κ) (ε - (ε0 + κ ε°)/(1 + κ))      ε0: natural
//
// Strains are curvatures and twist at both Gauss points of an element, and stretch at its ends and middle (viscous_history.hpp).  They are TwistedRod's:
// where a bend turns in its section the moment is not along the curvature, and twists a rod that nothing else does (docs/decisions/viscous_rods.md):
//
//   T' = M·t'      t: tangent
//
// Allocates and throws at construction.  Real-time: all else is noexcept and allocation-free, O(n).
#pragma once

#include <stdexcept>

#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/motion/viscous_history.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::detail {

template <class Element, typename S, int Elements, int MaxElements>
class ViscousRod : public ViscousHistory<S, 9, Elements, MaxElements> {
  using History = ViscousHistory<S, 9, Elements, MaxElements>;
  using Properties = RodProperties<S>;

 public:
  using typename History::Strain;  ///< κ1, κ2, τ of both points [1/m], ε at ξ = 0, ½, 1

  /// @param parts  RodElements, elastic
  /// @throws std::invalid_argument of a RoundRod
  template <class Parts>
  ViscousRod(const Rod& rod, int elements, const Parts& parts)
      : History(rod.damping(), elements), elastic_(elements), viscous_(elements) {
    if (!this->none() && Element::unknowns != 7)
      throw std::invalid_argument(
          "rod damping: a viscous rod twists where its bend turns, and RoundRod does not; take TwistedRod");
    for (int e = 0; e < elements; ++e) viscous_[e] = elastic_[e] = parts.properties(e);
  }

  /// At rest in the present shape.   @param parts  in and out: elastic again
  template <class Parts>
  void relax(Parts& parts) noexcept {
    for (int e = 0; e < this->size(); ++e) parts.set_properties(e, viscous_[e] = elastic_[e]);
    this->relax_at([&](int e) { return strain(e, parts); });
  }
  /// Sets the elements of a stage.
  template <class Step, class Parts>
  void aim(int stage, const Step& step, Parts& parts) noexcept {
    this->aim_at(stage, step, [&](int e, const Strain& pulls) {
      const S all = 1 + this->stiffer();
      Properties& p = viscous_[e] = elastic_[e];
      p.axial *= all, p.torsion *= all, p.soft[0] /= all, p.soft[1] /= all;
      for (auto& point : p.points) point.bending1 *= all, point.bending2 *= all, point.torsion *= all;
      set_natural((natural(elastic_[e]) + pulls) / all, p);
      parts.set_properties(e, p);
    });
  }
  /// To be called where the stage has been solved.
  template <class Parts>
  void know(int stage, const Parts& parts) noexcept {
    this->know_at(stage, [&](int e) { return strain(e, parts); });
  }
  /// What the rod holds, over what its elements as they are say of that [J].
  S energy() const noexcept {
    S sum = 0;
    for (int e = 0; e < this->size(); ++e) {
      const Properties &p = elastic_[e], &q = viscous_[e];
      const Strain& now = this->strain_of(e);
      sum += energy(p, Strain(now - natural(p))) - energy(q, Strain(now - natural(q))) +
             this->stored(e, [&](const Strain& h) { return energy(p, h); });
    }
    return sum;
  }

 private:
  template <class Parts>
  Strain strain(int e, const Parts& parts) const noexcept {
    if constexpr (Element::unknowns == 7) {
      Properties p = elastic_[e];
      Element::take_natural(parts.nodes()[e], parts.nodes()[e + 1], parts.own(e).twist.value, p);
      return natural(p);
    } else {
      return Strain::Zero();
    }
  }
  static Strain natural(const Properties& p) noexcept {
    Strain all;
    for (int k = 0; k < 3; ++k)
      all[k] = p.points[0].natural[k], all[3 + k] = p.points[1].natural[k], all[6 + k] = p.natural_strain[k];
    return all;
  }
  static void set_natural(const Strain& all, Properties& p) noexcept {
    for (int k = 0; k < 3; ++k)
      p.points[0].natural[k] = all[k], p.points[1].natural[k] = all[3 + k], p.natural_strain[k] = all[6 + k];
  }
  /// Of an element that is strained by so much.
  static S energy(const Properties& p, const Strain& off) noexcept {
    S twice = 0;
    for (int g = 0; g < 2; ++g) {
      const auto& at = p.points[g];
      const S k1 = off[3 * g], k2 = off[3 * g + 1], t = off[3 * g + 2];
      twice += S(two_points.weight[g]) * (at.bending1 * k1 * k1 + at.bending2 * k2 * k2 + at.torsion * t * t);
    }
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) twice += p.axial * S(quadratic_mass[i][k]) * off[6 + i] * off[6 + k];
    return p.length * twice / 2;
  }

  PerNode<Properties, Elements, MaxElements> elastic_, viscous_;
};

}  // namespace hapbeam::detail
