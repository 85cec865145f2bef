// SPDX-License-Identifier: MIT
// The inertia of a rod as a step of time sees it: a spring to where it would be without force (dynamics.hpp).
//
// In places and tangents it is linear.  A node that has a director turns about its tangent by ψ, against the director that is carried from the
// beginning of a stage by the smallest rotation:
//
//   ρ I_p ψ'²/2,   ∂ψ/∂φ = 1,   ∂ψ/∂r' = holonomy()
//
// What a chain calls is virtual, as of Inertia.
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
#pragma once

#include <hapbeam/fem/mass_blocks.hpp>
#include <hapbeam/fem/rod/end_path.hpp>
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

}  // namespace hapbeam::detail
