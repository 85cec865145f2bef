// What internal_forces.hpp promises, of each model that offers it.
#include <cmath>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class Cut>
double bending(const Cut& cut) {
  if constexpr (std::is_same_v<Cut, InternalForces<double>>) return std::abs(cut.moment);
  else return std::hypot(cut.moment1, cut.moment2);
}

/// @param press  (model, s, d) -> Status
template <class Model, class Press>
void check(Model model, double depth, const Press& press) {
  static_assert(has_internal_forces<Model>&& noexcept(peak_strain(model)));
  const double length = model.shape().length();
  CHECK(peak_strain(model).strain < 1e-9);
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    REQUIRE(is_answer(press(model, random(0.2, 0.8) * length, random(depth))));
    const auto line = model.shape();
    const auto peak = peak_strain(model);
    // At a node the normal force has two values, where the contact pushes along the beam, too.
    CHECK(peak.strain == Approx(model.internal_forces(peak.s).surface_strain).epsilon(1e-3));
    for (int i = 0; i < 40; ++i) {
      const double s = length * (i + random(0.0, 1.0)) / 40;
      const auto cut = model.internal_forces(s), same = model.internal_forces(line.segment_at(s), s);
      CHECK(bending(cut) == bending(same));
      // A parabola through three places of a piece misses little of its top.
      CHECK(cut.surface_strain <= 1.001 * peak.strain);
      CHECK(cut.surface_strain >= std::abs(cut.axial_strain));
    }
    for (int i = 1; i + 1 < line.segments(); ++i)
      CHECK(bending(model.internal_forces(i, line[i].s)) ==
            Approx(bending(model.internal_forces(i - 1, line[i].s))).epsilon(1e-6).margin(1e-6));
  }
  model.reset();
  CHECK(peak_strain(model).strain < 1e-9);
}

template <class Model>
void check_planar() {
  const auto press = [](Model& model, double s, double d) { return model.press({s, d}).status; };
  for (const auto& [left, right] :
       {std::pair(Support::pinned, Support::pinned), std::pair(Support::clamped, Support::free),
        std::pair(Support::roller, Support::guided)})
    check(Model(thesis_beam(left, right), 8), 0.01, press);
}

template <class Model>
void check_in_space(Model model) {
  check(std::move(model), 0.01, [](Model& pushed, double s, double d) {
    return pushed.push({s, d, {0, 0.6, 0.8}}).status;
  });
}

}  // namespace

TEST_CASE("planar models tell what their sections carry", "[contract][internal]") {
  check_planar<FemModel<>>();
  check_planar<FemModel<Linear>>();
  check_planar<FemModel<VonKarman<ReducedIntegration>>>();
  check_planar<FemModel<Corotational<>>>();
}

TEST_CASE("models in space tell what their sections carry", "[contract][internal]") {
  const Rod rod(0.5, RodSection::circle(0.005), spring_steel, RodSupport::clamped, RodSupport::free);
  check_in_space(FemModel<RoundRod>(rod, 8));
  check_in_space(FemModel<TwistedRod>(rod, 8));
}
