// Ten lines: how hard a ruler pushes back, pressed 10 to 60 mm deep near its tip.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

int main() {
  using namespace hapbeam;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{210e9}, Support::clamped, Support::free);
  FemModel<Corotational<>> model(ruler, 8);
  for (int k = 1; k <= 6; ++k) {
    const auto answer = model.press({0.25, -0.01 * k});  // at 250 mm, downwards [m]
    if (is_answer(answer.status))
      std::printf("%2d mm  %6.3f N  %s\n", 10 * k, -answer.force, name(answer.status));
    else std::printf("%2d mm  no answer: %s\n", 10 * k, name(answer.status));
  }
}
