// SPDX-License-Identifier: MIT
// The inertia of a rod as a step of time sees it: a spring to where it would be without force (dynamics.hpp).
//
// In places and tangents it is linear.  A node that has a director turns about its tangent by ψ, against the director that is carried from the
// beginning of a stage by the smallest rotation:
//
//   ρ I_p ψ'²/2,   ∂ψ/∂φ = 1,   ∂ψ/∂r' = holonomy()
//
// What a chain calls is virtual, as of Inertia.
//
// What is viscous in a rod that moves: in a stage of its step the elements themselves are stiffer, and bent by nature.
//
//   E (ε - ε0) + E κ (ε - ε°) = E (1 + κ) (ε - (ε0 + κ ε°)/(1 + κ))      ε0: natural
//
// Strains are curvatures and twist at both Gauss points of an element, and stretch at its ends and middle (viscosity.hpp).  They are TwistedRod's:
// where a bend turns in its section the moment is not along the curvature, and twists a rod that nothing else does (docs/decisions/viscous_rods.md):
//
//   T' = M·t'      t: tangent
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
#pragma once

#include <hapbeam/check.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/mass_blocks.hpp>
#include <hapbeam/fem/rod/end_path.hpp>
#include <hapbeam/fem/viscosity.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// @tparam Unknowns  of a node: 6, or 7 with φ
template <typename S, int Elements, int MaxElements, int Unknowns, class Assembler>
class RodInertia : public MassBlocks<S, 3, Elements, MaxElements, Unknowns - 6> {
  using Base = MassBlocks<S, 3, Elements, MaxElements, Unknowns - 6>;
  using Base::blocks_, Base::ghost_;
  static constexpr bool spins = Unknowns == 7;
  using Nodes = PerNode<RodNode<S>, Elements, MaxElements>;

 public:
  using typename Base::Placed, typename Base::Values;

  template <class At>
  RodInertia(const Rod& rod, int elements, At&& at)
      : Base(rod, elements, at), at_(elements), from_(elements), turned_(elements) {}

  /// To be called where a stage begins.   @param start  (i) -> Placed of node i
  template <class Start>
  void begin_stage(const Nodes& nodes, Start&& start) noexcept {
    if constexpr (spins)
      for (int i = 0; i < nodes.size(); ++i) {
        from_[i] = nodes[i], turned_[i] = start(i)[6];
        from_[i].tangent = unit(nodes[i].tangent);
      }
  }
  /// Place, tangent and ψ of each node, as they lie now.
  const Values& find(const Nodes& nodes) noexcept {
    for (int i = 0; i < nodes.size(); ++i) at_[i] = at(nodes, i);
    return at_;
  }
  /// c M (q - q~) of node i, as they lie: on its unknowns, [N], [N·m].
  Placed force(const Nodes& nodes, int i) const noexcept {
    Placed f = this->product(i, [&](int k) { return Placed(at(nodes, k) - ghost_[k]); });
    if constexpr (spins) f.template segment<3>(3) += f[6] * holonomy<S>(from_[i].tangent, nodes[i].tangent);
    return f;
  }
  /// Adds itself to the equations, after all elements are in.   @return ½ c |q - q~|² [J]
  virtual S add(const Nodes& nodes, Assembler& assembler) noexcept {
    find(nodes);
    S sum = 0;
    this->each_product([this](int i) HAPBEAM_INLINED { return Placed(at_[i] - ghost_[i]); },
                       [&](int i, const Placed& off, const Placed& force) HAPBEAM_INLINED {
                         sum += off.dot(force);
                         const auto& own = blocks_[i].own;
                         assembler.add_even(i, own.own[0], own.other[0], own.own[3], force);
                         if (i + 1 < blocks_.size()) {
                           const auto& next = blocks_[i].next;
                           assembler.couple_even(i, next.own[0], next.other[0], next.other[3], next.own[3]);
                         }
                         if constexpr (spins) add_spin(i, nodes[i].tangent, force[6], assembler);
                       });
    return sum / 2;
  }

 private:
  Placed at(const Nodes& nodes, int i) const noexcept {
    Placed q;
    q.template head<3>() = nodes[i].r, q.template segment<3>(3) = nodes[i].tangent;
    if constexpr (spins) {
      const VectorOf<S, 3> u = unit(nodes[i].tangent);
      q[6] = turned_[i] +
             angle_about(u, across(carry(from_[i].director, from_[i].tangent, u), u), nodes[i].director);
    }
    return q;
  }
  /// @param moment  on ψ [N·m]
  void add_spin(int i, const VectorOf<S, 3>& tangent, S moment, Assembler& assembler) noexcept {
    const S own = blocks_[i].own.own[6];
    const VectorOf<S, 3>& from = from_[i].tangent;
    const VectorOf<S, 3> k = holonomy(from, tangent);
    Placed r = Placed::Zero();
    r.template segment<3>(3) = moment * k, r[6] = moment;
    Eigen::Matrix<S, Unknowns, Unknowns> K = Eigen::Matrix<S, Unknowns, Unknowns>::Zero();
    K.template block<3, 3>(3, 3) = own * k * k.transpose() - moment * holonomy_change(from, tangent);
    K.template block<1, 3>(6, 3) = own * k.transpose(), K(6, 6) = own;
    assembler.add_at(i, K, r);
    // Of neighbours by ψ alone: their tangents turn little in a stage.
    if (i + 1 < blocks_.size()) assembler.couple_at(i, 6, 6, blocks_[i].next.own[6]);
  }

  Values at_;                                 // q
  Nodes from_;                                // where the stage begins; their tangents are unit
  PerNode<S, Elements, MaxElements> turned_;  // ψ there
};

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
      refuse(
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
