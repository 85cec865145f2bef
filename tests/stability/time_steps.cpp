// Where rules fail that step a beam with mass: a ruler that is let go 170 mm aside, for half a second.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "support/catch.hpp"
#include "support/first_mode_swing.hpp"
#include "support/time_rules.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double seconds = 0.5;

struct Course {
  double last, most;  ///< energy over that of the beginning
  bool found;         ///< each step had a solution
};

template <class Swing>
Course follow(Swing&& swing, double h) {
  const double before = swing.energy();
  Course course{1, 1, true};
  for (int k = 0; k < seconds / h && course.found; ++k) {
    course.found = swing.step(h), course.last = swing.energy() / before;
    course.most = std::max(course.most, course.last);
  }
  return course;
}

}  // namespace

// It conserves the energy of a linear beam.  Here tension, which turns with the beam, feeds axial waves that no step follows.
TEST_CASE("the trapezoidal rule gives energy to a beam that swings far, and at last finds no step",
          "[dynamics]") {
  const LetGo start;
  for (const double h : {1e-3, 2.5e-4, 1e-4}) {
    CAPTURE(h);
    const Course naive = follow(start.by(AverageAcceleration()), h), library = follow(start.by_library(), h);
    CHECK(naive.most > 2);
    CHECK_FALSE(naive.found);
    CHECK(library.found);
    CHECK(library.most <= 1 + 1e-9);
  }
}

// Of a mode ω it leaves (1 + h²ω²)^-n of the energy after n steps: of the first, of 56.9 /s, 20 % with 1 ms and 85 % with 0.1 ms.
TEST_CASE("backward Euler takes most of the energy", "[dynamics]") {
  const LetGo start;
  for (const double h : {1e-3, 1e-4}) {
    const double first_mode = std::pow(1 + h * h * 56.9 * 56.9, -seconds / h);
    const Course naive = follow(start.by(BackwardEuler()), h), library = follow(start.by_library(), h);
    CAPTURE(h, naive.last, first_mode, library.last);
    CHECK(naive.found);
    CHECK(naive.last < first_mode);
    CHECK(library.last > 0.99);
  }
}

// Else none of the above would be a rule's: let go in its first mode, by 800 steps in a period, by all it swings as its elastica does.  The
// second backward difference is slower by h²ω²/3, backward Euler lags in proportion to h.
TEST_CASE("in short steps each rule swings as the elastica does", "[dynamics]") {
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped,
                  Support::free);
  const auto nodes = first_mode_shape(beam.length(), 8);
  const Centreline<double> shape{nodes.data(), static_cast<int>(nodes.size()), true};
  const FirstModeSwing path(beam);
  const auto error = [&](const auto& rule, int parts) {
    Swing<std::decay_t<decltype(rule)>> swing(beam, 8, shape, rule);
    return path.error(
        parts, [&](double h) { return swing.step(h); }, [&] { return swing.tip(); });
  };
  CHECK(error(AverageAcceleration(), 8) <= 3e-4);
  CHECK(error(GeneralizedAlpha(), 8) <= 3e-4);
  CHECK(error(Bdf2(), 8) <= 8e-4);
  CHECK(error(BackwardEuler(), 8) == Approx(error(BackwardEuler(), 4) / 2).epsilon(0.1));
}
