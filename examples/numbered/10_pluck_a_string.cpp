// A string of your own is plucked: what its bridge hears, in string.wav.
#include <cstdio>
#include <vector>

#include "../support/wav.hpp"
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/haptics/servo/sound.hpp>
#include <hapbeam/shapes.hpp>

int main(int count, char** arguments) {
  using namespace hapbeam;
  constexpr double length = 0.65, diameter = 0.0008, tension = 80, damping = 0.002;  // [m], [m], [N], [-]
  const Material steel{200e9, 7850, Damping::air(damping, 110)};
  const Beam string =
      tensioned(Beam(length, Section::circle(diameter), steel, Support::pinned, Support::pinned), tension);
  Beam pulled = string;
  pulled.add(PointLoad{0.12, 0, 0.5, 0});  // 0.5 N of a finger, 120 mm from the left end

  // 16 elements, 96 parts a millisecond; what the right support feels
  DynamicModel<> model(string, 16, 96);
  model.let_go_from(FemModel<Corotational<>>(pulled, 16).shape());
  Sound sound(model, {SoundSource::right_support});

  std::vector<float> heard(2 * 48000);
  std::size_t n = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    if (model.step(1e-3) != Status::ok) return 1;
    n += static_cast<std::size_t>(sound.read(&heard[n], 48));
    if (tick % 500 == 499) std::printf("%4d ms  %.3f N\n", tick + 1, heard[n - 1]);
  }
  heard.resize(n);
  return write_wav(count > 1 ? arguments[1] : "string.wav", heard, 48000) ? 0 : 1;
}
