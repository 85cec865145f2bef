// What is trained from must answer presses.
// expect: a full model is a ForceModel of doubles: see hapbeam/force_model.hpp
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/training/snapshots.hpp>

using namespace hapbeam;

struct NoModel : FemModel<> {
  using FemModel<>::FemModel;
#ifndef HAPBEAM_REPAIRED
  Response<double> press(const Press<double>&) { return {0, Status::ok}; }  // may throw
#endif
};

int main() {
  const Beam beam(1.0, 1e6, 1e2, 1e-2, Support::pinned, Support::pinned);
  return static_cast<int>(take_snapshots(beam, NoModel(beam, 4), TrainingPlan::at(0.5, 0.01)).grid.size());
}
