// SPDX-License-Identifier: MIT
// The elements of a rod side by side in the lanes of registers: their order, and what each is made of.
//
// Real-time: noexcept, no allocation after construction, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/solver/pair_order.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

/// Properties of elements in the order of PairOrder.  An empty place has another element, once more.
template <typename Scalar, int Elements, int MaxElements>
class RodAbreast {
  using Wide = Pack<Scalar>;
  static constexpr int lanes = Wide::size;

 public:
  explicit RodAbreast(int elements) : order_{elements}, wide_(elements) {}

  const PairOrder& order() const noexcept { return order_; }
  /// Of the elements from a place on that is a multiple of the lanes.
  const RodProperties<Wide>& properties(int first) const noexcept { return wide_[first / lanes]; }
  Abreast<Scalar> elements(int first) const noexcept {
    Abreast<Scalar> which;
    order_.elements_from(first, which.of);
    return which;
  }
  /// Lays an element's properties beside those of its neighbours.
  void take(int e, const RodProperties<Scalar>& from) noexcept {
    fill(e, [&](auto&& set, RodProperties<Wide>& to) {
      to.number = from.number, to.round = from.round;
      set(to.axial, from.axial), set(to.torsion, from.torsion);
      for (int i = 0; i < 3; ++i) {
        auto& point = to.points[i];
        set(point.bending1, from.points[i].bending1), set(point.bending2, from.points[i].bending2);
        set(point.torsion, from.points[i].torsion);
        for (int j = 0; j < 3; ++j) set(point.natural[j], from.points[i].natural[j]);
        set(to.natural_strain[i], from.natural_strain[i]);
      }
    });
    take_length(e, from);
  }

 private:
  void take_length(int e, const RodProperties<Scalar>& from) noexcept {
    fill(e, [&](auto&& set, RodProperties<Wide>& to) {
      set(to.length, from.length), set(to.inverse_length, from.inverse_length);
    });
  }

  /// Calls put(set, properties) for an element's lane, and for all others in which it stands.
  template <class Put>
  void fill(int e, Put&& put) noexcept {
    const auto at = [&](int place) {
      put([place](Wide& wide, Scalar value) { wide.set(place % lanes, value); }, wide_[place / lanes]);
    };
    const int place = order_.place(e), last = 2 * order_.pairs() - 1;
    at(place);
    if (e == 0 && order_.odd()) at(0);
    if (place == last)
      for (int k = last + 1; k % lanes != 0; ++k) at(k);
  }

  PairOrder order_;
  PerNode<RodProperties<Wide>, Elements, MaxElements> wide_;
};

}  // namespace hapbeam::detail
