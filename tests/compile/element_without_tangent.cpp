// expect: an Element needs static noexcept energy\(p, d\), residual\(p, d, r\), tangent\(p, d, r, K\) and name\(\)
#include <hapbeam/fem/fem_model.hpp>

struct Incomplete {
  static constexpr const char* name() noexcept { return "incomplete"; }
  template <typename S>
  static S energy(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d) noexcept {
    return hapbeam::Linear::energy(p, d);
  }
  template <typename S>
  static void residual(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                       hapbeam::Vector6<S>& r) noexcept {
    hapbeam::Linear::residual(p, d, r);
  }
#ifdef HAPBEAM_REPAIRED
  template <typename S>
  static S tangent(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                   hapbeam::Vector6<S>& r, hapbeam::Matrix6<S>& K) noexcept {
    return hapbeam::Linear::tangent(p, d, r, K);
  }
#endif
};

int main() {
  using namespace hapbeam;
  FemModel<Incomplete> model(Beam(1, 1e6, 1e2, 0.01, Support::clamped, Support::free), 4);
  return static_cast<int>(model.press({0.5, 1e-3}).status);
}
