// Every invalid input throws std::invalid_argument that names field, value, unit and what is allowed.
#include <functional>
#include <limits>

#include "support/catch.hpp"
#include "support/thesis_beam.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// What was thrown, or nothing.
std::string rejection(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void check_rejection(const std::function<void()>& call, const std::string& field, double value,
                     const std::string& unit, const std::string& allowed) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%g", value);
  CHECK(rejection(call) == field + " = " + digits + " " + unit + ": must be " + allowed);
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Beam hinged() { return thesis_beam(Support::pinned, Support::roller); }

}  // namespace

TEST_CASE("lengths, stiffnesses and sections must be positive and finite", "[beam]") {
  const std::string positive = "positive and finite";
  const Support p = Support::pinned;
  for (const double bad : {0.0, -1.0, -0.0, infinity, -infinity, not_a_number}) {
    check_rejection([=] { Beam(bad, 1e6, 1e3, 0.01, p, p); }, "length", bad, "m", positive);
    check_rejection([=] { Beam(1, bad, 1e3, 0.01, p, p); }, "axial_stiffness", bad, "N", positive);
    check_rejection([=] { Beam(1, 1e6, bad, 0.01, p, p); }, "bending_stiffness", bad, "N·m²", positive);
    check_rejection([=] { Beam(1, 1e6, 1e3, bad, p, p); }, "thickness", bad, "m", positive);
    check_rejection([=] { Beam(1, {1e-4, 1e-9, 0.01}, {bad}, p, p); }, "young", bad, "Pa", positive);
    check_rejection([=] { Beam(1, {bad, 1e-9, 0.01}, {2e11}, p, p); }, "area", bad, "m²", positive);
    check_rejection([=] { Beam(1, {1e-4, bad, 0.01}, {2e11}, p, p); }, "inertia", bad, "m⁴", positive);
    check_rejection([=] { Beam(1, {1e-4, 1e-9, bad}, {2e11}, p, p); }, "thickness", bad, "m", positive);
    check_rejection([=] { Section::rectangle(bad, 1); }, "section width", bad, "m", positive);
    check_rejection([=] { Section::rectangle(1, bad); }, "section height", bad, "m", positive);
    check_rejection([=] { Section::circle(bad); }, "section diameter", bad, "m", positive);
    check_rejection([=] { Section::tube(bad, 1); }, "section outer_diameter", bad, "m", positive);
    check_rejection([=] { Section::tube(1, bad); }, "section inner_diameter", bad, "m", positive);
  }
}

TEST_CASE("a tube must be wider outside than inside", "[beam]") {
  for (const double inner : {0.02, 0.03})
    check_rejection([=] { Section::tube(0.02, inner); }, "section inner_diameter", inner, "m",
                    "less than outer_diameter");
}

TEST_CASE("loads must be finite", "[beam]") {
  for (const double bad : {infinity, -infinity, not_a_number}) {
    check_rejection([=] { hinged().transverse(bad); }, "transverse load", bad, "N/m", "finite");
    check_rejection([=] { hinged().axial(bad); }, "axial load", bad, "N/m", "finite");
    check_rejection([=] { hinged().add({1, bad, 0, 0}); }, "point load axial", bad, "N", "finite");
    check_rejection([=] { hinged().add({1, 0, bad, 0}); }, "point load transverse", bad, "N", "finite");
    check_rejection([=] { hinged().add({1, 0, 0, bad}); }, "point load moment", bad, "N·m", "finite");
  }
}

TEST_CASE("a weight needs a density, a gravity and a known section", "[beam]") {
  for (const double bad : {0.0, -7850.0, infinity, not_a_number})
    check_rejection(
        [=] {
          hinged().weight(bad, {0, -9.81});
        },
        "density", bad, "kg/m³", "positive and finite");
  for (const double bad : {infinity, -infinity, not_a_number}) {
    check_rejection([=] { hinged().weight(7850, {bad, 0}); }, "gravity", bad, "m/s²", "finite");
    check_rejection([=] { hinged().weight(7850, {0, bad}); }, "gravity", bad, "m/s²", "finite");
  }
  const Beam stiffness_alone(1, 1e6, 1e3, 0.01, Support::pinned, Support::roller);
  check_rejection(
      [=] {
        Beam(stiffness_alone).weight(7850, {0, -9.81});
      },
      "area", 0, "m²",
      "known for a weight: a beam that is given by its stiffness has transverse() and axial()");
}

