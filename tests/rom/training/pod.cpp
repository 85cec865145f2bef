// Proper orthogonal decomposition: the laws of thesis eq. 3.43–3.66, and where the thesis' route to it loses them.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/rom/training/pod.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random(1); });
}

/// Snapshots of a family that decays as σ_i = 10⁻ⁱ: orthonormal factors with these values between them.
MatrixXd decaying(Eigen::Index rows, Eigen::Index columns, int modes) {
  const auto orthonormal = [modes](const MatrixXd& A) {
    return MatrixXd(Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), modes));
  };
  VectorXd sigma(modes);
  for (int i = 0; i < modes; ++i) sigma[i] = std::pow(10.0, -i);
  return orthonormal(random_matrix(rows, modes, 1)) * sigma.asDiagonal() *
         orthonormal(random_matrix(columns, modes, 2)).transpose();
}

/// ε²(l) = Σ_{i > l} σ_i²
double left_out(const Pod<>& pod) {
  const VectorXd& sigma = pod.singular_values();
  return sigma.tail(sigma.size() - pod.modes()).squaredNorm();
}

double defect(const MatrixXd& gram) {
  return (gram - MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the basis is orthonormal", "[pod]") {
  const MatrixXd X = decaying(24, 40, 10);
  const Pod<> plain(X, Truncation::count(10));
  CHECK(defect(plain.basis().transpose() * plain.basis()) <= 100 * eps);
}

// All modes of a tall matrix are orthonormal, those beyond its rank, too; σ is known to round-off of the largest.
TEST_CASE("a matrix with more rows than columns has the basis and values it was made of", "[pod]") {
  const MatrixXd X = decaying(40, 24, 10);
  const Pod<> pod(X, Truncation::count(24));
  CHECK(defect(pod.basis().transpose() * pod.basis()) <= 100 * eps);
  CHECK((X - pod.basis() * pod.coefficients(X)).norm() <= 100 * eps * X.norm());
  for (int i = 0; i < 24; ++i)
    CHECK(std::abs(pod.singular_values()[i] - (i < 10 ? std::pow(10.0, -i) : 0)) <= 100 * eps);
}

// Eq. 3.55 = 3.65: what a projection on l modes leaves of all snapshots is the sum of the squares of the other σ.
TEST_CASE("the error of a projection on l modes is the sum of the squares left out, to round-off", "[pod]") {
  const MatrixXd X = decaying(24, 40, 10);
  for (int l = 1; l < 10; ++l) {
    const Pod<> plain(X, Truncation::count(l));
    const MatrixXd left = X - plain.basis() * plain.coefficients(X);
    const double squares = left_out(plain);
    CHECK(std::abs(left.squaredNorm() - squares) <= 100 * eps * X.squaredNorm());
    // Sharper: the norms themselves, down to where round-off of X hides them.
    CHECK(left.norm() == Approx(std::sqrt(squares)).epsilon(1e-6));
  }
}

// Eq. 3.46: no other basis of l vectors does better.
TEST_CASE("no other basis of as many vectors leaves less", "[pod]") {
  const MatrixXd X = decaying(12, 30, 6);
  const double best = left_out(Pod<>(X, Truncation::count(3)));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MatrixXd Q = MatrixXd(Eigen::HouseholderQR<MatrixXd>(random_matrix(12, 3, seed)).householderQ() *
                                MatrixXd::Identity(12, 3));
    // One of them is X's own basis, which leaves as much, to the round-off of |X|².
    CHECK((X - Q * (Q.transpose() * X)).squaredNorm() >= best - 10 * eps * X.squaredNorm());
  }
}

TEST_CASE("the SVD keeps small modes that the eigenvalues of XXᵀ lose below 1e-8",
          "[pod][method_of_snapshots]") {
  const MatrixXd X = decaying(24, 40, 13);  // σ = 1 … 1e-12
  const Pod<> svd(X, Truncation::count(13));
  const Pod<MethodOfSnapshots> squared(X, Truncation::count(13));
  for (int i = 0; i < 13; ++i) {
    const double sigma = std::pow(10.0, -i);
    CHECK(std::abs(svd.singular_values()[i] - sigma) <= 100 * eps);
    // λ is known to eps λ₁, hence σ to eps/(2σ): half its digits at 1e-8.
    if (i <= 6) CHECK(std::abs(squared.singular_values()[i] - sigma) <= 100 * eps / sigma);
  }
  CHECK(svd.singular_values()[12] == Approx(1e-12).epsilon(1e-2));
  // There it is noise: not even the order of magnitude is right.
  CHECK(std::abs(std::log10(squared.singular_values()[12] / 1e-12)) > 2);
  // What its modes beyond 1e-8 leave out, the SVD's hold.
  const MatrixXd X9 = decaying(24, 40, 13);
  const auto left = [&X9](const auto& pod) { return (X9 - pod.basis() * pod.coefficients(X9)).norm(); };
  CHECK(left(Pod<>(X, Truncation::count(11))) <= 2e-11);
  CHECK(left(Pod<MethodOfSnapshots>(X, Truncation::count(11))) >= 1e-9);
}

TEST_CASE("truncation by count, energy and error keeps the fewest modes that are enough", "[pod]") {
  VectorXd sigma(4);
  sigma << 10, 3, 1, 0.1;
  const double all = sigma.squaredNorm();
  CHECK(Truncation::count(2).modes(sigma) == 2);
  CHECK(Truncation::count(9).modes(sigma) == 4);
  CHECK(Truncation::energy(100 / all - 1e-12).modes(sigma) == 1);
  CHECK(Truncation::energy(100 / all + 1e-12).modes(sigma) == 2);
  CHECK(Truncation::energy(1).modes(sigma) == 4);
  CHECK(Truncation::error(std::sqrt(1.01 / all) + 1e-12).modes(sigma) == 2);
  CHECK(Truncation::error(std::sqrt(1.01 / all) - 1e-12).modes(sigma) == 3);
  CHECK(Truncation::error(0.999).modes(sigma) == 1);
  CHECK(Truncation::error(0).modes(sigma) == 4);
}

TEST_CASE("what cannot be decomposed is refused by name", "[pod]") {
  CHECK_THROWS_WITH(Truncation::count(0), "modes = 0: must be 1 or more");
  CHECK_THROWS_WITH(Truncation::energy(0), "energy = 0: must be above 0 and at most 1");
  CHECK_THROWS_WITH(Truncation::energy(1.1), "energy = 1.1: must be above 0 and at most 1");
  CHECK_THROWS_WITH(Truncation::error(-1), "error = -1: must be 0 or more and below 1");
  MatrixXd X = random_matrix(3, 4, 1);
  X(1, 1) = std::nan("");
  CHECK_THROWS_AS(Pod<>(X, Truncation::count(1)), std::invalid_argument);
  CHECK_THROWS_AS(Pod<>(MatrixXd(), Truncation::count(1)), std::invalid_argument);
}
