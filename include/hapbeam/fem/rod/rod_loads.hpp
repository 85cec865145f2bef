// SPDX-License-Identifier: MIT
// The dead loads and elastic foundations of a rod on its mesh.
//
// A dead load does work on places and tangents, which the cubic has as linear functions of the nodes: the loads of an element
// are a constant vector, exact wherever they stand in it.  A distributed load is made the consistent load of the mesh.
// A foundation is a quadratic form of them, integrated exactly where the natural shape is straight, and once for each mesh:
//
//   V = ½ ∫ (r - r°)ᵀ (k⊥ I + (k∥ - k⊥) t° t°ᵀ) (r - r°) ds        ° of the natural shape, t° its tangent
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <hapbeam/fem/laid_mesh.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/rod/natural_rod.hpp>
#include <hapbeam/fem/rod/rod_forces.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam {

template <typename Scalar, int Elements, int MaxElements>
class RodLoads {
  using Vector3 = VectorOf<Scalar, 3>;

 public:
  /// @throws std::invalid_argument where a load is not finite, or larger than LargestLoad says
  [[gnu::cold]] RodLoads(const Rod& rod, int elements) : forces_(elements) {
    const detail::LargestLoad<Scalar> largest((std::min)(rod.stiffness().bending1, rod.stiffness().bending2),
                                              rod.length());
    if (rod.load()) spread_over_nodes(rod, elements, largest);
    for (const RodForce& force : rod.forces()) {
      for (int c = 0; c < 3; ++c) (void)largest.force("force", force.force[c]);
      add(force.s, force.force, VectorOf<double, 3>(0, 0, 0));
    }
  }
  bool empty() const noexcept { return loads_.empty(); }

  /// Takes each element's share on the mesh of a rod.
  void take(const Centreline<Scalar, 3>& line) noexcept {
    for (int e = 0; e < line.segments(); ++e) forces_[e].setZero();
    for (const PointLoad& load : loads_) {
      const int e = line.segment_at(load.s);
      const Scalar from = line[e].s, l = line[e + 1].s - from, t = (load.s - from) / l, u = 1 - t;
      Force& f = forces_[e];
      const Vector3 slope = 6 * t * u / l * load.couple;
      f.template segment<3>(0) += u * u * (1 + 2 * t) * load.force - slope;
      f.template segment<3>(3) += l * t * u * u * load.force + u * (1 - 3 * t) * load.couple;
      f.template segment<3>(6) += t * t * (3 - 2 * t) * load.force + slope;
      f.template segment<3>(9) += t * (3 * t - 2) * load.couple - l * t * t * u * load.force;
    }
  }
  /// From the residual of an element.   @tparam Unknowns  of a node
  template <int Unknowns, class Residual>
  void subtract(int e, Scalar lambda, Residual& r) const noexcept {
    const Force& f = forces_[e];
    r.template segment<6>(0) -= lambda * f.template segment<6>(0);
    r.template segment<6>(Unknowns) -= lambda * f.template segment<6>(6);
  }
  /// Of those of an element [J].
  Scalar work(int e, const RodNode<Scalar>& a, const RodNode<Scalar>& b) const noexcept {
    const Force& f = forces_[e];
    return f.template segment<3>(0).dot(a.r) + f.template segment<3>(3).dot(a.tangent) +
           f.template segment<3>(6).dot(b.r) + f.template segment<3>(9).dot(b.tangent);
  }
  /// Takes λ times those of element e past cuts on their way along it: past one at its end, and past one at s if they stand
  /// before it.  At a node that is on the side of this element.
  void pass(const Centreline<Scalar, 3>& line, int e, Scalar lambda, Scalar s, detail::RodCut<Scalar>& at_s,
            detail::RodCut<Scalar>& at_end) const noexcept {
    for (const PointLoad& load : loads_) {  // from the left end on: they are in no order
      if (line.segment_at(load.s) != e) continue;
      const RodPoint<Scalar> there = line.at(e, load.s);
      const auto past = [&](detail::RodCut<Scalar>& cut) {
        cut.pass(lambda * load.force, there.r);
        cut.moment -= detail::cross3<Scalar>(there.tangent, lambda * load.couple);
      };
      past(at_end);
      if (stands_before(load.s, s, line[e].s)) past(at_s);
    }
  }
  /// What λ times the distributed load does at a cut that its nodal forces do not.   @param from  where the element begins
  void spread(Scalar lambda, Scalar s, Scalar from, const Vector3& tangent,
              detail::RodCut<Scalar>& cut) const noexcept {
    if (cells_.empty()) return;
    std::size_t k = 0;
    while (k + 1 < cells_.size() && stands_before(loads_[k + 1].s, s, from)) ++k;
    const Scalar begin = loads_[k].s, h = loads_[k + 1].s - begin;
    cut.spread(lambda * cells_[k], tangent, (s - begin) / h, h);
  }

