// The closed form as a ForceModel: what one would write for a beam between two hinges, and for no other.
//
// The tension of closed_form.hpp, in double and by secants from that of the last press, then the shape at nodes that follow
// the contact.  Below κL = 0.05 the brackets have lost too many digits; there k is its tangent at κL = 0.05.
// Servo: noexcept, no allocation, at most 40 evaluations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

class ClosedFormModel {
 public:
  using Scalar = double;

  explicit ClosedFormModel(const Beam& beam) noexcept
      : L_(beam.length()),
        EA_(beam.axial_stiffness()),
        EI_(beam.bending_stiffness()),
        least_(0.0025 * EI_ / (L_ * L_)),
        thickness_(beam.thickness()) {
    reset();
  }

  Response<double> press(const Press<double>& request) noexcept {
    if (!std::isfinite(request.s) || !std::isfinite(request.d) || request.s < 0 || request.s > L_)
      return {0, Status::invalid_request};
    const Press<double> press = range().nearest(request);
    const double force = balance(press.s, press.d) * press.d;
    draw(press.s, force);
    return {force, press.s == request.s && press.d == request.d ? Status::ok : Status::out_of_range};
  }

  Centreline<double> shape() const noexcept { return {nodes_.data(), segments + 1}; }
  Range<double> range() const noexcept { return {L_ / 1000, L_ - L_ / 1000, L_ / 10, 0.5, 0, L_}; }
  double thickness() const noexcept { return thickness_; }
  void reset() noexcept {
    N_ = least_;
    for (int i = 0; i <= segments; ++i) nodes_[static_cast<std::size_t>(i)] = {L_ * i / segments, 0, 0, 0};
  }

 private:
  static constexpr int segments = 32;

  struct Stiffness {
    double k, by_tension;  // [N/m], [1/m]
  };

  Stiffness stiffness(double s, double N) const noexcept {
    const double r = L_ - s, kappa = std::sqrt(N / EI_);
    const double a = std::expm1(-2 * kappa * s), b = std::expm1(-2 * kappa * r);
    const double c = a + b + a * b;  // expm1(-2 κL)
    const double boundary = -a * b / (2 * c * kappa);
    const auto coth = [](double fall) { return -(2 + fall) / fall; };
    const double log_slope = s * coth(a) + r * coth(b) - L_ * coth(c);
    const double G = (s * r / L_ - boundary) / N;
    const double G_by_N = -(boundary * (log_slope * kappa - 1) / (2 * N) + G) / N;
    return {1 / G, -G_by_N / (G * G)};
  }

  /// Tension and k for a press.   @return k [N/m]
  double balance(double s, double d) noexcept {
    Stiffness at = stiffness(s, least_);
    const double unit = d * d * EA_ / (2 * L_);
    const double first = unit * at.by_tension - least_;
    if (first <= 0) {
      const double N = unit * at.by_tension;
      N_ = least_;
      return at.k + at.by_tension * (N - least_);
    }
    double low = least_, high = EA_, miss_low = first;
    double N = std::clamp(N_, 1.0001 * least_, high), before = low, miss_before = miss_low;
    for (int k = 0; k < 40; ++k) {
      at = stiffness(s, N);
      const double miss = unit * at.by_tension - N;
      (miss > 0 ? low : high) = N;
      double next = N - miss * (N - before) / (miss - miss_before);
      if (!(next > low && next < high)) next = (low + high) / 2;
      const double step = next - N;
      before = N, miss_before = miss;
      N = next;
      if (std::abs(step) <= 1e-9 * N) {
        at.k += at.by_tension * step;
        break;
      }
    }
    N_ = N;
    return at.k;
  }

  void draw(double s, double force) noexcept {
    side(s, force, 1, nodes_.begin(), 1);
    side(L_ - s, force, -1, nodes_.end() - 1, -1);
    nodes_[segments / 2].s = s;
  }

  /// The part of length `own` between a hinge and the contact, from the hinge on.  @param sign  -1: from the right
  template <class Iterator>
  void side(double own, double force, double sign, Iterator node, int next) noexcept {
    constexpr int pieces = segments / 2;
    const double kappa = std::sqrt(N_ / EI_), step = own / pieces, chord = (L_ - own) / L_, pull = force / N_;
    // B sinh κx and B cosh κx, by sums of angles.
    const double B = std::sinh(kappa * (L_ - own)) / std::sinh(kappa * L_);
    const double sh = std::sinh(kappa * step), ch = std::cosh(kappa * step);
    double S = 0, C = B;
    for (int i = 0; i <= pieces; ++i, node += next) {
      const double x = step * i, slope = pull * (chord - C);
      const double squares = chord * chord * x - 2 * chord * S / kappa + (B * B * x + S * C / kappa) / 2;
      const double u = N_ * x / EA_ - pull * pull * squares / 2;
      *node = {sign > 0 ? x : L_ - x, sign * u, pull * (chord * x - S / kappa), -sign * slope};
      const double turned = S * ch + C * sh;
      C = C * ch + S * sh, S = turned;
    }
  }

  double L_, EA_, EI_, least_, thickness_;
  double N_ = 0;  // of the last press [N]
  std::array<CentrelineNode<double>, segments + 1> nodes_{};
};

}  // namespace hapbeam::benchmarks
