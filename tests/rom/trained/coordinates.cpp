// The coordinates of reduced models: each has the inverse and the derivatives that it claims.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/coordinates.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

BeamData<double> data(Support left, Support right) { return BeamData<double>::of(thesis_beam(left, right)); }

template <class F>
double derivative(const F& f, double x, double h) {
  return (f(x + h) - f(x - h)) / (2 * h);
}

}  // namespace

TEST_CASE("PositionCoordinate has its inverse and derivatives, whichever ends hold w", "[coordinates]") {
  const auto [left, right] = GENERATE(table<Support, Support>({{Support::pinned, Support::pinned},
                                                               {Support::clamped, Support::roller},
                                                               {Support::clamped, Support::free},
                                                               {Support::free, Support::clamped},
                                                               {Support::roller, Support::guided}}));
  const PositionCoordinate<double> x(data(left, right));
  const double L = thesis_length, h = 1e-6 * L;
  for (const double s : {0.05 * L, 0.3 * L, 0.5 * L, 0.95 * L}) {
    CHECK(std::abs(x.inverse(x(s)) - s) <= 16 * eps * L);
    // Differences: h² of the third derivative, and round-off over h.
    CHECK(x.derivative(s) == Approx(derivative(x, s, h)).epsilon(1e-7));
    const auto log_scale = [&x](double at) { return std::log(x.scale(at)); };
    CHECK(x.log_scale_derivative(s) == Approx(derivative(log_scale, s, h)).epsilon(1e-7).margin(1e-7));
  }
}

// 3EI L/(s²(L - s)²) and 3EI L³/(s³(L - s)³): the linear stiffness of a hinged and of a clamped beam.
TEST_CASE("the scale takes out the poles of the linear stiffness", "[coordinates]") {
  const double L = thesis_length;
  const PositionCoordinate<double> hinged(data(Support::pinned, Support::pinned)),
      clamped(data(Support::clamped, Support::clamped));
  for (const double s : {0.01 * L, 0.2 * L, 0.9 * L}) {
    const double b = L - s;
    CHECK(hinged.scale(s) / (s * s * b * b) == Approx(std::pow(L, -4)));
    CHECK(clamped.scale(s) / (s * s * s * b * b * b) == Approx(std::pow(L, -6)));
  }
}

TEST_CASE("DepthCoordinate has its inverse and slope, even in depth or odd", "[coordinates]") {
  const bool symmetric = GENERATE(true, false);
  const DepthCoordinate<double> y(data(Support::pinned, Support::pinned), symmetric);
  for (const double e : {1e-5, 1e-3, 0.02, 0.3}) {
    CHECK(y(-e) == (symmetric ? y(e) : -y(e)));
    CHECK(y.inverse(y(e)) == Approx(e).epsilon(1e-11));  // 1 + (e/ρ)² at 1e-5 keeps 12 digits
    if (!symmetric) CHECK(y.inverse(y(-e)) == Approx(-e).epsilon(1e-11));
    CHECK(y.half_log_derivative(e, y(e)) == Approx(e / 2 * derivative(y, e, 1e-5 * e)).epsilon(1e-8));
  }
  CHECK(y.half_log_derivative(0, y(0)) == 0);
}

TEST_CASE("TensionCoordinate has its inverse, and a half beam the unit of the whole", "[coordinates]") {
  const TensionCoordinate<double> z(data(Support::pinned, Support::pinned));
  for (const double tension : {1.0, 1e3, 1e6}) CHECK(z.inverse(z(tension)) == Approx(tension).epsilon(1e-12));
  const BeamData<double> half = BeamData<double>::of(thesis_half(Support::pinned));
  CHECK(TensionCoordinate<double>(half).unit() == Approx(z.unit()));
}
