// What a servo loop is given that is not perfect: coarse encoders and ticks that do not come.  servo_loop.cpp has the bound
// and the delay.
#include "support/catch.hpp"
#include "support/step_response.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double at_rest = 1e-3;  // [m/s]
constexpr double tenth = thesis_length / 10, middle = thesis_length / 2;

CouplingFigures default_figures(const Situation& who, int delay_ticks = 0) {
  return safe_coupling(VirtualPhantom<Leaning>(Leaning{0}, who.options()).info(), delay_ticks);
}

template <class Coupling>
bool comes_to_rest(double s, const Coupling& coupling, const Situation& who) {
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 16);
  return step_response(model, s, coupling, who, 4, 3).speed <= at_rest;
}

}  // namespace

// Colgate and Schenkel's bound knows nothing of the grid: at it, 10 kN/m, the loop rests with the Phantom's 7 µm.
TEST_CASE("a coupling that is right for fine encoders buzzes with coarse ones; the default knows the grid",
          "[servo loop]") {
  Situation who;
  const double bound = passive_stiffness(who.damping, who.period, 0);
  CHECK(comes_to_rest(tenth, VirtualCoupling({bound, 0}), who));
  for (const double resolution : {200e-6, 400e-6}) {
    who.resolution = resolution;
    CHECK(bound > 2 * who.friction / resolution);  // Abbott and Okamura
    CHECK_FALSE(comes_to_rest(tenth, VirtualCoupling({bound, 0}), who));
    CHECK(default_figures(who).stiffness <= who.friction / resolution * (1 + 1e-12));
    CHECK(comes_to_rest(tenth, VirtualCoupling(default_figures(who)), who));
  }
}

// The force stays as it was while the arm moves on: so many ticks of delay.
TEST_CASE(
    "with one tick of four missed the bar buzzes; through a coupling that counts them as delay it rests",
    "[servo loop]") {
  Situation who;
  CHECK(comes_to_rest(middle, Direct(), who));
  who.missed = 1, who.of = 4;
  CHECK_FALSE(comes_to_rest(middle, Direct(), who));
  CHECK(comes_to_rest(tenth, VirtualCoupling(default_figures(who)), who));
  // The default, made for none, bears some: three of four, eight of thirty at once.  Twenty of thirty are too many for it.
  who.missed = 3;
  CHECK(comes_to_rest(tenth, VirtualCoupling(default_figures(who)), who));
  who.of = 30, who.missed = 8;
  CHECK(comes_to_rest(tenth, VirtualCoupling(default_figures(who)), who));
  who.missed = 20;
  CHECK_FALSE(comes_to_rest(tenth, VirtualCoupling(default_figures(who)), who));
  for (const int missed : {3, 8, 16}) {
    who.missed = missed;
    CHECK(comes_to_rest(tenth, VirtualCoupling(default_figures(who, missed)), who));
  }
}
