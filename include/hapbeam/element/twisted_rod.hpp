// SPDX-License-Identifier: MIT
// The element of a rod in space of any section and natural shape: exact derivatives of an energy that no rigid motion changes.
//
// Centreline: the cubic of rod_properties.hpp.  Frame: the director of node 1 is carried to the tangent at ξ by the smallest
// rotation, and turned there by
//
//   θ(ξ) = φ1 (1 - ξ) + (φ2 + m) ξ + 4 ψ ξ (1 - ξ)
//
// with m the angle from the carried director to that of node 2, and ψ a twist of the element's own, which is condensed.
// Without ψ torsion is of second order. φ1 and φ2 turn the directors of the nodes. They are zero in each state and the
// unknowns of its increment. While a tangent moves, its director is carried along by the smallest rotation.
//
//   V = ½ l εᵀ EA M ε + ½ l Σ w (EI1 (κ1 - κ1°)² + EI2 (κ2 - κ2°)² + GJ (τ - τ°)²)        sum over Gauss points
//
// Two points: three would resolve large bends better, but lock where bending and twist are coupled.  A round rod that is straight by
// nature bends as RoundRod does, and twists as round_twist.hpp says.
//
// ε = |r'| - 1 - ε° at ξ = 0, ½, 1, interpolated (M). Full integration of ε locks, and its mean leaves a mechanism. κ°
// is interpolated the same way from the natural shape, whose energy is therefore zero.
//
// In the axes of node 1, (d1, d2, tangent), with a = r' = (x, y, z), b = r'' = (p, q, s), n = |a|, D = n (n + z):
//
//   K1 = -q/n + y g,   K2 = p/n - x g,   c = (xq - yp)/D,   g = (s + a·b/n)/D          carried frame, which twists by -c
//   κ1 + iκ2 = e^(-iθ) (K1 + iK2),   τ = θ' - c
//
// and with u, v the directions of both ends' tangents,  ∂m = k·(∂u + ∂v),  k = u × v/(1 + u·v).
// The state has no angle that is counted from a state before: an equilibrium does not depend on the path to it.  Right
// while an element's tangent turns and twists by less than half a turn from one end to the other.
// Real-time: no allocation, noexcept, O(1).
// Source: carried frames, Bergou and others, Discrete elastic rods, ACM Trans. Graph. 27 (2008); the derivatives are ours.
#pragma once

#include <cmath>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/round_twist.hpp>
#include <hapbeam/element/rod/twisted_core.hpp>
#include <hapbeam/element/rod/twisted_strains.hpp>

namespace hapbeam {

struct TwistedRod {
  static constexpr int dimension = 3;
  static constexpr bool any_rotation = true;
  static constexpr int unknowns = 7;  ///< of a node: r, r', φ
  static constexpr const char* name() noexcept { return "twisted-rod"; }

  template <typename S>
  using Vector14 = Eigen::Matrix<S, 14, 1>;
  template <typename S>
  using Matrix14 = Eigen::Matrix<S, 14, 14>;

  /// ψ of one that is not round, and N of one that is taut.
  template <typename S>
  using Inner = detail::RodInners<S, unknowns>;

  /// The director at ξ.   @param twist  ψ
  template <typename S>
  static VectorOf<S, 3> director(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                                 S twist, S x) noexcept {
    const Frame<S> f(p, n1, n2);
    if (!p.round) return f.director(n1.director, twist, x);
    // As if what the middle has aside were the same all along: Θ grows with ξ³.
    const S carried = Twist<S>(p, n1, n2, {p, n1, n2}).carried();
    const V3<S> d3 = detail::unit(f.tangent(x));
    return detail::turn(detail::carry(n1.director, f.u, d3), d3, f.mismatch * x - carried * x * (1 - x * x));
  }
  /// ψ with which the director in the middle is along the given one.
  template <typename S>
  static S twist_to(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                    const VectorOf<S, 3>& middle) noexcept {
    const Frame<S> f(p, n1, n2);
    const V3<S> v = detail::unit(f.tangent(S(0.5)));
    const V3<S> half = detail::turn(detail::carry(n1.director, f.u, v), v, f.mismatch / 2);
    return detail::angle_about(v, half, detail::across(middle, v));
  }

