// The balance of energy that says what contacts dissipate: a hand that goes one millimetre against 2 N and 4 N gives 3 mJ.
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/fem/contact/contact_work.hpp>

using namespace hapbeam;

namespace {

using Vector = Vector2<double>;

using Work = detail::ContactWork<double, 2, 2>;

/// The hand is at x, and its force on the beam is f along x.
struct Touched {
  double x, f, reach = 0.01;
  bool held = false;  // a place of the beam is, too
  double led = 0;     // and how far [m]
};
void touch(Work& work, const Touched& t) {
  work.begin();
  work.touches(0, {0, Vector(t.x, 0), t.reach, 1}, {0, Status::ok, false, 0, Vector(0, 0), Vector(0, 1)},
               Vector(t.f, 0));
  if (t.held) work.holds(1, {0.3, t.led, Vector(0, 1)}, 0);
}

constexpr double millijoule = 1e-3;

}  // namespace

TEST_CASE("what leads a held place along gives the mean of its force times its way", "[friction]") {
  Work work;
  const auto lead = [&](double s, double d, double force) {
    work.begin();
    work.holds(1, {s, d, Vector(0, 1)}, force);
  };
  lead(0.3, 0, 2);
  lead(0.3, 0.01, 4);
  CHECK(work.done() == Approx(0.03));
  CHECK(work.way() == Approx(0.01));
  CHECK_FALSE(work.strange());
  lead(0.4, 0.01, 4);  // another place: what that gives is not known
  CHECK(work.done() == 0);
  CHECK(work.strange());
}

TEST_CASE("what the hands gave is stored or was dissipated", "[friction]") {
  const auto tick = [](double stored, double taken, bool slides = true) {
    Work work;
    touch(work, {0, 2});
    CHECK(work.factor([] { return 100 * millijoule; }, 1, true) == 1);  // nothing is known before
    touch(work, {1e-3, 4});
    return work.factor([&] { return stored * millijoule; }, taken * millijoule, slides);
  };
  CHECK(std::abs(tick(101, 2) - 1) <= 1e-12);
  CHECK(std::abs(tick(101.2, 2) - 0.9) <= 1e-12);
  CHECK(std::abs(tick(100.6, 2) - 1.2) <= 1e-12);
  CHECK(tick(100.6, 2, false) == 1);
  CHECK(tick(102.9, 0) == 1);
  // No contact takes much more or less than T times slip; what is far is a fall.
  CHECK(std::abs(tick(103, 2) - 0.75) <= 1e-12);
  CHECK(std::abs(tick(99, 2) - 1.25) <= 1e-12);
  CHECK(tick(98, 2) == 1);
  CHECK(tick(104, 2) == 1);
  CHECK(tick(std::nan(""), 2) == 1);
  // What turns back within the tick slides with all of its force, and the hand's force is zero in the mean.
  CHECK(std::abs(tick(103, 8) - 0.75) <= 1e-12);
}

TEST_CASE("what a tick cannot dissipate is left for the next one", "[friction]") {
  Work work;
  touch(work, {0, 2});
  (void)work.factor([] { return 100 * millijoule; }, 0, true);
  touch(work, {1e-3, 4});
  // 3 mJ are given and stored, so nothing was dissipated: 1.5 of 2 mJ are counted.
  CHECK(std::abs(work.factor([] { return 103 * millijoule; }, 2 * millijoule, true) - 0.75) <= 1e-12);
  touch(work, {1e-3, 4});
  CHECK(std::abs(work.factor([] { return 97 * millijoule; }, 4 * millijoule, true) - 1.125) <= 1e-12);
}

TEST_CASE("while all contacts stick the potential is what the hands give", "[friction]") {
  Work work;
  touch(work, {0, 2});
  (void)work.factor([] { return 100 * millijoule; }, 0, true);
  int computed = 0;
  for (int k = 1; k <= 10; ++k) {
    touch(work, {k * 1e-3, 2});
    CHECK(work.factor([&] { return ++computed; }, 0, false) == 1);
  }
  CHECK(computed == 0);
  touch(work, {0.011, 2});
  // 22 mJ were given.
  CHECK(std::abs(work.factor([] { return 120.1 * millijoule; }, 2 * millijoule, true) - 0.95) <= 1e-12);
}

TEST_CASE("what begins, ends, damps or is led besides breaks the balance of friction", "[friction]") {
  const Touched from{0, 2}, to{1e-3, 4}, held_from{0, 2, 0.01, true}, held_to{1e-3, 4, 0.01, true},
      wider{1e-3, 4, 0.011}, led{1e-3, 4, 0.01, true, 1e-3};
  enum { none, forgotten, damped };
  const auto breaks = [](const Touched& before, const Touched& after, int how = none) {
    Work work;
    touch(work, before);
    (void)work.factor([] { return 100 * millijoule; }, 0, true);
    if (how == forgotten) work.forget();
    if (how == damped) {
      touch(work, before);
      CHECK(work.factor([] { return 100 * millijoule; }, 1 * millijoule, false) == 1);
    }
    touch(work, after);
    const bool broken = work.factor([] { return 101.2 * millijoule; }, 2 * millijoule, true) == 1;
    touch(work, after);
    CHECK(std::abs(work.factor([] { return 99 * millijoule; }, 2 * millijoule, true) - 1.1) <= 1e-12);
    return broken;
  };
  CHECK_FALSE(breaks(from, to));
  CHECK_FALSE(breaks(held_from, held_to));
  CHECK(breaks(from, held_to));
  CHECK(breaks(held_from, to));
  CHECK(breaks(held_from, led));
  CHECK_FALSE(breaks(from, wider));  // growing against no force along the normal takes no work
  CHECK(breaks(from, to, forgotten));
  CHECK(breaks(from, to, damped));
}

TEST_CASE("a hand that lets go has gone as far as one that holds, and its last force over that way",
          "[friction]") {
  for (const bool lets_go : {false, true}) {
    Work work;
    touch(work, {0.1, 2});
    touch(work, {0.101, 3});
    if (lets_go) work.begin(), work.apart(0, {0, Vector(0.105, 0), 0.01, 1});
    else touch(work, {0.105, 1});
    CAPTURE(lets_go);
    CHECK(work.way() == Approx(0.004));
    CHECK(work.ahead() == Approx(3 * 0.004));
    CHECK(work.done() == Approx((lets_go ? 1.5 : 2) * 0.004));
  }
}
