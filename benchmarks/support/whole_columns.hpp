// What BeamSystem asks of an assembler for contacts, of a factorisation that solves for whole right-hand sides alone.
#pragma once

#include <hapbeam/element/element.hpp>
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
