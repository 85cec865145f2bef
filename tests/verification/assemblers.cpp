// The block-tridiagonal assembler against dense linear algebra on random states of a beam.
//
// Bounds are measured in a scaled system, D K D with D = diag(K)^(-1/2), where metres and radians are alike:
// LDLᵀ without pivoting of a positive definite matrix is as exact there as anywhere, |δx| <= c n eps κ |x|
// with κ the scaled condition (Higham, Accuracy and Stability, 10.1).
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "support/catch.hpp"
#include "support/chain.hpp"
#include "support/eigenvalues.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The whole tangent and right-hand side of a chain, for Eigen.
template <int Block>
struct DenseSystem {
  Eigen::MatrixXd K;
  Eigen::VectorXd b;

  explicit DenseSystem(int elements)
      : K(Eigen::MatrixXd::Zero(Block * (elements + 1), Block * (elements + 1))),
        b(Eigen::VectorXd::Zero(K.rows())) {}
  template <class Tangent, class Residual>
  void add(int e, const Tangent& tangent, const Residual& residual) {
    K.block<2 * Block, 2 * Block>(Block * e, Block * e) += tangent;
    b.segment<2 * Block>(Block * e) -= residual;
  }
  template <class Tangent, class Residual>
  void add_at(int node, const Tangent& tangent, const Residual& residual) {
    K.block<Block, Block>(Block * node, Block * node) += tangent;
    b.segment<Block>(Block * node) -= residual;
  }
  /// Other unknowns of a node:  old = T new.
  template <class Matrix>
  void change(int node, const Matrix& T) {
    K.middleCols<Block>(Block * node) = (K.middleCols<Block>(Block * node) * T).eval();
    K.middleRows<Block>(Block * node) = (T.transpose() * K.middleRows<Block>(Block * node)).eval();
    b.segment<Block>(Block * node) = (T.transpose() * b.segment<Block>(Block * node)).eval();
  }
  /// Unknown k becomes known; its solution is 0.
  void prescribe(int k, double increment) {
    b -= increment * K.col(k);
    b[k] = 0;
    K.row(k).setZero();
    K.col(k).setZero();
    K(k, k) = 1;
  }
  Eigen::VectorXd solve() const { return K.fullPivLu().solve(b); }
};

/// @param K, r  of each element
template <class Chain, class Tangents, class Residuals>
void add_all(Chain& chain, const Tangents& K, const Residuals& r) {
  const auto of = [](const auto& all) {
    return [&all](int e) -> const auto& { return all[static_cast<std::size_t>(e)]; };
  };
  add_elements(chain, static_cast<int>(K.size()), of(K), of(r));
}

struct Prescribed {
  int node, component;
  double increment;
};

/// One random beam in a random state: element tangents, residuals less random nodal forces, prescribed increments.
struct Problem {
  std::vector<Matrix6<double>> K;
  std::vector<Vector6<double>> r;
  std::vector<Prescribed> prescribed;

  /// @param strain  of the axis, negative in compression   @param slope  size of the random rotations
  Problem(Random& random, int elements, double strain, double slope)
      : K(static_cast<std::size_t>(elements)), r(K.size()) {
    Vector3<double> node(0, 0, random(slope));
    for (std::size_t e = 0; e < K.size(); ++e) {
      const ElementProperties<double> p(random(0.2, 0.6), 1.3e8, 7e3);
      const Vector3<double> next(node[0] + strain * p.length, node[1] + random(slope) * p.length,
                                 random(slope));
      Vector6<double> d;
      d << node, next;
      VonKarman<>::tangent(p, d, r[e], K[e]);
      node = next;
    }
    const auto force = [&random] { return Vector3<double>(random(1e3), random(1e2), random(1e2)); };
    for (auto& residual : r) residual.head<3>() -= force();
    r.back().tail<3>() -= force();
    prescribed = {{0, 0, random(1e-4)}, {0, 1, random(1e-3)}, {elements, 0, random(1e-4)}, {elements, 1, 0}};
    if (elements > 2) prescribed.push_back({random.integer(1, elements - 1), 1, random(1e-3)});
  }

  int elements() const { return static_cast<int>(K.size()); }

  void assemble(BlockTridiagonal<double>& assembler) const {
    add_all(assembler, K, r);
    for (const Prescribed& p : prescribed) assembler.prescribe(p.node, p.component, p.increment);
  }
  Status solve(BlockTridiagonal<double>& assembler) const {
    assemble(assembler);
    return assembler.solve();
  }

