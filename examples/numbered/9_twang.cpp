// A steel ruler over the edge of a table is bent and let go: its tip as it swings, and its sound in twang.wav.
#include <cstdio>
#include <vector>

#include "../support/wav.hpp"
#include <hapbeam/fem/dynamic_model.hpp>

int main(int count, char** arguments) {
  using namespace hapbeam;
  constexpr int rate = 48000, seconds = 2;
  const Beam ruler(0.12, Section::rectangle(0.025, 0.001), Material{200e9, 7850, Damping::air(0.01, 56.6)},
                   Support::clamped, Support::free);
  Beam bent = ruler;
  bent.add(PointLoad{0.12, 0, -15, 0});  // 15 N at its tip

  // 8 elements, one part a step; the air leaves 1/e of the energy in 0.14 s
  DynamicModel<> model(ruler, 8, 1);
  model.let_go_from(FemModel<Corotational<>>(bent, 8).shape());

  std::vector<float> sound;
  for (int k = 0; k < seconds * rate; ++k) {
    if (model.step(1.0 / rate) != Status::ok) return 1;
    if (k % 240 == 0 && k < 4800)
      std::printf("%5.1f ms  tip %6.2f mm\n", 1e3 * k / rate, 1e3 * model.shape().at(0.12).w);
    sound.push_back(static_cast<float>(model.velocity(0.12).y()));
  }
  return write_wav(count > 1 ? arguments[1] : "twang.wav", sound, rate) ? 0 : 1;
}
