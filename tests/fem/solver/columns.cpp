// Right-hand sides beyond the first of a chain, against a dense solve.
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "support/catch.hpp"
#include "support/chain.hpp"
#include <hapbeam/fem/solver/block_tridiagonal.hpp>

using namespace hapbeam;

namespace {

template <int Block>
void check(int n) {
  using Chain = BlockTridiagonal<double, Eigen::Dynamic, Eigen::Dynamic, Block>;
  std::mt19937 engine(static_cast<unsigned>(n));
  std::normal_distribution<> normal;
  const auto random = [&](int rows, int columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); }).eval();
  };
  const int size = Block * (n + 1);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  std::vector<Eigen::MatrixXd> tangents;
  std::vector<Eigen::VectorXd> residuals;
  for (int e = 0; e < n; ++e) {
    Eigen::MatrixXd k = random(2 * Block, 2 * Block);
    k = (k * k.transpose()).eval();
    if (e % 3 == 0) k -= 2 * Eigen::MatrixXd::Identity(2 * Block, 2 * Block);
    tangents.push_back(k);
    residuals.push_back(random(2 * Block, 1));
    K.block(e * Block, e * Block, 2 * Block, 2 * Block) += k;
    right.segment(e * Block, 2 * Block) -= residuals.back();
  }
  const auto dense = K.fullPivLu();
  Chain chain(n);
  typename Chain::Column one(n), other(n);
  for (int e = 0; e < n; ++e)
    for (int f = 0; f < n; ++f) {
      testing::add_elements(
          chain, n, [&](int i) -> const auto& { return tangents[static_cast<std::size_t>(i)]; },
          [&](int i) -> const auto& { return residuals[static_cast<std::size_t>(i)]; });
      REQUIRE(chain.factor() == Status::ok);
      const Eigen::VectorXd b = random(2 * Block, 1), c = random(2 * Block, 1);
      chain.forward(e, b, one);
      chain.forward(f, c, other);
      Eigen::VectorXd whole = Eigen::VectorXd::Zero(size), second = whole;
      whole.segment(e * Block, 2 * Block) = b;
      second.segment(f * Block, 2 * Block) = c;
      INFO("n = " << n << ", elements " << e << " and " << f);
      CHECK(chain.product(one, other) == Approx(whole.dot(dense.solve(second))).epsilon(1e-9).margin(1e-9));
      CHECK(chain.product(one) == Approx(whole.dot(dense.solve(right))).epsilon(1e-9).margin(1e-9));
      chain.add(other, 0.7);
      chain.substitute();
      const Eigen::VectorXd x = dense.solve(right + 0.7 * second);
      for (int i = 0; i <= n; ++i)
        CHECK((chain.increment(i) - x.segment(i * Block, Block)).norm() <= 1e-9 * x.norm());
    }
}

}  // namespace

TEST_CASE("a chain solves for right-hand sides of two nodes by half of a solve each", "[solver]") {
  for (const int n : {2, 3, 4, 5, 8}) check<3>(n), check<6>(n), check<7>(n);
}
