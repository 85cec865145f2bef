// A needle in the hand that meets a rod, in the words of a model that is touched: its shape is that of the rod.
//
// The needle's end goes where the hand goes, and does not turn; a spring and a damper that the device can render lead it.  What is felt is
// the force there.  Allocates and throws at construction.   Real-time: as hapbeam::World.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "body.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/world/world_tool.hpp>

namespace phantom {

class Probe {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;
  using World = hapbeam::World<hapbeam::RoundRod>;
  using Tool = hapbeam::WorldTool<hapbeam::RoundRod>;

  /// @param needle  its left end on coupling.support()   @throws std::invalid_argument as World
  Probe(const hapbeam::Rod& rod, const hapbeam::Rod& needle, int elements,
        const hapbeam::GripCoupling& coupling)
      : coupling_(coupling),
        world_(std::make_unique<World>(
            std::vector<hapbeam::WorldRod>{{rod, elements, {}}, {needle, elements, {}}})) {}

  hapbeam::Centreline<double, 3> shape() const noexcept { return world_->shape(0); }
  hapbeam::Centreline<double, 3> needle() const noexcept { return world_->shape(1); }
  const hapbeam::GripCoupling& coupling() const noexcept { return coupling_; }
  World& world() noexcept { return *world_; }
  const World& world() const noexcept { return *world_; }

 private:
  hapbeam::GripCoupling coupling_;
  std::unique_ptr<World> world_;
};

/// A tick's record, both rods and where they touch.
class ProbePicture {
 public:
  explicit ProbePicture(const Probe& probe) : rod_(probe.shape()), needle_(probe.needle()) { take(probe); }

  hapbeam::ServoRecord record;
  hapbeam::Centreline<double, 3> shape() const noexcept { return rod_.shape(); }
  hapbeam::Centreline<double, 3> needle() const noexcept { return needle_.shape(); }
  int contacts() const noexcept { return contacts_; }
  /// Midway between both centrelines [m].
  const Eigen::Vector3d& contact(int k) const noexcept { return places_[static_cast<std::size_t>(k)]; }

  void take(const Probe& probe) noexcept {
    rod_.take(probe.shape()), needle_.take(probe.needle());
    contacts_ = probe.world().contacts();
    for (int k = 0; k < contacts_; ++k) {
      const hapbeam::RodContact contact = probe.world().contact(k);
      places_[static_cast<std::size_t>(k)] = (contact.at[0] + contact.at[1]) / 2;
    }
  }

 private:
  hapbeam::ServoPicture<double, 3> rod_, needle_;
  std::array<Eigen::Vector3d, std::size_t(Probe::World::most_contacts)> places_;
  int contacts_ = 0;
};

inline void show(const ProbePicture& picture, DrawnBody& body) {
  body.beams.resize(2, body.beams[0]);
  body.beams[0].shape = picture.shape(), body.beams[1].shape = picture.needle();
  body.contacts.clear();
  for (int k = 0; k < picture.contacts(); ++k) body.contacts.push_back(picture.contact(k));
}

}  // namespace phantom

namespace hapbeam {

template <>
class Touch<phantom::Probe> {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;

  /// The radius is the needle's.
  Touch(phantom::Probe& probe, double) noexcept
      : probe_(probe),
        tool_(probe.world(), 1),
        grip_(tool_, RodSide::left),
        held_(grip_),
        coupling_(probe.coupling()) {
    reset();
  }

  /// The hand has the end where it is at rest.
  void reset() noexcept {
    held_.reset(), coupling_.reset();
    HandPose hand;
    hand.place = held_.end().place;
    (void)held_.follow(hand);
  }

  /// Once a period.   @param hand  [m]   @param dt  [s]   @return with the deepest place of the rod
  [[nodiscard]] CoupledForce<double, 3> lead(const Eigen::Vector3d& hand, double dt) noexcept {
    HandPose pose;
    pose.place = hand;
    CoupledForce<double, 3> felt = coupling_.tick(held_, pose, dt);
    const auto& world = probe_.world();
    felt.touch.pressing = world.contacts() > 0;
    double largest = 0;
    for (int k = 0; k < world.contacts(); ++k) {
      const RodContact contact = world.contact(k);
      const double force = contact.force.norm();
      if (!(force > largest)) continue;
      largest = force;
      const std::size_t rod = contact.rod[0] == 0 ? 0 : 1;
      const Eigen::Vector3d normal = (rod == 0 ? -1 : 1) * contact.force / force;
      felt.touch.press = {contact.s[rod], normal.dot(contact.at[rod])};
    }
    return felt;
  }

 private:
  using Tool = phantom::Probe::Tool;
  phantom::Probe& probe_;
  Tool tool_;
  Grip<Tool> grip_;
  Touch<Grip<Tool>> held_;
  GripCoupling coupling_;
};

template <>
struct Drawn<phantom::Probe> {
  using Picture = phantom::ProbePicture;
  static constexpr bool for_who_looks = false;
  static const phantom::Probe& of(const phantom::Probe& probe, const Touch<phantom::Probe>&) noexcept {
    return probe;
  }
};

}  // namespace hapbeam
