// expect: a Membrane policy needs static noexcept respond\(const ElementProperties<S>&, const Deformation<S>&\) -> CoreResponse<S> and name\(\)
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

/// Takes no membrane force at all.
struct Slack {
#ifdef HAPBEAM_REPAIRED
  static constexpr const char* name() noexcept { return "slack"; }
#endif
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e) noexcept {
    const S normal = p.axial_per_length * e.stretch;
    return {normal * e.stretch / 2,
            normal,
            0,
            0,
            0,
            CoreTangent<S>{p.axial_per_length, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
  }
};

int main() {
  const Beam beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free);
  FemModel<VonKarman<Slack>> model(beam, 4);
  FemModel<Corotational<VonKarman<Slack>>> turning(beam, 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status) +
         static_cast<int>(turning.press({0.5, 1e-3}).status);
}
