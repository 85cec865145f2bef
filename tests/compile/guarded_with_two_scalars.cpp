// Forces and shapes of two scalars cannot be one model's.
// expect: Guarded<Fast, Full>: both must have the same Scalar
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;

#ifdef HAPBEAM_REPAIRED
using Model = Guarded<PodModel<float>, FemModel<VonKarman<>, float>>;
#else
using Model = Guarded<PodModel<float>, FemModel<>>;
#endif

int main() { return sizeof(Model) == 0; }
