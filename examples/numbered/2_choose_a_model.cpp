// A scene says where and how deep a beam is pressed, what error is tolerated and how long a press may take; choose() tries all models.
#include <cstdio>

#include <hapbeam/scene/choose.hpp>  // offline alone: it trains

int main() {
  using namespace hapbeam;
  const Beam strip(0.3, Section::rectangle(0.03, 0.003), Material{3e9}, Support::pinned, Support::pinned);
  Scene scene = Scene::at(strip, 0.12, 0.01);  // at 120 mm, up to 10 mm deep
  scene.force_error = 0.02;                    // 2 % of the force
  scene.tick = 20e-6;                          // [s] a press
  const Choice choice = choose(scene);
  std::puts(choice.text().c_str());
  if (!choice.candidate) return 1;

  SceneModel model = build(scene, choice.model());  // press, shape, Touch, Servo: as any other model
  const auto answer = model.press({0.12, 0.008});
  std::printf("8 mm: %.2f N, %s\n", answer.force, name(answer.status));
  return is_answer(answer.status) ? 0 : 1;
}
