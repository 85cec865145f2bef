// The reference assembler: the whole tangent as one dense matrix, factored by Eigen.
//
// It computes what BlockTridiagonal computes, in O(n³), without knowing that a beam is a chain.  Use it to check
// an assembler or an element, never in a servo loop: it allocates.  Exceptions: only at construction.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include <hapbeam/fem/solver/pair_order.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements, int Block = 3>
class Dense {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

 public:
  explicit Dense(int elements)
      : K_(Block * (elements + 1), Block * (elements + 1)), x_(Block * (elements + 1)) {}

  /// Members do what those of BlockTridiagonal of the same name do.
  template <class Tangent, class Residual>
  void add(int e, const Tangent& K, const Residual& r) noexcept {
    if (e == 0) {
      K_.setZero();
      x_.setZero();
      held_energy_ = 0;
    }
    add_entries(e, K, r);
  }

  template <class Tangent, class Residual>
  void add_pairs(int first, Tangent& K, Residual& r) noexcept {
    const detail::PairOrder order{static_cast<int>(x_.size()) / Block - 1};
    Eigen::Matrix<Scalar, 2 * Block, 2 * Block> tangent;
    Eigen::Matrix<Scalar, 2 * Block, 1> residual;
    if (first == 0) {  // element 0 starts a new system
      tangent.setZero(), residual.setZero();
      add(0, tangent, residual);
    }
    for (int k = 0; k < r[0].size && first + k < 2 * order.pairs(); ++k) {
      const int e = order.element(first + k);
      if (e < 0) continue;
      for (int j = 0; j < 2 * Block; ++j) {
        residual[j] = r[j][k];
        for (int i = 0; i < 2 * Block; ++i) tangent(i, j) = K(i, j)[k];
      }
      add_entries(e, tangent, residual);
    }
  }

  template <class Tangent, class Residual>
  void add_at(int node, const Tangent& K, const Residual& r) noexcept {
    for (int i = 0; i < Block; ++i) {
      for (int j = 0; j < Block; ++j) K_(Block * node + i, Block * node + j) += i < j ? K(j, i) : K(i, j);
      x_[Block * node + i] -= r[i];
    }
  }
  Scalar residual(int node, int component) noexcept { return -x_[Block * node + component]; }
  template <int At, class Three>
  void turn(int node, const Three& Q) noexcept {
    const int k = Block * node + At;
    K_.template middleCols<3>(k) = (K_.template middleCols<3>(k) * Q).eval();
    K_.template middleRows<3>(k) = (Q.transpose() * K_.template middleRows<3>(k)).eval();
    x_.template segment<3>(k) = (Q.transpose() * x_.template segment<3>(k)).eval();
  }
  template <int Unknown, int Others, class Part>
  void lean(int node, const Part& part) noexcept {
    const int from = Block * node + Unknown, to = Block * node + Others;
    for (int j = 0; j < 3; ++j) {
      K_.col(to + j) -= part[j] * K_.col(from);
      x_[to + j] -= part[j] * x_[from];
    }
    for (int j = 0; j < 3; ++j) K_.row(to + j) -= part[j] * K_.row(from);
  }
  template <class Part>
  void lean(int node, int unknown, const Part& part) noexcept {
    const int from = Block * node + unknown, to = Block * node;
    for (int j = 0; j < 6; ++j) {
      K_.col(to + j) -= part[j] * K_.col(from);
      x_[to + j] -= part[j] * x_[from];
    }
    for (int j = 0; j < 6; ++j) K_.row(to + j) -= part[j] * K_.row(from);
  }
  template <class Three, class Increment>
  void clamp(int node, const Three& u, const Increment& by) noexcept {
    const int at = Block * node;
    x_ -= K_.middleCols(at, Block) * by;
    const Vector free = K_.middleCols(at + 3, 3) * u;
    const Scalar rhs = u.dot(x_.template segment<3>(at + 3)), pivot = u.dot(free.template segment<3>(at + 3));
    x_.segment(at, Block).setZero();
    K_.middleCols(at, Block).setZero();
    K_.col(at + 5) = free;
    K_.middleRows(at, Block).setZero();
    K_.row(at + 5) = free.transpose();
    K_.block(at, at, Block, Block).setIdentity();
    K_(at + 5, at + 5) = pivot;
    x_[at + 5] = rhs;
  }

