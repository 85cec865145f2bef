#include "trained.hpp"

#include <limits>
#include <stdexcept>
#include <utility>

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE
#include <hapbeam/rom/model_file.hpp>
#endif

namespace phantom {

#ifdef HAPBEAM_EXAMPLES_MODEL_FILE

namespace {

using hapbeam::GalerkinModel, hapbeam::PodModel;

int columns(const PodModel<>::Data& data) { return data.depths; }
int columns(const GalerkinModel<>::Data& data) { return data.tensions; }
bool loaded(const PodModel<>::Data& data) { return !data.symmetric; }
bool loaded(const GalerkinModel<>::Data&) { return false; }

template <typename Model>
Trained trained(const char* kind, Model model) {
  const auto& d = model.data();
  return {model,       kind,       d.beam,        d.s_min,   d.s_max, d.depth,
          d.positions, columns(d), d.shape.modes, loaded(d), d.errors};
}

Trained read(const std::string& path) {
  const hapbeam::ModelFileInfo info = hapbeam::describe_model_file(path);
  if (info.kind == "galerkin") return trained("galerkin", hapbeam::load_model<GalerkinModel<>>(path));
  return trained("pod", hapbeam::load_model<PodModel<>>(path));
}

}  // namespace

Trained load(Options& options) {
  Trained trained = read(options.model);
  if (options.guarded && trained.loaded)
    throw cli::UsageError("--guarded: must not stand beside " + options.model +
                          ", trained under dead loads that the file does not say");
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
