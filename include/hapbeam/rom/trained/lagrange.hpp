// SPDX-License-Identifier: MIT
// Lagrange interpolation in barycentric form, over a policy for the nodes (thesis eq. 3.67).
//
//   p(x) = Σ l_k(x) f_k,    l_k(x) = (w_k/(x - x_k)) / Σ_j w_j/(x - x_j)
//
// The weights l_k depend on x alone: one set serves every quantity at the same nodes, and on a grid the products of two sets.
// With 50 ChebyshevNodes an error in the values grows by at most Σ|l_k| = 3.5, with the thesis' EquispacedNodes by 2e12.
// Nodes of your own are a class N of static functions:
//
//   N::node(k, n)    double        x_k of n nodes, 0 ≤ k < n, in [-1, 1], ascending
//   N::weight(k, n)  double        w_k = 1/Π_(j≠k) (x_k - x_j), up to one common factor
//   N::name()        const char*   kept in the file of a trained model
//
//   take_snapshots<N>(…), train_pod<N>(…), PodModel<double, N>
//
// Source: Berrut and Trefethen, Barycentric Lagrange interpolation, SIAM Review 46 (2004).
// Real-time: weights() and combine() are noexcept, allocation-free, O(n) and O(rows × columns); construction throws.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

#include <Eigen/Core>

#include <hapbeam/check.hpp>

namespace hapbeam {

/// Chebyshev nodes of the first kind: none at the ends of the interval.
struct ChebyshevNodes {
  static constexpr const char* name() noexcept { return "chebyshev"; }
  static double node(int k, int n) { return n == 2 * k + 1 ? 0 : -std::cos(angle(k, n)); }
  static double weight(int k, int n) { return (k % 2 ? -1 : 1) * std::sin(angle(k, n)); }

 private:
  static double angle(int k, int n) { return 3.141592653589793238462643 * (2 * k + 1) / (2 * n); }
};

/// Equidistant nodes, the first and the last at the ends of the interval.
struct EquispacedNodes {
  static constexpr const char* name() noexcept { return "equispaced"; }
  static double node(int k, int n) { return n == 1 ? 0 : 2.0 * k / (n - 1) - 1; }
  /// Binomial coefficients with alternating signs, over the largest of them.
  static double weight(int k, int n) {
    const auto log_binomial = [n](int j) { return std::lgamma(n) - std::lgamma(j + 1) - std::lgamma(n - j); };
    return (k % 2 ? -1 : 1) * std::exp(log_binomial(k) - log_binomial((n - 1) / 2));
  }
};

namespace detail {
template <class N>
auto as_nodes(N*) -> std::bool_constant<std::is_convertible_v<decltype(N::node(0, 1)), double> &&
                                        std::is_convertible_v<decltype(N::weight(0, 1)), double> &&
                                        std::is_convertible_v<decltype(N::name()), const char*>>;
template <typename>
std::false_type as_nodes(...);

template <int Rows, typename Scalar>
[[gnu::always_inline]] inline void combine_rows(const Scalar* a, int stride, const Scalar* x, int columns,
                                                Scalar* y) noexcept {
  using Column = Eigen::Array<Scalar, Rows, 1>;
  Column sum = Column::Zero();
  for (int k = 0; k < columns; ++k, a += stride) sum += x[k] * Eigen::Map<const Column>(a);
  Eigen::Map<Column>{y} = sum;
}

/// y = Σ_k x_k a_k with a_k the first `rows` of the k-th run of `stride` numbers of A.  So many rows at a time as registers
/// hold, through all columns: A is read once and y is written once.  Quickest where rows is a multiple of eight.
/// @param y  out, rows values
template <typename Scalar>
[[gnu::noinline]] void combine(const Scalar* A, int stride, int rows, const Scalar* x, int columns,
                               Scalar* y) noexcept {
  constexpr int wide = 32, half = 16, narrow = 8;
  int r = 0;
  for (; r + wide <= rows; r += wide) combine_rows<wide>(A + r, stride, x, columns, y + r);
  for (; r + half <= rows; r += half) combine_rows<half>(A + r, stride, x, columns, y + r);
  for (; r + narrow <= rows; r += narrow) combine_rows<narrow>(A + r, stride, x, columns, y + r);
  for (; r < rows; ++r) combine_rows<1>(A + r, stride, x, columns, y + r);
}

/// The next multiple of eight.
constexpr int padded(int rows) noexcept { return (rows + 7) / 8 * 8; }

/// Σ x_k y_k
template <typename Scalar>
Scalar dot(const Scalar* x, const Scalar* y, int size) noexcept {
  return std::inner_product(x, x + size, y, Scalar(0));
}

}  // namespace detail

/// @tparam Nodes   ChebyshevNodes | EquispacedNodes | a class as above
template <class Nodes = ChebyshevNodes, typename Scalar = double>
class Lagrange {
  static_assert(decltype(detail::as_nodes<Nodes>(nullptr))::value,
                "a Nodes policy needs static node(int k, int n) -> double, weight(int k, int n) -> double "
                "and name()");

