// expect: a Membrane policy needs static noexcept respond\(const ElementProperties<S>&, const Deformation<S>&\) -> CoreResponse<S> and name\(\)
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

struct Careless {
  static constexpr const char* name() noexcept { return "careless"; }
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e)
#ifdef HAPBEAM_REPAIRED
      noexcept
#endif
  {
    return AssumedStrain::respond(p, e);
  }
};

int main() {
  FemModel<VonKarman<Careless>> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
