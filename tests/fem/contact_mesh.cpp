// The nodes at which a beam in closed form is drawn.
#include <algorithm>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/mesh.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("a node lies at the contact and the others share both parts of the beam evenly", "[mesh]") {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = random.integer(2, 40);
    const double length = random(0.01, 10), s = random(0, length);
    const ContactMesh<double> mesh = ContactMesh<double>(n, length).at(s);
    REQUIRE(mesh.position(0) == 0);
    REQUIRE(mesh.position(n) == length);
    REQUIRE(mesh.position(mesh.node()) == s);
    REQUIRE((mesh.node() >= 1 && mesh.node() <= n - 1));
    const double left = s / mesh.node(), right = (length - s) / (n - mesh.node());
    for (int i = 0; i < n; ++i) {
      const double l = mesh.position(i + 1) - mesh.position(i);
      REQUIRE(std::abs(l - (i < mesh.node() ? left : right)) <= 4 * 2.2e-16 * length);
    }
    // The nearest node moves by half an element at most, so no part is stretched by more than 3/2, ends
    // apart.
    if (s > length / n && s < length - length / n) REQUIRE(std::max(left, right) <= 1.5 * length / n);
  }
}

TEST_CASE("an end is a node, and only where the contact is exactly there", "[mesh]") {
  const ContactMesh<double> uniform(8, 2.0);
  CHECK(uniform.at(0).node() == 0);
  CHECK(uniform.at(2.0).node() == 8);
  CHECK(uniform.at(1e-3).node() == 1);
  CHECK(uniform.at(2.0 - 1e-3).node() == 7);
  for (int i = 0; i <= 8; ++i) {
    CHECK(uniform.position(i) == 0.25 * i);
    CHECK(uniform.at(0.25 * i).position(3) == 0.75);
  }
}
