// A policy of your own: a strap that is a hundred times softer where it is pressed together than where it is stretched.
// What a membrane has to have stands at the head of element/von_karman.hpp; the compiler says what is missing.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

struct Strap {
  static constexpr const char* name() noexcept { return "strap"; }

  /// Energy, its first and its second derivatives in the coordinates of the element.
  template <typename S>
  static hapbeam::CoreResponse<S> respond(const hapbeam::ElementProperties<S>& properties,
                                          const hapbeam::Deformation<S>& e) noexcept {
    const hapbeam::CoreResponse<S> stretched = hapbeam::AssumedStrain::respond(properties, e);
    if (stretched.s >= 0) return stretched;  // s: ∂energy/∂stretch, the normal force
    hapbeam::ElementProperties<S> slack = properties;
    slack.axial_stiffness /= 100;
    slack.axial_per_length /= 100;
    return hapbeam::AssumedStrain::respond(slack, e);
  }
};

// Pushed together, the beam has buckled further than a millimetre, and has to be held back there.  The strap has not.
int main() {
  using namespace hapbeam;
  const Beam tape(0.3, Section::rectangle(0.02, 0.0005), Material{210e9}, Support::clamped, Support::clamped);
  for (const double by :
       {-20e-6, 0.0, 100e-6}) {  // [m] the ends are pushed together, left alone, pulled apart
    FemModel<> beam(stretched(tape, by), 16);
    FemModel<VonKarman<Strap>> strap(stretched(tape, by), 16);
    const auto as_beam = beam.press({0.15, 0.001}), as_strap = strap.press({0.15, 0.001});
    if (!is_answer(as_beam.status) || !is_answer(as_strap.status)) return 1;
    std::printf("ends moved by %4.0f um: %7.4f N as a beam, %7.4f N as a strap\n", 1e6 * by, as_beam.force,
                as_strap.force);
  }
}
