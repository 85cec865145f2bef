// Beams on a mesh, of elements that are exact under their own tension, against fine meshes of assumed strain, whose equations they share
// in the limit, and which come close to it with the fourth power of the element's length.
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/push_round.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Cubic = Corotational<VonKarman<AssumedStrain>>;

/// The force of a circle that presses a thin strip between its supports, 6 mm deep [N].
template <class Element>
double pressed_strip(int elements) {
  const Beam strip(0.4, Section::rectangle(0.01, 0.0003), Material{200e9}, Support::pinned, Support::clamped);
  FemModel<Element> model(strip, elements);
  PushRound push(model);
  double s = 0.13, force = 0;
  for (int k = 1; k <= 70; ++k) {
    const double depth = 1e-4 * std::min(k, 60);
    const Pushed<double> pushed = push({s, {0.13, 0.005 - depth}, 0.005, 1});
    REQUIRE(is_answer(pushed.status));
    s = pushed.s, force = -pushed.force;
  }
  return force;
}

/// Forces of a stroke through the limit point of a shallow arch [N].   @param part  of its length
template <class Element>
std::vector<double> through_the_peak(int elements, double part) {
  const Beam bow = arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), Material{200e9}, Support::pinned);
  FemModel<Element> model(bow, elements);
  const double s = part * bow.length(), start = model.shape().at(s).w;
  std::vector<double> forces;
  for (int k = 1; k <= 160; ++k) {
    const auto [force, status] = model.push(Push<double>{s, start - 0.0184 * k / 160, {0, 1}});
    REQUIRE(is_answer(status));
    forces.push_back(force);
  }
  return forces;
}

}  // namespace

// Its layers of bending, 3 mm long, are a sixteenth of an element.
TEST_CASE("a strip has the force of its layers however coarse its mesh", "[exact]") {
  const double fine = pressed_strip<Cubic>(512);
  CHECK(relative_error(pressed_strip<Corotational<>>(4), fine) <= 2e-6);
  CHECK(relative_error(pressed_strip<Corotational<>>(8), fine) <= 2e-6);
  CHECK(relative_error(pressed_strip<Corotational<>>(16), fine) <= 2e-6);
  CHECK(relative_error(pressed_strip<Corotational<>>(32), fine) <= 1e-6);
}

TEST_CASE("a shallow arch is pressed through its peak, with a few millionths of it with 8 elements",
          "[exact]") {
  for (const double part : {0.37, 0.47}) {
    const std::vector<double> fine = through_the_peak<Cubic>(256, part);
    double peak = 0;
    for (const double force : fine) peak = std::max(peak, std::abs(force));
    const auto error = [&](int elements) {
      const std::vector<double> forces = through_the_peak<Corotational<>>(elements, part);
      double largest = 0;
      for (std::size_t k = 0; k < fine.size(); ++k)
        largest = std::max(largest, std::abs(forces[k] - fine[k]));
      return largest / peak;
    };
    CAPTURE(part);
    CHECK(error(8) <= 1e-5);
    CHECK(error(16) <= 1e-6);
    CHECK(error(32) <= 8e-8);
  }
}
