#include "curves.hpp"

#include <stdexcept>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace phantom {

namespace {

template <typename Element>
void add(std::vector<Curve>& curves, const char* name, const hapbeam::Beam& beam, int elements, double place,
         double depth) {
  Curve curve{name, {}, {}};
  try {
    hapbeam::FemModel<Element> model(beam, elements);
    const double rest = model.shape().at(place).w;
    constexpr int presses = 48;
    for (int i = 1; i <= presses; ++i) {
      const double d = depth * i / presses;
      const auto response = model.press({place, rest - d});
      if (response.status != hapbeam::Status::ok) break;
      if (i == 1) curve.depth.push_back(0), curve.force.push_back(0);
      curve.depth.push_back(static_cast<float>(d));
      curve.force.push_back(static_cast<float>(-response.force));
    }
  } catch (const std::exception&) {
    // A beam that this kinematics refuses has no curve.
  }
  if (!curve.depth.empty()) curves.push_back(curve);
}

}  // namespace

std::vector<Curve> force_curves(const hapbeam::Beam& beam, int elements, double place, double depth) {
  std::vector<Curve> curves;
  add<hapbeam::Linear>(curves, "linear", beam, elements, place, depth);
  add<hapbeam::VonKarman<>>(curves, "von Karman", beam, elements, place, depth);
  add<hapbeam::Corotational<>>(curves, "corotational", beam, elements, place, depth);
  return curves;
}

}  // namespace phantom
