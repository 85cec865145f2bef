// The elements of one rod on a mesh whose nodes move: places, tangents and directors, strain energy, dead loads, and their
// derivatives.
//
// A dead load does work on places and tangents, which the cubic has as linear functions of the nodes: the loads of an element
// are a constant vector, exact wherever they stand in it.  A distributed load is made the consistent load of the uniform
// mesh, once.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/element/rod_properties.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/natural_rod.hpp>
#include <hapbeam/fem/rod_bed.hpp>
#include <hapbeam/fem/rod_lanes.hpp>
#include <hapbeam/fem/rod_profile.hpp>
#include <hapbeam/fem/solver/pair_order.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodElements {
 public:
  using Scalar = ScalarType;
  using Node = RodNode<Scalar>;
  using Nodes = detail::PerNode<Node, Elements, MaxElements>;
  using Inner = typename Element::template Inner<Scalar>;
  using Inners = detail::PerNode<Inner, Elements, MaxElements>;
  static constexpr int unknowns = Element::unknowns;
  using Residual = Eigen::Matrix<Scalar, 2 * unknowns, 1>;
  using Tangent = Eigen::Matrix<Scalar, 2 * unknowns, 2 * unknowns>;

  /// In its natural shape.  @throws std::invalid_argument where a load or a section makes no sense somewhere on the rod, or
  /// elements does not fit the type, or the element does not model such a rod
  RodElements(const Rod& rod, int elements)
      : nodes_(elements),
        inners_(elements),
        properties_(elements),
        order_{elements},
        wide_(elements),
        forces_(elements),
        natural_(rod),
        mesh_(elements, static_cast<Scalar>(rod.length())),
        profile_(rod),
        bed_(rod, elements) {
    if constexpr (!has_twist)
      if (!rod.arcs().empty() || !profile_.round())
        throw std::invalid_argument(
            "rod: RoundRod takes rods that are straight by nature, with one bending stiffness for all "
            "directions; take "
            "TwistedRod");
    if constexpr (has_twist)
      if (!holds_twist(rod.left()) && !holds_twist(rod.right()))
        throw std::invalid_argument(std::string("supports = ") + name(rod.left()) + ", " + name(rod.right()) +
                                    ": TwistedRod turns about its axis, hold its twist at one end");
    const bool two = has_twist && !(natural_.straight() && profile_.round() && profile_.smooth());
    for (int e = 0; e < elements; ++e) properties_[e].number = two ? 2 : 3;
    collect_loads(rod, elements);
    for (int i = 0; i <= elements; ++i) nodes_[i] = natural_.at(mesh_.position(i));
    take(mesh_);
    for (int e = 0; e < elements; ++e) find_twist(e, natural_.at(middle(e)).director);
  }

  int size() const noexcept { return nodes_.size() - 1; }
  Nodes& nodes() noexcept { return nodes_; }
  const Nodes& nodes() const noexcept { return nodes_; }
  Inners& inners() noexcept { return inners_; }
  const Inners& inners() const noexcept { return inners_; }
  const NaturalRod<Scalar>& natural_shape() const noexcept { return natural_; }
  const ContactMesh<Scalar>& mesh() const noexcept { return mesh_; }
  static Centreline<Scalar, 3> view(const Nodes& nodes) noexcept { return {nodes.data(), nodes.size()}; }

  /// Moves to another mesh of as many elements and carries the shape over.  @param scratch, more  overwritten
  void remesh(const ContactMesh<Scalar>& mesh, Nodes& scratch, Inners& more) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) scratch[i] = nodes_[i], more[i] = inners_[i];
    const Centreline<Scalar, 3> line = view(scratch);
    int piece = 0;
    const auto look = [&](Scalar s) {
      while (piece + 1 < line.segments() && scratch[piece + 1].s <= s) ++piece;
      if (s == scratch[piece].s) return scratch[piece];
      const RodPoint<Scalar> at = line.at(piece, s);
      Node node{s, at.r, at.tangent, scratch[piece].director};
      const Node &a = scratch[piece], &b = scratch[piece + 1];
      if constexpr (has_twist) {
        RodProperties<Scalar> p;
        p.length = b.s - a.s, p.inverse_length = 1 / p.length;
        node.director = Element::director(p, a, b, more[piece].twist, (s - a.s) * p.inverse_length);
      } else {
        node.director = detail::carry(a.director, detail::unit(a.tangent), detail::unit(at.tangent));
      }
      node.director = detail::across(node.director, detail::unit(node.tangent));
      return node;
    };
    nodes_[0] = look(0);
    for (int e = 0; e < size(); ++e) {
      VectorOf<Scalar, 3> director = nodes_[e].director;
      if constexpr (has_twist) director = look((mesh.position(e) + mesh.position(e + 1)) / 2).director;
      nodes_[e + 1] = look(mesh.position(e + 1));
      set_length(e, nodes_[e + 1].s - nodes_[e].s);
      find_twist(e, director);
    }
    take(mesh);
  }
  /// Sets the whole state.  @param nodes those of the given mesh
  void set(const ContactMesh<Scalar>& mesh, const Nodes& nodes, const Inners& inners) noexcept {
    for (int i = 0; i < nodes_.size(); ++i) nodes_[i] = nodes[i], inners_[i] = inners[i];
    take(mesh);
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
    for (int first = 0; first < 2 * order_.pairs(); first += lanes) {
      Group group;
      compute(first, group);
      const Wide inner = group.inner.energy();
      for (int lane = 0; lane < lanes && first + lane < 2 * order_.pairs(); ++lane) {
        const int e = order_.element(first + lane);
        if (e < 0) continue;
        sum.strain += group.energy[lane];
        sum.inner += inner[lane];
        if constexpr (has_twist) group.get(lane, inners_[e]);
        if (loaded() || !bed_.empty()) add_loads(e, lambda, lane, group, sum);
      }
      visit(first, group.K, group.r);
    }
    return sum;
  }
  /// The residual alone of one element.
  void residual(int e, Scalar lambda, Residual& r) const noexcept {
    Group group;
    const int place = order_.place(e), lane = place % lanes;
    compute(place - lane, group);
    group.get(lane, r);
    Tangent unused = Tangent::Zero();
    if (!bed_.empty()) (void)bed_.template add<unknowns>(e, nodes_[e], nodes_[e + 1], r, unused);
    if (loaded()) subtract_loads(e, lambda, r);
  }
  /// [J]
  Scalar strain_energy() const noexcept {
    Scalar energy = 0;
    for (int e = 0; e < size(); ++e) {
      energy += Element::energy(properties_[e], nodes_[e], nodes_[e + 1], inners_[e]);
      if (!bed_.empty()) energy += bed_.energy(e, nodes_[e], nodes_[e + 1]);
    }
    return energy;
  }

 private:
  static constexpr bool has_twist = unknowns == 7;
  using Force = VectorOf<Scalar, 12>;  // on r1, r1', r2, r2'

  using Wide = detail::Pack<Scalar>;
  static constexpr int lanes = Wide::size;

  /// Elements side by side.
  struct Group {
    Eigen::Matrix<Wide, 2 * unknowns, 1> r;
    Eigen::Matrix<Wide, 2 * unknowns, 2 * unknowns> K;
    typename Element::template Inner<Wide> inner;
    Wide energy;

    [[gnu::always_inline]] void get(int lane, Residual& to) const noexcept {
      HAPBEAM_UNROLL
      for (int i = 0; i < 2 * unknowns; ++i) to[i] = r[i][lane];
    }
    [[gnu::always_inline]] void get(int lane, Inner& to) const noexcept {
      to.residual = inner.residual[lane];
      to.stiffness = inner.stiffness[lane];
      for (int i = 0; i < 2 * unknowns; ++i) to.row[i] = inner.row[i][lane];
    }
  };
  /// @param first  of their places
  void compute(int first, Group& group) const noexcept {
    const detail::Abreast<Scalar> of =
        detail::Abreast<Scalar>::from(first, 2 * order_.pairs() - 1).of_each([this](int place) {
          return element(place);
        });
    if constexpr (has_twist) group.inner.twist = detail::gather(of, [&](int e) { return inners_[e].twist; });
    group.energy = Element::tangent(wide_[first / lanes], detail::gather_nodes<has_twist>(of, nodes_),
                                    detail::gather_nodes<has_twist>(of.next(1, size()), nodes_), group.inner,
                                    group.r, group.K);
  }
  /// At an empty place stands another one.
  int element(int place) const noexcept { return (std::max)(order_.element(place), 0); }
  /// Dead loads and the foundation.
  void add_loads(int e, Scalar lambda, int lane, Group& group, Energies& sum) const noexcept {
    const Node &a = nodes_[e], &b = nodes_[e + 1];
    Residual r;
    group.get(lane, r);
    if (!bed_.empty()) {
      Tangent K = Tangent::Zero();
      sum.strain += bed_.template add<unknowns>(e, a, b, r, K);
      for (int j = 0; j < 2 * unknowns; ++j)
        for (int i = 0; i < 2 * unknowns; ++i) group.K(i, j).set(lane, group.K(i, j)[lane] + K(i, j));
    }
    if (loaded()) {
      subtract_loads(e, lambda, r);
      const Force& f = forces_[e];
      sum.work += lambda * (f.template segment<3>(0).dot(a.r) + f.template segment<3>(3).dot(a.tangent) +
                            f.template segment<3>(6).dot(b.r) + f.template segment<3>(9).dot(b.tangent));
    }
    for (int i = 0; i < 2 * unknowns; ++i) group.r[i].set(lane, r[i]);
  }
  /// Lays an element's properties beside those of its neighbours.
  void widen(int e) noexcept {
    const RodProperties<Scalar>& from = properties_[e];
    fill(e, [&](auto&& set, RodProperties<Wide>& to) {
      to.number = from.number;
      set(to.axial, from.axial);
      for (int i = 0; i < 3; ++i) {
        auto& point = to.points[i];
        set(point.bending1, from.points[i].bending1), set(point.bending2, from.points[i].bending2);
        set(point.torsion, from.points[i].torsion);
        for (int j = 0; j < 3; ++j) set(point.natural[j], from.points[i].natural[j]);
        set(to.natural_strain[i], from.natural_strain[i]);
      }
    });
    widen_length(e);
  }
  void widen_length(int e) noexcept {
    const RodProperties<Scalar>& from = properties_[e];
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

  Scalar wide_length(int e) const noexcept {
    const int place = order_.place(e);
    return wide_[place / lanes].length[place % lanes];
  }

  /// A force at a point, and what works on the tangent there.
  struct PointLoad {
    Scalar s;
    VectorOf<Scalar, 3> force, couple;
  };

  bool loaded() const noexcept { return !loads_.empty(); }
  Scalar middle(int e) const noexcept { return (nodes_[e].s + nodes_[e + 1].s) / 2; }

  void find_twist(int e, const VectorOf<Scalar, 3>& director) noexcept {
    if constexpr (has_twist)
      inners_[e].twist = Element::twist_to(properties_[e], nodes_[e], nodes_[e + 1], director);
  }

  void set_length(int e, Scalar length) noexcept {
    properties_[e].length = length;
    properties_[e].inverse_length = 1 / length;
  }

  [[gnu::cold]] void collect_loads(const Rod& rod, int elements) {
    using Vector3 = VectorOf<double, 3>;
    const double h = rod.length() / elements;
    const auto add = [this](double s, const Vector3& force, const Vector3& couple) {
      loads_.push_back(
          {static_cast<Scalar>(s), force.template cast<Scalar>(), couple.template cast<Scalar>()});
    };
    if (const RodLoad distributed = rod.load()) {
      std::vector<std::array<Vector3, 2>> on(static_cast<std::size_t>(elements) + 1,
                                             {Vector3(0, 0, 0), Vector3(0, 0, 0)});
      for (int e = 0; e < elements; ++e)
        for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
          const double t = detail::gauss_points[k], u = 1 - t, weight = h * detail::gauss_weights[k];
          Vector3 f = distributed((e + t) * h);
          for (int c = 0; c < 3; ++c) detail::finite("load", f[c], "N/m");
          f *= weight;
          auto &a = on[static_cast<std::size_t>(e)], &b = on[static_cast<std::size_t>(e) + 1];
          a[0] += u * u * (1 + 2 * t) * f, a[1] += h * t * u * u * f;
          b[0] += t * t * (3 - 2 * t) * f, b[1] -= h * t * t * u * f;
        }
      for (int i = 0; i <= elements; ++i)
        add(i == elements ? rod.length() : i * h, on[static_cast<std::size_t>(i)][0],
            on[static_cast<std::size_t>(i)][1]);
    }
    for (const RodForce& force : rod.forces()) add(force.s, force.force, Vector3(0, 0, 0));
  }

  void subtract_loads(int e, Scalar lambda, Residual& r) const noexcept {
    const Force& f = forces_[e];
    r.template segment<6>(0) -= lambda * f.template segment<6>(0);
    r.template segment<6>(unknowns) -= lambda * f.template segment<6>(6);
  }

  void take(const ContactMesh<Scalar>& mesh) noexcept {
    mesh_ = mesh;
    // Where all elements are the same their length alone changes.
    const bool alike = profile_.constant() && natural_.straight() && known_;
    known_ = true;
    for (int e = 0; e < size(); ++e) {
      const Scalar length = nodes_[e + 1].s - nodes_[e].s;
      if (alike) {
        if (length != properties_[e].length || length != wide_length(e)) {
          set_length(e, length);
          widen_length(e);
        }
      } else {
        set_length(e, length);
        profile_.apply(nodes_[e].s, nodes_[e + 1].s, properties_[e]);
        if constexpr (has_twist)
          if (!natural_.straight()) take_natural(e);
        widen(e);
      }
      if (!bed_.empty()) bed_.take(e, nodes_[e].s, nodes_[e + 1].s, natural_);
    }
    if (loaded()) take_loads();
  }

  void take_natural(int e) noexcept {
    RodProperties<Scalar>& p = properties_[e];
    const Node a = natural_.at(nodes_[e].s), b = natural_.at(nodes_[e + 1].s);
    Element::take_natural(a, b, Element::twist_to(p, a, b, natural_.at(middle(e)).director), p);
  }

  void take_loads() noexcept {
    for (int e = 0; e < size(); ++e) forces_[e].setZero();
    for (const PointLoad& load : loads_) {
      const int e = view(nodes_).segment_at(load.s);
      const Scalar l = properties_[e].length, t = (load.s - nodes_[e].s) / l, u = 1 - t;
      Force& f = forces_[e];
      const VectorOf<Scalar, 3> slope = 6 * t * u / l * load.couple;
      f.template segment<3>(0) += u * u * (1 + 2 * t) * load.force - slope;
      f.template segment<3>(3) += l * t * u * u * load.force + u * (1 - 3 * t) * load.couple;
      f.template segment<3>(6) += t * t * (3 - 2 * t) * load.force + slope;
      f.template segment<3>(9) += t * (3 * t - 2) * load.couple - l * t * t * u * load.force;
    }
  }

  Nodes nodes_;
  Inners inners_;
  detail::PerNode<RodProperties<Scalar>, Elements, MaxElements> properties_;
  detail::PairOrder order_;
  detail::PerNode<RodProperties<Wide>, Elements, MaxElements> wide_;
  detail::PerNode<Force, Elements, MaxElements> forces_;
  std::vector<PointLoad> loads_;
  NaturalRod<Scalar> natural_;
  ContactMesh<Scalar> mesh_;
  RodProfile<Scalar> profile_;
  RodBed<Scalar> bed_;
  bool known_ = false;  // what elements are made of
};

}  // namespace hapbeam
