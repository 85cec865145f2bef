// The hierarchy over boxes finds what a loop over all finds, and looks at few more, however many there are.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/many/beam_array.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Bounds = detail::Box<double>;
using Step = detail::Step<double>;
using Tree = detail::SortedBoxes<double>;

Bounds at(double x, double y, double width, double height) {
  Bounds box;
  box.include(Vector2<double>(x, y));
  box.include(Vector2<double>(x + width, y + height));
  return box;
}

}  // namespace

TEST_CASE("box tree: every box that meets a query is looked at, once") {
  Random random(1);
  for (const int size : {1, 2, 7, 8, 9, 17, 100, 1000}) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < size; ++i)
      boxes.push_back(at(random(1), random(1), random(0, 0.1), i % 3 ? random(0, 0.01) : random(0, 0.5)));
    std::vector<std::int32_t> order;
    const Tree tree(boxes, order);
    for (int k = 0; k < 200; ++k) {
      const Step step{{random(1.2), random(1.2)}, {random(1.2), random(1.2)}, random(0, 0.2)};
      std::vector<int> looked(boxes.size());
      tree.visit(step, [&](int i) {
        ++looked[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
        return true;
      });
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        REQUIRE(looked[i] <= 1);
        REQUIRE((looked[i] == 1 || !step.meets(boxes[i])));
      }
    }
  }
}

TEST_CASE("a box is met by a way that comes through it, and by no other") {
  const Bounds box = at(0, 0, 2, 1);
  CHECK(box.meets({-1, 0.5}, {3, 0.6}));
  CHECK(box.meets({1, 0.5}, {1, 0.5}));
  CHECK(box.meets({-0.5, 0.9}, {0.5, 1.05}));
  CHECK_FALSE(box.meets({-0.5, 0.9}, {0.5, 1.3}));  // past a corner
  CHECK_FALSE(box.meets({-1, -1}, {3, -0.1}));
  CHECK(box.meets({-1e200, -1e200}, {1e200, 1e200}));
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const Vector2<double> a(random(4), random(4)), b(random(4), random(4));
    bool inside = false;
    for (int i = 0; i <= 200; ++i) inside = inside || box.distance_squared(a + (b - a) * (i / 200.0)) == 0;
    if (inside) REQUIRE(box.meets(a, b));
    if (box.meets(a, b) && !inside) {  // by less than the way between two samples
      double least = 9;
      for (int i = 0; i <= 200; ++i) least = std::min(least, box.distance_squared(a + (b - a) * (i / 200.0)));
      REQUIRE(std::sqrt(least) <= (b - a).norm() / 200);
    }
  }
}

// A query meets at most 11 boxes of a row, which lie in at most four leaves of eight: on the tree's border two share them.
TEST_CASE("box tree: boxes looked at do not grow with those that are far away") {
  for (const int size : {100, 1000, 10000, 100000}) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < size; ++i) boxes.push_back(at(i, 0, 0.5, 50));
    std::vector<std::int32_t> order;
    const Tree tree(boxes, order);
    Random random(2);
    int most = 0;
    for (int k = 0; k < 1000; ++k) {
      int looked = 0;
      const double x = random(0, size);
      tree.visit({{x + 0.1, 41}, {x, 40}, 5}, [&](int) { return ++looked > 0; });
      most = std::max(most, looked);
    }
    CAPTURE(size);
    CHECK(most <= 32);
  }
}

TEST_CASE("box tree: a visit ends where it is told to, and the nearest leaf comes first") {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back(at(i, 0, 0.5, 1));
  std::vector<std::int32_t> order;
  const Tree tree(boxes, order);
  int looked = 0;
  double nearest = 1e9;
  tree.visit({{0, 0}, {700, 0}, 1000}, [&](int i) {
    nearest = std::min(nearest, std::abs(order[static_cast<std::size_t>(i)] - 700.0));
    return ++looked < 8;
  });
  CHECK(looked == 8);
  CHECK(nearest <= 8);
}
