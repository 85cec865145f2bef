// Two devices on one beam: each with a servo and a time of its own, in lock step.  Do they come to rest, and give nothing that they were not given?
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/step_response.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Leans down from a moment on, when the guard has let the force in, and half a second later along the beam as well.
struct LeaningLater {
  double push, aside, at;
  HandTarget operator()(double time) const noexcept {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return {zero, zero, time < at ? zero : Eigen::Vector3d(time < at + 0.5 ? 0 : aside, -push, 0)};
  }
};

/// A device, its servo, and what went through it.
template <class Model>
class Station {
 public:
  Station(Hand<Model>& hand, const Situation& who, double at, const Placement& placement, double aside = 0)
      : who_(who),
        device_({who.push, aside, at}, who.options()),
        servo_(hand, device_.info(), options(placement, who)) {
    held_.fill(Eigen::Vector3d::Zero());
  }

  double time() const noexcept { return static_cast<double>(ticks_) * who_.period; }
  /// @return [J] what hand, arm and motors have put into the loop in this tick, at least
  double step() noexcept {
    struct Send {
      Servo<Hand<Model>>& servo;
      Eigen::Vector3d sent;
      Eigen::Vector3d operator()(const DeviceState& state) noexcept { return sent = servo.tick(state); }
    } send{servo_, Eigen::Vector3d::Zero()};
    const Eigen::Vector3d before = device_.tip().position;
    device_.step(send);
    ++ticks_;
    std::move_backward(held_.begin(), held_.end() - 1, held_.end());
    held_[0] = send.sent;
    const Eigen::Vector3d moved = device_.tip().position - before;
    return -held_[static_cast<std::size_t>(who_.delay)].dot(moved) +
           who_.damping * moved.squaredNorm() / who_.period + who_.friction * moved.cwiseAbs().sum();
  }
  double speed() const noexcept { return device_.tip().velocity.norm(); }
  const ServoRecord& record() const noexcept { return servo_.record(); }

 private:
  static ServoOptions options(const Placement& placement, const Situation& who) {
    ServoOptions options;
    options.placement = placement, options.delay_ticks = who.delay, options.friction = who.rough;
    return options;
  }

  Situation who_;
  VirtualPhantom<LeaningLater> device_;
  Servo<Hand<Model>> servo_;
  std::array<Eigen::Vector3d, 17> held_;  // newest first
  long ticks_ = 0;
};

struct PairResponse {
  double speed = 0;         ///< [m/s] RMS over the last 0.1 s
  double least_energy = 0;  ///< [J] of both hands and arms together
  double dissipated = 0;    ///< [J] by friction on the beam
  std::vector<double> forces;
  bool pressing = false;  ///< both
};

/// The side from which a planar beam is pressed, or a rod's.   @param model  at rest
template <class Model>
Placement on_side(const Model& model, double s, const Eigen::Vector3d& from) {
  const Placement upper = above(model, s, from, 0.005);
  if constexpr (dimension_of<Model> == 2)
    if (from.y() < 0) {
      Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
      turned(1, 1) = turned(2, 2) = -1;
      return Placement(turned, {s, 2 * model.shape().at(s).w - upper.origin().y(), 0});
    }
  return upper;
}

template <class Model>
PairResponse pair_response(Model& model, const Placement& first, const Placement& second, const Situation& a,
                           const Situation& b, double later, double duration, double aside = 0) {
  TwoHands<Model> hands(model);
  Station<Model> left(hands[0], a, 0.3, first, aside), right(hands[1], b, 0.3 + later, second, -aside);
  PairResponse r;
  double energy = 0, squares = 0, count = 0;
  while (std::min(left.time(), right.time()) < duration) {
    Station<Model>& next = left.time() <= right.time() ? left : right;
    energy += next.step();
    r.least_energy = std::min(r.least_energy, energy);
    r.forces.push_back(next.record().force.y());
    if (next.time() < duration - 0.1) continue;
    squares += next.speed() * next.speed();
    ++count;
  }
  r.speed = std::sqrt(squares / count);
  r.pressing = left.record().pressing && right.record().pressing;
  r.dissipated = left.record().dissipated + right.record().dissipated;
  return r;
}

}  // namespace

