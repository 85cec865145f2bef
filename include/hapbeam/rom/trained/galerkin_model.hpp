// SPDX-License-Identifier: MIT
// A trained beam that still solves its equation, in one unknown, the tension N, as a ForceModel.
//
//   V(d, N) = ½ k(s, N) d² - N² L/(2EA),     F = ∂V/∂d = k d,     0 = ∂V/∂N = ½ d² ∂k/∂N - N L/EA
//
// k = 1/g(s; s, N), with g the response to a unit force at s under N (docs/theory.md, reduced models).  It is interpolated: ln(scale k)
// over x(s) and z = ln(1 + N/N0), N0 = 10 EI/L².  For the von Kármán beam there is no other error.  k increases with N and is concave, so
// the equation has one root: Newton's method within a bracket.
// Beyond the largest trained tension k' falls to that of a string, 1/A, as N^(-1/2), the effect of its boundary layers: A = s(L - s)/L
// between two ends that hold w.  Where no tension arises (an end slides, or the element is linear) k depends on s alone.
// Offline: construction allocates and throws.  Servo: noexcept, allocation-free, at most max_iterations iterations.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/trained_model.hpp>

namespace hapbeam {

namespace detail {

/// By position: by tension f = ln(scale k), df/dz, d²f/dz² and d²f/dxdz; what makes the nodes near the contact, with df/dx for its own.
template <typename Scalar, class Nodes>
struct GalerkinTable : TrainedTable<GalerkinModelData<Scalar>, Nodes, 4> {
  using Base = TrainedTable<GalerkinModelData<Scalar>, Nodes, 4>;
  using Base::data;
  TensionCoordinate<Scalar> tension{data.beam};
  Lagrange<Nodes, Scalar> z{data.tensions, 0, tension(data.tension)};

  [[gnu::cold]] explicit GalerkinTable(GalerkinModelData<Scalar> given) : Base(std::move(given)) {
    const int m = data.tensions, size = this->row_size();
    Scalar* row = this->table.data();
    for (int i = 0; i < data.positions; ++i, row += size) {
      for (int j = 0; j < m; ++j) row[4 * j] = data.log_stiffness[static_cast<std::size_t>(i * m + j)];
      z.differentiate(row, 4, row + 1, 4);
      z.differentiate(row + 1, 4, row + 2, 4);
    }
    row = this->table.data();
    for (int j = 0; j < m; ++j) {
      this->x.differentiate(row + 4 * j, size, this->nearby(row, j) + Base::Shape::own, size);
      this->x.differentiate(row + 4 * j + 1, size, row + 4 * j + 3, size);
    }
  }
};

}  // namespace detail

/// @tparam ScalarType double | float      @tparam NodePolicy  ChebyshevNodes | EquispacedNodes, as it was trained
template <typename ScalarType = double, class NodePolicy = ChebyshevNodes>
class GalerkinModel : public detail::TrainedModel<detail::GalerkinTable<ScalarType, NodePolicy>> {
  using Base = detail::TrainedModel<detail::GalerkinTable<ScalarType, NodePolicy>>;

 public:
  using Scalar = ScalarType;
  using Nodes = NodePolicy;
  using Data = GalerkinModelData<Scalar>;
  static constexpr int max_iterations = 40;

  /// @throws std::invalid_argument where the data do not make a model
  [[gnu::cold]] explicit GalerkinModel(Data data) : Base(std::move(data)) {}

  /// The force alone; shape() stays.  @return as press()
  [[nodiscard]] Response<Scalar> force(const Press<Scalar>& request) noexcept {
    Point at;
    return respond(request, at);
  }

  /// Force and shape of a transverse displacement d [m] at arc position s [m] of the unloaded beam.
  /// Deeper than range() the equation is still solved, with a tension that may exceed the trained ones; s is that of
  /// the nearest press in range.
  /// @return force [N] and ok | out_of_range | invalid_request | non_finite
  Response<Scalar> press(const Press<Scalar>& request) noexcept;

  void reset() noexcept {
    Base::reset();
    last_ = 0;
  }

  /// Newton iterations of the last press.
  int iterations() const noexcept { return iterations_; }

 private:
  using Base::max_size;
  using Base::trained_;