 private:
  using Force = VectorOf<Scalar, 12>;  // on r1, r1', r2, r2'

  /// A force at a point, and what works on the tangent there.
  struct PointLoad {
    Scalar s;
    Vector3 force, couple;
  };

  static bool stands_before(Scalar load, Scalar cut, Scalar from) noexcept {
    return load < cut || (load == cut && cut == from);
  }
  void add(double s, const VectorOf<double, 3>& force, const VectorOf<double, 3>& couple) {
    loads_.push_back({static_cast<Scalar>(s), force.template cast<Scalar>(), couple.template cast<Scalar>()});
  }
  void spread_over_nodes(const Rod& rod, int elements, const detail::LargestLoad<Scalar>& largest) {
    using Vector = VectorOf<double, 3>;
    const std::vector<Scalar> mesh = lay_mesh<Scalar>(rod, rod.forces(), elements);
    const auto at = [&mesh](int i) { return static_cast<double>(mesh[static_cast<std::size_t>(i)]); };
    const RodLoad distributed = rod.load();
    std::vector<std::array<Vector, 2>> on(static_cast<std::size_t>(elements) + 1,
                                          {Vector(0, 0, 0), Vector(0, 0, 0)});
    cells_.assign(static_cast<std::size_t>(elements), Vector3::Zero());
    for (int e = 0; e < elements; ++e) {
      const double h = at(e + 1) - at(e);
      for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
        const double t = detail::gauss_points[k], u = 1 - t, weight = h * detail::gauss_weights[k];
        Vector f = distributed(at(e) + t * h);
        for (int c = 0; c < 3; ++c) (void)largest.distributed("load", f[c]);
        f *= weight;
        auto &a = on[static_cast<std::size_t>(e)], &b = on[static_cast<std::size_t>(e) + 1];
        cells_[static_cast<std::size_t>(e)] += (f / h).template cast<Scalar>();
        a[0] += u * u * (1 + 2 * t) * f, a[1] += h * t * u * u * f;
        b[0] += t * t * (3 - 2 * t) * f, b[1] -= h * t * t * u * f;
      }
    }
    for (int i = 0; i <= elements; ++i) {
      const auto& of = on[static_cast<std::size_t>(i)];
      add(at(i), of[0], of[1]);
    }
  }

  detail::PerNode<Force, Elements, MaxElements> forces_;
  std::vector<PointLoad> loads_;  // first those of a distributed load, node by node
  std::vector<Vector3> cells_;    // its mean between those [N/m]
};

/// Its elastic foundations.
template <typename Scalar>
class RodBed {
  using Vector12 = VectorOf<Scalar, 12>;  // r1, r1', r2, r2'

 public:
  RodBed(const Rod& rod, int elements) : foundations_(rod.foundations()) {
    if (!foundations_.empty()) springs_.resize(static_cast<std::size_t>(elements));
  }
  bool empty() const noexcept { return springs_.empty(); }

