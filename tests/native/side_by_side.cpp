// Rods on this machine's processor, whatever stands side by side there: eight numbers with AVX-512, four with AVX, two elsewhere.  The other tests are
// compiled for any processor of its kind, and see two.
//
// It is also where a compiler sees what is written for these processors, and may warn of it.
//
// Each number of elements fills the last register in another way.  Pressed in the middle, the contact's node is that at which both chains of the solver meet.
#include <cmath>
#include <cstdio>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;

namespace {

int failed = 0;

/// @param s  [m] where it is pressed   @return force [N]
template <class Element>
double press(const Rod& rod, int elements, double s) {
  FemModel<Element> model(rod, elements);
  const Eigen::Vector3d normal(0, 0.8, 0.6);
  double force = 0;
  for (int k = 1; k <= 4; ++k) {
    const double d = 1e-4 * k;
    const auto response = model.push({s, d, normal});
    const double missed = std::abs(normal.dot(model.shape().at(s).r) - d);
    if (response.status != Status::ok || model.report().solves > 8 || !(missed <= 1e-12)) {
      std::printf("%s, %d elements, pressed at %g m, %g m deep: %s after %d solves, missed by %g m\n",
                  Element::name(), elements, s, d, name(response.status), model.report().solves, missed);
      ++failed;
    }
    force = response.force;
  }
  return force;
}

template <class Element>
void presses(const Rod& rod) {
  for (const double s : {0.15, 0.06}) {
    const double fine = press<Element>(rod, 48, s);
    for (int n = 6; n <= 25; ++n) {
      // Of fourth order: 0.3 of the force where the shorter part is one element.
      const double force = press<Element>(rod, n, s), error = std::abs(force / fine - 1);
      if (error <= 60 / std::pow(n, 4)) continue;
      std::printf("%s, %d elements, pressed at %g m: %g N, not %g N\n", Element::name(), n, s, force, fine);
      ++failed;
    }
  }
}

}  // namespace

int main() {
  const Rod wire(0.3, RodSection::circle(0.0015), RodMaterial{200e9, 77e9}, RodSupport::clamped,
                 RodSupport::clamped),
      strip(0.3, RodSection::rectangle(0.01, 0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped,
            RodSupport::clamped);
  presses<RoundRod>(wire);
  presses<TwistedRod>(wire);
  presses<TwistedRod>(strip);
  return failed > 0;
}
