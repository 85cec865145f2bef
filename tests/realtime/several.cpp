// Several avatars and props on one beam: no heap, finite, no pull, and a bounded number of linear solves.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "rod/rods.hpp"
#include "stability/bistable.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A push has 48 and a second look before and after a fall on each of its passes; the release in it as many again.
constexpr int most_solves_of_a_tick = 2 * 48 + 2 * 12 + 2;

/// Two hands that go from place to place through the beam, jump, and are nowhere.
template <class Vector>
std::vector<Vector> hands(double length, unsigned seed) {
  Random random(seed);
  std::vector<Vector> path;
  const auto place = [&] {
    Vector x = Vector::Zero();
    x[0] = random(-0.05, 1.05) * length;
    for (int k = 1; k < x.size(); ++k) x[k] = random(0.15) * length;
    return x;
  };
  Vector at[2] = {place(), place()};
  for (int way = 0; way < 30; ++way) {
    const Vector from[2] = {at[0], at[1]}, to[2] = {place(), place()};
    const int ticks = way % 6 == 0 ? 1 : 60;
    for (int t = 1; t <= ticks; ++t)
      for (int k = 0; k < 2; ++k) path.push_back(at[k] = from[k] + (to[k] - from[k]) * (double(t) / ticks));
  }
  for (const double bad : {std::nan(""), double(INFINITY), 1e300}) {
    Vector none = at[0];
    none[1] = bad;
    path.push_back(none), path.push_back(at[1]);
  }
  return path;
}

/// In space with shafts, which a rod does not slip around.
template <class Touching, class Vector>
auto tick(Touching& touch, const Vector* at, double length) noexcept {
  if constexpr (Touching::dimension == 3) {
    const Vector half(0, 0, length), tips[2] = {at[0] - half, at[1] - half},
                                     shafts[2] = {2 * half + Vector(0, 0.1 * length, 0), 2 * half};
    return touch.tick(tips, shafts, 2);
  } else {
    return touch.tick(at, 2);
  }
}

template <class Model, class Body>
void check(const char* name, const Body& body, std::initializer_list<Prop<Model::dimension>> props,
           const Friction& friction = {}) {
  Model model(body, 16);
  using Vector = VectorOf<double, Model::dimension>;
  const double length = body.length();
  TouchSeveral<Model> touch(model, {{0.02 * length, 2, friction}, {0.01 * length, 1, friction}}, props);
  const auto path = hands<Vector>(length, 5);
  int touching = 0, bad = 0, pulls = 0, most = 0, beyond = 0;
  const HeapUse use = heap_use([&]() noexcept {
    for (std::size_t t = 0; t + 1 < path.size(); t += 2) {
      const auto felt = tick(touch, &path[t], length);
      most = std::max(most, model.report().solves);
      int now = 0;
      for (const auto& place : felt) {
        bad += !place.force.allFinite();
        const Vector across = place.force - place.friction;
        pulls += across.dot(place.normal) < 0;
        beyond += place.friction.norm() > friction.sticking * across.norm() * (1 + 1e-12);
        now += place.touching;
      }
      touching += now > 1;
    }
    touch.reset();
  });
  INFO(name << ": " << touching << " ticks with two contacts or more, at most " << most << " solves");
  CHECK(use == HeapUse{});
  CHECK(bad == 0);
  CHECK(pulls == 0);
  CHECK(beyond == 0);
  CHECK(most <= most_solves_of_a_tick);
  CHECK(touching > 10);
  // Recovered.
  Vector far = Vector::Zero();
  far[1] = 5 * length;
  for (int t = 0; t < 50; ++t) (void)touch.tick(far, far);
  const auto felt = touch.tick(far, far);
  CHECK(is_answer(felt.status));
  CHECK((felt.force(0).norm() == 0 && felt.force(1).norm() == 0));
}

}  // namespace

TEST_CASE("several avatars and props take nothing from the heap, with friction as without",
          "[realtime][several]") {
  using Flat = FemModel<Several<Corotational<>, 4>>;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{2e11}, Support::clamped, Support::free);
  const Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  for (const Friction& friction : {Friction(0), Friction(0.7, 0.5)}) {
    check<Flat>("ruler", ruler, {Prop<>::peg({0.2, -0.01}, 0.005).rough(friction)}, friction);
    check<Flat>("arch", hinged_arch(), {}, friction);
    check<FemModel<Several<RoundRod, 4>>>(
        "wire", wire, {Prop<3>::bar({0.1, -0.01, -0.1}, {0.1, -0.01, 0.1}, 0.004).rough(friction)}, friction);
  }
}

TEST_CASE("two hands with a servo each take nothing from the heap", "[realtime][two_hands]") {
  using Model = FemModel<Several<Corotational<>, 2>>;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{2e11}, Support::clamped, Support::free);
  Model model(ruler, 16);
  TwoHands<Model> both(model);
  const DeviceInfo device = VirtualPhantom<>(HandPath({0, 0})).info();
  ServoOptions rough;
  rough.friction = {0.5, 0.4};
  Servo<Hand<Model>> left(both[0], device, rough), right(both[1], device);
  const auto path = hands<Vector2<double>>(ruler.length(), 6);
  int pressing = 0, wild = 0, most = 0;
  const HeapUse use = heap_use([&]() noexcept {
    for (std::size_t t = 0; t + 1 < path.size(); t += 2) {
      DeviceState states[2];
      for (std::size_t k = 0; k < 2; ++k) {
        states[k].position = {path[t + k].x(), path[t + k].y(), 0};
        states[k].time = 1e-3 * static_cast<double>(t), states[k].reset = t == 0;
      }
      for (const Eigen::Vector3d& force : {left.tick(states[0]), right.tick(states[1])})
        wild += !(force.norm() <= device.peak_force * (1 + 1e-12));
      most = std::max(most, model.report().solves);
      pressing += left.record().pressing && right.record().pressing;
    }
    left.reset(), right.reset();
  });
  CHECK(use == HeapUse{});
  CHECK(wild == 0);
  CHECK(most <= most_solves_of_a_tick);
  CHECK(pressing > 10);
}