  /// Tangent and right-hand side of the free degrees of freedom, scaled to a unit diagonal, and which these
  /// are.
  struct Reduced {
    Eigen::MatrixXd K;
    Eigen::VectorXd rhs, scale;
    std::vector<int> free;
  };
  Reduced reduced() const {
    DenseSystem<3> all(elements());
    for (int e = 0; e < elements(); ++e)
      all.add(e, K[static_cast<std::size_t>(e)], r[static_cast<std::size_t>(e)]);
    std::vector<bool> held(static_cast<std::size_t>(all.b.size()));
    for (const Prescribed& p : prescribed) {
      const int k = 3 * p.node + p.component;
      all.b -= p.increment * all.K.col(k);
      held[static_cast<std::size_t>(k)] = true;
    }
    Reduced result;
    for (int k = 0; k < all.b.size(); ++k)
      if (!held[static_cast<std::size_t>(k)]) result.free.push_back(k);
    const int n = static_cast<int>(result.free.size());
    result.scale.resize(n);
    result.K.resize(n, n);
    result.rhs.resize(n);
    for (int i = 0; i < n; ++i) {
      const int row = result.free[static_cast<std::size_t>(i)];
      result.scale[i] = 1 / std::sqrt(std::abs(all.K(row, row)));
      for (int j = 0; j < n; ++j) result.K(i, j) = all.K(row, result.free[static_cast<std::size_t>(j)]);
      result.rhs[i] = all.b[row];
    }
    result.K = (result.scale.asDiagonal() * result.K * result.scale.asDiagonal()).eval();
    result.rhs = (result.scale.asDiagonal() * result.rhs).eval();
    return result;
  }
};

/// Increments of the free degrees of freedom, in the scaled system.
Eigen::VectorXd increments(const BlockTridiagonal<double>& assembler, const Problem::Reduced& reduced) {
  Eigen::VectorXd x(reduced.rhs.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const int k = reduced.free[static_cast<std::size_t>(i)];
    x[i] = assembler.increment(k / 3)[k % 3] / reduced.scale[i];
  }
  return x;
}

}  // namespace

TEST_CASE("increments are those of the dense system, prescriptions included", "[assembler]") {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int elements = random.integer(2, 24);
    const Problem problem(random, elements, 1e-3, 0.02);  // in tension, so positive definite
    const Problem::Reduced reduced = problem.reduced();
    const Spectrum spectrum(reduced.K);
    REQUIRE(spectrum.negative() == 0);

    BlockTridiagonal<double> chain(elements);
    REQUIRE(problem.solve(chain) == Status::ok);
    const Eigen::VectorXd x = spectrum.solve(reduced.rhs);
    const double tolerance = 2.2e-16 * 3 * elements * spectrum.condition() * x.norm();
    CHECK((increments(chain, reduced) - x).norm() <= tolerance);
    // xᵀKx
    const double energy = x.dot(reduced.rhs);
    CHECK(std::abs(chain.energy() - energy) <= 2 * tolerance * reduced.rhs.norm());
    for (const Prescribed& p : problem.prescribed) CHECK(chain.increment(p.node)[p.component] == 0);
  }
}

TEST_CASE("the negative pivots are as many as the negative eigenvalues of the free tangent", "[assembler]") {
  Random random(2);
  std::array<int, 3> seen{};
  for (int trial = 0; trial < 400; ++trial) {
    const int elements = random.integer(2, 16);
    // From tension into compression far beyond the buckling of one element, EI/(EA l²) 4π².
    const Problem problem(random, elements, random(-2e-2, 1e-3), 0.02);
    const Spectrum spectrum(problem.reduced().K);
    const int negative = spectrum.negative();
    if (spectrum.smallest() < 1e-9) continue;  // undecided by round-off
    BlockTridiagonal<double> chain(elements);
    REQUIRE(problem.solve(chain) == Status::ok);
    INFO("trial " << trial << ", " << elements << " elements");
    CHECK(chain.negative_pivots() == negative);
    ++seen[negative == 0 ? 0 : negative < 4 ? 1 : 2];
  }
  for (const int times : seen) CHECK(times >= 20);  // definite, slightly and highly indefinite all occurred
}

// Straight, of equal elements and with a power of two for EA/l and EI/l³, so that elimination is exact.
TEST_CASE("a bar that can slide is reported as singular", "[assembler]") {
  for (const int elements : {2, 3, 8, 64})
    for (const bool loaded : {false, true}) {
      Matrix6<double> K;
      Vector6<double> r;
      VonKarman<>::tangent(ElementProperties<double>(0.25, 1 << 20, 1 << 10), Vector6<double>::Zero().eval(),
                           r, K);
      BlockTridiagonal<double> chain(elements);
      const Vector6<double> end = r - Vector6<double>::Unit(0);
      add_elements(
          chain, elements, [&](int) -> const auto& { return K; },
          [&](int e) -> const auto& { return loaded && e == 0 ? end : r; });
      for (int i = 0; i <= elements; ++i)
        for (const int component : {1, 2}) chain.prescribe(i, component, 0);
      CHECK(chain.solve() == Status::singular);
    }
}