TEST_CASE("two hands that lean on one beam come to rest, each at its own rate", "[two_hands]") {
  Random random(41);
  FemModel<Several<Corotational<>, 2>> ruler(steel_ruler(), 16);
  FemModel<Several<RoundRod, 2>> wire(
      Rod(0.3, RodSection::circle(0.0015), {200e9, 77e9}, RodSupport::clamped, RodSupport::free), 12);
  int pressing = 0;
  for (int i = 0; i < 30; ++i) {
    const Situation a = random_hand(random), b = random_hand(random);
    const double s = random(0.2, 0.55) * 0.3, apart = random(0.05, 0.4) * 0.3, later = random(0.0, 0.2);
    const double turn = random(3.1), other = random(3.1);
    const auto side = [](double angle, bool planar) {
      return planar ? Eigen::Vector3d(0, angle > 0 ? 1 : -1, 0)
                    : Eigen::Vector3d(0, std::cos(angle), std::sin(angle));
    };
    const auto respond = [&](auto& model, bool planar) {
      model.reset();
      return pair_response(model, on_side(model, s, side(turn, planar)),
                           on_side(model, s + apart, side(other, planar)), a, b, later, 2);
    };
    const PairResponse r = i % 2 == 0 ? respond(ruler, true) : respond(wire, false);
    CAPTURE(i, s, apart, a.push, b.push, a.period, b.period, a.delay, b.delay, turn, other);
    CHECK(r.speed <= 1e-3);
    CHECK(r.least_energy >= -1e-9);
    pressing += r.pressing;
  }
  CHECK(pressing >= 15);
}

// They draw the beam between them, or push it.
TEST_CASE("two hands that lean on one beam with friction, and then along it, come to rest",
          "[two_hands][friction]") {
  Random random(47);
  FemModel<Several<Corotational<>, 2>> ruler(steel_ruler(), 16);
  FemModel<Several<RoundRod, 2>> wire(
      Rod(0.3, RodSection::circle(0.0015), {200e9, 77e9}, RodSupport::clamped, RodSupport::free), 12);
  int pressing = 0, rubbed = 0;
  for (int i = 0; i < 30; ++i) {
    Situation a = random_hand(random), b = random_hand(random);
    a.rough = random(0.1, 1), b.rough = i % 5 == 0 ? 0 : random(0.1, 1);
    const double s = random(0.2, 0.4) * 0.3, apart = random(0.2, 0.4) * 0.3, later = random(0.0, 0.2),
                 aside = random(0.6) * std::min(a.push, b.push);
    const bool below = random(1) > 0;
    const auto respond = [&](auto& model) {
      model.reset();
      const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
      return pair_response(model, on_side(model, s, below ? Eigen::Vector3d(-up) : up),
                           on_side(model, s + apart, up), a, b, later, 2.5, aside);
    };
    const PairResponse r = i % 3 != 0 ? respond(ruler) : respond(wire);
    CAPTURE(i, s, apart, below, aside, a.rough, b.rough, a.push, b.push, a.period, b.period, a.delay,
            b.delay);
    CHECK(r.speed <= 1e-3);
    CHECK(r.least_energy >= -1e-9);
    pressing += r.pressing, rubbed += r.dissipated > 1e-6;
  }
  CHECK(pressing >= 15);
  CHECK(rubbed >= 15);
}

TEST_CASE("in lock step two hands feel the same to the last bit in every run", "[two_hands]") {
  Random random(43);
  const Situation a = random_hand(random), b = random_hand(random);
  const auto run = [&] {
    FemModel<Several<Corotational<>, 2>> model(steel_ruler(), 16);
    return pair_response(model, on_side(model, 0.12, Eigen::Vector3d::UnitY()),
                         on_side(model, 0.25, Eigen::Vector3d::UnitY()), a, b, 0.1, 0.8)
        .forces;
  };
  const std::vector<double> first = run();
  CHECK(first.size() > 500);
  CHECK(*std::max_element(first.begin(), first.end()) > 0.1);
  CHECK(first == run());
}

TEST_CASE("a device that is unplugged leaves the other one its beam", "[two_hands]") {
  Situation who;
  using Model = FemModel<Several<Corotational<>, 2>>;
  Model model(steel_ruler(), 16);
  TwoHands hands(model);
  // One presses the ruler down, and the other one holds it up.
  Station<Model> left(hands[0], who, 0.3, on_side(model, 0.25, Eigen::Vector3d::UnitY())),
      right(hands[1], who, 0.3, on_side(model, 0.2, -Eigen::Vector3d::UnitY()));
  for (int k = 0; k < 1000; ++k) (void)left.step(), (void)right.step();
  REQUIRE((left.record().pressing && right.record().pressing));
  const double held = model.shape().at(model.shape().length()).w;
  for (int k = 0; k < 600; ++k) (void)left.step();
  CHECK(left.record().pressing);
  CHECK(left.record().failed_ticks == 0);
  CHECK(model.shape().at(model.shape().length()).w < held - 0.001);
  CHECK(left.speed() <= 1e-3);
  // Plugged in again, where it is now.
  for (int k = 0; k < 1000; ++k) (void)left.step(), (void)right.step();
  CHECK(right.record().pressing);
  CHECK(model.shape().at(model.shape().length()).w ==
        Approx(held).margin(3e-4));  // the arms' friction leaves them elsewhere
}