 public:
  /// More nodes do not help ChebyshevNodes and ruin EquispacedNodes.
  static constexpr int max_size = 64;
  static constexpr int block = 4;  // numbers of a register

  /// @param size 1 to max_size   @param low, high  ends of the interval; equal only where size is 1
  /// @throws std::invalid_argument
  [[gnu::cold]] Lagrange(int size, Scalar low, Scalar high) : size_(size), low_(low), high_(high) {
    if (size < 1 || size > max_size) detail::refuse("nodes = %d: must be 1 to %d", size, max_size);
    if (!(std::isfinite(low) && std::isfinite(high) && (low < high || (low == high && size == 1))))
      detail::refuse("interval = %g to %g: must be finite and ascending", double(low), double(high));
    std::fill_n(nodes_, max_size, std::numeric_limits<Scalar>::infinity());
    std::fill_n(weights_, max_size, Scalar(0));
    const double middle = (double(low) + double(high)) / 2, half = (double(high) - double(low)) / 2;
    for (int k = 0; k < size; ++k) {
      nodes_[k] = static_cast<Scalar>(middle + half * Nodes::node(k, size));
      weights_[k] = static_cast<Scalar>(Nodes::weight(k, size));
      // Differences of neighbours must have digits left.
      const Scalar least = 1000 * std::numeric_limits<Scalar>::epsilon() * std::abs(nodes_[k]);
      if (k > 0 && !(nodes_[k] - nodes_[k - 1] > least))
        detail::refuse("interval = %g to %g: must be wider for so many nodes", double(low), double(high));
    }
  }

  Scalar low() const noexcept { return low_; }
  Scalar high() const noexcept { return high_; }
  int size() const noexcept { return size_; }
  Scalar node(int k) const noexcept { return nodes_[k]; }

  /// l_k(x) for every k, whose sum is 1.  Outside the interval this extrapolates.
  /// @param l  out, size() values
  [[gnu::noinline]] void weights(Scalar x, Scalar* l) const noexcept {
    using Block = Eigen::Array<Scalar, block, 1>;
    const auto term = [&](int k) -> Block {
      return Eigen::Map<const Block>(weights_ + k) / (x - Eigen::Map<const Block>(nodes_ + k));
    };
    Block sum = Block::Zero();
    int k = 0;
    for (; k + block <= size_; k += block) sum += Eigen::Map<Block>{l + k} = term(k);
    const Block rest = k < size_ ? term(k) : Block(Block::Zero());
    const Scalar inverse = 1 / (sum + rest).sum();
    if (!(std::abs(inverse) > 0)) {  // a term of the barycentric form is infinite
      for (k = 0; k < size_; ++k) l[k] = size_ == 1 || x == nodes_[k] ? Scalar(1) : Scalar(0);
      return;
    }
    for (k = 0; k + block <= size_; k += block) Eigen::Map<Block>{l + k} *= inverse;
    for (int i = k; i < size_; ++i) l[i] = rest[i - k] * inverse;
  }

  /// The interpolant's derivative at the nodes.  Its degree is n - 2, so that they define it.
  /// @param f, slope  in and out, no overlap: size() values each, so many apart
  [[gnu::cold, gnu::noinline]] void differentiate(const Scalar* f, int stride, Scalar* slope,
                                                  int slope_stride) const noexcept {
    for (int i = 0; i < size(); ++i) {
      const Scalar here = f[i * stride];
      Scalar sum = 0;  // Σ_j l_j'(x_i) f_j, where the l_j' sum to zero: the derivative of 1
      for (int j = 0; j < size(); ++j)
        if (j != i) sum += weights_[j] / weights_[i] * (f[j * stride] - here) / (nodes_[i] - nodes_[j]);
      slope[i * slope_stride] = sum;
    }
  }

 private:
  int size_;
  Scalar low_, high_;
  // Beyond size_ there are weights of zero, and nodes that nothing is near.
  Scalar nodes_[max_size], weights_[max_size];
};

}  // namespace hapbeam
