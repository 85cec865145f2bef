// The simulated device in lock step: what the hand does, what the encoders say, what the motors may do.
#include <cstring>
#include <limits>
#include <vector>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {

struct Free {
  Eigen::Vector3d operator()(const DeviceState&) noexcept { return Eigen::Vector3d::Zero(); }
};
struct Always {
  Eigen::Vector3d force;
  Eigen::Vector3d operator()(const DeviceState&) noexcept { return force; }
};
struct Wall {
  double stiffness;  // [N/m] below y = 0
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    return {0, std::max(0.0, -stiffness * state.position.y()), 0};
  }
};
struct Recorder {
  std::vector<DeviceState> states;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    states.push_back(state);
    return {0, std::max(0.0, -2000 * state.position.y()), 0};
  }
};
/// A hand that holds still at the origin.
struct Still {
  HandTarget operator()(double) const noexcept { return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}; }
};

const HandPath press_and_slide = HandPath({0, 0.02}).press(0.03, 0.5).slide(0.1, 0.5).release(0.03, 0.5);

bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("a free hand arrives where it wants to be, within what friction holds", "[phantom]") {
  VirtualPhantom<> phantom(press_and_slide);
  Free free;
  phantom.run(free, 4);
  const HandOptions hand;
  const ArmOptions arm;
  const Eigen::Vector3d miss = phantom.tip().position - press_and_slide(4).position;
  CHECK(std::abs(miss.x()) <= arm.friction / hand.stiffness);
  CHECK(std::abs(miss.y()) <= arm.friction / hand.stiffness);
  CHECK(miss.z() == 0);
  CHECK(phantom.tip().velocity.norm() == 0);

  VirtualPhantomOptions smooth;
  smooth.arm.friction = 0;
  VirtualPhantom<> frictionless(press_and_slide, smooth);
  frictionless.run(free, 6);
  CHECK((frictionless.tip().position - press_and_slide(6).position).norm() <= 1e-12);
}

TEST_CASE("positions lie on the grid of the encoders, half a step from the truth at most", "[phantom]") {
  VirtualPhantom<> phantom(press_and_slide);
  const double grid = phantom.info().position_resolution;
  REQUIRE(grid == 7e-6);
  struct {
    VirtualPhantom<>* phantom;
    double grid, off_grid = 0, off_truth = 0;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      const Eigen::Vector3d steps = state.position / grid;
      off_grid = std::max(off_grid, (steps.array() - steps.array().round()).abs().maxCoeff());
      off_truth = std::max(off_truth, (state.position - phantom->tip().position).cwiseAbs().maxCoeff());
      return {0, std::max(0.0, -2000 * state.position.y()), 0};
    }
  } servo{&phantom, grid};
  phantom.run(servo, 2);
  CHECK(servo.off_grid <= 1e-10);
  CHECK(servo.off_truth <= grid / 2 * (1 + 1e-10));
  CHECK(servo.off_truth >= grid / 2 * 0.99);
}

TEST_CASE("the velocity is a low pass of the readings' differences", "[phantom]") {
  const double period = 1e-3, cutoff = 100, speed = 0.1;
  Encoders exact(0, cutoff), coarse(7e-6, cutoff);
  for (int n = 1; n <= 200; ++n) {
    exact.read({speed * n * period, 0, 0}, period);
    coarse.read({speed * n * period, 0, 0}, period);
    const double expected = speed * (1 - std::exp(-2 * 3.14159265358979 * cutoff * period * n));
    REQUIRE(exact.velocity().x() == Approx(expected).epsilon(1e-10));
    // A reading is half a step off; so is their sum, through gain and decay of the filter.
    REQUIRE(std::abs(coarse.velocity().x() - expected) <= 7e-6 / period);
  }
}

TEST_CASE("the motors give the peak in the direction asked for, and the device says so", "[phantom]") {
  const Eigen::Vector3d direction = Eigen::Vector3d(1, -2, 2) / 3;
  Always peak{37.5 * direction}, more{1e6 * direction};
  VirtualPhantom at_peak(Still{}), beyond(Still{});
  at_peak.run(peak, 0.05);
  beyond.run(more, 0.05);
  CHECK((at_peak.tip().position - beyond.tip().position).norm() <= 1e-14);
  CHECK(at_peak.counts().force_cut_ticks == 0);
  CHECK(beyond.counts().force_cut_ticks == 50);
  CHECK(beyond.counts().ticks == 50);
  CHECK(beyond.counts().missed_ticks == 0);
}

