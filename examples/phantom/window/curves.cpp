#include "curves.hpp"

#include <stdexcept>
#include <variant>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace phantom {

namespace {

constexpr int presses = 48;

/// How a beam is pressed down, and a rod along a direction, from where it rests.
class Presser {
 public:
  Presser(double place, const Eigen::Vector3d& along) : place_(place), along_(along) {}
  /// @param model  at rest
  template <typename Model>
  void begin(const Model& model) {
    if constexpr (Model::dimension == 2) rest_ = model.shape().at(place_).w;
    else rest_ = along_.dot(model.shape().at(place_).r);
  }
  template <typename Model>
  auto operator()(Model& model, double depth) const {
    if constexpr (Model::dimension == 2) {
      auto response = model.press({place_, rest_ - depth});
      response.force = -response.force;
      return response;
    } else {
      return model.push({place_, rest_ + depth, along_});
    }
  }

 private:
  double place_, rest_ = 0;
  Eigen::Vector3d along_;
};

template <typename Element>
void add(std::vector<Curve>& curves, const char* name, const typename hapbeam::FemModel<Element>::Body& beam,
         int elements, Presser press, double depth) {
  Curve curve{name, {}, {}};
  try {
    hapbeam::FemModel<Element> model(beam, elements);
    press.begin(model);
    for (int i = 1; i <= presses; ++i) {
      const double d = depth * i / presses;
      const auto response = press(model, d);
      if (response.status != hapbeam::Status::ok) break;
      if (i == 1) curve.depth.push_back(0), curve.force.push_back(0);
      curve.depth.push_back(static_cast<float>(d));
      curve.force.push_back(static_cast<float>(response.force));
    }
  } catch (const std::exception&) {
    // A beam that this kinematics refuses has no curve.
  }
  if (!curve.depth.empty()) curves.push_back(curve);
}

/// As stiff all the way as the first of the others is where it begins.
Curve tangent_of(const Curve& first, double depth) {
  const float slope = first.force[1] / first.depth[1];
  return {"linear", {0, static_cast<float>(depth)}, {0, slope * static_cast<float>(depth)}};
}

}  // namespace

std::vector<Curve> force_curves(const Slender& slender, int elements, double place,
                                const Eigen::Vector3d& along, double depth) {
  std::vector<Curve> curves;
  const Presser press(place, along);
  if (const auto* const beam = std::get_if<hapbeam::Beam>(&slender)) {
    add<hapbeam::Linear>(curves, "linear", *beam, elements, press, depth);
    add<hapbeam::VonKarman<>>(curves, "von Karman", *beam, elements, press, depth);
    add<hapbeam::Corotational<>>(curves, "corotational", *beam, elements, press, depth);
    return curves;
  }
  const auto& rod = std::get<hapbeam::Rod>(slender);
  add<hapbeam::TwistedRod>(curves, "twisted rod", rod, elements, press, depth);
  add<hapbeam::RoundRod>(curves, "round rod", rod, elements, press, depth);
  if (!curves.empty()) curves.insert(curves.begin(), tangent_of(curves.front(), depth));
  return curves;
}

}  // namespace phantom
