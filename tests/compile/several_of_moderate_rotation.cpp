// expect: Element must be valid at finite rotation
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

int main() {
  using namespace hapbeam;
#ifdef HAPBEAM_REPAIRED
  using Element = Several<Corotational<>, 2>;
#else
  using Element = Several<VonKarman<>, 2>;
#endif
  FemModel<Element> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
