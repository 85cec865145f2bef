// A dead load beside which round-off leaves nothing of the bending stiffness is rejected, in each model's scalar and in any units.
#include <limits>
#include <string>

#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {

template <class Model, class Body>
std::string rejection(const Body& body) {
  try {
    Model(body, 8);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// @param unit  of length [m]
Beam bar(double unit) {
  return Beam(unit, Section::rectangle(0.1 * unit, 0.01 * unit), Material{200e9 / unit / unit},
              Support::clamped, Support::clamped);
}

template <class Model>
void check_beam(double unit) {
  const double L = unit, EI = bar(unit).bending_stiffness(),
               most =
                   EI / L / L / static_cast<double>(std::numeric_limits<typename Model::Scalar>::epsilon());
  const auto at = [&](double axial, double transverse, double moment) {
    Beam beam = bar(unit);
    beam.add(PointLoad{L / 2, axial, transverse, moment});
    return rejection<Model>(beam);
  };
  CAPTURE(unit);
  const double beyond = 1.01 * most;
  CHECK_THAT(at(-beyond, 0, 0),
             ContainsSubstring("point load axial = -") && ContainsSubstring(" N: must be at most "));
  CHECK_THAT(at(0, beyond, 0), ContainsSubstring("point load transverse = "));
  CHECK_THAT(at(0, 0, beyond * L),
             ContainsSubstring("point load moment = ") && ContainsSubstring(" N·m: must be"));
  CHECK_THAT(rejection<Model>(bar(unit).axial(beyond / L)),
             ContainsSubstring("axial load = ") && ContainsSubstring(" N/m: must be at most "));
  CHECK_THAT(rejection<Model>(bar(unit).transverse(beyond / L)), ContainsSubstring("transverse load = "));
  CHECK(at(most / 1e6, 0, 0).empty());
}

}  // namespace

TEST_CASE("a dead load that no answer can have is rejected", "[loads]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    check_beam<FemModel<>>(unit);
    check_beam<FemModel<Corotational<>>>(unit);
    check_beam<FemModel<VonKarman<>, float>>(unit);
  }
  const RodSection section = RodSection::circle(0.002);
  const auto rod = [&] {
    return Rod(0.3, section, RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::clamped);
  };
  const double most = rod().stiffness().bending1 / 0.09 / std::numeric_limits<double>::epsilon();
  CHECK_THAT(rejection<FemModel<RoundRod>>(rod().add(RodForce{0.1, {0, 0, -1.01 * most}})),
             ContainsSubstring("force = -") && ContainsSubstring(" N: must be at most "));
  CHECK_THAT(rejection<FemModel<RoundRod>>(rod().load(VectorOf<double, 3>(1.01 * most / 0.3, 0, 0))),
             ContainsSubstring("load = ") && ContainsSubstring(" N/m: must be at most "));
}
