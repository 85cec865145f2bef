// The textbook's corotational beam element in space: a chord that takes all rigid motion, and small strains beside it, whose energy
// is that of a straight linear beam.
//
//   V = ½ EA l ε² + ½ GJ/l τ² + Σ 2 EI/l (b1² + b1 b2 + b2²)                                      all less what is natural
//   ε = |Δ|/l - 1,   sin b_i = d1_i · e  and  d2_i · e,   sin τ = ½ (d2_1 · d1_2 - d1_1 · d2_2)         e = Δ/|Δ|
//
// Angles are taken between the chord and the nodes' own axes.  Crisfield takes them to axes midway between the nodes'.  Both energies of an
// element that bends and twists are wrong by the square of its length, and these by half as much to as much as Crisfield's.
// As an element of the library's rods, so that mesh, contact and solver are the same.  Their nodes have r' with a length, which here
// does nothing, so a spring holds it at 1.
// Real-time: no allocation, noexcept, O(1).
// Source: Crisfield, A consistent co-rotational formulation for non-linear, three-dimensional, beam-elements, Comput. Methods Appl.
// Mech. Eng. 81 (1990), 131-150; Crisfield & Moita, A unified co-rotational framework for solids, shells and beams, Int. J. Solids
// Struct. 33 (1996), 2969-2992.  The derivatives, by places, tangents and angles, are ours.
#pragma once

#include <cmath>

#include <hapbeam/element/twisted_rod.hpp>

namespace hapbeam::benchmarks {

struct CrisfieldRod {
  static constexpr int dimension = 3;
  static constexpr bool any_rotation = true;
  static constexpr int unknowns = 7;  ///< of a node: r, r', φ
  static constexpr const char* name() noexcept { return "crisfield-rod"; }

  template <typename S>
  using Vector14 = TwistedRod::Vector14<S>;
  template <typename S>
  using Matrix14 = TwistedRod::Matrix14<S>;
  /// Nothing is the element's own: it stays zero.
  template <typename S>
  using Inner = detail::RodInners<S, 7>;

  template <typename S>
  static S energy(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                  const Inner<S>&) noexcept {
    S energy = lengths(p, n1, n2);
    const Strains<S> at(p, n1, n2);
    S f[6];
    for (int k = 0; k < 6; ++k) f[k] = at.force(k);
    for (int k = 0; k < 6; ++k) energy += f[k] * at.strain[k] / 2;
    return energy;
  }

  template <typename S>
  static VectorOf<S, 3> director(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                                 S twist, S x) noexcept {
    return TwistedRod::director(p, n1, n2, twist, x);
  }
  template <typename S>
  static S twist_to(const RodProperties<S>&, const RodNode<S>&, const RodNode<S>&,
                    const VectorOf<S, 3>&) noexcept {
    return 0;
  }
  /// What is natural in a shape.
  template <typename S>
  static void take_natural(const RodNode<S>& n1, const RodNode<S>& n2, S, RodProperties<S>& p) noexcept {
    for (auto& point : p.points)
      for (S& k : point.natural) k = 0;
    p.natural_strain[0] = 0;
    const Strains<S> at(p, n1, n2);
    for (int k = 0; k < 5; ++k) p.points[k / 3].natural[k % 3] = at.strain[k];
    p.natural_strain[0] = at.strain[5];
  }

