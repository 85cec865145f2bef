// The membrane policy that makes a straight element exact: what its tension does to its stretch and to its bending.
//
//   V(d, N) = N e - N² l/2EA + EI/4l³ ((B - 6)(a + b)² + (A - 2)(a - b)²),     e = u2 - u1 + rise²/2l - e0,     q = N l²/EI
//
// stationary in N, the element's own unknown, which is condensed.  A(q), B(q): tension_stiffness.hpp; 2 and 6: the bending without
// tension, which VonKarman adds; e0: the e of the natural shape without tension.  Without a load on it, or as a part of a polygon of
// constant tension, the element solves EI w'''' = N w'' exactly.  AssumedStrain is its first order, A = 2 + q/6 and B = 6 + q/10.
//
//   ∂V/∂N = 0:    N l/EA = e + (B'(a + b)² + A'(a - b)²)/4l
//
// The right side falls with N and is convex: Newton's method rises to its one root, from e alone or from the first step of N = 0.
// Real-time: no allocation, noexcept, O(1).
// Source: derived here; docs/theory.md, The element.
#pragma once

#include <hapbeam/element/element.hpp>
#include <hapbeam/element/tension_stiffness.hpp>

namespace hapbeam {

namespace detail {

template <typename S>
[[gnu::always_inline]] inline S larger(const S& a, const S& b) noexcept {
  return a < b ? b : a;
}
template <typename S>
[[gnu::always_inline]] inline bool all_less(const S& a, const S& b) noexcept {
  return a < b;
}

/// q of an element and what follows from it.
template <typename S>
struct ElementTension {
  S q;
  TensionStiffness<S> k;
  S compliance;  ///< ∂e/∂N at held rotations, times (EA/l) (EI/l³) l [N]

  /// @param across, about  squares of a + b and a - b
  [[gnu::always_inline]] ElementTension(const ElementProperties<S>& p, const S& e, const S& across,
                                        const S& about) noexcept {
    using detail::all_less;
    const S unit = p.bending_per_length3 * p.length, stiff = p.axial_per_length,
            quarter = p.inverse_length / 4;
    const auto lack = [&](const S& b1, const S& a1) {
      return stiff * (e + quarter * (b1 * across + a1 * about));
    };
    const auto slope = [&](const S& b2, const S& a2) {
      return unit - stiff * quarter * (b2 * across + a2 * about);
    };
    const S first = lack(S(1. / 10), S(1. / 6)) / slope(S(-1. / 700), S(-1. / 180));
    q = larger(first, S(stiff * e / unit));
    const S eps = S(Eigen::NumTraits<S>::epsilon());
    // The last step is entered to second order: what is left is of its third.
    for (int i = 0; i < most; ++i) {
      k = tension_stiffness(q);
      compliance = slope(k.b2, k.a2);
      const S step = (lack(k.b1, k.a1) - unit * q) / compliance;
      q += step;
      k.a += step * (k.a1 + step * k.a2 / 2), k.a1 += step * k.a2;
      k.b += step * (k.b1 + step * k.b2 / 2), k.b1 += step * k.b2;
      if (all_less(S(step * step), S(eps * (1 + q * q)))) break;
    }
  }

 private:
  static constexpr int most = 12;
};

}  // namespace detail

struct StabilityFunctions {
  using ExactUnderTension = StabilityFunctions;
  using Abreast = StabilityFunctions;
  static constexpr const char* name() noexcept { return "stability-functions"; }

  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& d) noexcept {
    const S i = p.inverse_length, half = p.bending_per_length3 / 2;
    const S across = d.a + d.b, about = d.a - d.b,
            e = d.stretch + (d.rise * d.rise - detail::natural_mean_square(p)) * i / 2;
    const detail::ElementTension<S> t(p, e, S(across * across), S(about * about));
    const S unit = p.bending_per_length3 * p.length, normal = t.q * unit, n = normal * i;
    const S bx = half * t.k.b * across, ax = half * t.k.a * about, m1 = bx + ax, m2 = bx - ax;
    // ∂²V/∂N∂(rise, lθ1, lθ2)
    const S b1 = t.k.b1 * across * i / 2, a1 = t.k.a1 * about * i / 2, n1 = b1 + a1, n2 = b1 - a1,
            nr = d.rise * i + n1 + n2;
    const S stiff = p.axial_per_length * unit / t.compliance, k11 = half * (t.k.b + t.k.a),
            k12 = half * (t.k.b - t.k.a), sum = 2 * half * t.k.b;
    const S s1 = stiff * n1, s2 = stiff * n2, sr = stiff * nr;
    const S stretched = e - normal / p.axial_per_length / 2;
    return {normal * stretched + (bx * across + ax * about) / 2,
            normal,
            n * d.rise + m1 + m2,
            m1,
            m2,
            {stiff, sr, s1, s2, n + 2 * sum + sr * nr, sum + sr * n1, sum + sr * n2, k11 + s1 * n1,
             k12 + s1 * n2, k11 + s2 * n2}};
  }
};

}  // namespace hapbeam
