// SPDX-License-Identifier: MIT
// The consistent mass of a beam or a rod, in the places and tangents of its nodes, and where it would be without force.
//
//   |q|² = qᵀ M q,   M of the cubic: constant, alike along each axis, and of neighbours alone
//
// The inertia ρI of sections that turn across the tangent is left out: the first frequency between hinges is (πh/L)²/24 of itself too high, h: height.
// Allocates at construction; all else is noexcept and allocation-free, O(n).
// Source: Archer 1963.
#pragma once

#include <array>
#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// @tparam D  2 | 3   @tparam Spins  1: nodes have an angle of twist, too; else 0
template <typename S, int D, int Elements, int MaxElements, int Spins = 0>
class MassBlocks {
 public:
  /// Place [m] and tangent of a node, and its angle of twist.
  using Placed = Eigen::Matrix<S, 2 * D + Spins, 1>;
  using Values = PerNode<Placed, Elements, MaxElements>;

  /// @param at  (i) -> arc position of node i [m]
  template <class Body, class At>
  MassBlocks(const Body& beam, int elements, At&& at)
      : masses_(elements), spins_(elements), blocks_(elements), ghost_(elements) {
    for (int e = 0; e < elements; ++e) {
      const double from = at(e), l = at(e + 1) - from;
      Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
      // Exact where the mass is even or tapers linearly.
      constexpr std::array<double, 4> x{0.0694318442029737124, 0.330009478207571868, 0.669990521792428132,
                                        0.930568155797026288},
          w{0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};
      for (std::size_t g = 0; g < x.size(); ++g) {
        const double t = x[g], u = 1 - t;
        const Eigen::Vector4d h(u * u * (1 + 2 * t), l * t * u * u, t * t * (3 - 2 * t), -l * t * t * u);
        const double mass = beam.mass_per_length(from + t * l);
        sum += w[g] * l * mass * h * h.transpose();
        if constexpr (Spins > 0) spins_[e] += static_cast<S>(w[g] * l * beam.spin_per_length(from + t * l));
      }
      masses_[e] = sum.template cast<S>();
    }
    set_rate(1);
  }

  /// @param c [1/s²]
  void set_rate(S c) noexcept {
    if (c == rate_) return;
    rate_ = c;
    const int last = blocks_.size() - 1;
    const auto of_both = [](S place, S tangent) {
      Placed both = Placed::Zero();
      both.template head<D>().setConstant(place), both.template segment<D>(D).setConstant(tangent);
      return both;
    };
    for (int i = 0; i <= last; ++i) {
      Eigen::Matrix<S, 2, 2> own = Eigen::Matrix<S, 2, 2>::Zero(), next = own, before = own;
      if (i > 0) {
        own += c * masses_[i - 1].template bottomRightCorner<2, 2>();
        before = c * masses_[i - 1].template bottomLeftCorner<2, 2>();
      }
      if (i < last) {
        own += c * masses_[i].template topLeftCorner<2, 2>();
        next = c * masses_[i].template topRightCorner<2, 2>();
      }
      const auto block = [&](const auto& M) {
        return Block{of_both(M(0, 0), M(1, 1)), of_both(M(0, 1), M(1, 0))};
      };
      blocks_[i] = {block(own), block(next), block(before)};
      if constexpr (Spins > 0) {
        // The mean of the consistent mass of a linear angle and of lumped mass: of fourth order.
        const S left = i > 0 ? c * spins_[i - 1] : S(0), right = i < last ? c * spins_[i] : S(0);
        blocks_[i].own.own[2 * D] = 5 * (left + right) / 12;
        blocks_[i].next.own[2 * D] = right / 12, blocks_[i].before.own[2 * D] = left / 12;
      }
    }
  }
  /// To be called where a stage begins: places and tangents say all of themselves.
  template <class Nodes, class Start>
  void begin_stage(const Nodes&, Start&&) noexcept {}
  Values& ghost() noexcept { return ghost_; }
  /// What increments are measured by, beside the strain energy [J].
  S scale() const noexcept { return scale_; }
  void set_scale(S energy) noexcept { scale_ = energy; }

  /// ½ |v|² [J].   @param v  (i) -> Placed of node i
  template <class V>
  S energy(V&& v) const noexcept {
    Placed sum = Placed::Zero();
    each_product(v,
                 [&](int, const Placed& x, const Placed& by) HAPBEAM_INLINED { sum += by.cwiseProduct(x); });
    return sum.sum() / (2 * rate_);
  }

  /// c M x of node i.   @param of  (i) -> x of node i
  template <class Of>
  Placed product(int i, Of&& of) const noexcept {
    const Blocks& to = blocks_[i];
    Placed sum = to.own * of(i);
    if (i + 1 < blocks_.size()) sum += to.next * of(i + 1);
    if (i > 0) sum += to.before * of(i - 1);
    return sum;
  }

  /// √(c |q|²) of places that are all displaced by so much [√J].   @param off [m]
  virtual S round_off(S off) const noexcept {
    Placed x = Placed::Zero();
    x.template head<D>().setConstant(off);
    return std::sqrt(2 * rate_ * energy([&x](int) { return x; }));
  }

 protected:
  /// Of c M, alike along each axis: what place and tangent of a node feel of themselves, and of each other.
  struct Block {
    Placed own = Placed::Zero(), other = Placed::Zero();
    [[gnu::always_inline]] Placed operator*(const Placed& off) const noexcept {
      Placed by;
      HAPBEAM_UNROLL
      for (int k = 0; k < D; ++k) {
        by[k] = own[k] * off[k] + other[k] * off[D + k];
        by[D + k] = own[D + k] * off[D + k] + other[D + k] * off[k];
      }
      if constexpr (Spins > 0) by[2 * D] = own[2 * D] * off[2 * D];
      return by;
    }
  };
  /// Of a node, with the next one and the one before.
  struct Blocks {
    Block own, next, before;
  };
  /// Calls use(i, x, c M x) for each node.   @param of  (i) -> x of node i
  template <class Of, class Use>
  [[gnu::always_inline]] void each_product(Of&& of, Use&& use) const noexcept {
    const int last = blocks_.size() - 1;
    Placed before = Placed::Zero(), here = of(0);
    for (int i = 0; i <= last; ++i) {
      const Placed next = i < last ? Placed(of(i + 1)) : here;  // the last one has no block of it
      const Blocks& to = blocks_[i];
      use(i, here, Placed(to.own * here + to.next * next + to.before * before));
      before = here, here = next;
    }
  }

  PerNode<Eigen::Matrix<S, 4, 4>, Elements, MaxElements>
      masses_;  // of places and tangents of both nodes, along an axis [kg], [kg·m], [kg·m²]
  PerNode<S, Elements, MaxElements> spins_;  // of an element that turns about its tangent [kg·m²]
  PerNode<Blocks, Elements, MaxElements> blocks_;
  Values ghost_;  // q~
  S rate_ = 0, scale_ = 0;
};

}  // namespace hapbeam::detail
