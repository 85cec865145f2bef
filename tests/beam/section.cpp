// Sections against their definition, A = ∫ b dz and I = ∫ z² b dz with b(z) the width at height z.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pi.hpp"
#include "support/thesis_beam.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// ∫ zᵏ b(z) dz over -h/2 … h/2 by z = h/2 sin t and the midpoint rule in t, which then converges faster than
/// any power.
template <class Width>
double moment(int k, double height, Width&& width) {
  constexpr int n = 64;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = pi * ((i + 0.5) / n - 0.5), z = height / 2 * std::sin(t);
    sum += std::pow(z, k) * width(z) * height / 2 * std::cos(t) * pi / n;
  }
  return sum;
}

}  // namespace

TEST_CASE("rectangle: A = b h and I = b h³/12, bending across h", "[beam]") {
  const Section section = Section::rectangle(0.03, 0.002);
  CHECK(relative_error(section.area, 0.03 * 0.002) <= 1e-15);
  CHECK(relative_error(section.inertia, 0.03 * 0.002 * 0.002 * 0.002 / 12) <= 1e-15);
  CHECK(section.thickness == 0.002);
}

TEST_CASE("circle and tube: the integrals over their width", "[beam]") {
  const double D = 0.012, d = 0.009;
  const auto disc = [](double diameter) {
    return [diameter](double z) { return 2 * std::sqrt(std::max(0.0, diameter * diameter / 4 - z * z)); };
  };
  const double area = moment(0, D, disc(D)), hole_area = moment(0, d, disc(d));
  const double inertia = moment(2, D, disc(D)), hole_inertia = moment(2, d, disc(d));
  const Section circle = Section::circle(D), tube = Section::tube(D, d);
  CHECK(relative_error(circle.area, area) <= 1e-12);
  CHECK(relative_error(circle.inertia, inertia) <= 1e-12);
  CHECK(circle.thickness == D);
  CHECK(relative_error(tube.area, area - hole_area) <= 1e-12);
  CHECK(relative_error(tube.inertia, inertia - hole_inertia) <= 1e-12);
  CHECK(tube.thickness == D);
}

TEST_CASE("a beam of section and material has EA and EI", "[beam]") {
  const Beam beam = thesis_beam(Support::pinned, Support::clamped);
  CHECK(relative_error(beam.axial_stiffness(), thesis_EA) <= 1e-15);
  CHECK(relative_error(beam.bending_stiffness(), thesis_EI) <= 1e-15);
  CHECK(beam.length() == thesis_length);
  CHECK(beam.thickness() == inch);
  CHECK(beam.left() == Support::pinned);
  CHECK(beam.right() == Support::clamped);
  // 206.8427 GPa, as printed
  CHECK(std::abs(thesis_young - 206.8427e9) <= 0.5e5);
}
