// SPDX-License-Identifier: MIT
// Nodes and elements of a rod side by side in the lanes of a register: what is computed of each alone is computed of a few at a time.
//
// Real-time: noexcept, no allocation after construction, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/pack_rows.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/fem/solver/pair_order.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Groups of what stands side by side in a rod, for PerNode, which has one more.
template <typename Scalar>
constexpr int groups_of(int elements) noexcept {
  return elements == Eigen::Dynamic ? Eigen::Dynamic : (std::max)(elements / pack_size<Scalar> + 1, 2);
}

/// Which nodes or elements stand side by side.
template <typename Scalar, int Size = pack_size<Scalar>>
struct Abreast {
  using Wide = Pack<Scalar, Size>;
  static constexpr int size = Size;
  int of[size];

  /// From first on.  Beyond the last one that one stands again.
  static Abreast from(int first, int last) noexcept {
    Abreast abreast;
    for (int k = 0; k < size; ++k) abreast.of[k] = (std::min)(first + k, last);
    return abreast;
  }
  /// Those so many nodes further on, none before 0 or behind the last one.
  Abreast next(int by, int last) const noexcept {
    Abreast abreast;
    for (int k = 0; k < size; ++k) abreast.of[k] = std::clamp(of[k] + by, 0, last);
    return abreast;
  }
};

/// Calls f(which) for all nodes from 0 to the last one, as many at a time as registers hold.  One or two that are left take a
/// register for two: that is the last of 8 elements.
template <typename Scalar, class F>
[[gnu::always_inline]] inline void for_each_abreast(int last, F&& f) noexcept {
  int first = 0;
  for (; first + 2 <= last; first += pack_size<Scalar>) f(Abreast<Scalar>::from(first, last));
  if (first <= last) f(Abreast<Scalar, 2>::from(first, last));
}

/// @param f  index -> number
template <typename Scalar, int Size, class F>
[[gnu::always_inline]] inline Pack<Scalar, Size> gather(const Abreast<Scalar, Size>& abreast,
                                                        F&& f) noexcept {
  return Pack<Scalar, Size>::of([&](int k) { return f(abreast.of[k]); });
}
/// Nodes as rows of numbers: s, r, tangent, director.
template <typename Scalar, int Size>
struct NodeRows {
  using Wide = Pack<Scalar, Size>;
  using Rows = PackRows<Scalar, Size>;
  using Node = RodNode<Scalar>;
  static constexpr int numbers = 10, whole = numbers / Size * Size;
  static_assert(sizeof(Node) == numbers * sizeof(Scalar), "nothing stands between the numbers of a node");
  [[gnu::always_inline]] static const Scalar* numbers_of(const Node& node) noexcept {
    return reinterpret_cast<const Scalar*>(&node);
  }
  [[gnu::always_inline]] static Scalar* numbers_of(Node& node) noexcept {
    return reinterpret_cast<Scalar*>(&node);
  }

  /// Reads the first of them.   @param column  out, number by number
  template <int Count, class Nodes>
  [[gnu::always_inline]] static void gather(const Abreast<Scalar, Size>& which, const Nodes& nodes,
                                            Wide (&column)[numbers]) noexcept {
    for (int at = 0; at < (std::min)(Count, whole); at += Size) {
      const Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + at;
      Rows::load(rows, column + at);
    }
    if constexpr (Count > whole) {
      const Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + whole;
      Rows::load_two(rows, column[whole], column[whole + 1]);
    }
  }
  /// Writes them.
  template <class Nodes>
  [[gnu::always_inline]] static void scatter(const Abreast<Scalar, Size>& which,
                                             const Wide (&column)[numbers], Nodes& nodes) noexcept {
    for (int at = 0; at < whole; at += Size) {
      Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + at;
      Rows::store(column + at, rows);
    }
    if constexpr (numbers > whole) {
      Scalar* rows[Size];
      HAPBEAM_UNROLL
      for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]) + whole;
      Rows::store_two(column[whole], column[whole + 1], rows);
    }
  }
};

/// @tparam directors  whether they matter
template <bool directors = true, typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline RodNode<Pack<Scalar, Size>> gather_nodes(const Abreast<Scalar, Size>& abreast,
                                                                       const Nodes& nodes) noexcept {
  using Wide = Pack<Scalar, Size>;
  using Vector = VectorOf<Wide, 3>;
  Wide all[10];
  NodeRows<Scalar, Size>::template gather<directors ? 10 : 7>(abreast, nodes, all);
  RodNode<Wide> node{all[0], Vector(all[1], all[2], all[3]), Vector(all[4], all[5], all[6]), Vector::Zero()};
  if constexpr (directors) node.director = Vector(all[7], all[8], all[9]);
  return node;
}
template <typename Scalar, int Size, class Nodes>
[[gnu::always_inline]] inline void scatter_nodes(const Abreast<Scalar, Size>& abreast,
                                                 const RodNode<Pack<Scalar, Size>>& node,
                                                 Nodes& nodes) noexcept {
  const auto &r = node.r, &t = node.tangent, &d = node.director;
  const Pack<Scalar, Size> all[10] = {node.s, r[0], r[1], r[2], t[0], t[1], t[2], d[0], d[1], d[2]};
  NodeRows<Scalar, Size>::scatter(abreast, all, nodes);
}

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
      to.number = from.number, to.round = from.round, to.taut = from.taut, to.swings = from.swings;
      set(to.length, from.length), set(to.inverse_length, from.inverse_length);
      set(to.axial, from.axial), set(to.torsion, from.torsion);
      set(to.soft[0], from.soft[0]), set(to.soft[1], from.soft[1]);
      for (int i = 0; i < 3; ++i) {
        auto& point = to.points[i];
        set(point.bending1, from.points[i].bending1), set(point.bending2, from.points[i].bending2);
        set(point.torsion, from.points[i].torsion);
        for (int j = 0; j < 3; ++j) set(point.natural[j], from.points[i].natural[j]);
        set(to.natural_strain[i], from.natural_strain[i]);
      }
    });
  }

 private:
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

/// The increments of all nodes, in the order in which their chain is solved from both ends.   @tparam Unknowns  of a node
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
    const int last = order_.last_node(), again = last % lanes, end = this->end() % lanes;
    auto& x = groups_[last / lanes].x;
    for (int k = 0; k < Unknowns; ++k)
      for (int lane = again; lane <= end; ++lane) x[k][lane] = x[k][again - 1];
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