  /// Curvatures and twist at the Gauss points and |r'| - 1 at ξ = 0, ½, 1 of a shape: what is natural in it.
  template <typename S>
  static void take_natural(const RodNode<S>& n1, const RodNode<S>& n2, S twist,
                           RodProperties<S>& p) noexcept {
    for (S& e : p.natural_strain) e = 0;
    const Frame<S> f(p, n1, n2);
    for (int g = 0; g < points; ++g) {
      const S x = S(rule.x[g]);
      const Point<S> point(f, cubics[g]);
      point.strains(f.mismatch * x + 4 * twist * x * (1 - x), f.mismatch + 4 * twist * (1 - 2 * x),
                    p.inverse_length, p.points[g].natural);
    }
    S e[3];
    f.stretches(p, e);
    for (int i = 0; i < 3; ++i) p.natural_strain[i] = e[i];
  }

  /// Residual and tangent, the element's own twist condensed away.
  /// @param r  out [N, N·m of r', N·m]   @param K  out, symmetric, both triangles   @param inner  its derivatives are set
  template <typename S>
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>& inner,
                   Vector14<S>& r, Matrix14<S>& K) noexcept {
    RodTangent<S, 4> all;
    const S energy = tangent(p, n1, n2, inner, all);
    all.expand(r, K);
    return energy;
  }
  /// The same, each derivative once.
  template <typename S>
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>& inner,
                   RodTangent<S, 4>& all) noexcept;

 private:
  static constexpr int points = 2;
  static constexpr const detail::GaussRule& rule = detail::two_points;
  static constexpr detail::CubicAt cubics[points] = {detail::CubicAt(rule.x[0]), detail::CubicAt(rule.x[1])};
  template <typename S>
  using V3 = VectorOf<S, 3>;

  template <typename S>
  HAPBEAM_ALIGNED_STACK [[gnu::flatten]] static S round_tangent(const RodProperties<S>& p,
                                                                const RodNode<S>& n1, const RodNode<S>& n2,
                                                                Inner<S>& inner,
                                                                RodTangent<S, 4>& all) noexcept {
    const detail::EndsAndMiddle<S> at(p, n1, n2);
    const S energy = RoundRod::respond(p, n1, n2, at, inner.tension, all);
    const Twist<S> twist(p, n1, n2, at);
    twist.add(p.inverse_length, all);
    return energy + twist.energy();
  }

  /// Of one that is not round.   @return the energy [J]
  template <typename S>
  HAPBEAM_ALIGNED_STACK [[gnu::flatten]] static S add_tension(const RodProperties<S>& p, const RodNode<S>& n1,
                                                              const RodNode<S>& n2,
                                                              detail::RodInner<S, 7>& inner,
                                                              RodTangent<S, 4>& all) noexcept {
    const detail::EndsAndMiddle<S> at(p, n1, n2);
    const Tension<S> tension(p, at, inner.value);
    tension.add(p.inverse_length, inner, all);
    return tension.energy();
  }

  template <typename S>
  using Tension = detail::RoundTension<S>;
  template <typename S>
  using Twist = detail::RoundTwist<S>;
  template <typename S>
  using Frame = detail::CarriedFrame<S>;
  template <typename S>
  using Point = detail::CarriedPoint<S>;
};

// Outside of the class: only so does "extern template" keep a compiler from it.
template <typename S>
S TwistedRod::tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>& inner,
                      RodTangent<S, 4>& all) noexcept {
  if (p.round) return round_tangent(p, n1, n2, inner, all);
  const Frame<S> f(p, n1, n2);
  detail::TwistedCore<S> core;
  const S energy = detail::respond(p, f, inner.twist.value, core);
  detail::expand(f, core, p.inverse_length, inner.twist, all);
  return p.taut ? S(energy + add_tension(p, n1, n2, inner.tension, all)) : energy;
}

}  // namespace hapbeam