TEST_CASE("a force that is no number is no force, and the next tick knows", "[phantom]") {
  struct Faulty {
    int tick = 0;
    double answer;
    std::vector<ForceCut> cuts;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      cuts.push_back(state.cut);
      return ++tick == 3 ? Eigen::Vector3d(1, answer, 1)
             : tick == 5 ? Eigen::Vector3d(0, 100, 0)
                         : Eigen::Vector3d(0, 1, 0);
    }
  };
  for (const double answer :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    VirtualPhantom phantom(Still{});
    Faulty servo{0, answer, {}};
    phantom.run(servo, 6e-3);
    CHECK(servo.cuts == std::vector<ForceCut>{ForceCut::none, ForceCut::none, ForceCut::none,
                                              ForceCut::not_finite, ForceCut::none, ForceCut::peak});
    CHECK(phantom.counts().force_cut_ticks == 2);
    CHECK(phantom.tip().position.allFinite());
    CHECK(phantom.tip().position.x() == 0);
  }
}

TEST_CASE("pressed against a spring, hand and wall come to rest in balance", "[phantom]") {
  const HandPath path = HandPath({0, 0.02}).press(0.04, 1).rest(1);
  const HandOptions hand;
  for (const double wall : {200.0, 1000.0, 3500.0}) {
    VirtualPhantom<> phantom(path);
    Wall servo{wall};
    phantom.run(servo, 4);
    const ArmOptions arm;
    const double balance = -0.02 * hand.stiffness / (hand.stiffness + wall);
    CHECK(phantom.tip().velocity.y() == 0);
    CHECK(std::abs(phantom.tip().position.y() - balance) <=
          (arm.friction + wall * arm.resolution / 2) / (hand.stiffness + wall));
  }
}

TEST_CASE("lock step gives the same bits every time, however it is cut", "[phantom]") {
  VirtualPhantom<> once(press_and_slide), again(press_and_slide);
  Recorder first, second, third;
  once.run(first, 1.5);
  again.run(second, 0.7);
  for (int tick = 0; tick < 800; ++tick) again.step(second);
  once.reset();
  once.run(third, 1.5);
  REQUIRE(first.states.size() == 1500);
  for (const Recorder* other : {&second, &third}) {
    REQUIRE(other->states.size() == 1500);
    for (std::size_t i = 0; i < 1500; ++i) {
      REQUIRE(same_bits(first.states[i].position, other->states[i].position));
      REQUIRE(same_bits(first.states[i].velocity, other->states[i].velocity));
      REQUIRE(first.states[i].time == other->states[i].time);
    }
  }
  CHECK(first.states[0].time == 0);
  CHECK(first.states[1499].time == Approx(1.499).epsilon(1e-15));
}

