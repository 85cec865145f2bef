// expect: a Local element needs static noexcept respond\(const ElementProperties<S>&, const Deformation<S>&\) -> CoreResponse<S> and name\(\)
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

struct Local {
  static constexpr const char* name() noexcept { return "only a name"; }
#ifdef HAPBEAM_REPAIRED
  template <typename S>
  static CoreResponse<S> respond(const ElementProperties<S>& p, const Deformation<S>& e) noexcept {
    return Linear::respond(p, e);
  }
#endif
};

int main() {
  FemModel<Corotational<Local>> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
