// The balance of energy that says what contacts dissipate: a hand that goes one millimetre against 2 N and 4 N gives 3 mJ.
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/fem/friction_balance.hpp>

using namespace hapbeam;

namespace {

using Balance = detail::FrictionBalance<Circle<double>, double, 2, 2>;
using Vector = Vector2<double>;

/// The hand is at x, and its force on the beam is f along x.   @param other  whether a place of the beam is held, and how far
void touch(Balance& balance, double x, double f, bool other = false, double led = 0) {
  balance.begin();
  balance.touches(0, {0, Vector(x, 0), 0.01, 1}, {0, Status::ok, 0, false, 0, Vector(0, 0), Vector(0, 1)},
                  Vector(f, 0));
  if (other) balance.holds(1, {0.3, led, Vector(0, 1)});
}

constexpr double millijoule = 1e-3;

}  // namespace

TEST_CASE("what the hands gave is stored or was dissipated", "[friction]") {
  const auto tick = [](double stored, double taken, bool slides = true) {
    Balance balance;
    touch(balance, 0, 2);
    CHECK(balance.factor([] { return 100 * millijoule; }, 1, true) == 1);  // nothing is known before
    touch(balance, 1e-3, 4);
    return balance.factor([&] { return stored * millijoule; }, taken * millijoule, slides);
  };
  CHECK(std::abs(tick(101, 2) - 1) <= 1e-12);
  CHECK(std::abs(tick(101.2, 2) - 0.9) <= 1e-12);
  CHECK(std::abs(tick(100.6, 2) - 1.2) <= 1e-12);
  CHECK(tick(100.6, 2, false) == 1);
  CHECK(tick(100.6, 0) == 1);
  // No contact gives anything back, and what is far is a fall.
  CHECK(std::abs(tick(105, 2) - 0.5) <= 1e-12);
  CHECK(std::abs(tick(97, 2) - 1.5) <= 1e-12);
  CHECK(tick(94, 2) == 1);
  CHECK(tick(109, 2) == 1);
  // What turns back within the tick slides with all of its force, and the hand's force is zero in the mean.
  CHECK(std::abs(tick(103, 8) - 0.5) <= 1e-12);
  CHECK(tick(std::nan(""), 2) == 1);
}

TEST_CASE("what a tick cannot dissipate is left for the next one", "[friction]") {
  Balance balance;
  touch(balance, 0, 2);
  (void)balance.factor([] { return 100 * millijoule; }, 0, true);
  touch(balance, 1e-3, 4);
  // 3 mJ are given and 5 mJ more are stored: 2 mJ would be -2.
  CHECK(std::abs(balance.factor([] { return 105 * millijoule; }, 2 * millijoule, true) - 0.5) <= 1e-12);
  touch(balance, 1e-3, 4);
  CHECK(std::abs(balance.factor([] { return 98.5 * millijoule; }, 4 * millijoule, true) - 0.875) <= 1e-12);
}

TEST_CASE("while all contacts stick the potential is what the hands give", "[friction]") {
  Balance balance;
  touch(balance, 0, 2);
  (void)balance.factor([] { return 100 * millijoule; }, 0, true);
  int computed = 0;
  for (int k = 1; k <= 10; ++k) {
    touch(balance, k * 1e-3, 2);
    CHECK(balance.factor([&] { return ++computed; }, 0, false) == 1);
  }
  CHECK(computed == 0);
  touch(balance, 0.011, 2);
  // 22 mJ were given.
  CHECK(std::abs(balance.factor([] { return 121 * millijoule; }, 2 * millijoule, true) - 0.5) <= 1e-12);
}

TEST_CASE("what begins, ends or is led besides breaks the balance of friction", "[friction]") {
  for (const int how : {0, 1, 2, 3}) {
    Balance balance;
    touch(balance, 0, 2, how == 1 || how == 3);
    (void)balance.factor([] { return 100 * millijoule; }, 0, true);
    if (how == 2) balance.forget();
    touch(balance, 1e-3, 4, how == 0 || how == 3, 1e-3);
    CHECK(balance.factor([] { return 101.2 * millijoule; }, 2 * millijoule, true) == 1);
    touch(balance, 1e-3, 4, how == 0 || how == 3, 1e-3);
    CHECK(std::abs(balance.factor([] { return 99 * millijoule; }, 2 * millijoule, true) - 1.1) <= 1e-12);
  }
}
