// A program that loads a trained model: it must not be made to compile what trained it.
#include <cstdlib>
#include <cstring>

#include <hapbeam/rom/file/model_file.hpp>

#ifdef EIGEN_SVD_MODULE_H
#error "loading a model compiles a singular value decomposition"
#endif

namespace {

bool told() {
  try {
    hapbeam::load_model<hapbeam::GalerkinModel<float>>("no/such.json");
  } catch (const hapbeam::ModelFileError& error) {
    return std::strstr(error.what(), "no/such.json: cannot be opened") != nullptr;
  }
  return false;
}

const bool checked = told() || (std::abort(), false);

}  // namespace
