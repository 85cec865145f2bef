// SPDX-License-Identifier: MIT
// The elements of one rod on a mesh that stays: where its nodes are and what each element is made of, strain energy, dead loads,
// foundations, and their derivatives; and what a section carries.
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/body/cut_piece.hpp>
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/body/rod_profile.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_tangent.hpp>
#include <hapbeam/element/rod/round_tension.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/rod/rod_loads.hpp>
#include <hapbeam/fem/rod/rod_moments.hpp>
#include <hapbeam/fem/section_cut.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodElements {
 public:
  using Scalar = ScalarType;
  using Node = RodNode<Scalar>;
  using Nodes = detail::PerNode<Node, Elements, MaxElements>;
  static constexpr int unknowns = Element::unknowns;
  /// Unknowns of their own: tensions N [N] of all elements, and behind them twists ψ [rad].
  static constexpr int own_unknowns = unknowns == 7 ? 2 : 1;
  using Inners = detail::PerNode<Scalar, detail::times(Elements, own_unknowns),
                                 detail::times(MaxElements, own_unknowns)>;
  static constexpr bool has_tensions = false;
  using Inner = typename Element::template Inner<Scalar>;
  using Residual = Eigen::Matrix<Scalar, 2 * unknowns, 1>;
  using Tangent = Eigen::Matrix<Scalar, 2 * unknowns, 2 * unknowns>;

  /// In its natural shape.  @throws std::invalid_argument where a load or a section makes no sense somewhere on the rod, or
  /// elements does not fit the type, or the element does not model such a rod
  RodElements(const Rod& rod, int elements)
      : nodes_(elements),
        inner_(own_unknowns * elements),
        properties_(elements),
        abreast_(elements),
        natural_(rod),
        profile_(rod),
        loads_(rod, elements),
        bed_(rod, elements),
        inners_abreast_(detail::groups_of<Scalar>(elements)),
        surface_(rod) {
    if constexpr (!has_twist)
      if (!rod.arcs().empty() || !profile_.round())
        detail::refuse(
            "rod: RoundRod takes rods that are straight by nature, with one bending stiffness for all "
            "directions; take TwistedRod");
    if constexpr (has_twist)
      if (!rod.holds_twist())
        detail::refuse("supports = %s, %s: TwistedRod turns about its axis, hold its twist at one end",
                       name(rod.left()), name(rod.right()));
    const bool even = natural_.straight() && profile_.smooth(),
               viscous = has_twist && rod.damping().viscous();
    round_ = even && profile_.round() && !viscous;
    own_ = {rod.drawn() && even && !viscous, has_twist && !round_};
    lay_mesh<Scalar>(rod, rod.forces(), elements, [this](int i, Scalar s) { nodes_[i] = natural_.at(s); });
    moments_ = {rod, unknowns, natural_, nodes_};
    for (int e = 0; e < elements; ++e) make(e);
    if (!loads_.empty()) loads_.take(view(nodes_));
  }

  /// From here on its elements bend under tension as the cubics of its mass do.
  void swing() noexcept {
    for (int e = 0; e < size(); ++e) properties_[e].swings = true, abreast_.take(e, properties_[e]);
  }
  /// What an element is made of, from here on.
  void set_properties(int e, const RodProperties<Scalar>& p) noexcept {
    abreast_.take(e, properties_[e] = p);
  }
  int size() const noexcept { return nodes_.size() - 1; }
  Nodes& nodes() noexcept { return nodes_; }
  const Nodes& nodes() const noexcept { return nodes_; }
  /// Each is 0 where it is no unknown.
  Inners& inners() noexcept { return inner_; }
  const Inners& inners() const noexcept { return inner_; }
  /// Whether elements have a tension of their own.
  bool taut() const noexcept { return own_.tension; }
  /// N (1 + N/EA)/EI, where elements have a tension of their own [1/m²].
  Scalar stiffening(int e) const noexcept {
    const RodProperties<Scalar>& p = properties_[e];
    return taut() ? inner_[e] * (1 + inner_[e] / p.axial) * p.softest() : Scalar(0);
  }
  /// Whether an element is drawn so taut that its curve is no cubic any more, and does not know that: it has no tension of its own, swings, or is bent about
  /// its stiffer axis.  The error of a press within it may exceed 1 %.   @param s  of the press [m]   @param normal  along which
  bool overdrawn(int e, Scalar s, const VectorOf<Scalar, 3>& normal) const noexcept {
    constexpr Scalar aside = Scalar(0.01);
    const RodProperties<Scalar>& p = properties_[e];
    const bool exact = taut() && !p.swings;
    if ((exact && p.soft[0] == p.soft[1]) || !overdrawn(e)) return false;
    if (!exact) return true;
    const Node there = node_within(e, s);
    const VectorOf<Scalar, 3> u = detail::unit(there.tangent), across = normal - u * u.dot(normal),
                              stiffer = p.soft[0] > p.soft[1] ? detail::cross3(u, there.director)
                                                              : VectorOf<Scalar, 3>(there.director);
    return stiffer.dot(across) * stiffer.dot(across) > aside * across.squaredNorm();
  }
  /// Whether forces may be off by 1 %, wherever they act: it is bent by nature and an element drawn so straight, or an end is turned against a pull so that
  /// it bends within less than an element.
  bool overdrawn() const noexcept {
    for (int e = 0; e < size() && natural_.bent(); ++e)
      if (overdrawn(e)) return true;
    return turned(0, nodes_[0]) || turned(size() - 1, nodes_[size()]);
  }
  /// What an element is made of.
  const RodProperties<Scalar>& properties(int e) const noexcept { return properties_[e]; }
  template <class AnyNodes>
  static Centreline<Scalar, 3> view(const AnyNodes& nodes) noexcept {
    return {nodes.data(), nodes.size()};
  }

  /// What is an element's own, as it lies.
  Inner own(int e) const noexcept {
    Inner own;
    own.tension.value = inner_[e];
    if constexpr (has_twist) own.twist.value = inner_[size() + e];
    return own;
  }
  /// The same, and how it follows the nodes since visit_tangents().
  Inner inner(int e) const noexcept {
    const int place = abreast_.order().place(e), lane = place % lanes;
    Inner inner = own(e);
    const auto take = [lane](const auto& from, auto& to) {
      to.residual = from.residual[lane], to.stiffness = from.stiffness[lane];
      for (int i = 0; i < 2 * unknowns; ++i) to.row[i] = from.row[i][lane];
    };
    const auto& from = inners_abreast_[place / lanes];
    take(from.tension, inner.tension);
    if constexpr (has_twist) take(from.twist, inner.twist);
    return inner;
  }
  /// To be called before the nodes move.  @param increments  of all nodes: ChainIncrements   @param skip  (e) -> whether it follows otherwise
  template <class Increments, class Skip>
  void advance_inners(const Increments& increments, Skip&& skip) noexcept {
    for (int first = 0; (own_.tension || own_.twist) && first < abreast_.places(); first += lanes) {
      auto& inner = inners_abreast_[first / lanes];
      Eigen::Matrix<Wide, 2 * unknowns, 1> both;
      increments.of_elements(first, both);
      if (own_.tension) inner.tension.advance(both);
      if constexpr (has_twist)
        if (own_.twist) inner.twist.advance(both);
      abreast_.for_each_lane(first, [&](int e, int lane) {
        if (own_.tension && !skip(e)) set_tension(e, inner.tension.value[lane]);
        if constexpr (has_twist)
          if (own_.twist) inner_[size() + e] = inner.twist.value[lane];
      });
    }
  }
  /// No step goes far into compression, which has no bending stiffness left.
  void set_tension(int e, Scalar value) noexcept {
    const RodProperties<Scalar>& p = properties_[e];
    inner_[e] = (std::max)(value, (std::min)(inner_[e], Scalar(0)) -
                                      largest_push * p.inverse_length * p.inverse_length / p.softest());
  }
  /// Gives each element the twist with which its middle has a director.   @param director  (s) -> d1 there
  template <class Director>
  void find_twists([[maybe_unused]] Director&& director) noexcept {
    if constexpr (has_twist)
      for (int e = 0; own_.twist && e < size(); ++e)
        inner_[size() + e] = Element::twist_to(properties_[e], nodes_[e], nodes_[e + 1],
                                               director((nodes_[e].s + nodes_[e + 1].s) / 2));
  }
  /// Twists that belong to the shape, from about there.
  void relax_twists() noexcept {
    if constexpr (has_twist)
      for (int k = 0; own_.twist && k < most_relaxations; ++k)
        for (int first = 0; first < abreast_.places(); first += lanes) {
          WideInner inner;
          Stiffness unused;
          (void)compute(first, inner, unused);
          abreast_.for_each_lane(first, [&](int e, int lane) {
            inner_[size() + e] -= inner.twist.residual[lane] / inner.twist.stiffness[lane];
          });
        }
  }
  /// Tensions that belong to the shape.
  void find_tensions() noexcept {
    for (int e = 0; taut() && e < size(); ++e) {
      const detail::EndsAndMiddle<Scalar> at(properties_[e], nodes_[e], nodes_[e + 1]);
      for (int k = 0; k < most_tensions; ++k) {
        const detail::RoundTension<Scalar> tension(properties_[e], at, inner_[e]);
        const Scalar by = -tension.residual() / tension.stiffness();
        inner_[e] += by;
        if (!(std::abs(by) > Scalar(1e-4) * std::abs(inner_[e]))) break;  // left: its square
      }
    }
  }
  struct Energies {
    Scalar strain = 0;  ///< [J]
    Scalar work = 0;    ///< of λ times the loads [J]
    Scalar inner = 0;   ///< of the increment that inner twists make on their own [J]
  };

  /// Residual and tangent of V - λW in each element, and the derivatives of its inner twist.  Elements are computed a few at a time,
  /// side by side.   @param visit  called with (place, tangents, residuals) of those from that place on, in the order of PairOrder
  template <class Visit>
  [[gnu::always_inline]] Energies visit_tangents(Scalar lambda, Visit&& visit) noexcept {
    Energies sum;
    Wide strain = 0, own = 0;
    for (int first = 0; first < abreast_.places(); first += lanes) {
      auto& inner = inners_abreast_[first / lanes];
      Stiffness K;
      const Wide energy = compute(first, inner, K);
      abreast_.add(first, energy, strain);
      abreast_.add(first, energy_of(inner), own);
      if (loads_.empty()) {
        visit(first, K, K);
        continue;
      }
      WideResidual r;
      for (int i = 0; i < 2 * unknowns; ++i) r[i] = K[i];
      subtract_loads(first, lambda, r, sum);
      visit(first, K, r);
    }
    sum.strain += total(strain), sum.inner += total(own);
    return sum;
  }
  /// The same of a foundation, to which places matter and not their differences alone.   @param visit  called with (element, tangent, residual)   @return [J]
  template <class Visit>
  Scalar visit_foundation(Visit&& visit) const noexcept {
    Scalar energy = 0;
    for (int e = 0; !bed_.empty() && e < size(); ++e) {
      Residual r = Residual::Zero();
      Tangent K = Tangent::Zero();
      energy += bed_.template add<unknowns>(e, nodes_[e], nodes_[e + 1], r, K);
      visit(e, K, r);
    }
    return energy;
  }
  /// The same of moments at nodes.   @param visit  called with (node, tangent, residual)   @return work of λ times them [J]
  template <class Visit>
  Scalar visit_moments(Scalar lambda, Visit&& visit) noexcept {
    moments_.turn(nodes_);
    return moments_.template visit<unknowns>(lambda, nodes_, visit);
  }
  /// Whether there are any of these two.
  bool has_more() const noexcept { return !bed_.empty() || !moments_.empty(); }
  /// The residual alone of one element.
  void residual(int e, Scalar lambda, Residual& r) const noexcept {
    const int place = abreast_.order().place(e), lane = place % lanes;
    WideInner inner;
    Stiffness all;
    (void)compute(place - lane, inner, all);
    for (int i = 0; i < 2 * unknowns; ++i) r[i] = all[i][lane];
    // The equation of its tension lacks what a contact does to that.
    if (taut())
      for (int i = 0; i < 2 * unknowns; ++i)
        r[i] += inner.tension.row[i][lane] * inner.tension.residual[lane] / inner.tension.stiffness[lane];
    Tangent unused = Tangent::Zero();
    if (!bed_.empty()) (void)bed_.template add<unknowns>(e, nodes_[e], nodes_[e + 1], r, unused);
    if (!loads_.empty()) loads_.template subtract<unknowns>(e, lambda, r);
    if (!moments_.empty())
      moments_in(e, lambda, [&](int node, const auto& by) {
        r.template segment<unknowns>(node == e ? 0 : unknowns) += by;
      });
  }
  /// About a node, of what works on its unknowns.
  static VectorOf<Scalar, 3> moment(const VectorOf<Scalar, unknowns>& r,
                                    const VectorOf<Scalar, 3>& tangent) noexcept {
    VectorOf<Scalar, 3> m = detail::cross3<Scalar>(tangent, r.template segment<3>(3));
    if constexpr (has_twist) m += r[6] * detail::unit(tangent);
    return m;
  }
  /// A node where the mesh has none, in element e, which holds s.
  Node node_within(int e, Scalar s) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    const RodPoint<Scalar> at = view(nodes_).at(e, s);
    return {s, at.r, at.tangent,
            detail::across(director_within(e, (s - a.s) / (b.s - a.s)), detail::unit(at.tangent))};
  }
  /// d1 in element e.   @param t  ξ
  VectorOf<Scalar, 3> director_within(int e, Scalar t) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    if constexpr (has_twist) return Element::director(properties_[e], a, b, inner_[size() + e], t);
    else return detail::CarriedFrame<Scalar>(properties_[e], a, b).director(a.director, 0, t);
  }
  /// What the section carries, in element e.
  /// @param curve  s -> node on it   @param contacts  calls its argument with place, force and point of each of that element [m], [N]
  template <class Curve, class EachContact>
  InternalForces<Scalar, 3> internal_forces(int e, const detail::CutAt<Scalar>& at, Scalar lambda,
                                            Curve&& curve, EachContact&& contacts) const noexcept {
    using Vector3 = VectorOf<Scalar, 3>;
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    const RodProperties<Scalar>& p = properties_[e];
    using ByPlace = detail::Jet<Scalar, 1>;
    const Scalar n = stiffening(e);
    const auto cut_at = [&](Scalar x) {
      return detail::CutPiece<ByPlace>(ByPlace(p.length), ByPlace::variable(x - a.s, 0), ByPlace(n));
    };
    // As the nodes hold it, under its tension.
    const auto place_at = [&](Scalar x) {
      ByPlace h[4];
      cut_at(x).weights(p.inverse_length, h);
      detail::CutPlace<Scalar, 3> there{a.r, Vector3::Zero()};
      const auto add = [&there](const ByPlace& weight, const Vector3& to) {
        there.r += weight.value * to, there.tangent += weight.by(0) * to;
      };
      add(h[1], a.tangent), add(h[2], b.r - a.r), add(h[3], b.tangent);
      return there;
    };
    Residual r;
    residual(e, lambda, r);
    contacts([&](Scalar x, const Vector3& force, const Vector3& there) {
      const detail::CutPlace<Scalar, 3> held = place_at(x);
      ByPlace h[4];
      cut_at(x).weights(p.inverse_length, h);
      // A contact that lies off the curve of the nodes has a moment about it, which turns the tangent.
      const Scalar stretched = std::sqrt(held.tangent.squaredNorm()), f = (x - a.s) * p.inverse_length;
      const Vector3 u = held.tangent / stretched, moment = detail::cross3<Scalar>(there - held.r, force),
                    turns = detail::cross3<Scalar>(moment, u) / stretched;
      for (int q = 0; q < 4; ++q)
        r.template segment<3>(q < 2 ? 3 * q : unknowns + 3 * (q - 2)) -=
            h[q].value * force + h[q].by(0) * turns;
      if constexpr (has_twist) r[6] -= (1 - f) * u.dot(moment), r[13] -= f * u.dot(moment);
    });
    const auto curve_at = [&curve](Scalar x) {
      const Node there = curve(x);
      return detail::CutPlace<Scalar, 3>{there.r, there.tangent};
    };
    const auto moment = [&r](int row, const Vector3& tangent) -> Vector3 {
      return RodElements::moment(r.template segment<unknowns>(row), tangent);
    };
    const auto cut = detail::cut_element<Scalar, 3>(
        {-r.template segment<3>(0), -moment(0, a.tangent), a.r}, moment(unknowns, b.tangent), at, lambda,
        loads_.all(), curve_at, [&](auto& of, bool whole) {
          contacts([&](Scalar x, const Vector3& force, const Vector3& there) {
            if (whole || x < at.s) of.pass(force, there);
          });
          moments_in(e, lambda, [&](int node, const auto& by) {
            if (whole || at.passed(nodes_[node].s))
              of.moment += RodElements::moment(by, nodes_[node].tangent);
          });
          if (!bed_.empty())
            bed_.visit(a.s, whole ? b.s : at.s, natural_, [&](Scalar x, const auto& k, const Vector3& home) {
              const Vector3 there = place_at(x).r;
              of.pass(-k * (there - home), there);
            });
        });
    const Scalar t = (at.s - a.s) / (b.s - a.s);
    const Vector3 u = detail::unit(curve_at(at.s).tangent);
    return surface_.in_section(cut, detail::across(director_within(e, t), u), u, profile_.at(at.s));
  }
  /// [J]
  Scalar strain_energy() const noexcept {
    Wide strain = 0;
    for (int first = 0; first < abreast_.places(); first += lanes) {
      WideInner inner;
      Stiffness unused;
      abreast_.add(first, compute(first, inner, unused), strain);
    }
    Scalar sum = total(strain);
    for (int e = 0; !bed_.empty() && e < size(); ++e) sum += bed_.energy(e, nodes_[e], nodes_[e + 1]);
    return sum;
  }
  /// Whether λ times the loads are any.
  bool loaded(Scalar lambda) const noexcept { return lambda != 0 && !loads_.empty(); }
  /// Of λ times the loads [J].
  Scalar work(Scalar lambda) const noexcept {
    Scalar work = 0;
    for (int e = 0; !loads_.empty() && e < size(); ++e) work += loads_.work(e, nodes_[e], nodes_[e + 1]);
    work *= lambda;
    if (!moments_.empty()) work += moments_.template visit<unknowns>(lambda, nodes_, [](auto&&...) {});
    return work;
  }

 private:
  /// Unknowns of each element: its tension, where ends or joints may draw it taut and it is straight by nature; its twist, unless it is round and straight.
  struct Own {
    bool tension = false, twist = false;
  };
  static constexpr bool has_twist = unknowns == 7;
  using Wide = detail::Pack<Scalar>;
  static constexpr int lanes = Wide::size;

  using WideResidual = Eigen::Matrix<Wide, 2 * unknowns, 1>;
  using WideInner = typename Element::template Inner<Wide>;
  using Stiffness = RodTangent<Wide, unknowns - 3>;

  Scalar tension(int e) const noexcept {
    if (taut()) return inner_[e];
    const RodProperties<Scalar>& p = properties_[e];
    const detail::EndsAndMiddle<Scalar> at(p, nodes_[e], nodes_[e + 1]);
    const auto strain = [&](int k) { return at.n[k] - 1 - p.natural_strain[k]; };
    return p.axial * (strain(0) + 4 * strain(1) + strain(2)) / 6;
  }
  /// N l²/EI above 4, of what is bent by nature above 0.4.
  bool overdrawn(int e) const noexcept {
    const RodProperties<Scalar>& p = properties_[e];
    return tension(e) * p.length * p.length * p.softest() > (natural_.bent() ? Scalar(0.4) : Scalar(4));
  }
  /// By an angle α against the chord of its element, N l² (1 - cos α)/EI above 1, or at all where the element does not know its tension.
  bool turned(int e, const Node& end) const noexcept {
    constexpr Scalar at_all = Scalar(1e-6);
    const RodProperties<Scalar>& p = properties_[e];
    const VectorOf<Scalar, 3> chord = nodes_[e + 1].r - nodes_[e].r;
    const Scalar longer = std::sqrt(chord.squaredNorm()) - chord.dot(detail::unit(end.tangent));
    return tension(e) * p.length * longer * p.softest() > 1 ||
           (longer > at_all * p.length && overdrawn(e, end.s, chord));
  }
  void make(int e) noexcept {
    const Scalar from = nodes_[e].s, to = nodes_[e + 1].s;
    RodProperties<Scalar>& p = properties_[e];
    p.number = own_.twist ? 2 : 3, p.round = round_, p.taut = taut();
    p.length = to - from;
    p.inverse_length = 1 / p.length;
    profile_.apply(from, to, p);
    if constexpr (has_twist)
      if (!round_) {
        Scalar& twist = inner_[size() + e];
        twist = Element::twist_to(p, nodes_[e], nodes_[e + 1], natural_.at((from + to) / 2).director);
        if (!natural_.straight()) Element::take_natural(nodes_[e], nodes_[e + 1], twist, p);
      }
    abreast_.take(e, p);
    if (!bed_.empty()) bed_.take(e, from, to, natural_);
  }

  /// Of the increments that they make on their own [J].
  Wide energy_of(const WideInner& inner) const noexcept {
    Wide sum = own_.tension ? inner.tension.energy() : Wide(0);
    if constexpr (has_twist)
      if (own_.twist) sum += inner.twist.energy();
    return sum;
  }
  /// @param first  of the places of elements   @param inner, a, b  out: what is their own, and their nodes
  [[gnu::always_inline]] void gather(int first, WideInner& inner, RodNode<Wide>& a,
                                     RodNode<Wide>& b) const noexcept {
    const auto& order = abreast_.order();
    if (own_.tension) inner.tension.value = abreast_.gather(first, [&](int e) { return inner_[e]; });
    if constexpr (has_twist)
      if (own_.twist) inner.twist.value = abreast_.gather(first, [&](int e) { return inner_[size() + e]; });
    // The nodes of these places and of the pair behind them are those of both ends.
    detail::Abreast<Scalar> of;
    order.nodes_from(first, of.of);
    const Node *const left = &nodes_[order.node((std::min)(first + lanes, order.last_node() - 1))],
                      *const right = &nodes_[order.node((std::min)(first + lanes + 1, order.last_node()))];
    const RodNode<Wide> outer = detail::gather_nodes<has_twist>(of, nodes_);
    const auto take = [&](auto member, auto from) {
      HAPBEAM_UNROLL
      for (int c = 0; c < 3; ++c) {
        const Scalar two[2] = {(left->*from)[c], (right->*from)[c]};
        const Wide here = (outer.*member)[c], next = before(here, two);
        (a.*member)[c] = in_turn(here, next), (b.*member)[c] = in_turn(next, here);
      }
    };
    take(&RodNode<Wide>::r, &Node::r);
    take(&RodNode<Wide>::tangent, &Node::tangent);
    if constexpr (has_twist) take(&RodNode<Wide>::director, &Node::director);
  }
  /// @param inner, K  out   @return the energies of those from a place on [J]
  [[gnu::always_inline]] Wide compute(int first, WideInner& inner, Stiffness& K) const noexcept {
    RodNode<Wide> a, b;
    gather(first, inner, a, b);
    return Element::tangent(abreast_.properties(first), a, b, inner, K);
  }
  /// Moments at the node that element e begins with, at the last one's end, too.   @param visit  called with (node, residual)
  template <class Visit>
  void moments_in(int e, Scalar lambda, Visit&& visit) const noexcept {
    (void)moments_.template visit<unknowns>(lambda, nodes_, [&](int node, const auto&, const auto& r) {
      if ((std::min)(node, size() - 1) == e) visit(node, r);
    });
  }
  /// Dead loads.
  void subtract_loads(int first, Scalar lambda, WideResidual& r, Energies& sum) noexcept {
    abreast_.for_each_lane(first, [&](int e, int lane) {
      Residual by = Residual::Zero();
      loads_.template subtract<unknowns>(e, lambda, by);
      sum.work += lambda * loads_.work(e, nodes_[e], nodes_[e + 1]);
      for (int i = 0; i < 2 * unknowns; ++i) r[i].set(lane, r[i][lane] + by[i]);
    });
  }
  static constexpr int most_tensions = 16, most_relaxations = 4;
  static constexpr Scalar largest_push = 8;  // in one increment [EI/l²]

  Nodes nodes_;
  Inners inner_;
  detail::PerNode<RodProperties<Scalar>, Elements, MaxElements> properties_;
  detail::ElementsAbreast<RodProperties, Scalar, Elements, MaxElements> abreast_;
  NaturalRod<Scalar> natural_;
  RodProfile<Scalar> profile_;
  RodLoads<Scalar, Elements, MaxElements> loads_;
  RodBed<Scalar> bed_;
  detail::PerNode<WideInner, detail::groups_of<Scalar>(Elements), detail::groups_of<Scalar>(MaxElements)>
      inners_abreast_;
  detail::RodSurface<Scalar> surface_;
  bool round_ = false;  // section, and straight by nature
  Own own_;
  detail::RodMoments<Scalar> moments_;
};

}  // namespace hapbeam