TEST_CASE("a hand whose position is none is a hand that is not ticked", "[two_hands]") {
  using Model = FemModel<Several<Corotational<>, 2>>;
  // The right hand comes onto the ruler, and from 400 on its place is none, or it is not ticked at all.
  const auto forces = [](bool ticked) {
    Model model(steel_ruler(), 16);
    TwoHands hands(model);
    const DeviceInfo device = VirtualPhantom<>(HandPath({0, 0})).info();
    Servo left(hands[0], device), right(hands[1], device);
    std::vector<double> felt;
    for (int k = 0; k < 900; ++k) {
      DeviceState one, other;
      one.reset = other.reset = k == 0;
      one.time = other.time = 1e-3 * k;
      one.position = {0.2, 0.0055 - 3e-5 * k, 0};
      other.position = {0.1, k < 400 ? 0.0055 - 2e-5 * k : std::nan(""), 0};
      felt.push_back(left.tick(one).y());
      if (k >= 400 && !ticked) continue;
      const Eigen::Vector3d none = right.tick(other);
      if (k >= 430) CHECK(none.isZero(0));
    }
    return felt;
  };
  const std::vector<double> quiet = forces(false);
  CHECK(quiet.back() > 1);
  CHECK(forces(true) == quiet);
}

// The other loop has 100 ticks before the guard of this one would see a pause.
TEST_CASE("a hand that was lifted while its loop stood still comes in slowly", "[two_hands]") {
  for (const double period : {1e-3, 5e-4, 2.5e-4})
    for (const double pause : {0.03, 0.06, 0.095, 0.11})
      for (const double place : {-0.01, 0.001, 0.003}) {
        FemModel<Several<Corotational<>, 2>> model(steel_ruler(), 16);
        TwoHands hands(model);
        DeviceInfo device = VirtualPhantom<>(HandPath({0, 0})).info();
        device.continuous_force = device.peak_force;
        Servo left(hands[0], device);
        device.period = period;
        Servo right(hands[1], device);
        double time = 0, others = 0, held = 0;
        const auto tick = [&](double y, double step) {
          for (; others < time - 1e-9; others += period) {
            DeviceState other;
            other.time = others, other.position = {0.1, 0.2, 0};
            (void)right.tick(other);
          }
          DeviceState one;
          one.time = time, one.position = {0.2, y, 0};
          time += step;
          return left.tick(one).norm();
        };
        for (int k = 0; k < 1000; ++k)
          held = tick(0.0055 - 0.0155 * std::min(1.0, k / 500.0), k < 999 ? 1e-3 : pause);
        REQUIRE(held > 1);
        CAPTURE(period, pause, place, held);
        const bool stood_still = pause >= 100 * period || pause > 0.1;
        for (int k = 1; k <= 3 && stood_still; ++k) CHECK(tick(place, 1e-3) <= k / 200.0 * held * 1.2);
        if (!stood_still) CHECK(tick(-0.01, 1e-3) == Approx(held).epsilon(1e-3));
      }
}

