// The mesh that follows the contact, and carrying a shape from one mesh to another.
#include <algorithm>
#include <array>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/contact_mesh.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

std::vector<CentrelineNode<double>> nodes_of(const ContactMesh<double>& mesh) {
  std::vector<CentrelineNode<double>> nodes(static_cast<std::size_t>(mesh.elements() + 1));
  for (int i = 0; i <= mesh.elements(); ++i) nodes[static_cast<std::size_t>(i)].s = mesh.position(i);
  return nodes;
}

Centreline<double> view(const std::vector<CentrelineNode<double>>& nodes) {
  return {nodes.data(), static_cast<int>(nodes.size())};
}

}  // namespace

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

// u is linear and w a cubic on the beam, so that every mesh can hold them; values are of size 1, and theta =
// -w' of size 1/L' with L' the shortest element, whose differences lose eps/L'.
TEST_CASE("a shape that both meshes can hold is carried over unchanged", "[mesh]") {
  const double length = 2;
  const auto w = [](double s) { return 0.3 + s * (0.2 - s * (0.7 - 0.25 * s)); };
  const auto theta = [](double s) { return -(0.2 - s * (1.4 - 0.75 * s)); };
  const auto u = [](double s) { return 0.1 - 0.4 * s; };
  Random random(6);
  for (int trial = 0; trial < 500; ++trial) {
    const int n = random.integer(2, 20);
    const ContactMesh<double> uniform(n, length), from = uniform.at(random(0.01, 1.99)),
                                                  to = uniform.at(random(0.01, 1.99));
    std::vector<CentrelineNode<double>> source = nodes_of(from), target(source.size());
    for (auto& node : source) node = {node.s, u(node.s), w(node.s), theta(node.s)};
    transfer(view(source), to, target.data());
    double error = 0;
    for (int i = 0; i <= n; ++i) {
      const auto& node = target[static_cast<std::size_t>(i)];
      REQUIRE(node.s == to.position(i));
      error = std::max({error, std::abs(node.u - u(node.s)), std::abs(node.w - w(node.s)),
                        std::abs(node.theta - theta(node.s))});
    }
    REQUIRE(error <= 16 * 2.2e-16 / 0.01 * 4);
    std::vector<CentrelineNode<double>> back(source.size());
    transfer(view(source), from, back.data());
    // On its own mesh: bit for bit, but for the last node, which ends the last piece.
    for (std::size_t i = 0; i + 1 < source.size(); ++i) REQUIRE(back[i].w == source[i].w);
    REQUIRE(std::abs(back.back().w - source.back().w) <= 2 * 2.2e-16);
  }
}

TEST_CASE(
    "each of several contacts has a node, and the longest element between them is as short as it can be",
    "[mesh]") {
  Random random(8);
  for (int trial = 0; trial < 2000; ++trial) {
    const int count = random.integer(2, 4), n = random.integer(count + 1, 40);
    const double length = random(0.01, 10);
    std::array<double, 4> s{};
    for (int k = 0; k < count; ++k) s[static_cast<std::size_t>(k)] = random(0, length);
    std::sort(s.begin(), s.begin() + count);
    if (trial % 7 == 0) s[0] = 0;
    if (trial % 5 == 0) s[static_cast<std::size_t>(count - 1)] = length;
    const auto mesh = ContactMesh<double, 4>(n, length).at(s, count);
    REQUIRE(mesh.count() == count);
    REQUIRE(mesh.position(0) == 0);
    REQUIRE(mesh.position(n) == length);
    const int least = n >= 2 * (count + 1) ? 2 : 1;
    int from = 0;
    double before = 0, longest = 0,
           given = length;  // given: the shortest that an element becomes elsewhere if its part gives one
    for (int k = 0; k <= count; ++k) {
      const int to = k < count ? mesh.node(k) : n;
      const double after = k < count ? s[static_cast<std::size_t>(k)] : length;
      REQUIRE(mesh.position(to) == after);
      if (after == before) REQUIRE(to == from);
      else REQUIRE(to - from >= least);
      for (int i = from; i < to; ++i)
        REQUIRE(std::abs(mesh.position(i + 1) - mesh.position(i) - (after - before) / (to - from)) <=
                4 * 2.2e-16 * length);
      if (to > from) longest = std::max(longest, (after - before) / (to - from));
      if (to - from > least) given = std::min(given, (after - before) / (to - from - 1));
      from = to, before = after;
    }
    REQUIRE(longest <= given * (1 + 1e-12));
  }
}

TEST_CASE("the mesh of several contacts follows one as that of one does", "[mesh]") {
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const double s = random(0, 1);
    const auto one = ContactMesh<double>(16, 1).at(s);
    const auto several = ContactMesh<double, 4>(16, 1).at({s}, 1);
    for (int i = 0; i <= 16; ++i) REQUIRE(one.position(i) == several.position(i));
  }
}
