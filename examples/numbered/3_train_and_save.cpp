// Presses the full model once, keeps what that shows, and loads it again as a program would that never trains.
#include <cmath>
#include <cstdio>

#include <hapbeam/hapbeam.hpp>
#include <hapbeam/rom/file/model_file.hpp>
#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/rom/training/validate.hpp>

int main() {
  using namespace hapbeam;
  const Beam bar(2.54, Section::rectangle(0.0254, 0.0254), Material{206.84e9}, Support::pinned,
                 Support::pinned);
  const auto full = full_model(bar);
  auto data = train_pod(take_snapshots(bar, full, TrainingPlan::anywhere(bar, 0.02)));  // up to 20 mm
  data.errors = validate(PodModel<>(data), full);
  std::printf("trained: force error at most %.0e\n", data.errors.force_bound);
  save_model(PodModel<>(data), "numbered_bar.json");

  auto model = load_model<PodModel<>>("numbered_bar.json");
  FemModel<> elements(bar, 32);
  double worst = 0;
  for (int mm = 2; mm <= 18; mm += 4) {
    const Press<double> press{1.0, 1e-3 * mm};
    const auto quick = model.press(press), slow = elements.press(press);
    if (!is_answer(quick.status) || !is_answer(slow.status)) return 1;
    worst = std::fmax(worst, std::abs(quick.force / slow.force - 1));
    std::printf("%2d mm  %7.2f N loaded  %7.2f N with 32 elements\n", mm, quick.force, slow.force);
  }
  return worst < 1e-3 ? 0 : 1;
}
