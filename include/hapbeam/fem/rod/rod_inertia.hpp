// SPDX-License-Identifier: MIT
// The inertia of a rod whose nodes have places and tangents alone, as a step of time sees it: a spring to where it would be without force
// (dynamics.hpp), linear in what its nodes have.
//
// A section that turns about the tangent has no inertia.
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
#pragma once

#include <hapbeam/fem/mass_blocks.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

template <typename S, int Elements, int MaxElements>
class RodInertia : public MassBlocks<S, 3, Elements, MaxElements> {
  using Base = MassBlocks<S, 3, Elements, MaxElements>;
  using Base::blocks_, Base::ghost_;

 public:
  using typename Base::Placed, typename Base::Values;

  template <class At>
  RodInertia(const Rod& rod, int elements, At&& at) : Base(rod, elements, at), at_(elements) {}

  /// Place and tangent of each node, as they lie now.
  template <class Nodes>
  const Values& find(const Nodes& nodes) noexcept {
    for (int i = 0; i < nodes.size(); ++i) at_[i] << nodes[i].r, nodes[i].tangent;
    return at_;
  }
  /// c M (q - q~) of node i, as they lie: on r [N] and on r' [N·m].
  template <class Nodes>
  Placed force(const Nodes& nodes, int i) const noexcept {
    return this->product(i, [&](int k) {
      Placed at;
      at << nodes[k].r, nodes[k].tangent;
      return Placed(at - ghost_[k]);
    });
  }
  /// Adds itself to the equations, after all elements are in.   @return ½ c |q - q~|² [J]
  template <class Nodes, class Assembler>
  S add(const Nodes& nodes, Assembler& assembler) noexcept {
    find(nodes);
    S sum = 0;
    this->each_product([this](int i) HAPBEAM_INLINED { return Placed(at_[i] - ghost_[i]); },
                       [&](int i, const Placed& off, const Placed& force) HAPBEAM_INLINED {
                         sum += off.dot(force);
                         assembler.add_even(i, blocks_[i].own.own[0], blocks_[i].own.other[0],
                                            blocks_[i].own.own[3], force);
                         if (i + 1 < blocks_.size()) {
                           const auto& next = blocks_[i].next;
                           assembler.couple_even(i, next.own[0], next.other[0], next.other[3], next.own[3]);
                         }
                       });
    return sum / 2;
  }

 private:
  Values at_;  // q
};

/// What is viscous in a rod: nothing.
struct Elastic {
  template <class Parts>
  Elastic(const Rod&, int, const Parts&) noexcept {}
  bool none() const noexcept { return true; }
  template <class Parts>
  void relax(const Parts&) noexcept {}
  template <class Parts>
  void know(int, const Parts&) noexcept {}
  template <typename S>
  void begin(S) noexcept {}
  void stop() noexcept {}
  void take_back() noexcept {}
  void start_again() noexcept {}
  void aim(int) noexcept {}
  int energy() const noexcept { return 0; }
};

}  // namespace hapbeam::detail
