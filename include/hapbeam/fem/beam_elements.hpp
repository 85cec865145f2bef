// SPDX-License-Identifier: MIT
// The elements of one beam on a mesh that stays: displacements, strain energy, dead loads, and their derivatives.
//
// Displacements are those from the straight beam, of arches too.  The tension of each element is an unknown where the element has one.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/beam_pieces.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/pack.hpp>
#include <hapbeam/fem/beam_loads.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/section_cut.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class BeamElements {
 public:
  using Scalar = ScalarType;
  using Node = CentrelineNode<Scalar>;
  using Nodes = detail::PerNode<Node, Elements, MaxElements>;
  using Properties = detail::PerNode<ElementProperties<Scalar>, Elements, MaxElements>;
  using Inners = detail::PerNode<Scalar, Elements, MaxElements>;
  using Pieces = detail::BeamPieces<Element, Scalar>;
  /// Whether the tensions of the elements are unknowns, which move with the nodes.
  static constexpr bool has_tensions = has_own_tension<Element>;
  static constexpr int own_unknowns = 1;  // a touched element has one whatever it is made of
  static_assert(
      is_element<Element, Scalar>,
      "an Element needs static noexcept energy(p, d), residual(p, d, r), tangent(p, d, r, K) and name(): "
      "see hapbeam/element/element.hpp");

  /// At rest on the x axis.  @throws std::invalid_argument where a load is not finite somewhere on the beam, elements
  /// does not fit the type, or the section changes and Element does not take that
  BeamElements(const Beam& beam, int elements)
      : nodes_(elements),
        properties_(elements),
        tensions_(elements),
        abreast_(elements),
        own_(detail::groups_of<Scalar>(elements)),
        loads_(beam, elements),
        pieces_(beam) {
    lay_mesh<Scalar>(beam, beam.point_loads(), elements, [this](int i, Scalar s) {
      nodes_[i] = {s, 0, 0, 0};
    });
    for (int e = 0; e < elements; ++e)
      abreast_.take(e, properties_[e] = pieces_.between(nodes_[e].s, nodes_[e + 1].s));
  }

  int size() const noexcept { return nodes_.size() - 1; }
  Nodes& nodes() noexcept { return nodes_; }
  const Nodes& nodes() const noexcept { return nodes_; }
  const Properties& properties() const noexcept { return properties_; }
  /// N of each element [N].
  Inners& inners() noexcept { return tensions_; }
  const Inners& inners() const noexcept { return tensions_; }
  /// What elements and parts of them are made of.
  const Pieces& pieces() const noexcept { return pieces_; }
  const NaturalShape<Scalar>& natural_shape() const noexcept { return pieces_.natural_shape(); }
  /// Any nodes of this beam, seen with its kinematics.
  template <class AnyNodes>
  static Centreline<Scalar> view(const AnyNodes& nodes) noexcept {
    return {nodes.data(), nodes.size(), any_rotation<Element>};
  }

  /// Those that belong to the displacements.
  void find_tensions() noexcept {
    if constexpr (has_tensions)
      for (int e = 0; e < size(); ++e) {
        OwnTension<Scalar> own;
        own.normal = tensions_[e];
        for (int k = 0; k < most_tensions; ++k) {
          (void)Element::core(properties_[e], displacements(e), own);
          own.normal += own.missing;
          if (!(std::abs(own.missing) > Scalar(1e-4) * std::abs(own.normal))) break;  // left: its square
        }
        tensions_[e] = own.normal;
      }
  }
  /// Tensions follow the nodes.   @param increments  of all nodes: ChainIncrements
  /// @return Σ |∂²Π/∂N²| (ΔN² - (ΔN - m)²), m: what N lacked: by so much the increment is longer than its nodes alone say [J]
  template <class Increments>
  [[gnu::always_inline]] Scalar follow([[maybe_unused]] const Increments& increments) noexcept {
    Wide longer = 0;
    if constexpr (has_tensions)
      for (int first = 0; first < abreast_.places(); first += lanes) {
        const auto& own = own_[first / lanes];
        const auto& p = abreast_.properties(first);
        Vector6<Wide> x;
        increments.of_elements(first, x);
        // A step far into compression, which has no bending stiffness left, leads nowhere.
        const Wide by = own.missing + own.s * (x[3] - x[0]) + own.r * (x[4] - x[1]) +
                        p.length * (own.t1 * x[2] + own.t2 * x[5]),
                   least = -larger(-own.normal, Wide(0)) - largest_push * p.bending_per_length3 * p.length,
                   next = larger(own.normal + by, least);
        abreast_.for_each_lane(first, [&](int e, int lane) { tensions_[e] = next[lane]; });
        abreast_.add(first, own.lack * (2 * by - own.missing), longer);
      }
    return total(longer);
  }
  /// What is touched follows otherwise.
  void leave([[maybe_unused]] int e) noexcept {
    if constexpr (has_tensions) own_[place(e) / lanes].lack.set(place(e) % lanes, 0);
  }
  int place(int e) const noexcept { return abreast_.order().place(e); }

  using Wide = detail::Pack<Scalar>;
  static constexpr int lanes = Wide::size;
  /// Residual and tangent of V in each element, a few at a time.   @param visit  called with (place, V [J], r, K) of those from that place on, in the order of
  /// PairOrder
  template <class Visit>
  [[gnu::always_inline]] void visit_tangents(Visit&& visit) noexcept {
    for (int first = 0; first < abreast_.places(); first += lanes) {
      Vector6<Wide> r;
      Matrix6<Wide> K;
      Wide energy = 0;
      if constexpr (goes_abreast<Element>) {
        energy = Element::tangent(abreast_.properties(first), core_abreast(first), r, K);
      } else {
        for_each_lane(first, [&](int e, int lane) {
          Vector6<Scalar> its;
          Matrix6<Scalar> stiff;
          energy.set(lane, Element::tangent(properties_[e], displacements(e), its, stiff));
          set_lane(lane, its, stiff, r, K);
        });
      }
      visit(first, energy, r, K);
    }
  }
  /// Calls f(element, lane) for those from a place on.
  template <class F>
  [[gnu::always_inline]] void for_each_lane(int first, F&& f) const noexcept {
    abreast_.for_each_lane(first, f);
  }
  /// Adds to a sum what each of those from a place on has.
  [[gnu::always_inline]] void add(int first, const Wide& each, Wide& sum) const noexcept {
    abreast_.add(first, each, sum);
  }
  /// Residual and tangent of one of them, as far as a system reads them.
  [[gnu::always_inline]] static void get_lane(int lane, const Vector6<Wide>& r, const Matrix6<Wide>& K,
                                              Vector6<Scalar>& its, Matrix6<Scalar>& stiff) noexcept {
    stiff.setZero();
    each_entry([&](int i, int j) HAPBEAM_INLINED { stiff(i, j) = K(i, j)[lane]; });
    HAPBEAM_UNROLL
    for (int k = 0; k < 6; ++k) its[k] = r[k][lane];
  }
  [[gnu::always_inline]] static void set_lane(int lane, const Vector6<Scalar>& its,
                                              const Matrix6<Scalar>& stiff, Vector6<Wide>& r,
                                              Matrix6<Wide>& K) noexcept {
    each_entry([&](int i, int j) HAPBEAM_INLINED { K(i, j).set(lane, stiff(i, j)); });
    HAPBEAM_UNROLL
    for (int k = 0; k < 6; ++k) r[k].set(lane, its[k]);
  }
  /// Whether λ times the loads are any.
  bool loaded(Scalar lambda) const noexcept { return lambda != 0 && !loads_.empty(); }
  /// Takes those of λW off residual and, where there is one, tangent.   @return work of λ times the loads on element e [J]
  Scalar subtract_loads(int e, Scalar lambda, Vector6<Scalar>& r,
                        Matrix6<Scalar>* K = nullptr) const noexcept {
    if (!loaded(lambda)) return 0;
    return hapbeam::subtract_loads<Element>(loads_, nodes_[e].s, nodes_[e + 1].s, e + 1 == size(), lambda,
                                            properties_[e], displacements(e), r, K);
  }
  /// The residual alone.
  void residual(int e, Scalar lambda, Vector6<Scalar>& r) const noexcept {
    if constexpr (has_tensions) {
      const CoreResponse<Scalar> c = core(e);
      detail::expand(properties_[e], c.s, c.r, c.t1, c.t2, r);
    } else {
      Element::residual(properties_[e], displacements(e), r);
    }
    subtract_loads(e, lambda, r);
  }
  /// What the section at s carries, in element e, which holds s.   @param thickness [m]   @param r  its forces on its nodes, less loads
  /// @param place  (s) -> node within it   @param others  as of cut_element()
  template <class Place, class Others>
  InternalForces<Scalar> internal_forces(const detail::CutAt<Scalar>& at, Scalar lambda, Scalar thickness,
                                         const Vector6<Scalar>& r, Place&& place,
                                         Others&& others) const noexcept {
    const auto on_curve = [&](Scalar s) { return detail::cut_place<Element>(place(s)); };
    const detail::SectionCut<Scalar, 2> left{{-r[0], -r[1]}, -r[2], on_curve(at.from).r};
    return detail::in_section<Element>(detail::cut_element(left, r[5], at, lambda, loads_, on_curve, others),
                                       place(at.s).theta, pieces_.stiffness(at.s), thickness);
  }
  /// [J]
  Scalar strain_energy(int e) const noexcept {
    if constexpr (has_tensions) return core(e).energy;
    else return Element::energy(properties_[e], displacements(e));
  }
  /// Of λ times the loads [J].
  Scalar work(Scalar lambda) const noexcept {
    Scalar work = 0;
    Vector6<Scalar> r = Vector6<Scalar>::Zero();
    for (int e = 0; loaded(lambda) && e < size(); ++e) work += subtract_loads(e, lambda, r);
    return work;
  }

  /// Of both nodes of an element.
  Vector6<Scalar> displacements(int e) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    return {a.u, a.w, a.theta, b.u, b.w, b.theta};
  }
  Scalar tension(int e) const noexcept { return tensions_[e]; }
  void set_tension(int e, Scalar N) noexcept { tensions_[e] = N; }
  /// N/EI, of elements that are exact under it; else none [1/m²].
  Scalar stiffening(int e) const noexcept {
    if constexpr (!has_tensions) return 0;
    const ElementProperties<Scalar>& p = properties_[e];
    return tensions_[e] / (p.bending_per_length3 * p.length * p.length * p.length);
  }
  /// As of OwnTension.
  Scalar turning() const noexcept { return turning_; }
  void set_turning(Scalar share) noexcept { turning_ = share; }

 private:
  static constexpr int most_tensions = 16;
  /// Calls f(i, j) with the lower triangles of both nodes, and with what couples the first with the second.
  template <class F>
  [[gnu::always_inline]] static void each_entry(F&& f) noexcept {
    HAPBEAM_UNROLL
    for (int j = 0; j < 3; ++j) {
      HAPBEAM_UNROLL
      for (int i = 0; i < 3; ++i) {
        if (i >= j) f(i, j), f(3 + i, 3 + j);
        f(i, 3 + j);
      }
    }
  }
  static constexpr Scalar largest_push = 8;  // in one increment [EI/l²]

  /// Of one element under its own tension.
  CoreResponse<Scalar> core(int e) const noexcept {
    OwnTension<Scalar> own;
    own.normal = tensions_[e];
    return Element::core(properties_[e], displacements(e), own);
  }
  CoreResponse<Wide> core_abreast(int first) noexcept {
    const Vector6<Wide> d = displacements_abreast(first);
    if constexpr (has_tensions) {
      auto& own = own_[first / lanes];
      own.normal = abreast_.gather(first, [this](int e) { return tensions_[e]; });
      own.turning = turning_;
      return Element::core(abreast_.properties(first), d, own);
    } else {
      return Element::core(abreast_.properties(first), d);
    }
  }
  /// The nodes of these places and of the pair behind them are those of both ends.
  [[gnu::always_inline]] Vector6<Wide> displacements_abreast(int first) const noexcept {
    const detail::PairOrder& order = abreast_.order();
    detail::Abreast<Scalar> of;
    order.nodes_from(first, of.of);
    const Node &left = nodes_[order.node((std::min)(first + lanes, order.last_node() - 1))],
               &right = nodes_[order.node((std::min)(first + lanes + 1, order.last_node()))];
    Vector6<Wide> d;
    const auto take = [&](int k, Scalar Node::*member) HAPBEAM_INLINED {
      const Scalar two[2] = {left.*member, right.*member};
      const Wide outer = detail::gather(of, [&](int i) { return nodes_[i].*member; }),
                 next = before(outer, two);
      d[k] = in_turn(outer, next), d[3 + k] = in_turn(next, outer);
    };
    take(0, &Node::u), take(1, &Node::w), take(2, &Node::theta);
    return d;
  }

  Nodes nodes_;
  Properties properties_;
  Inners tensions_;
  Scalar turning_ = 1;
  detail::ElementsAbreast<ElementProperties, Scalar, Elements, MaxElements> abreast_;
  detail::PerNode<OwnTension<Wide>, detail::groups_of<Scalar>(Elements),
                  detail::groups_of<Scalar>(MaxElements)>
      own_;  // since visit_tangents()
  DeadLoads<Scalar> loads_;
  Pieces pieces_;
};

}  // namespace hapbeam
