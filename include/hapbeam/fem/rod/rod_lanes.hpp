// SPDX-License-Identifier: MIT
// Nodes and elements of a chain side by side in the lanes of a register: what is computed of each alone is computed of a few at a time.
//
// Real-time: noexcept, no allocation after construction, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/element/element.hpp>
#include <hapbeam/element/pack_rows.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// Groups of what stands side by side in a chain, for PerNode, which has one more.
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
    const Scalar* rows[Size];
    HAPBEAM_UNROLL
    for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]);
    for (int at = 0; at < (std::min)(Count, whole); at += Size) {
      Rows::load(rows, column + at);
      for (const Scalar*& row : rows) row += Size;
    }
    if constexpr (Count > whole) Rows::load_two(rows, column[whole], column[whole + 1]);
  }
  /// Writes them.
  template <class Nodes>
  [[gnu::always_inline]] static void scatter(const Abreast<Scalar, Size>& which,
                                             const Wide (&column)[numbers], Nodes& nodes) noexcept {
    Scalar* rows[Size];
    HAPBEAM_UNROLL
    for (int k = 0; k < Size; ++k) rows[k] = numbers_of(nodes[which.of[k]]);
    for (int at = 0; at < whole; at += Size) {
      Rows::store(column + at, rows);
      for (Scalar*& row : rows) row += Size;
    }
    if constexpr (numbers > whole) Rows::store_two(column[whole], column[whole + 1], rows);
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

/// Lays the properties of an element in a lane.
template <typename Wide, typename Scalar>
void set_lane(RodProperties<Wide>& to, int lane, const RodProperties<Scalar>& from) noexcept {
  to.number = from.number, to.round = from.round, to.taut = from.taut, to.swings = from.swings;
  to.length.set(lane, from.length), to.inverse_length.set(lane, from.inverse_length);
  to.axial.set(lane, from.axial), to.torsion.set(lane, from.torsion);
  to.soft[0].set(lane, from.soft[0]), to.soft[1].set(lane, from.soft[1]);
  for (int i = 0; i < 3; ++i) {
    auto& point = to.points[i];
    point.bending1.set(lane, from.points[i].bending1), point.bending2.set(lane, from.points[i].bending2);
    point.torsion.set(lane, from.points[i].torsion);
    for (int j = 0; j < 3; ++j) point.natural[j].set(lane, from.points[i].natural[j]);
    to.natural_strain[i].set(lane, from.natural_strain[i]);
  }
}
template <typename Wide, typename Scalar>
void set_lane(ElementProperties<Wide>& to, int lane, const ElementProperties<Scalar>& from) noexcept {
  to.length.set(lane, from.length), to.inverse_length.set(lane, from.inverse_length);
  to.axial_stiffness.set(lane, from.axial_stiffness), to.axial_per_length.set(lane, from.axial_per_length);
  to.bending_per_length3.set(lane, from.bending_per_length3);
  to.natural_a.set(lane, from.natural_a), to.natural_b.set(lane, from.natural_b);
  to.natural_stretch.set(lane, from.natural_stretch);
}

/// Elements in the order of PairOrder, and their properties.  An empty place has another element, once more.
/// @tparam Properties  RodProperties | ElementProperties
template <template <typename> class Properties, typename Scalar, int Elements, int MaxElements>
class ElementsAbreast {
  using Wide = Pack<Scalar>;

 public:
  static constexpr int lanes = Wide::size;

  explicit ElementsAbreast(int elements) : order_{elements}, wide_(elements) {}

  const PairOrder& order() const noexcept { return order_; }
  int places() const noexcept { return 2 * order_.pairs(); }
  /// Of the elements from a place on that is a multiple of the lanes.
  const Properties<Wide>& properties(int first) const noexcept { return wide_[first / lanes]; }
  /// Of one number of each element.   @param f  element -> number
  template <class F>
  [[gnu::always_inline]] Wide gather(int first, F&& f) const noexcept {
    Abreast<Scalar> which;
    order_.elements_from(first, which.of);
    return detail::gather(which, f);
  }
  /// Calls f(element, lane) for those from a place on.
  template <class F>
  [[gnu::always_inline]] void for_each_lane(int first, F&& f) const noexcept {
    for (int lane = 0; lane < lanes && first + lane < places(); ++lane)
      if (const int e = order_.element(first + lane); e >= 0) f(e, lane);
  }
  /// Adds to a sum what each of those from a place on has.
  [[gnu::always_inline]] void add(int first, const Wide& each, Wide& sum) const noexcept {
    if (first + lanes <= places() && order_.element(first) >= 0) sum += each;
    else for_each_lane(first, [&](int, int lane) { sum.set(lane, sum[lane] + each[lane]); });
  }
  /// Lays an element's properties beside those of its neighbours.
  void take(int e, const Properties<Scalar>& from) noexcept {
    const auto at = [&](int place) { set_lane(wide_[place / lanes], place % lanes, from); };
    const int place = order_.place(e), last = places() - 1;
    at(place);
    if (e == 0 && order_.odd()) at(0);
    if (place == last)
      for (int k = last + 1; k % lanes != 0; ++k) at(k);
  }

 private:
  PairOrder order_;
  PerNode<Properties<Wide>, Elements, MaxElements> wide_;
};

/// The increments of all nodes, in the order in which their chain is solved from both ends.   @tparam Unknowns  of a node
template <typename Scalar, int Elements, int MaxElements, int Unknowns>
class ChainIncrements {
 public:
  using Vector = VectorOf<Scalar, Unknowns>;
  using Wide = Pack<Scalar>;
  static constexpr int lanes = Wide::size;

  explicit ChainIncrements(int elements) : order_{elements}, groups_(groups_of<Scalar>(elements)) {}

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

  /// Calls f(node, increment) for each node.
  template <class F>
  [[gnu::always_inline]] void for_each_node(F&& f) const noexcept {
    const auto at = [&](int node, const Group& group, int lane) HAPBEAM_INLINED {
      Vector x;
      HAPBEAM_UNROLL
      for (int k = 0; k < Unknowns; ++k) x[k] = group.x[k][lane];
      f(node, x);
    };
    int j = 0;
    for (const Group& group : groups_) {
      HAPBEAM_UNROLL
      for (int lane = 0; lane < lanes; lane += 2, ++j) {
        if (j >= order_.odd() && j <= order_.pairs()) at(j - order_.odd(), group, lane);
        if (j < order_.pairs()) at(order_.elements - j, group, lane + 1);
      }
    }
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
