// Dense symmetric systems against Eigen: solution and inertia, whatever the units of the unknowns.
#include <Eigen/Eigenvalues>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/solver/symmetric_indefinite.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr int most = 24;
using System = detail::SymmetricIndefinite<double, most>;

System system_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  System system;
  system.resize(static_cast<int>(b.size()));
  for (int i = 0; i < b.size(); ++i) {
    system[i] = b[i];
    for (int j = 0; j <= i; ++j) system(i, j) = A(i, j);
  }
  return system;
}

}  // namespace

TEST_CASE("a symmetric system is solved whatever its signs and units", "[solver]") {
  Random random(5);
  for (int n = 1; n <= most; ++n)
    for (int k = 0; k < 20; ++k) {
      Eigen::MatrixXd A(n, n);
      Eigen::VectorXd b(n), units(n);
      for (int i = 0; i < n; ++i) {
        b[i] = random(1.0), units[i] = std::pow(10, random(4.0));
        for (int j = 0; j <= i; ++j) A(i, j) = A(j, i) = random(1.0);
      }
      // As multipliers have it; of an odd number of unknowns that may be singular.
      if (n % 2 == 0 && k % 4 == 0) A.diagonal().setZero();
      // Pivots of one that are small lose what the rest has.
      if (n % 2 == 0 && k % 4 == 1) A.diagonal() *= 1e-8;
      int negative = 0;
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
      for (int i = 0; i < n; ++i) negative += values[i] < 0;
      const double condition = values.cwiseAbs().maxCoeff() / values.cwiseAbs().minCoeff();
      System system = system_of(units.asDiagonal() * A * units.asDiagonal(), units.asDiagonal() * b);
      CHECK(system.solve() == negative);
      Eigen::VectorXd x(n);
      for (int i = 0; i < n; ++i) x[i] = units[i] * system[i];
      CHECK((A * x - b).norm() <= 1e-13 * n * condition * b.norm());
      // Another right-hand side.
      System::Unknowns other{};
      for (int i = 0; i < n; ++i) other[static_cast<std::size_t>(i)] = units[i] * b[n - 1 - i];
      system.solve(other);
      for (int i = 0; i < n; ++i) x[i] = units[i] * other[static_cast<std::size_t>(i)];
      CHECK((A * x - b.reverse()).norm() <= 1e-13 * n * condition * b.norm());
    }
}

TEST_CASE("an unknown that nothing tells stays where it is", "[solver]") {
  System system =
      system_of((Eigen::MatrixXd(3, 3) << 2, 1, 2, 1, -3, 1, 2, 1, 2).finished(), Eigen::Vector3d(1, 2, 1));
  // The first and the last are the same: one of them is enough.
  CHECK(system.solve() == 1);
  const double x = system[0] + system[2], y = system[1];
  CHECK(2 * x + y == Approx(1));
  CHECK(x - 3 * y == Approx(2));
  CHECK((system[0] == 0 || system[2] == 0));
  System::Unknowns other{2, -3, 2};
  system.solve(other);
  CHECK(2 * (other[0] + other[2]) + other[1] == Approx(2));
  CHECK((other[0] == 0 || other[2] == 0));
  system = system_of((Eigen::MatrixXd(2, 2) << 2, 1, 1, 3).finished(), Eigen::Vector2d(4, 5));
  system.hold(1, -1);
  CHECK(system.solve() == 1);
  CHECK(system[0] == Approx(2));
  CHECK(system[1] == 0);
}
