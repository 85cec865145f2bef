// A linear beam under one transverse force, in closed form: the ForceModel contract as a short program.
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/force_model.hpp>

enum class Ends { simply_supported, cantilever };

/// Euler–Bernoulli, length 1 m; F = 3 EI d / (s² (1 - s)²) between hinges, F = 3 EI d / s³ on a cantilever.
/// Both deflect as a cubic on either side of the force, so two pieces hold the shape exactly.
template <typename S>
class ClosedFormBeam {
 public:
  using Scalar = S;
  static constexpr Scalar bending_stiffness = 1;

  explicit ClosedFormBeam(Ends ends) : ends_(ends) { reset(); }

  hapbeam::Response<Scalar> press(const hapbeam::Press<Scalar>& request) noexcept {
    ++presses;
    if (fail_with != hapbeam::Status::ok) return {0, fail_with};
    if (!std::isfinite(request.s) || !std::isfinite(request.d) || request.s < 0 || request.s > 1)
      return {0, hapbeam::Status::invalid_request};
    const auto p = range().nearest(request);
    const Scalar a = p.s, b = 1 - p.s;
    Scalar force, slope_left, slope_at, slope_right;
    if (ends_ == Ends::simply_supported) {
      force = 3 * bending_stiffness * p.d / (a * a * b * b);
      slope_left = force * b * (1 - b * b) / (6 * bending_stiffness);
      slope_at = force * b * (1 - b * b - 3 * a * a) / (6 * bending_stiffness);
      slope_right = -force * a * (1 - a * a) / (6 * bending_stiffness);
      nodes_[2].w = 0;
    } else {
      force = 3 * bending_stiffness * p.d / (a * a * a);
      slope_left = 0;
      slope_at = slope_right = Scalar(1.5) * p.d / a;
      nodes_[2].w = p.d + b * slope_at;
    }
    nodes_[0] = {0, 0, 0, -slope_left};
    nodes_[1] = {p.s, 0, p.d, -slope_at};
    nodes_[2] = {1, 0, nodes_[2].w, -slope_right};
    if (!(b > 0)) {  // the force is at the free end: split the one piece in the middle
      nodes_[2] = nodes_[1];
      nodes_[1] = {Scalar(0.5), 0, p.d * Scalar(5) / 16, -p.d * Scalar(9) / 8};
    }
    const bool inside = p.s == request.s && p.d == request.d;
    return {force, inside ? hapbeam::Status::ok : hapbeam::Status::out_of_range};
  }
  hapbeam::Centreline<Scalar> shape() const noexcept { return {nodes_, 3}; }
  hapbeam::Range<Scalar> range() const noexcept {
    const bool tip = ends_ == Ends::cantilever;
    const Scalar none = std::numeric_limits<Scalar>::infinity();
    return {Scalar(0.05), tip ? Scalar(1) : Scalar(0.95), Scalar(0.1), Scalar(2), 0, tip ? none : Scalar(1)};
  }
  Scalar thickness() const noexcept { return Scalar(2e-3); }
  void reset() noexcept {
    nodes_[0] = {0, 0, 0, 0};
    nodes_[1] = {Scalar(0.5), 0, 0, 0};
    nodes_[2] = {1, 0, 0, 0};
  }

  int presses = 0;                                  ///< how often press() was called
  hapbeam::Status fail_with = hapbeam::Status::ok;  ///< what press() answers, with force 0 and the state kept

 private:
  Ends ends_;
  hapbeam::CentrelineNode<Scalar> nodes_[3];
};
