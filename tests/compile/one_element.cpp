// expect: a beam needs two elements or more
#include <hapbeam/fem/fem_model.hpp>

#ifdef HAPBEAM_REPAIRED
constexpr int elements = 2;
#else
constexpr int elements = 1;
#endif

int main() {
  using namespace hapbeam;
  FemModel<VonKarman<>, double, elements> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free),
                                                elements);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