TEST_CASE("what one hand does to the beam does not confuse the other hand's coupling", "[two_hands]") {
  // The left hand stands still; the right one presses and draws back within 0.1 s each.
  FemModel<Several<Corotational<>, 2>> model(steel_ruler(), 16);
  TwoHands hands(model);
  Servo left(hands[0], VirtualPhantom<>(HandPath({0, 0})).info()),
      right(hands[1], VirtualPhantom<>(HandPath({0, 0})).info());
  DeviceState one, other;
  const auto tick = [&](int k, double deep) {
    one.reset = other.reset = k == 0;
    one.time = other.time = 1e-3 * k;
    one.position = {0.2, 0.0055 - 0.02 * std::min(1.0, k / 300.0), 0};
    other.position = {0.1, 0.0055 - deep, 0};
    const Eigen::Vector3d felt = left.tick(one);
    (void)right.tick(other);
    return felt.y();
  };
  double last = 0, steepest = 0;
  for (int k = 0; k < 600; ++k) last = tick(k, 0);
  const double before = last;
  double least = before;
  int without = 0;
  for (int k = 600; k < 800; ++k) {
    const double deep = 0.007 * (k < 700 ? (k - 600) / 100.0 : (800 - k) / 100.0), now = tick(k, deep);
    steepest = std::max(steepest, std::abs(now - last));
    least = std::min(least, now);
    without += left.record().status != LoopStatus::touching;
    last = now;
  }
  for (int k = 800; k < 900; ++k) last = tick(k, 0);
  INFO(before << " N, at least " << least << " N, at most " << steepest << " N a tick, " << without
              << " ticks otherwise");
  CHECK(last == Approx(before).epsilon(1e-3));
  CHECK(least < 0.85 * before);
  CHECK(least > 0);
  CHECK(without == 0);
  // It reaches the bent ruler in the last 30 of its 100 ticks.
  CHECK(steepest <= 4 * (before - least) / 30);
}

// The ruler is lifted from below, and the hand is above it at rest when its loop begins anew.
TEST_CASE("servos that begin anew feel what new ones feel, to the last bit", "[two_hands][reset]") {
  using Ruler = FemModel<Several<Corotational<>, 2>>;
  enum class How { servos, devices, other_hand };
  const How how = GENERATE(How::servos, How::devices, How::other_hand);
  const double lift = GENERATE(0.01, 0.02, 0.04, 0.06);
  CAPTURE(static_cast<int>(how), lift);
  const DeviceInfo device{"mine", {0.4, 0.3, 0.2}, 37.5, 6.2, 3500, 7e-6, 0.2, 1e-3, 5, 0.2};
  ServoOptions options;
  options.placement = Placement::in_plane({0.2, 0});
  struct Pair {
    Ruler model{steel_ruler(), 16};
    TwoHands<Ruler> hands{model};
    Servo<Hand<Ruler>> first, second;
    Pair(const DeviceInfo& device, const ServoOptions& options)
        : first(hands[0], device, options), second(hands[1], device, options) {}
  } used(device, options), fresh(device, options);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  for (int i = 0; i < 1500; ++i) {
    (void)used.first.tick({0.05, -0.01 + (lift + 0.01) * std::min(1.0, i / 1000.0), 0}, none, 1e-3);
    (void)used.second.tick({-0.1, 0.1, 0}, none, 1e-3);
  }
  REQUIRE(used.first.record().force.y() < -1);
  if (how == How::servos) used.first.reset(), used.second.reset();
  if (how == How::other_hand) used.first.reset();
  auto &mine = how == How::other_hand ? used.second : used.first,
       &theirs = how == How::other_hand ? fresh.second : fresh.first;
  int differ = 0;
  double most = 0;
  for (int i = 0; i < 3000; ++i) {
    DeviceState state;
    state.position = {0.05, lift / 2 + 0.006 - (lift / 2 + 0.016) * std::clamp(i / 1000.0 - 1, 0.0, 1.0), 0};
    state.time = 100 + 1e-3 * i;
    state.reset = i == 0 && how != How::servos;
    state.sent = mine.record().force;
    const Eigen::Vector3d felt = mine.tick(state), expected = theirs.tick(state);
    differ += felt != expected;
    most = std::max(most, expected.y());
  }
  CHECK(differ == 0);
  CHECK(most > 1);
}

// ServoLoop::start() of one device, in the program's thread, while that of the other one ticks.
TEST_CASE("a servo begins anew while that of the other hand ticks", "[two_hands][reset]") {
  FemModel<Several<Corotational<>, 2>> model(steel_ruler(), 16);
  TwoHands hands(model);
  Servo left(hands[0], VirtualPhantom<>(HandPath({0, 0})).info()),
      right(hands[1], VirtualPhantom<>(HandPath({0, 0})).info());
  std::atomic<int> ticks{0};
  std::atomic<bool> done{false};
  std::thread loop([&] {
    DeviceState state;
    for (int k = 0; !done.load(); ++k, ++ticks) {
      state.time = 1e-3 * k, state.position = {0.2, 0.01 - 0.03 * ((k % 1000) / 1000.0), 0};
      (void)left.tick(state);
    }
  });
  for (int resets = 0; resets < 1000 || ticks.load() < 1000; ++resets) right.reset();
  done = true;
  loop.join();
  CHECK(left.record().contact_ticks > 0);
  CHECK_FALSE(right.record().pressing);
}
