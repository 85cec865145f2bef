// expect: a fixed size is its own maximum
#include <hapbeam/fem/fem_model.hpp>

#ifdef HAPBEAM_REPAIRED
constexpr int maximum = 8;
#else
constexpr int maximum = 16;
#endif

int main() {
  using namespace hapbeam;
  using Model = FemModel<VonKarman<>, double, 8, maximum>;
  Model model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 8);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