TEST_CASE("arm, hand and script that cannot be are refused by name, value and unit", "[phantom]") {
  const auto with = [](auto change) {
    VirtualPhantomOptions options;
    change(options);
    return [options] { VirtualPhantom<> phantom(press_and_slide, options); };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(with([](auto& o) { o.arm.apparent_mass = 0; })(),
                    ContainsSubstring("apparent_mass = 0 kg"));
  CHECK_THROWS_WITH(with([](auto& o) { o.arm.friction = -1; })(),
                    ContainsSubstring("friction = -1 N: must be"));
  CHECK_THROWS_WITH(with([](auto& o) { o.arm.period = 5; })(), ContainsSubstring("period = 5 s"));
  CHECK_THROWS_WITH(with([&](auto& o) { o.hand.stiffness = nan; })(),
                    ContainsSubstring("hand stiffness = nan N/m"));
  CHECK_THROWS_WITH(with([](auto& o) { o.arm.damping = 1e9; })(), ContainsSubstring("apparent_mass"));
  CHECK_THROWS_AS(with([](auto& o) { o.arm.damping = -1; })(), std::invalid_argument);
  CHECK_THROWS_AS(with([](auto& o) { o.arm.resolution = -1; })(), std::invalid_argument);
  CHECK_THROWS_AS(with([](auto& o) { o.arm.velocity_cutoff = 0; })(), std::invalid_argument);
  CHECK_THROWS_AS(with([&](auto& o) { o.arm.peak_force = nan; })(), std::invalid_argument);
  CHECK_THROWS_AS(with([](auto& o) { o.hand.damping = -1; })(), std::invalid_argument);
  CHECK_THROWS_AS(with([](auto& o) { o.hand.grip_mass = -1; })(), std::invalid_argument);
  CHECK_THROWS_WITH(VirtualPhantom<>(HandPath({0.2, 0})), ContainsSubstring("hand path x = 0.2 m"));
  CHECK_THROWS_WITH(VirtualPhantom<>(HandPath({0, 0}).press(0.14, 1)),
                    ContainsSubstring("hand path y = -0.14 m"));
}

TEST_CASE("the servo is told what was sent, and to begin anew in the first tick alone", "[phantom][thread]") {
  VirtualPhantom<> phantom(press_and_slide);
  struct {
    std::vector<DeviceState> states;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      states.push_back(state);
      return {0, 20.0 * static_cast<double>(states.size()), 0};
    }
  } servo;
  CHECK(phantom.status() == DeviceStatus::stopped);
  phantom.run(servo, 4e-3);
  REQUIRE(servo.states.size() == 4);
  const double sent[] = {0, 20, 37.5, 37.5};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(servo.states[i].sent == Eigen::Vector3d(0, sent[i], 0));
    CHECK(servo.states[i].cut == (i < 2 ? ForceCut::none : ForceCut::peak));
    CHECK(servo.states[i].reset == (i == 0));
    CHECK(servo.states[i].status == DeviceStatus::running);
  }
  phantom.reset();
  phantom.step(servo);
  CHECK(servo.states.back().reset);
  CHECK(servo.states.back().sent == Eigen::Vector3d::Zero());
  phantom.start(servo);
  CHECK(phantom.status() == DeviceStatus::running);
  phantom.stop();
  CHECK(phantom.status() == DeviceStatus::stopped);
}

TEST_CASE("motors that are late by n periods move the arm as a servo that answers n periods later",
          "[phantom]") {
  struct Pulse {
    int first, tick = 0;
    Eigen::Vector3d operator()(const DeviceState&) noexcept {
      const int since = tick++ - first;
      return {0, since >= 0 && since < 3 ? 2.0 * (since + 1) : 0.0, 0};
    }
  };
  for (const int delay : {0, 1, 3, 16}) {
    VirtualPhantomOptions late;
    late.arm.delay_ticks = delay;
    VirtualPhantom delayed(Still{}, late), prompt(Still{});
    Pulse early{2}, later{2 + delay};
    for (int tick = 0; tick < 100; ++tick) {
      delayed.step(early);
      prompt.step(later);
      REQUIRE(same_bits(delayed.tip().position, prompt.tip().position));
    }
    CHECK(delayed.tip().position.y() != 0);
    // What is under way is forgotten with the rest.
    Pulse now{0};
    delayed.step(now);
    delayed.reset();
    Free free;
    delayed.run(free, 0.05);
    CHECK(delayed.tip().position.isZero(0));
  }
  VirtualPhantomOptions options;
  for (const int delay : {-1, 17}) {
    options.arm.delay_ticks = delay;
    CHECK_THROWS_WITH((VirtualPhantom<Still>(Still{}, options)), ContainsSubstring("delay_ticks"));
  }
}

TEST_CASE("a push besides, held over each period, moves the arm as the device's own force does",
          "[phantom]") {
  struct Pushing {
    HandTarget operator()(double time) const noexcept {
      return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
              Eigen::Vector3d(0, time < 0.0995 ? 0 : -3, 0)};
    }
  };
  struct Step {
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      return {0, state.time < 0.0995 ? 0.0 : -3.0, 0};
    }
  };
  VirtualPhantom pushed(Pushing{});
  VirtualPhantom driven(Still{});
  Free free;
  Step step;
  for (int tick = 0; tick < 3000; ++tick) {
    pushed.step(free);
    driven.step(step);
    REQUIRE(same_bits(pushed.tip().position, driven.tip().position));
  }
  const HandOptions hand;
  const ArmOptions arm;
  CHECK(pushed.tip().velocity.norm() == 0);
  CHECK(std::abs(pushed.tip().position.y() * hand.stiffness + 3) <= arm.friction);
}
