// SPDX-License-Identifier: MIT
// The elements of one beam on a mesh that stays: displacements, strain energy, dead loads, and their derivatives.
//
// Displacements are those from the straight beam, of arches too.  The tension of each element is an unknown where the element has one.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/beam_pieces.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/pack.hpp>
#include <hapbeam/fem/beam_loads.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/section_cut.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

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
  static constexpr int own_unknowns = 1;
  static constexpr bool has_inners = true;  // a touched element has one whatever it is made of
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
        own_(detail::groups_of<Scalar>(elements)),
        loads_(beam, elements),
        pieces_(beam) {
    lay_mesh<Scalar>(beam, beam.point_loads(), elements, [this](int i, Scalar s) {
      nodes_[i] = {s, 0, 0, 0};
    });
    for (int e = 0; e < elements; ++e) properties_[e] = pieces_.between(nodes_[e].s, nodes_[e + 1].s);
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
  /// To be called where the nodes have moved.   @param increment  i -> [u, w, θ] of node i   @param skip  (e) -> whether it follows otherwise
  /// @return Σ |∂²Π/∂N²| (ΔN² - (ΔN - m)²), m: what N lacked: by so much the increment is longer than its nodes alone say [J]
  template <class Increment, class Skip>
  [[gnu::always_inline]] Scalar follow([[maybe_unused]] Increment&& increment,
                                       [[maybe_unused]] Skip&& skip) noexcept {
    Scalar longer = 0;
    if constexpr (has_tensions) {
      Vector3<Scalar> x = increment(0);
      for (int e = 0; e < size(); ++e) {
        const Vector3<Scalar> y = increment(e + 1);
        const auto& own = own_[e / Group::size];
        const int k = e % Group::size;
        const ElementProperties<Scalar>& p = properties_[e];
        const Scalar by = own.missing[k] + own.s[k] * (y[0] - x[0]) + own.r[k] * (y[1] - x[1]) +
                          p.length * (own.t1[k] * x[2] + own.t2[k] * y[2]);
        // No step goes far into compression, which has no bending stiffness left.
        if (!skip(e)) {
          const Scalar before = tensions_[e];
          tensions_[e] = (std::max)(
              before + by, (std::min)(before, Scalar(0)) - largest_push * p.bending_per_length3 * p.length);
          longer += own.lack[k] * (2 * by - own.missing[k]);
        }
        x = y;
      }
    }
    return longer;
  }

  /// Elements that are computed side by side, from the one on whose number is a multiple of their size.
  struct Group {
    using Number = std::conditional_t<goes_abreast<Element>, detail::Pack<Scalar>, Scalar>;
    static constexpr int size = goes_abreast<Element> ? detail::pack_size<Scalar> : 1;
    CoreResponse<Number> core;
  };
  /// To be called with each element, in order.
  [[gnu::always_inline]] void respond([[maybe_unused]] int e, [[maybe_unused]] Group& group) noexcept {
    if constexpr (goes_abreast<Element>)
      if (e % Group::size == 0) respond_abreast(e, group);
  }
  /// Residual and tangent of V in element e.   @param group  with which respond(e, group) was called   @return V [J]
  [[gnu::always_inline]] Scalar tangent(int e, [[maybe_unused]] const Group& group, Vector6<Scalar>& r,
                                        Matrix6<Scalar>& K) const noexcept {
    if constexpr (goes_abreast<Element>) {
      const auto& c = group.core;
      const int i = e % Group::size;
      const CoreResponse<Scalar> core{c.energy[i],
                                      c.s[i],
                                      c.r[i],
                                      c.t1[i],
                                      c.t2[i],
                                      {c.k.ss[i], c.k.sr[i], c.k.s1[i], c.k.s2[i], c.k.rr[i], c.k.r1[i],
                                       c.k.r2[i], c.k.t11[i], c.k.t12[i], c.k.t22[i]}};
      return Element::tangent(properties_[e], core, r, K);
    } else {
      return Element::tangent(properties_[e], displacements(e), r, K);
    }
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
  /// @param place  (s) -> Displacement within it   @param others  as of cut_element()
  template <class Place, class Others>
  InternalForces<Scalar> internal_forces(const detail::CutAt<Scalar>& at, Scalar lambda, Scalar thickness,
                                         const Vector6<Scalar>& r, Place&& place,
                                         Others&& others) const noexcept {
    const auto on_curve = [&](Scalar s) { return detail::cut_place<Element>(s, place(s)); };
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
  static constexpr Scalar largest_push = 8;  // in one increment [EI/l²]

  /// Of one element under its own tension.
  CoreResponse<Scalar> core(int e) const noexcept {
    OwnTension<Scalar> own;
    own.normal = tensions_[e];
    return Element::core(properties_[e], displacements(e), own);
  }
  void respond_abreast(int first, Group& group) noexcept {
    if constexpr (has_tensions) {
      auto& own = own_[first / Group::size];
      own.normal = Group::Number::of([&](int k) { return tensions_[(std::min)(first + k, size() - 1)]; });
      own.turning = turning_;
      group.core = gather(first, [&own](const auto& p, const auto& d) { return Element::core(p, d, own); });
    } else {
      group.core = gather(first, [](const auto& p, const auto& d) { return Element::core(p, d); });
    }
  }
  /// Of a group from its first element on: use(properties, displacements), side by side.
  template <class Use>
  [[gnu::always_inline]] auto gather(int first, Use&& use) const noexcept {
    using Wide = typename Group::Number;
    const auto each = [&](auto&& number) {
      return Wide::of([&](int k) { return number((std::min)(first + k, size() - 1)); });
    };
    const auto property = [&](Scalar ElementProperties<Scalar>::*member) {
      return each([&](int e) { return properties_[e].*member; });
    };
    const auto moved = [&](int by, Scalar Node::*member) {
      return each([&](int e) { return nodes_[e + by].*member; });
    };
    using P = ElementProperties<Scalar>;
    ElementProperties<Wide> p;
    p.length = property(&P::length);
    p.inverse_length = property(&P::inverse_length);
    p.axial_stiffness = property(&P::axial_stiffness);
    p.axial_per_length = property(&P::axial_per_length);
    p.bending_per_length3 = property(&P::bending_per_length3);
    if (!natural_shape().straight()) {
      p.natural_a = property(&P::natural_a);
      p.natural_b = property(&P::natural_b);
      p.natural_stretch = property(&P::natural_stretch);
    }
    const Vector6<Wide> d(moved(0, &Node::u), moved(0, &Node::w), moved(0, &Node::theta), moved(1, &Node::u),
                          moved(1, &Node::w), moved(1, &Node::theta));
    return use(p, d);
  }

  Nodes nodes_;
  Properties properties_;
  Inners tensions_;
  Scalar turning_ = 1;
  detail::PerNode<OwnTension<typename Group::Number>, detail::groups_of<Scalar>(Elements),
                  detail::groups_of<Scalar>(MaxElements)>
      own_;  // since respond()
  DeadLoads<Scalar> loads_;
  Pieces pieces_;
};

}  // namespace hapbeam