  /// Takes an element's share on its mesh.
  void take(int e, Scalar from, Scalar to, const NaturalRod<Scalar>& natural) noexcept {
    Spring& spring = springs_[static_cast<std::size_t>(e)];
    spring = {};
    const Scalar l = to - from;
    spring.home = unknowns(natural.at(from), natural.at(to));
    visit(from, to, natural,
          [&](Scalar s, const Eigen::Matrix<Scalar, 3, 3>& k, const VectorOf<Scalar, 3>& home) {
            const Scalar t = (s - from) / l, u = 1 - t;
            const Scalar N[4] = {u * u * (1 + 2 * t), l * t * u * u, t * t * (3 - 2 * t), -l * t * t * u};
            // How far the cubic of the natural nodes is from the natural shape, and what that takes.
            VectorOf<Scalar, 3> miss = -home;
            for (int i = 0; i < 4; ++i) miss += N[i] * spring.home.template segment<3>(3 * i);
            const VectorOf<Scalar, 3> force = k * miss;
            for (int i = 0; i < 4; ++i) {
              for (int j = 0; j < 4; ++j) spring.K.template block<3, 3>(3 * i, 3 * j) += N[i] * N[j] * k;
              spring.force.template segment<3>(3 * i) += N[i] * force;
            }
            spring.energy += miss.dot(force) / 2;
          });
  }

  /// Calls visit(s, k, r°) for points from a to b that stand for its springs there, k their stiffness [N/m].
  template <class Visit>
  void visit(Scalar from, Scalar to, const NaturalRod<Scalar>& natural, Visit&& visit) const noexcept {
    for (const RodFoundation& foundation : foundations_) {
      const Scalar a = (std::max)(from, static_cast<Scalar>(foundation.from)),
                   b = (std::min)(to, static_cast<Scalar>(foundation.to));
      if (!(b > a)) continue;
      const Scalar across = static_cast<Scalar>(foundation.across),
                   more = static_cast<Scalar>(foundation.along) - across;
      for (std::size_t g = 0; g < detail::gauss_points.size(); ++g) {
        const Scalar s = a + static_cast<Scalar>(detail::gauss_points[g]) * (b - a),
                     weight = static_cast<Scalar>(detail::gauss_weights[g]) * (b - a);
        const RodNode<Scalar> home = natural.at(s);
        visit(s,
              Eigen::Matrix<Scalar, 3, 3>(weight * (across * Eigen::Matrix<Scalar, 3, 3>::Identity() +
                                                    more * home.tangent * home.tangent.transpose())),
              home.r);
      }
    }
  }
  /// [J]
  Scalar energy(int e, const RodNode<Scalar>& a, const RodNode<Scalar>& b) const noexcept {
    const Spring& spring = springs_[static_cast<std::size_t>(e)];
    const Vector12 x = unknowns(a, b) - spring.home, Kx = spring.K * x;
    return spring.energy + x.dot(Kx / 2 + spring.force);
  }
  /// Adds its residual and tangent.   @tparam Unknowns  of a node   @return [J]
  template <int Unknowns, class Residual, class Tangent>
  Scalar add(int e, const RodNode<Scalar>& a, const RodNode<Scalar>& b, Residual& r,
             Tangent& K) const noexcept {
    const Spring& spring = springs_[static_cast<std::size_t>(e)];
    const Vector12 x = unknowns(a, b) - spring.home, Kx = spring.K * x;
    for (int i = 0; i < 12; i += 6) {
      const int row = i == 0 ? 0 : Unknowns;
      r.template segment<6>(row) += (Kx + spring.force).template segment<6>(i);
      for (int j = 0; j < 12; j += 6)
        K.template block<6, 6>(row, j == 0 ? 0 : Unknowns) += spring.K.template block<6, 6>(i, j);
    }
    return spring.energy + x.dot(Kx / 2 + spring.force);
  }

 private:
  struct Spring {
    Eigen::Matrix<Scalar, 12, 12> K = Eigen::Matrix<Scalar, 12, 12>::Zero();
    // Of the natural shape's nodes, their unknowns, and residual and energy there.
    Vector12 home = Vector12::Zero(), force = Vector12::Zero();
    Scalar energy = 0;
  };
  static Vector12 unknowns(const RodNode<Scalar>& a, const RodNode<Scalar>& b) noexcept {
    Vector12 x;
    x << a.r, a.tangent, b.r, b.tangent;
    return x;
  }

  std::vector<RodFoundation> foundations_;
  std::vector<Spring> springs_;
};

}  // namespace hapbeam