namespace {

/// As in a program of few calls, which a compiler inlines differently from a model: g++ 12 -O3 has solved another system here.
[[gnu::noinline]] Status solve_apart(BlockTridiagonal<double>& assembler, const Matrix6<double>& K,
                                     const Vector6<double>& r, int elements) {
  add_elements(
      assembler, elements, [&](int) -> const auto& { return K; }, [&](int) -> const auto& { return r; });
  return assembler.solve();
}

}  // namespace

TEST_CASE("an assembler solves the same system wherever it is called from", "[assembler]") {
  Matrix6<double> K;
  Vector6<double> r;
  const Vector6<double> d(0, 0, 0.01, 1e-4, 1e-3, 0.02);
  VonKarman<>::tangent(ElementProperties<double>(0.1, 1.3e8, 7e3), d, r, K);
  K.diagonal().array() += 1e5;
  for (const int elements : {2, 3, 8}) {
    BlockTridiagonal<double> chain(elements);
    DenseSystem<3> dense(elements);
    for (int e = 0; e < elements; ++e) dense.add(e, K, r);
    const Eigen::VectorXd x = dense.solve();
    REQUIRE(solve_apart(chain, K, r, elements) == Status::ok);
    // K's condition, 1.3e9 / 1e5 in its own units, costs four of sixteen digits.
    for (int i = 0; i <= elements; ++i)
      CHECK((chain.increment(i) - x.segment<3>(3 * i)).norm() <= 1e-11 * x.segment<3>(3 * i).norm());
  }
}

TEST_CASE("a tangent or residual that is not finite is reported as such", "[assembler]") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity})
    for (const std::size_t element : {0u, 2u, 4u})
      for (const bool in_tangent : {true, false}) {
        Random random(4);
        Problem problem(random, 5, 1e-3, 0.02);
        problem.prescribed = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
        (in_tangent ? problem.K[element](3, 3) : problem.r[element][4]) = value;
        BlockTridiagonal<double> chain(5);
        CHECK(problem.solve(chain) == Status::non_finite);
      }
}

namespace {

/// Random symmetric elements of so many unknowns a node, one prescribed and one held: against Eigen's eigenvalues and factors.
template <int Block>
void check_block(Random& random, double shift) {
  const int elements = random.integer(2, 9);
  BlockTridiagonal<double, Eigen::Dynamic, Eigen::Dynamic, Block> chain(elements);
  DenseSystem<Block> all(elements);
  std::vector<Eigen::MatrixXd> tangents;
  std::vector<Eigen::VectorXd> residuals;
  for (int e = 0; e < elements; ++e) {
    Eigen::Matrix<double, 2 * Block, 2 * Block> K;
    Eigen::Matrix<double, 2 * Block, 1> r;
    for (int i = 0; i < 2 * Block; ++i) {
      r[i] = random(1.0);
      for (int j = 0; j <= i; ++j) K(i, j) = K(j, i) = random(1.0);
      K(i, i) += shift;
    }
    tangents.push_back(K), residuals.push_back(r);
    all.add(e, K, r);
  }
  add_all(chain, tangents, residuals);
  const int node = random.integer(1, elements), component = random.integer(0, Block - 1), p = Block - 1,
            h = Block * node + component;
  const double at_0 = random(1.0), at_h = random(1.0);
  DenseSystem<Block> known = all;
  known.prescribe(p, at_0);
  known.prescribe(h, at_h);
  const Spectrum spectrum(known.K);
  if (spectrum.smallest() < 1e-3) return;  // near to singular: nothing to compare
  Eigen::VectorXd x = known.solve();
  chain.prescribe(0, p, at_0);
  chain.prescribe(node, component, at_h);
  REQUIRE(chain.solve() == Status::ok);
  for (int i = 0; i <= elements; ++i) {
    const Eigen::VectorXd there = x.segment<Block>(Block * i);
    // LDLᵀ without pivoting of an indefinite matrix loses what its pivots grow by.
    CHECK((chain.increment(i) - there).norm() <= 1e-8 * (1 + there.norm()));
  }
  CHECK(chain.increment(0)[p] == 0);
  CHECK(chain.increment(node)[component] == 0);
  CHECK(chain.energy() == Approx(known.b.dot(x)).epsilon(1e-8));
  CHECK(chain.negative_pivots() == spectrum.negative());
}

}  // namespace

TEST_CASE("a node may have any number of unknowns", "[assembler]") {
  Random random(6);
  for (int trial = 0; trial < 60; ++trial) {
    const double shift = random(0, 20);
    check_block<1>(random, shift);
    check_block<2>(random, shift);
    check_block<3>(random, shift);
    check_block<6>(random, shift);
    check_block<7>(random, shift);
  }
}

