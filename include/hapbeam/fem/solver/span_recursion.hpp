// One more element of a span under tension, condensed to the span's inner end.
//
// Under a tension N all elements of a span, which are equally long, have one stiffness, linear in N.  Seen from its inner
// end a span is a stiffness S in w and φ = lθ there; one more element makes of it
//
//   S' = K22 - K21 (K11 + S)⁻¹ K12
//
// This is rational in S and linear in its Plücker coordinates σ : σS : σ det S: a step is a product with a constant sparse
// matrix and has no division.  A displacement that the outer support holds is an infinite S, σ = 0, and needs no case of its
// own.  With K11 = H + c, K12 = -H T⁻¹, T⁻¹ = [1 τ; 0 1], H = [rr -r; -r h], c on φ alone and D = det H the step is
//
//   σ' = σ + (h a + 2r b + rr e)/D + d                          S = [a b; b e]/σ - c,  det(S + c) = D d/σ
//   a' = a + rr d,   b' = b + τa + r d,   e' = e + 2τb + τ²a + h d + 2c σ',   d' = d + 2c a'/D
//
// All terms are positive where N is not negative, so that nothing cancels: the stiffness at the inner node is exact to a few
// last places whatever the number of elements, in float as in double.  With Taylor polynomials in N for numbers the same
// steps give its derivatives.  Two spans run side by side, in the lanes of one register.
//
// Lengths are in units of the beam's L, forces of EI/L², so that tension is ν = N L²/EI.
// Real-time: noexcept, no allocation; 63 multiply-adds a pair of elements with derivatives.
// Source: condensation as in Golub and Van Loan, Matrix Computations, 4.5.1; Riccati recursions are linear on Lagrangian
// planes: Bittanti, Laub and Willems, The Riccati Equation, 1991, ch. 3.
#pragma once

#include <type_traits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/taylor.hpp>

namespace hapbeam::detail {

/// An element of length and EI 1 under tension, as above.
/// @tparam T  Lanes, or Taylor of Lanes
template <class T>
struct TensionedElement {
  T rr, r, h, tau, c, c2, D, i_D;
  T h_D, r_D, r2_D, rr_D, t12_D, shear_D, c2_D;  // over D; shear: r (h - t12)
};

/// σ and so on of either span.
template <class T>
struct SpanStiffness {
  T sigma, a, b, e, d;
};

/// What an element does to a span.
template <class Element, typename Scalar>
class SpanRecursion {
  using Pair = Lanes<Scalar>;  // of the left and of the right span

 public:
  /// An element's tangent in (rise, lθ1, lθ2).
  struct Terms {
    Pair rr, r, t11, t12;
  };

  SpanRecursion() {
    // Of one element of length 1: EI = 1 without tension, and a unit of tension alone.
    const auto terms = [](Scalar bending, Scalar stretch) {
      const auto k = Element::respond(ElementProperties<Scalar>(1, 1, bending),
                                      Deformation<Scalar>(stretch, Scalar(0), Scalar(0)))
                         .k;
      return Terms{Pair::both(k.rr), Pair::both(k.r1), Pair::both(k.t11), Pair::both(k.t12)};
    };
    bent_ = terms(1, 0);
    taut_ = terms(0, 1);
    const Pair bent = bent_.t11 + bent_.t12, taut = taut_.t11 + taut_.t12, four = Pair::both(4),
               two = Pair::both(2);
    turning_ = bent * taut_.rr + taut * bent_.rr - four * bent_.r * taut_.r;
    turning_taut_ = taut * taut_.rr - two * taut_.r * taut_.r;
  }

  /// Of a unit of tension alone.
  const Terms& taut() const noexcept { return taut_; }

  /// @param n  tension times l²
  template <class T>
  [[gnu::always_inline]] TensionedElement<T> under(const T& n) const noexcept {
    TensionedElement<T> k;
    k.rr = linear(bent_.rr, taut_.rr, n);
    k.r = linear(bent_.r, taut_.r, n);
    const T t12 = linear(bent_.t12, taut_.t12, n), r2 = k.r + k.r, i = inverse(k.rr);
    k.tau = r2 * i;
    k.h = k.tau * k.r - t12;
    k.c = n * linear(turning_, turning_taut_, n) * i;  // t11 + t12 - τr, whose parts without tension cancel
    k.c2 = k.c + k.c;
    k.D = k.r * k.r - k.rr * t12;
    k.i_D = inverse(k.D);
    k.h_D = k.h * k.i_D;
    k.r_D = k.r * k.i_D;
    k.r2_D = k.r_D + k.r_D;
    k.rr_D = k.rr * k.i_D;
    k.t12_D = t12 * k.i_D;
    k.shear_D = k.r_D * (k.h - t12);
    k.c2_D = k.c2 * k.i_D;
    return k;
  }

  /// Adds elements to both spans.  @param visit  (span before, σ after) at each
  template <class T, class Visit>
  [[gnu::always_inline]] static SpanStiffness<T> add(const TensionedElement<T>& element, SpanStiffness<T> x,
                                                     int elements, Visit&& visit) noexcept {
    const TensionedElement<T> k = element;
    for (int i = 0; i < elements; ++i) {
      const T b = add_product(x.b, k.tau, x.a), e = add_product(x.e, k.tau, T(x.b + b));
      const T sigma =
          add_product(add_product(add_product(x.sigma, k.h_D, x.a), k.r2_D, x.b), k.rr_D, x.e) + x.d;
      visit(x, value(sigma));
      x.sigma = sigma;
      x.a = add_product(x.a, k.rr, x.d);
      x.b = add_product(b, k.r, x.d);
      x.e = add_product(add_product(e, k.h, x.d), k.c2, sigma);
      x.d = add_product(x.d, k.c2_D, x.a);
      if (value(sigma)[0] > large || value(sigma)[1] > large) {
        const Pair q = inverse(value(sigma));
        x = {scaled(q, x.sigma), scaled(q, x.a), scaled(q, x.b), scaled(q, x.e), scaled(q, x.d)};
      }
    }
    return x;
  }

 private:
  /// Of a σ that is brought back to 1: a product of two, over l⁴, is a number.
  static constexpr Scalar large = std::is_same_v<Scalar, float> ? Scalar(1e6) : Scalar(1e12);

  [[gnu::always_inline]] static Pair linear(const Pair& a, const Pair& b, const Pair& x) noexcept {
    return add_product(a, b, x);
  }
  [[gnu::always_inline]] static Taylor<Pair> linear(const Pair& a, const Pair& b,
                                                    const Taylor<Pair>& x) noexcept {
    return {add_product(a, b, x.c0), b * x.c1, b * x.c2};
  }

  Terms bent_, taut_;            // by bending alone, and by a unit of tension
  Pair turning_, turning_taut_;  // of c
};

}  // namespace hapbeam::detail
