// expect: an Element needs static noexcept energy
#include <hapbeam/fem/fem_model.hpp>

#ifdef HAPBEAM_REPAIRED
#define NOEXCEPT noexcept
#else
#define NOEXCEPT
#endif

struct Careless {
  static constexpr const char* name() noexcept { return "careless"; }
  template <typename S>
  static S energy(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d) noexcept {
    return hapbeam::Linear::energy(p, d);
  }
  template <typename S>
  static void residual(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                       hapbeam::Vector6<S>& r) NOEXCEPT {
    hapbeam::Linear::residual(p, d, r);
  }
  template <typename S>
  static S tangent(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                   hapbeam::Vector6<S>& r, hapbeam::Matrix6<S>& K) noexcept {
    return hapbeam::Linear::tangent(p, d, r, K);
  }
};

int main() {
  using namespace hapbeam;
  FemModel<Careless> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
