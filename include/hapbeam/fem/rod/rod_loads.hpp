// SPDX-License-Identifier: MIT
// The dead loads and elastic foundations of a rod on its mesh.
//
// The cubic is linear in its nodes: dead loads of an element are a constant vector.  A distributed load is made the consistent load of the mesh.
// A foundation is a quadratic form of them, integrated exactly where the natural shape is straight, and once for each mesh:
//
//   V = ½ ∫ (r - r°)ᵀ (k⊥ I + (k∥ - k⊥) t° t°ᵀ) (r - r°) ds        ° of the natural shape, t° its tangent
//
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <vector>

#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam {

template <typename Scalar, int Elements, int MaxElements>
class RodLoads {
  using Vector3 = VectorOf<Scalar, 3>;

 public:
  /// @throws std::invalid_argument where a load is not finite, or larger than LargestLoad says
  RodLoads(const Rod& rod, int elements)
      : loads_(rod, elements, (std::min)(rod.stiffness().bending1, rod.stiffness().bending2)),
        forces_(elements) {}
  bool empty() const noexcept { return loads_.empty(); }
  /// At their places.
  const DeadLoads<Scalar, 3>& all() const noexcept { return loads_; }

  /// Takes each element's share on the mesh of a rod.
  void take(const Centreline<Scalar, 3>& line) noexcept {
    for (int e = 0; e < line.segments(); ++e) {
      const Scalar from = line[e].s, to = line[e + 1].s, l = to - from;
      Force& f = forces_[e];
      f.setZero();
      loads_.visit(from, to, e + 1 == line.segments(), [&](const PointForce<Scalar, 3>& load) {
        const Scalar t = (load.s - from) / l, u = 1 - t;
        const Vector3 slope = 6 * t * u / l * load.arm;
        f.template segment<3>(0) += u * u * (1 + 2 * t) * load.force - slope;
        f.template segment<3>(3) += l * t * u * u * load.force + u * (1 - 3 * t) * load.arm;
        f.template segment<3>(6) += t * t * (3 - 2 * t) * load.force + slope;
        f.template segment<3>(9) += t * (3 * t - 2) * load.arm - l * t * t * u * load.force;
      });
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

 private:
  using Force = VectorOf<Scalar, 12>;  // on r1, r1', r2, r2'

  DeadLoads<Scalar, 3> loads_;
  detail::PerNode<Force, Elements, MaxElements> forces_;
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
        Eigen::Matrix<Scalar, 3, 3> k;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            k(i, j) = weight * (more * home.tangent[i] * home.tangent[j] + (i == j ? across : 0));
        visit(s, k, home.r);
      }
    }
  }
  /// [J]
  Scalar energy(int e, const RodNode<Scalar>& a, const RodNode<Scalar>& b) const noexcept {
    const Spring& spring = springs_[static_cast<std::size_t>(e)];
    const Vector12 x = unknowns(a, b) - spring.home, Kx = spring.K * x;
    return spring.energy + x.dot(Kx) / 2 + x.dot(spring.force);
  }
  /// Adds its residual and tangent.   @tparam Unknowns  of a node   @return [J]
  template <int Unknowns, class Residual, class Tangent>
  Scalar add(int e, const RodNode<Scalar>& a, const RodNode<Scalar>& b, Residual& r,
             Tangent& K) const noexcept {
    const Spring& spring = springs_[static_cast<std::size_t>(e)];
    const Vector12 x = unknowns(a, b) - spring.home, Kx = spring.K * x, force = Kx + spring.force;
    for (int i = 0; i < 12; i += 6) {
      const int row = i == 0 ? 0 : Unknowns;
      r.template segment<6>(row) += force.template segment<6>(i);
      for (int j = 0; j < 12; j += 6)
        K.template block<6, 6>(row, j == 0 ? 0 : Unknowns) += spring.K.template block<6, 6>(i, j);
    }
    return spring.energy + x.dot(Kx) / 2 + x.dot(spring.force);
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
