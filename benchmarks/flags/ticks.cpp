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

Rod wire() {
  return {0.3, RodSection::circle(0.0015), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free};
}

/// @param hand  way -> where it is, of a way of 0 to 1
template <class Model, class Body, class Path>
void measure(const char* name, const Body& body, const Path& hand) {
  Model model(body, 8);
  Touch<Model> touch(model, 0.010);
  constexpr int rounds = 200, ticks = 500;
  std::vector<double> us;
  double felt = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int tick = 0; tick < ticks; ++tick) {
      const double way = (tick < ticks / 2 ? tick : ticks - tick) / (ticks / 2.0);  // there and back
      using Scalar = typename Model::Scalar;
      felt += static_cast<double>(touch.tick(hand(way).template cast<Scalar>()).force.y());
    }
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() /
                 ticks);
  }
  std::nth_element(us.begin(), us.begin() + rounds / 2, us.end());
  std::printf("%s %.4f %.9g\n", name, us[rounds / 2], felt);
}

/// 20 mm deep, and 25 mm along the bar.
template <class Model>
void press_bar(const char* name) {
  measure<Model>(name, bar(),
                 [](double way) { return Vector2<double>(1.0 + 0.025 * way, 0.0227 - 0.02 * way); });
}
/// 20 mm deep, and 20 mm to the side.
template <class Model>
void press_wire(const char* name) {
  measure<Model>(name, wire(),
                 [](double way) { return Vector3<double>(0.2, 0.01 - 0.02 * way, 0.02 * way); });
}

}  // namespace

int main() {
#ifdef HAPBEAM_SEVERAL
  press_bar<FemModel<Linear>>("Linear");
  press_bar<FemModel<VonKarman<>, float>>("float");
  press_bar<FemModel<VonKarman<>>>("VonKarman");
  press_bar<FemModel<Corotational<>>>("Corotational");
  press_wire<FemModel<RoundRod>>("RoundRod");
  press_wire<FemModel<TwistedRod>>("TwistedRod");
#else
  press_bar<FemModel<>>("VonKarman");
#endif
}
