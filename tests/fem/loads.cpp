// Distributed loads as forces at points: the same resultants, and the same work on every shape the elements
// can take.
#include <limits>

#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/loads.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

// The five-point rule is exact to degree nine: loads to degree six do exact work on the cubic.
TEST_CASE("consistent forces do the work of the load on every cubic", "[load]") {
  const double L = thesis_length;
  const auto power = [L](double x, int k) { return std::pow(x / L, k); };
  for (const int degree : {0, 1, 2, 4, 6})
    for (const int elements : {2, 5, 16}) {
      Beam beam = thesis_beam(Support::pinned, Support::roller);
      beam.transverse([&](double x) { return 3 * power(x, degree); });
      beam.axial([&](double x) { return 7 * power(x, degree); });
      for (int k = 0; k <= 3; ++k) {
        double across = 0, along = 0;
        const DeadLoads<double> loads(beam, elements);
        for (const PointForce<double>& f : loads.forces()) {
          across += f.force.y() * power(f.s, k);
          if (k > 0) across += f.arm.y() * k / L * power(f.s, k - 1);  // works on w'
          if (k < 2) along += f.force.x() * power(f.s, k);
        }
        const double integral = L / (degree + k + 1);
        CHECK(std::abs(across - 3 * integral) <= 1e-14 * 3 * L);
        if (k < 2) CHECK(std::abs(along - 7 * integral) <= 1e-14 * 7 * L);
      }
    }
}

TEST_CASE("point loads stay as they are, in order of s", "[load]") {
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.add({0.7, 1, 2, 3}).add({0.0137, 4, 5, 6});
  const DeadLoads<float> loads(beam, 4);
  const auto& forces = loads.forces();
  REQUIRE(forces.size() == 2);
  CHECK(forces[0].s == 0.0137f);
  CHECK(forces[0].force.y() == 5);
  CHECK(forces[0].moment == 6);
  CHECK(forces[1].s == 0.7f);
  CHECK(forces[1].force.x() == 1);
  CHECK(forces[1].arm.isZero(0));
}

TEST_CASE("a load that is not finite somewhere on the beam is rejected by name", "[load]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto hole = [nan](double x) { return x > 2 ? nan : 1.0; };
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.transverse(hole);
  CHECK_THROWS_WITH(DeadLoads<double>(beam, 8), ContainsSubstring("transverse load") &&
                                                    ContainsSubstring("N/m") && ContainsSubstring("finite"));
  beam.transverse(0).axial(hole);
  CHECK_THROWS_WITH(DeadLoads<double>(beam, 8), ContainsSubstring("axial load"));
}
