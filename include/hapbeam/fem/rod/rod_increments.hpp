// SPDX-License-Identifier: MIT
// The increments of all nodes of a rod side by side, in the order in which its chain is solved from both ends.
//
// Allocates at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/solver/pair_order.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// @tparam Unknowns  of a node
template <typename Scalar, int Elements, int MaxElements, int Unknowns>
class RodIncrements {
 public:
  using Vector = VectorOf<Scalar, Unknowns>;
  using Wide = Pack<Scalar>;
  static constexpr int lanes = Wide::size;

  explicit RodIncrements(int elements) : order_{elements}, groups_(groups_of<Scalar>(elements)) {}

  /// From an assembler that has solved for them.
  template <class Assembler>
  void take(const Assembler& assembler) noexcept {
    for (int first = 0; first <= order_.last_node(); first += lanes)
      assembler.increments(first, groups_[first / lanes].x);
    const int last = order_.last_node();
    auto& x = groups_[last / lanes].x;
    for (int k = 0; k < Unknowns; ++k)
      for (int place = last; place <= end(); ++place) x[k][place % lanes] = x[k][(last - 1) % lanes];
  }
  /// Of a node with unknowns of its own.
  void set(int node, const Vector& x) noexcept {
    const auto put = [&](int place) {
      for (int k = 0; k < Unknowns; ++k) groups_[place / lanes].x[k][place % lanes] = x[k];
    };
    const int place = order_.node_place(node), last = order_.last_node();
    put(place);
    if (place + 1 == last)
      for (int again = last; again <= end(); ++again) put(again);
  }
  Vector operator[](int node) const noexcept {
    const int place = order_.node_place(node);
    Vector x;
    for (int k = 0; k < Unknowns; ++k) x[k] = groups_[place / lanes].x[k][place % lanes];
    return x;
  }

  /// Calls f(nodes, increments) for a few nodes at a time: which they are, and k -> of their unknown k.
  template <class F>
  [[gnu::always_inline]] void visit(F&& f) const noexcept {
    for_each_abreast<Scalar>(order_.last_node(), [&](const auto& places) {
      const int first = places.of[0];
      auto nodes = places;
      order_.nodes_from(first, nodes.of);
      f(nodes, [&](int k) {
        return std::decay_t<decltype(places)>::Wide::load(groups_[first / lanes].x[k] + first % lanes);
      });
    });
  }
  /// Of both nodes of the elements from a place on.   @param x  out
  template <class Both>
  [[gnu::always_inline]] void of_elements(int first, Both& x) const noexcept {
    const auto &here = groups_[first / lanes].x, &next = groups_[first / lanes + 1].x;
    HAPBEAM_UNROLL
    for (int k = 0; k < Unknowns; ++k) {
      const Wide outer = Wide::load(here[k]), inner = before(outer, next[k]);
      x[k] = in_turn(outer, inner), x[Unknowns + k] = in_turn(inner, outer);
    }
  }

 private:
  /// The middle node stands twice, and behind that once more as far as it is computed: to here.
  int end() const noexcept {
    const int last = order_.last_node();
    return last % lanes == 1 ? last : last / lanes * lanes + lanes - 1;
  }

  struct alignas(sizeof(Wide)) Group {
    Scalar x[Unknowns][lanes] = {};
  };
  PairOrder order_;
  PerNode<Group, groups_of<Scalar>(Elements), groups_of<Scalar>(MaxElements)> groups_;
};

}  // namespace hapbeam::detail