  /// As the library's elements hand it over.
  template <typename S>
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>& inner,
                   RodTangent<S, 4>& to) noexcept {
    using To = RodTangent<S, 4>;
    Vector14<S> r;
    Matrix14<S> K;
    const S energy = tangent(p, n1, n2, inner, r, K);
    for (int i = 0; i < 3; ++i) to.D[i] = r[7 + i];
    for (int j = 0; j < 3; ++j)
      for (int i = j; i < 3; ++i) to.DD[To::template half<3>(i, j)] = K(7 + i, 7 + j);
    for (int j = 0; j < 4; ++j) {
      to.t1[j] = r[3 + j], to.t2[j] = r[10 + j];
      for (int i = 0; i < 3; ++i) to.D1[3 * j + i] = K(7 + i, 3 + j), to.D2[3 * j + i] = K(7 + i, 10 + j);
      for (int i = 0; i < 4; ++i) {
        to.K12[4 * j + i] = K(3 + i, 10 + j);
        if (i < j) continue;
        to.K11[To::template half<4>(i, j)] = K(3 + i, 3 + j),
                                       to.K22[To::template half<4>(i, j)] = K(10 + i, 10 + j);
      }
    }
    return energy;
  }
  /// @param r  out [N, N·m of r', N·m]   @param K  out, symmetric, both triangles
  template <typename S>
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>&,
                   Vector14<S>& r, Matrix14<S>& K) noexcept {
    const Strains<S> at(p, n1, n2);
    const S length = at.length, inverse = 1 / length;
    const V3<S>& e = at.e;
    const auto& d = at.axes;
    // ∂s by Δ and by the rotation vectors of both nodes.
    V3<S> B[6][3];
    S f[6], energy = lengths(p, n1, n2);
    for (int k = 0; k < 6; ++k) {
      f[k] = at.force(k);
      energy += f[k] * at.strain[k] / 2;
      for (auto& part : B[k]) part.setZero();
    }
    for (int k = 0; k < 4; ++k) {
      const V3<S>& axis = d[k / 2][k % 2];
      B[k][0] = at.slope[k] * inverse * (axis - at.sine[k] * e);
      B[k][1 + k / 2] = at.slope[k] * detail::cross3(axis, e);
    }
    const V3<S> spin = (detail::cross3(d[0][1], d[1][0]) - detail::cross3(d[0][0], d[1][1])) / 2;
    B[4][1] = at.slope[4] * spin, B[4][2] = -B[4][1];
    B[5][0] = at.inverse_rest * e;
    // Gradient, and the Hessian's part by stiffness:  Σ D_kl ∇s_k ∇s_lᵀ
    V3<S> g[3];
    M3<S> H[3][3];
    for (int a = 0; a < 3; ++a) {
      g[a].setZero();
      for (int k = 0; k < 6; ++k) g[a] += f[k] * B[k][a];
    }
    V3<S> DB[6][3];
    for (int k = 0; k < 6; ++k)
      for (int a = 0; a < 3; ++a) {
        DB[k][a] = at.own[k] * B[k][a];
        if (k < 4) DB[k][a] += at.shared[k] * B[(k + 2) % 4][a];
        DB[k][a] += at.bend[k] * f[k] * B[k][a];
      }
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) {
        H[a][b].setZero();
        for (int k = 0; k < 6; ++k) H[a][b] += DB[k][a] * B[k][b].transpose();
      }
    // And by forces:  Σ f_k ∇²s_k
    for (int k = 0; k < 4; ++k) {
      const V3<S>& axis = d[k / 2][k % 2];
      const S c = f[k] * at.slope[k], s = at.sine[k];
      const int node = 1 + k / 2;
      const V3<S> half = axis - S(1.5) * s * e;
      H[0][0] -= c * inverse * inverse * (half * e.transpose() + e * half.transpose());
      H[node][node] += c / 2 * (e * axis.transpose() + axis * e.transpose());
      for (int i = 0; i < 3; ++i) H[0][0](i, i) -= c * inverse * inverse * s, H[node][node](i, i) -= c * s;
      H[node][0] += c * inverse * (skew(axis) - detail::cross3(axis, e) * e.transpose());
    }
    {
      const S c = f[4] * at.slope[4] / 2;
      const auto square = [](const V3<S>& x, const V3<S>& y) -> M3<S> {
        M3<S> m = (x * y.transpose() + y * x.transpose()) / 2;
        const S dot = x.dot(y);
        for (int i = 0; i < 3; ++i) m(i, i) -= dot;
        return m;
      };
      const M3<S> both = c * (square(d[0][1], d[1][0]) - square(d[0][0], d[1][1]));
      H[1][1] += both, H[2][2] += both;
      // ϑ2 before ϑ1
      H[2][1] += c * (d[0][0] * d[1][1].transpose() - d[0][1] * d[1][0].transpose());
      const S dot = d[0][1].dot(d[1][0]) - d[0][0].dot(d[1][1]);
      for (int i = 0; i < 3; ++i) H[2][1](i, i) += c * dot;
      const S N = f[5] * at.inverse_rest * inverse;
      H[0][0] -= N * (e * e.transpose());
      for (int i = 0; i < 3; ++i) H[0][0](i, i) += N;
    }
    place(p, n1, n2, g, H, r, K);
    return energy;
  }

 private:
  template <typename S>
  using V3 = VectorOf<S, 3>;
  template <typename S>
  using M3 = Eigen::Matrix<S, 3, 3>;

  template <typename S>
  static M3<S> skew(const V3<S>& v) noexcept {
    M3<S> m;
    m << S(0), -v[2], v[1], v[2], S(0), -v[0], -v[1], v[0], S(0);
    return m;
  }

  /// The angles of node 1 to the chord, along d1 and d2, those of node 2, the twist, and ε.
  template <typename S>
  struct Strains {
    V3<S> axes[2][2], e;  // d1 and d2 of the nodes
    S length, inverse_rest;
    S strain[6], sine[5], slope[6], bend[6];  // dv/ds and (d²v/ds²)/(dv/ds)² of v = asin s
    S own[6], shared[4];                      // ∂²V/∂v²; of an angle with that of the other node

    Strains(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2) noexcept {
      using std::atan2;
      using std::sqrt;
      const RodNode<S>* const nodes[2] = {&n1, &n2};
      const V3<S> chord = n2.r - n1.r;
      length = sqrt(chord.squaredNorm());
      e = chord / length;
      inverse_rest = p.inverse_length;
      for (int i = 0; i < 2; ++i) {
        axes[i][0] = nodes[i]->director;
        axes[i][1] = detail::cross3<S>(detail::unit(nodes[i]->tangent), nodes[i]->director);
        for (int k = 0; k < 2; ++k) sine[2 * i + k] = axes[i][k].dot(e);
      }
      sine[4] = (axes[0][1].dot(axes[1][0]) - axes[0][0].dot(axes[1][1])) / 2;
      for (int k = 0; k < 5; ++k) {
        const S cosine = sqrt(1 - sine[k] * sine[k]);
        strain[k] = atan2(sine[k], cosine) - p.points[k / 3].natural[k % 3];
        slope[k] = 1 / cosine;
        bend[k] = sine[k] * slope[k];
      }
      strain[5] = length * inverse_rest - 1 - p.natural_strain[0];
      slope[5] = 1, bend[5] = 0;
      const auto& at = p.points[0];
      for (int k = 0; k < 4; ++k) {
        shared[k] = 2 * (k % 2 ? at.bending1 : at.bending2) * p.inverse_length;
        own[k] = 2 * shared[k];
      }
      own[4] = at.torsion * p.inverse_length;
      own[5] = p.axial * p.length;
    }
    S force(int k) const noexcept {
      return own[k] * strain[k] + (k < 4 ? shared[k] * strain[(k + 2) % 4] : S(0));
    }
  };

  /// Energy of what holds |r'| at 1 [J].
  template <typename S>
  static S lengths(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2) noexcept {
    using std::sqrt;
    const S a = sqrt(n1.tangent.squaredNorm()) - 1, b = sqrt(n2.tangent.squaredNorm()) - 1;
    return p.axial * p.length * (a * a + b * b) / 4;
  }

  /// From Δ and rotation vectors to r, r' and φ.  A tangent t u that moves by x turns its node by
  ///   ϑ = φ u + u × x/t - (u·x)(u × x)/t² + ½ φ (x - u u·x)/t        to second order
  template <typename S>
  static void place(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                    const V3<S> (&g)[3], const M3<S> (&H)[3][3], Vector14<S>& r, Matrix14<S>& K) noexcept {
    using std::sqrt;
    const auto set = [&K](int i, int j, const auto& block) {
      K.template block<3, 3>(i, j) = block;
      if (i != j) K.template block<3, 3>(j, i) = block.transpose();
    };
    r.template segment<3>(0) = -g[0], r.template segment<3>(7) = g[0];
    set(0, 0, H[0][0]), set(7, 7, H[0][0]), set(7, 0, M3<S>(-H[0][0]));
    const RodNode<S>* const nodes[2] = {&n1, &n2};
    V3<S> u[2];
    M3<S> J[2];
    for (int i = 0; i < 2; ++i) {
      const V3<S>& t = nodes[i]->tangent;
      const S size = sqrt(t.squaredNorm()), inverse = 1 / size, spring = p.axial * p.length / 2;
      u[i] = t * inverse;
      J[i] = inverse * skew(u[i]);
      const int at = 7 * i + 3;
      const V3<S>& m = g[1 + i];
      r.template segment<3>(at) = J[i].transpose() * m + spring * (size - 1) * u[i];
      r[at + 3] = u[i].dot(m);
      const V3<S> w = detail::cross3(m, u[i]), Hu = H[1 + i][1 + i] * u[i];
      M3<S> own = J[i].transpose() * (H[1 + i][1 + i] * J[i]) + spring * inverse * (u[i] * u[i].transpose()) -
                  inverse * inverse * (u[i] * w.transpose() + w * u[i].transpose());
      for (int k = 0; k < 3; ++k) own(k, k) += spring * (1 - inverse);
      set(at, at, own);
      const V3<S> beside = J[i].transpose() * Hu + inverse / 2 * (m - u[i].dot(m) * u[i]);
      K.template block<3, 1>(at, at + 3) = beside, K.template block<1, 3>(at + 3, at) = beside.transpose();
      K(at + 3, at + 3) = u[i].dot(Hu);
      const M3<S> by_chord = J[i].transpose() * H[1 + i][0];
      const V3<S> turn = H[1 + i][0].transpose() * u[i];
      set(at, 0, M3<S>(-by_chord)), set(at, 7, by_chord);
      K.template block<3, 1>(0, at + 3) = -turn, K.template block<1, 3>(at + 3, 0) = -turn.transpose();
      K.template block<3, 1>(7, at + 3) = turn, K.template block<1, 3>(at + 3, 7) = turn.transpose();
    }
    const M3<S>& C = H[2][1];
    set(10, 3, M3<S>(J[1].transpose() * (C * J[0])));
    const V3<S> first = J[1].transpose() * (C * u[0]), second = J[0].transpose() * (C.transpose() * u[1]);
    K.template block<3, 1>(10, 6) = first, K.template block<1, 3>(6, 10) = first.transpose();
    K.template block<3, 1>(3, 13) = second, K.template block<1, 3>(13, 3) = second.transpose();
    K(13, 6) = K(6, 13) = u[1].dot(C * u[0]);
  }
};

}  // namespace hapbeam::benchmarks
