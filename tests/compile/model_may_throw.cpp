// A model whose press() may throw is no ForceModel: Touch refuses it, and says what it wants.
// expect: Touch<Model>: Model must offer press
#include <hapbeam/contact/touch.hpp>

struct Model {
  using Scalar = double;
#ifdef HAPBEAM_REPAIRED
  hapbeam::Response<double> press(const hapbeam::Press<double>&) noexcept { return {}; }
#else
  hapbeam::Response<double> press(const hapbeam::Press<double>&) { return {}; }
#endif
  hapbeam::Centreline<double> shape() const noexcept { return {nullptr, 0}; }
  hapbeam::Range<double> range() const noexcept { return {}; }
  double thickness() const noexcept { return 0; }
  void reset() noexcept {}
};

template class hapbeam::Touch<Model>;