  struct Point {
    Press<Scalar> press;
    Scalar lx[max_size], lz[max_size];  // weights
    Scalar column[4 * max_size];        // by tension f = ln(scale k) at s, df/dz, d²f/dz² and d²f/dxdz
    Scalar f, by_z, by_zz, by_xz;
    Scalar beyond;  // √(N/Nm), 1 where the tension was trained
  };

  Response<Scalar> respond(const Press<Scalar>& request, Point& at) noexcept;

  /// f and its derivatives at z.
  void along(Point& at, Scalar z) const noexcept {
    const int m = trained_->data.tensions;
    trained_->z.weights(z, at.lz);
    Eigen::Array<Scalar, 4, 1> sum = Eigen::Array<Scalar, 4, 1>::Zero();
    for (int j = 0; j < m; ++j) sum += at.lz[j] * Eigen::Map<const decltype(sum)>(at.column + 4 * j);
    at.f = sum[0], at.by_z = sum[1], at.by_zz = sum[2], at.by_xz = sum[3];
  }

  /// k(s, N) [N/m] with N the tension of the press.  In z the equation is
  ///   φ(z) = q exp(f - z) f' - (exp(z) - 1) = 0,     q = d² EA/(2 L N0² scale)
  /// with φ falling, for k is concave in N.
  Scalar balance(Point& at, Scalar scale) noexcept;

  /// What ∂k/∂N = 1/A + b √(Nm/N) adds to k from Nm to N.
  Scalar beyond(const Point& at, Scalar string, Scalar b) const noexcept {
    const Scalar r = at.beyond;
    return trained_->data.tension * (string * (r - 1) * (r + 1) + 2 * b * (r - 1));
  }

  /// θ at the contact: (∂V/∂s)/F = ½ d (∂k/∂s)/k, N being stationary [rad].
  /// @param by_x  df/dx
  Scalar rotation(const Point& at, Scalar by_x) const noexcept;

  /// 1/A, stiffness of a string under unit tension with these ends [1/m], and its derivative by s.
  struct String {
    Scalar stiffness, by_s;
  };
  String string_at(Scalar s) const noexcept {
    const auto& beam = trained_->data.beam;
    const Scalar L = beam.length, right = L - s;
    if (!fixes_w(beam.left)) return {1 / right, 1 / (right * right)};
    if (!fixes_w(beam.right)) return {1 / s, -1 / (s * s)};
    return {L / (s * right), L * (2 * s - L) / (s * s * right * right)};
  }