  void prescribe(int node, int component, Scalar increment) noexcept {
    const int k = Block * node + component;
    const Scalar pivot = K_(k, k);
    x_ -= increment * K_.col(k);
    x_[k] = 0;
    K_.row(k).setZero();
    K_.col(k).setZero();
    K_(k, k) = pivot;
  }

  struct HeldRow {
    Vector by;
    Scalar by_loads = 0;
  };
  void hold(int node, int component, Scalar increment) noexcept { hold(node, component, increment, held_); }
  void hold(int node, int component, Scalar increment, HeldRow& row) noexcept {
    const int k = Block * node + component;
    row.by = K_.col(k);
    row.by[k] = 0;
    row.by_loads = K_(k, k) * increment - x_[k];
    held_energy_ += K_(k, k) * increment * increment;
    prescribe(node, component, increment);
  }
  template <class Three>
  void hold_along(int node, int component, const Three& by, HeldRow& row) noexcept {
    const int k = Block * node + component;
    const Vector made = K_.middleCols(Block * node, 3) * by;
    row.by = K_.col(k);
    row.by[k] = 0;
    row.by_loads = made[k] - x_[k];
    held_energy_ += by.dot(made.template segment<3>(Block * node));
    x_ -= made;
    prescribe(node, component, 0);
  }
  void know(int node, int component, Scalar increment, HeldRow& row) const noexcept {
    row.by_loads += row.by[Block * node + component] * increment;
  }
  HeldRow& held() noexcept { return held_; }

  Status solve() {
    if (!K_.allFinite() || !x_.allFinite()) return Status::non_finite;
    const Vector assembled = K_.diagonal(), rhs = x_;
    const Eigen::LDLT<Matrix> factor(K_);
    x_ = factor.solve(rhs);
    energy_ = rhs.dot(x_);
    if (held_energy_ > std::abs(energy_)) energy_ = held_energy_;
    negative_pivots_ = static_cast<int>((factor.vectorD().array() < 0).count());
    // Its order of elimination is not the beam's, so a pivot that should be zero holds the round-off of all rows.
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon() * static_cast<Scalar>(K_.rows());
    const Vector unpermuted = factor.transpositionsP().transpose() * factor.vectorD();
    return (unpermuted.array().abs() > epsilon * assembled.array().abs()).all() ? Status::ok
                                                                                : Status::singular;
  }

  Scalar energy() const noexcept { return energy_; }
  Scalar reaction() const noexcept { return reaction(held_); }
  Scalar reaction(const HeldRow& row) const noexcept { return row.by_loads + row.by.dot(x_); }
  int negative_pivots() const noexcept { return negative_pivots_; }
  Eigen::Matrix<Scalar, Block, 1> increment(int node) const noexcept {
    return x_.template segment<Block>(Block * node);
  }

  template <std::size_t Lanes>
  void increments(int first, Scalar (&x)[Block][Lanes]) const noexcept {
    const detail::PairOrder order{static_cast<int>(x_.size()) / Block - 1};
    for (int lane = 0; lane < static_cast<int>(Lanes); ++lane)
      for (int k = 0; k < Block; ++k)
        x[k][lane] = increment(order.node((std::min)(first + lane, order.last_node())))[k];
  }

 private:
  template <class Tangent, class Residual>
  void add_entries(int e, const Tangent& K, const Residual& r) noexcept {
    for (int i = 0; i < 2 * Block; ++i) {
      for (int j = 0; j < 2 * Block; ++j) {
        const bool mirrored = i < Block ? i < j && j < Block : i < j || j < Block;
        K_(Block * e + i, Block * e + j) += mirrored ? K(j, i) : K(i, j);
      }
      x_[Block * e + i] -= r[i];
    }
  }

  Matrix K_;
  Vector x_;
  HeldRow held_;
  Scalar energy_ = 0, held_energy_ = 0;
  int negative_pivots_ = 0;
};

}  // namespace hapbeam