TEST_CASE("a weight and other distributed loads replace each other", "[beam]") {
  Beam beam(1, Section::rectangle(0.02, 0.01), Material{2e11}, Support::clamped, Support::free);
  beam.transverse(5).axial(6).weight(1000, {0, -10});
  CHECK(beam.transverse()(0.3) == Approx(-2).epsilon(1e-14));
  CHECK_FALSE(beam.axial());
  beam.weight(1000, {3, -10}).transverse(5);
  CHECK(beam.axial()(0.3) == Approx(0.6).epsilon(1e-14));
  // Other sections change what is left of the weight, and no other load.
  beam.section([](double s) { return Section::rectangle(0.02, 0.01 * (2 - s)); });
  CHECK(beam.axial()(0.3) == Approx(0.6 * 1.7).epsilon(1e-14));
  CHECK(beam.transverse()(0.3) == 5);
  beam.weight(1000, {0, 0});
  CHECK_FALSE(beam.transverse());
  CHECK_FALSE(beam.axial());
}

TEST_CASE("a point load must lie on the beam", "[beam]") {
  for (const double s : {-1e-12, thesis_length + 1e-9, infinity, not_a_number})
    check_rejection(
        [=] {
          hinged().add({s, 0, 1, 0});
        },
        "point load s", s, "m", "on the beam, 0 to its length");
  CHECK(rejection([] { hinged().add({0, 0, 1, 0}).add({thesis_length, 0, 1, 0}); }).empty());
}

TEST_CASE("arcs must follow each other, on the beam, with finite curvatures", "[beam]") {
  const std::string order = "beyond the arc before it and on the beam", unit = "1/m";
  for (const double end : {0.0, -1.0, thesis_length * (1 + 1e-9), infinity, not_a_number})
    check_rejection([=] { hinged().naturally({{end, 0.1}}); }, "arc end", end, "m", order);
  for (const double end : {0.5, 0.3, -1.0, not_a_number})
    check_rejection(
        [=] {
          hinged().naturally({{0.5, 0.1}, {end, -0.1}, {2, 0.1}});
        },
        "arc end", end, "m", order);
  for (const double bad : {infinity, -infinity, not_a_number})
    check_rejection(
        [=] {
          hinged().naturally({{0.5, 0.1}, {1, bad}});
        },
        "arc curvature", bad, unit, "finite");
  CHECK(rejection([] { hinged().naturally({}); }).empty());
  CHECK(rejection([] { hinged().naturally({{1, 0.1}, {thesis_length, -3}}); }).empty());
}

TEST_CASE("ends must be placed at finite places", "[beam]") {
  for (const double bad : {infinity, -infinity, not_a_number})
    for (const bool left : {true, false}) {
      const auto place = [=](const EndPlace& end) {
        return [=] { hinged().place(left ? end : EndPlace{}, left ? EndPlace{} : end); };
      };
      check_rejection(place({bad, 0, 0}), "end place u", bad, "m", "finite");
      check_rejection(place({0, bad, 0}), "end place w", bad, "m", "finite");
      check_rejection(place({0, 0, bad}), "end place theta", bad, "rad", "finite");
    }
}

TEST_CASE("a beam is straight unless it is naturally bent or held elsewhere", "[beam]") {
  CHECK(hinged().straight());
  CHECK(hinged().naturally({}).place({}, {}).straight());
  CHECK_FALSE(hinged().naturally({{1, 0.1}}).straight());
  for (const EndPlace& end : {EndPlace{1e-3, 0, 0}, {0, -1e-3, 0}, {0, 0, 1e-3}}) {
    CHECK_FALSE(hinged().place(end, {}).straight());
    CHECK_FALSE(hinged().place({}, end).straight());
  }
}

TEST_CASE("what was rejected leaves the beam as it was", "[beam]") {
  Beam beam = hinged();
  beam.transverse(3);
  CHECK_FALSE(rejection([&] { beam.transverse(not_a_number); }).empty());
  CHECK_FALSE(rejection([&] { beam.add({1, 0, not_a_number, 0}); }).empty());
  CHECK_FALSE(rejection([&] { beam.naturally({{1, 0.1}, {0.5, 0.1}}); }).empty());
  CHECK_FALSE(rejection([&] { beam.place({1e-3, 0, 0}, {0, not_a_number, 0}); }).empty());
  CHECK(beam.straight());
  CHECK(beam.transverse()(0.5) == 3);
  CHECK(beam.point_loads().empty());
}
