// SPDX-License-Identifier: MIT
// Trained models: made offline, and kept in files where the module was built with jansson.
#include <stdexcept>
#include <utility>

#include "factories.hpp"
#include "model_of.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/rom/training/validate.hpp>
#ifdef HAPBEAM_PYTHON_HAS_MODEL_FILES
#include <hapbeam/rom/file/model_file.hpp>
#endif

namespace hapbeam::python {
namespace {

#ifndef HAPBEAM_PYTHON_HAS_MODEL_FILES
[[noreturn]] void no_files(const std::string& path) {
  throw std::runtime_error(path + ": this module was built without model files (HAPBEAM_WITH_JANSSON)");
}
#endif

#ifdef HAPBEAM_PYTHON_HAS_MODEL_FILES
/// What a file has wrong is a wrong value of who names it.
template <class Use>
auto with_file(const Use& use) {
  try {
    return use();
  } catch (const ModelFileError& error) {
    throw std::invalid_argument(error.what());
  }
}
#endif

template <class Model>
class TrainedOf final : public ModelOf<Model, AnyTrained> {
 public:
  explicit TrainedOf(Model model)
      : ModelOf<Model, AnyTrained>(std::is_same_v<Model, PodModel<>> ? "PodModel" : "GalerkinModel",
                                   std::move(model)) {}
  const ErrorReport& errors() const noexcept override { return this->model_.errors(); }
  void save(const std::string& path) const override {
#ifdef HAPBEAM_PYTHON_HAS_MODEL_FILES
    with_file([&] { save_model(this->model_, path); });
#else
    no_files(path);
#endif
  }
};

template <class Model>
TrainedPointer made(Model model) {
  return std::make_unique<TrainedOf<Model>>(std::move(model));
}

template <class Model, class Data, class Full>
TrainedPointer validated(Data data, const Full& full) {
  data.errors = validate(Model(data), full);
  return made(Model(std::move(data)));
}

}  // namespace

TrainedPointer train_pod(const Beam& beam, const TrainingPlan& plan, int elements) {
  const auto full = full_model(beam, elements);
  return validated<PodModel<>>(hapbeam::train_pod(take_snapshots(beam, full, plan)), full);
}
TrainedPointer train_galerkin(const Beam& beam, const TrainingPlan& plan, int elements) {
  const auto full = full_model(beam, elements);
  return validated<GalerkinModel<>>(hapbeam::train_galerkin(take_snapshots_at_tensions(beam, full, plan)),
                                    full);
}

#ifdef HAPBEAM_PYTHON_HAS_MODEL_FILES
const bool has_model_files = true;
TrainedPointer load_model(const std::string& path) {
  return with_file([&] {
    if (describe_model_file(path).kind == "pod") return made(hapbeam::load_model<PodModel<>>(path));
    return made(hapbeam::load_model<GalerkinModel<>>(path));
  });
}
#else
const bool has_model_files = false;
TrainedPointer load_model(const std::string& path) { no_files(path); }
#endif

}  // namespace hapbeam::python
