// expect: a Membrane policy needs static noexcept respond\(const ElementProperties<S>&, const Deformation<S>&\) -> CoreResponse<S> and name\(\)
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

struct Nameless {
  static constexpr const char* name() noexcept { return "only a name"; }
#ifdef HAPBEAM_REPAIRED
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e) noexcept {
    return AssumedStrain::respond(p, e);
  }
#endif
};

int main() {
  FemModel<VonKarman<Nameless>> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