  Scalar last_ = 0;  // z of the last press
  int iterations_ = 0;
};

// Long functions are defined outside of the class: only then does "extern template class GalerkinModel<>;" compile them in one file alone.
template <typename Scalar, class Nodes>
Response<Scalar> GalerkinModel<Scalar, Nodes>::press(const Press<Scalar>& request) noexcept {
  Point at;
  const Response<Scalar> response = respond(request, at);
  if (!is_answer(response.status)) return response;
  const auto theta = [&](Scalar by_x) { return rotation(at, by_x); };
  if (!this->draw(at.press, at.press.d, at.lx, at.lz, theta)) return {0, Status::non_finite};
  return response;
}

template <typename Scalar, class Nodes>
Response<Scalar> GalerkinModel<Scalar, Nodes>::respond(const Press<Scalar>& request, Point& at) noexcept {
  iterations_ = 0;
  at.beyond = 1;
  if (!this->valid(request)) return {0, Status::invalid_request};
  const Press<Scalar> nearest = this->range().nearest(request);
  at.press = {nearest.s, detail::bounded(request.d, trained_->data.beam.length)};
  const int m = trained_->data.tensions;
  this->weigh(at.press.s, at.lx);
  detail::combine(trained_->table.data(), trained_->row_size(), detail::padded(4 * m), at.lx,
                  trained_->data.positions, at.column);
  const Scalar scale = trained_->position.scale(at.press.s);
  const Scalar stiffness = m == 1 ? (along(at, 0), std::exp(at.f) / scale) : balance(at, scale);
  const Scalar force = stiffness * at.press.d;
  if (!std::isfinite(force)) return {0, Status::non_finite};
  const bool in_range = nearest.s == request.s && nearest.d == request.d;
  return {force, in_range ? Status::ok : Status::out_of_range};
}

template <typename Scalar, class Nodes>
Scalar GalerkinModel<Scalar, Nodes>::balance(Point& at, Scalar scale) noexcept {
  const Scalar d = at.press.d, N0 = trained_->tension.unit(), z_max = trained_->z.high();
  const Scalar flexibility = trained_->data.beam.length / trained_->data.beam.axial_stiffness;
  const Scalar q = d * d / (2 * flexibility * N0 * N0 * scale);
  // Newton's method, and near the root Halley's, of third order: what a step that small leaves is round-off.
  const Scalar settled = std::cbrt(std::numeric_limits<Scalar>::epsilon()) / 16;
  Scalar low = -1, high = 2 * z_max, z = (std::min)(last_, z_max);  // both open: no end has been looked at
  Scalar k = 0;
  for (; iterations_ < max_iterations; ++iterations_) {
    along(at, z);
    const Scalar ratio = std::exp(at.f - z), part = q * ratio, growth = std::expm1(z),
                 phi = part * at.by_z - growth;
    (phi > 0 ? low : high) = z;
    k = ratio * (growth + 1) / scale;
    if (low == z_max) break;
    const Scalar less = at.by_z - 1, falls = growth + 1 - part * (at.by_z * less + at.by_zz),
                 bends = growth + 1 - part * (at.by_z * less * less + at.by_zz * (3 * at.by_z - 2));
    const Scalar newton = phi / falls, curve = newton * bends / (2 * falls);
    const Scalar step = std::abs(curve) < Scalar(0.25) ? newton / (1 + curve) : newton;
    const Scalar next = (std::min)((std::max)(z + step, Scalar(0)), z_max);
    if (std::abs(step) <= settled) {
      const Scalar way = next - z, change = way * (at.by_z + way / 2 * at.by_zz);
      at.f += change;
      at.by_z += way * at.by_zz;
      k *= 1 + change * (1 + change / 2);
      z = next;
      trained_->z.weights(z, at.lz);
      break;
    }
    z = next > low && next < high ? next : ((std::max)(low, Scalar(0)) + (std::min)(high, z_max)) / 2;
  }
  last_ = z;
  if (low != z_max) return k;

  // N = Nm r²:  k' = 1/A + b/r,  hence r³ - P r - Q = 0, convex where r > 0; Newton comes down to its only root there.
  const Scalar Nm = trained_->data.tension, string = string_at(at.press.s).stiffness;
  const Scalar b = k * at.by_z / (N0 + Nm) - string, half = d * d / (2 * flexibility * Nm);
  const Scalar P = half * string, Q = half * b;
  Scalar r = (std::max)(std::sqrt(P) + std::cbrt((std::max)(Q, Scalar(0))), Scalar(1));
  for (; iterations_ < max_iterations; ++iterations_) {
    const Scalar step = (r * (r * r - P) - Q) / (3 * r * r - P);
    if (!(step > 0)) break;
    r -= step;
    if (step <= settled * r) break;
  }
  at.beyond = (std::max)(r, Scalar(1));
  return k + beyond(at, string, b);
}

template <typename Scalar, class Nodes>
Scalar GalerkinModel<Scalar, Nodes>::rotation(const Point& at, Scalar by_x) const noexcept {
  const Scalar s = at.press.s, x_by_s = trained_->position.derivative(s);
  const Scalar log_by_s = by_x * x_by_s - trained_->position.log_scale_derivative(s);  // of k, or of k at Nm
  if (!(at.beyond > 1)) return at.press.d / 2 * log_by_s;
  const Scalar k = std::exp(at.f) / trained_->position.scale(s), k_by_s = k * log_by_s;
  const auto [string, string_by_s] = string_at(s);
  const Scalar span = trained_->tension.unit() + trained_->data.tension;  // N0 + Nm
  const Scalar b = k * at.by_z / span - string;
  const Scalar b_by_s = (k_by_s * at.by_z + k * at.by_xz * x_by_s) / span - string_by_s;
  return at.press.d / 2 * (k_by_s + beyond(at, string_by_s, b_by_s)) / (k + beyond(at, string, b));
}

}  // namespace hapbeam
