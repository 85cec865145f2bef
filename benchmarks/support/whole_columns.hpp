// What BeamSystem asks of an assembler for contacts, of a factorisation that solves for whole right-hand sides alone.
#pragma once

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

/// Base class of an assembler.
/// @tparam Solver  x = solved(b) after factor(), where x() is that of its own right-hand side
template <class Solver, typename Scalar>
class WholeColumns {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

 public:
  struct Column {
    int first = 0;
    Vector6<Scalar> b;
    Vector x;  ///< K⁻¹b
    explicit Column(int elements) : x(3 * (elements + 1)) {}
  };

  /// As of BlockTridiagonal: elements that were computed side by side.
  template <class Tangent, class Residual>
  void add_pairs(int first, const Tangent& K, const Residual& r) {
    Solver& self = static_cast<Solver&>(*this);
    const detail::PairOrder order{static_cast<int>(self.x_.rows()) / 3 - 1};
    if (first == 0) self.start();
    for (int lane = 0; lane < r[0].size && first + lane < 2 * order.pairs(); ++lane) {
      const int e = order.element(first + lane);
      if (e < 0) continue;
      Matrix6<Scalar> its;
      Vector6<Scalar> residual;
      for (int j = 0; j < 6; ++j) {
        residual[j] = r[j][lane];
        for (int i = 0; i < 6; ++i) its(i, j) = K(i, j)[lane];
      }
      self.add(e, its, residual);
    }
  }
  template <std::size_t Lanes>
  void increments(int first, Scalar (&x)[3][Lanes]) const {
    int nodes[Lanes];
    detail::PairOrder{static_cast<int>(solver().x_.rows()) / 3 - 1}.nodes_from(first, nodes);
    for (std::size_t lane = 0; lane < Lanes; ++lane)
      for (int k = 0; k < 3; ++k) x[k][lane] = solver().x_[3 * nodes[lane] + k];
  }
  void forward(int e, const Vector6<Scalar>& b, Column& column) const {
    column.first = 3 * e;
    column.b = b;
    column.x.setZero();
    column.x.template segment<6>(column.first) = b;
    column.x = solver().solved(column.x);
  }
  Scalar product(const Column& a, const Column& b) const { return a.b.dot(b.x.template segment<6>(a.first)); }
  Scalar product(const Column& b) const { return b.b.dot(solver().x_.template segment<6>(b.first)); }
  void add(const Column& b, Scalar times) { static_cast<Solver&>(*this).x_ += times * b.x; }
  void substitute() const noexcept {}

  Status solve() { return static_cast<Solver&>(*this).factor(); }

 private:
  const Solver& solver() const noexcept { return static_cast<const Solver&>(*this); }
};

}  // namespace hapbeam::benchmarks
