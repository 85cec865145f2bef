// SPDX-License-Identifier: MIT
// The coordinates in which a beam's response is smooth enough for a polynomial.
//
// Toward an end that holds w the stiffness grows as the 2nd power of the inverse distance beside a hinge, and the 3rd beside a clamp.
// With these powers divided out it is smooth in x = ln(s/(L - s)).  Deep presses stiffen from k to k + c d², which is gradual in
// y = ln(1 + (d/ρ)²), ρ = ½√(EI/EA).  Presses up to 50 mm of the thesis' pinned beam, 16 × 12 nodes: the largest error of the force is
// 5e-5; with s and d² it is 7e-2.
// noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/support.hpp>

namespace hapbeam {

/// The data of its beam that a trained model keeps.
template <typename Scalar>
struct BeamData {
  Scalar length;             ///< [m]
  Scalar axial_stiffness;    ///< EA [N]
  Scalar bending_stiffness;  ///< EI [N·m²]
  Scalar thickness;          ///< [m]
  Support left, right;

  /// @tparam AnyBeam  Beam; a template, so that a program that only loads a model need not include it
  template <class AnyBeam>
  static BeamData of(const AnyBeam& beam) noexcept {
    const auto EA = Scalar(beam.axial_stiffness()), EI = Scalar(beam.bending_stiffness());
    return {Scalar(beam.length()), EA, EI, Scalar(beam.thickness()), beam.left(), beam.right()};
  }
};

/// x(s) = ln(s/L) - ln(1 - s/L), without the term of an end that yields.
template <typename Scalar>
class PositionCoordinate {
 public:
  explicit PositionCoordinate(const BeamData<Scalar>& beam) noexcept
      : length_(beam.length), left_(power(beam.left)), right_(power(beam.right)) {}

  Scalar operator()(Scalar s) const noexcept {
    const Scalar t = s / length_;
    return left_ > 0 ? right_ > 0 ? std::log(t / (1 - t)) : std::log(t) : -std::log(1 - t);
  }
  /// s at x
  Scalar inverse(Scalar x) const noexcept {
    if (left_ > 0) return length_ * (right_ > 0 ? 1 / (1 + std::exp(-x)) : std::exp(x));
    return length_ * (1 - std::exp(-x));
  }
  /// dx/ds [1/m]
  Scalar derivative(Scalar s) const noexcept {
    return (left_ > 0 ? 1 / s : Scalar(0)) + (right_ > 0 ? 1 / (length_ - s) : Scalar(0));
  }

  /// What a stiffness at s is multiplied with to stay finite at the ends: (s/L)ᵖ (1 - s/L)^q.
  Scalar scale(Scalar s) const noexcept {
    const Scalar t = s / length_;
    return raise(t, left_) * raise(1 - t, right_);
  }
  /// d ln(scale)/ds [1/m]
  Scalar log_scale_derivative(Scalar s) const noexcept {
    return (left_ > 0 ? Scalar(left_) / s : Scalar(0)) -
           (right_ > 0 ? Scalar(right_) / (length_ - s) : Scalar(0));
  }

 private:
  static int power(Support end) noexcept { return !fixes_w(end) ? 0 : fixes_theta(end) ? 3 : 2; }
  static Scalar raise(Scalar t, int power) noexcept {
    return power == 0 ? Scalar(1) : power == 2 ? t * t : t * t * t;
  }

  Scalar length_;
  int left_, right_;
};

/// Symmetric: y(e) = ln(1 + (e/ρ)²), for a response that is even in e.  Signed: ±√ of it, for one that is not.
template <typename Scalar>
class DepthCoordinate {
 public:
  DepthCoordinate(const BeamData<Scalar>& beam, bool symmetric) noexcept
      : rho_(std::sqrt(beam.bending_stiffness / beam.axial_stiffness) / 2), symmetric_(symmetric) {}

  Scalar operator()(Scalar e) const noexcept {
    const Scalar t = e / rho_, y = std::log1p(t * t);
    return symmetric_ ? y : t < 0 ? -std::sqrt(y) : std::sqrt(y);
  }
  /// e at y, not negative where symmetric
  Scalar inverse(Scalar y) const noexcept {
    if (symmetric_) return rho_ * std::sqrt(std::expm1(y));
    return (y < 0 ? -rho_ : rho_) * std::sqrt(std::expm1(y * y));
  }
  /// ½ e dy/de, given y(e)
  Scalar half_log_derivative(Scalar e, Scalar y) const noexcept {
    const Scalar t = e / rho_, even = t * t / (1 + t * t);
    return symmetric_ ? even : y == 0 ? Scalar(0) : even / (2 * y);
  }

 private:
  Scalar rho_;
  bool symmetric_;
};

/// z(N) = ln(1 + N/N0), N0 = 10 EI/L²: tensions that bending outweighs and string-like ones lie orders of magnitude apart.
/// A guided end is a plane of symmetry: L is then that of the whole beam.
template <typename Scalar>
class TensionCoordinate {
 public:
  explicit TensionCoordinate(const BeamData<Scalar>& beam) noexcept
      : unit_((beam.left == Support::guided || beam.right == Support::guided ? Scalar(2.5) : Scalar(10)) *
              beam.bending_stiffness / (beam.length * beam.length)) {}
  Scalar operator()(Scalar tension) const noexcept { return std::log1p(tension / unit_); }
  Scalar inverse(Scalar z) const noexcept { return unit_ * std::expm1(z); }
  Scalar unit() const noexcept { return unit_; }  ///< N0 [N]

 private:
  Scalar unit_;
};

}  // namespace hapbeam
