#include "trained.hpp"

#include <limits>
#include <stdexcept>
#include <utility>

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE
#include <hapbeam/rom/file/model_file.hpp>
#endif

namespace phantom {

using hapbeam::GalerkinModel, hapbeam::PodModel;

Trained::Trained(const PodModel<>& pod)
    : model(pod),
      kind("pod"),
      beam(pod.data().beam),
      s_min(pod.data().s_min),
      s_max(pod.data().s_max),
      depth(pod.data().depth),
      positions(pod.data().positions),
      columns(pod.data().depths),
      modes(pod.data().shape.modes),
      loaded(!pod.data().symmetric),
      errors(pod.data().errors) {}

Trained::Trained(const GalerkinModel<>& galerkin)
    : model(galerkin),
      kind("galerkin"),
      beam(galerkin.data().beam),
      s_min(galerkin.data().s_min),
      s_max(galerkin.data().s_max),
      depth(galerkin.data().depth),
      positions(galerkin.data().positions),
      columns(galerkin.data().tensions),
      modes(galerkin.data().shape.modes),
      loaded(false),
      errors(galerkin.data().errors) {}

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE

namespace {

Trained read(const std::string& path) {
  const hapbeam::ModelFileInfo info = hapbeam::describe_model_file(path);
  if (info.kind == "galerkin") return Trained(hapbeam::load_model<GalerkinModel<>>(path));
  return Trained(hapbeam::load_model<PodModel<>>(path));
}

}  // namespace

Trained load(Options& options) {
  Trained trained = read(options.model);
  if (options.guarded && trained.loaded)
    throw cli::UsageError("--guarded: must not stand beside " + options.model +
                          ", trained under dead loads that the file does not say");
  const bool pod = std::holds_alternative<PodModel<>>(trained.model);
  options.model_choice = pod ? ModelChoice::pod : ModelChoice::galerkin;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  cli::BeamOptions& beam = options.beam;
  beam.name = options.model;
  beam.length = trained.beam.length, beam.height = trained.beam.thickness;
  beam.width = beam.young = unknown;
  beam.left = trained.beam.left, beam.right = trained.beam.right;
  // A guarded model is good for all of the beam; the place is where the trained one is.
  settle(options, trained.s_min, trained.s_max);
  if (options.guarded) options.from = 0, options.to = beam.length;
  return trained;
}

#else

Trained load(Options&) {
  throw cli::UsageError(
      "--model: cannot be used, this program was built without jansson, which reads models");
}

#endif

}  // namespace phantom
