// Ticks of a hand that presses and slides, for flags.sh: one line of "model median_us", the median of 200 rounds.
//
// Compiled with HAPBEAM_SEVERAL it holds the other models too, as a program with several does; a compiler then inlines less.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include <hapbeam/hapbeam.hpp>

namespace {

using namespace hapbeam;

Beam bar() {
  return {2.54, Section::rectangle(0.0254, 0.0254), Material{206.84e9}, Support::pinned, Support::pinned};
}

template <class Model>
void measure(const char* name) {
  Model model(bar(), 8);
  Touch<Model> touch(model, 0.010);
  constexpr int rounds = 200, ticks = 500;
  std::vector<double> us;
  double felt = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int tick = 0; tick < ticks; ++tick) {
      const double way = tick < ticks / 2 ? tick : ticks - tick;  // there and back, 20 mm deep
      using Scalar = typename Model::Scalar;
      const auto hand = Vector2<double>(1.0 + 1e-4 * way, 0.0227 - 8e-5 * way).template cast<Scalar>();
      felt += static_cast<double>(touch.tick(hand).force.y());
    }
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() /
                 ticks);
  }
  std::nth_element(us.begin(), us.begin() + rounds / 2, us.end());
  std::printf("%s %.4f %.9g\n", name, us[rounds / 2], felt);
}

}  // namespace

int main() {
#ifdef HAPBEAM_SEVERAL
  measure<FemModel<Linear>>("Linear");
  measure<FemModel<VonKarman<>, float>>("float");
  measure<FemModel<VonKarman<>>>("VonKarman");
  measure<FemModel<Corotational<>>>("Corotational");
#else
  measure<FemModel<>>("VonKarman");
#endif
}