namespace {

/// A chain whose nodes are seen in other axes, with something added to one, and whose ends may be clamped: as the congruences say
/// that these changes of unknowns are.
template <int Block>
void check_changes(Random& random, bool clamped) {
  using Tangent = Eigen::Matrix<double, 2 * Block, 2 * Block>;
  using Own = Eigen::Matrix<double, Block, Block>;
  using Unknowns = Eigen::Matrix<double, Block, 1>;
  const int elements = random.integer(2, 9);
  BlockTridiagonal<double, Eigen::Dynamic, Eigen::Dynamic, Block> chain(elements);
  DenseSystem<Block> dense(elements);
  std::vector<Eigen::MatrixXd> tangents;
  std::vector<Eigen::VectorXd> residuals;
  for (int e = 0; e < elements; ++e) {
    Tangent K = Tangent::Identity() * 20;
    Eigen::Matrix<double, 2 * Block, 1> r;
    for (int i = 0; i < 2 * Block; ++i) {
      r[i] = random(1.0);
      for (int j = 0; j < i; ++j) K(i, j) = K(j, i) = random(1.0);
    }
    tangents.push_back(K), residuals.push_back(r);
    dense.add(e, K, r);
  }
  add_all(chain, tangents, residuals);
  for (const int e : {0, random.integer(0, elements - 1), elements - 1}) {
    Tangent K = Tangent::Identity();
    Eigen::Matrix<double, 2 * Block, 1> r;
    for (int i = 0; i < 2 * Block; ++i) {
      r[i] = random(1.0);
      for (int j = 0; j < i; ++j) K(i, j) = K(j, i) = random(1.0);
    }
    chain.add_more(e, K, r);
    dense.add(e, K, r);
  }
  for (const int node : {0, random.integer(0, elements), elements}) {
    Own K = 5 * Own::Identity();
    Unknowns r;
    for (int i = 0; i < Block; ++i) {
      r[i] = random(1.0);
      for (int j = 0; j < i; ++j) K(i, j) = K(j, i) = random(1.0);
    }
    const Vector3<double> axis = Vector3<double>(random(1.0), random(1.0), random(1.0)).normalized(),
                          part(random(1.0), random(1.0), random(1.0));
    const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2 * axis * axis.transpose();
    Eigen::Matrix3d cycle;
    cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    chain.add_at(node, K, r);
    chain.template turn<0>(node, mirror * cycle);
    chain.template turn<3>(node, cycle * mirror);
    chain.template lean<2, 3>(node, part);
    if constexpr (Block == 7) chain.template lean<6, 3>(node, part);

    dense.add_at(node, K, r);
    Own turned = Own::Identity(), leant = Own::Identity();  // old = ... new
    turned.template block<3, 3>(0, 0) = mirror * cycle;
    turned.template block<3, 3>(3, 3) = cycle * mirror;
    leant.template block<1, 3>(2, 3) = -part.transpose();
    if constexpr (Block == 7) leant.template block<1, 3>(6, 3) = -part.transpose();
    dense.change(node, turned * leant);
    CHECK(chain.residual(node, 1) == Approx(-dense.b[Block * node + 1]).epsilon(1e-12).margin(1e-12));
  }
  const Vector3<double> along = Vector3<double>(random(1.0), random(1.0), random(1.0)).normalized();
  if (clamped) {
    Unknowns by;
    for (int i = 0; i < Block; ++i) by[i] = random(1.0);
    chain.clamp(0, along, by);
    chain.clamp(elements, along, Unknowns(Unknowns::Zero()));

    Eigen::VectorXd all = Eigen::VectorXd::Zero(dense.b.size());  // prescribed increments
    all.template head<Block>() = by;
    dense.b -= dense.K * all;
    Own lengthens = Own::Identity();  // the last unknown of r' is how much longer it becomes along u
    lengthens.template block<3, 1>(3, 5) = along;
    for (const int node : {0, elements}) {
      dense.change(node, lengthens);
      for (int i = 0; i < Block; ++i)
        if (i != 5) dense.prescribe(Block * node + i, 0);
    }
  }
  REQUIRE(chain.solve() == Status::ok);
  const Eigen::VectorXd x = dense.solve();
  for (int i = 0; i <= elements; ++i) {
    const Unknowns there = x.segment<Block>(Block * i);
    CHECK((chain.increment(i) - there).norm() <= 1e-10 * (1 + there.norm()));
  }
  CHECK(chain.energy() == Approx(dense.b.dot(x)).epsilon(1e-10));
}

}  // namespace

TEST_CASE("unknowns of a node are turned, leant and clamped, and something is added to them", "[assembler]") {
  Random random(7);
  for (int trial = 0; trial < 40; ++trial) {
    check_changes<6>(random, trial % 2 == 1);
    check_changes<7>(random, trial % 2 == 1);
  }
}
