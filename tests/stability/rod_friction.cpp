// Coulomb friction between a sphere or a capsule and a rod in space, and through the loop.
#include <array>
#include <cmath>

#include "rod/rods.hpp"
#include "rod/touching.hpp"
#include "support/csv.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/step_response.hpp"
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Wire = FemModel<RoundRod>;

void check_friction(const Felt& r, const Friction& friction) {
  const Point across = r.force - r.friction;
  REQUIRE(r.force.allFinite());
  REQUIRE(across.dot(r.contact.normal) >= 0);
  REQUIRE(r.friction.norm() <= friction.sticking * across.norm() * (1 + 1e-13));
  REQUIRE(std::abs(r.friction.dot(r.contact.normal)) <= 1e-12 * across.norm());
  if (!r.pressing) REQUIRE(r.force.isZero(0));
}

Rod needle() {
  return Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
}

/// The hand leans on the beam, then along it and aside.
struct LeaningAside {
  Eigen::Vector3d down, aside;  // [N]
  HandTarget operator()(double time) const noexcept {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return {zero, zero, (time < 0.3 ? zero : down) + (time < 0.8 ? zero : aside)};
  }
};

/// [m/s] RMS of a hand half a second after it has leaned aside, the largest over any 0.1 s; infinite where the loop was not passive.
template <class Model>
double unrest(Model& model, double s, const Friction& friction, const Situation& who,
              const Eigen::Vector3d& aside) {
  model.reset();
  VirtualPhantom<LeaningAside> device(LeaningAside{{0, -who.push, 0}, aside}, who.options());
  ServoOptions options;
  options.avatar_radius = Model::dimension == 2 ? 0.005 : 0.02;
  options.placement = above(model, s, Eigen::Vector3d::UnitY(), options.avatar_radius);
  options.delay_ticks = who.delay;
  options.friction = friction;
  Servo<Model> servo(model, device.info(), options, VirtualCoupling(safe_coupling(device.info(), who.delay)));
  device.run(servo, 1.3);
  double worst = 0;
  for (int window = 0; window < 5; ++window) {
    double squares = 0;
    const int ticks = static_cast<int>(0.1 / who.period);
    for (int k = 0; k < ticks; ++k) device.step(servo), squares += device.tip().velocity.squaredNorm();
    worst = std::max(worst, std::sqrt(squares / ticks));
  }
  const ServoRecord& r = servo.record();
  return r.energy_generated == 0 && r.failed_ticks == 0 && r.pressing ? worst : 1e9;
}

}  // namespace

TEST_CASE("a stylus across a strip slides with friction as the elastica says", "[rod][friction]") {
  const Csv table("finger_with_friction.csv");
  const double EA = 200e9 * 0.025 * 0.001, EI = EA * 1e-6 / 12;
  const Rod strip(0.3, RodStiffness{EA, EI, EI, EI}, 0.001, RodSupport::clamped, RodSupport::free);
  Wire model(strip, 16);
  const Point shaft(0, 0, 0.04);
  double worst = 0;
  for (std::size_t row = 0; row < table.rows();) {
    const double mu = table.number(row, "mu"), x = table.number(row, "x_c");
    model.reset();
    Touch<Wire> touch(model, 0.005, mu);
    Point before(x, 0.006, -0.02);
    for (; row < table.rows() && table.number(row, "mu") == mu && table.number(row, "x_c") == x; ++row) {
      const Point to(x, table.number(row, "y_c"), -0.02);
      Felt r;
      move(touch, before, to, shaft, 40, [&](const Point&, const Felt& now) { check_friction(r = now, mu); });
      before = to;
      REQUIRE(r.status == Status::ok);
      const Point force(table.number(row, "force_x"), table.number(row, "force_y"), 0);
      worst = std::max(worst, (r.force - force).norm() / force.norm());
    }
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-5);
}

namespace {

/// Twice around a closed path, and once more.   @param path  t of period 1 -> place [m]   @return what the hand gives beyond what friction
/// takes and the wire stores, over what friction takes
template <class Path>
double unaccounted(Wire& model, const Friction& friction, const Path& path, int ticks) {
  model.reset();
  Touch<Wire> touch(model, 0.01, friction);
  Felt before = touch.tick(path(0.0));
  double given = 0, taken = 0, stored = 0;
  int unsettled = 0;
  for (int k = 1; k <= 3 * ticks; ++k) {
    const double t = double(k) / ticks;
    const Felt now = touch.tick(path(t));
    unsettled += now.status != Status::ok;
    check_friction(now, friction);
    given -= (now.force + before.force).dot(path(t) - path(t - 1.0 / ticks)) / 2;
    before = now;
    if (k == 2 * ticks) given = 0, taken = now.dissipated, stored = model.strain_energy();
  }
  taken = before.dissipated - taken;
  CAPTURE(friction.sticking, given, taken);
  // Not even where the hand turns back, and the direction of friction leaps.
  CHECK(unsettled == 0);
  CHECK(taken > 1e-4);
  return std::abs(given - taken - (model.strain_energy() - stored)) / taken;
}

}  // namespace

TEST_CASE("around a closed path on a wire friction takes the work, along it and aside", "[rod][friction]") {
  const auto circle = [](double x, double depth, double wide, double high, double aside) {
    return [=](double t) {
      const double a = 2 * pi * t, in = std::min(1.0, 4 * t);
      return Point(x + wide * std::sin(a) * in, 0.0112 - depth * in + high * std::cos(a) * in,
                   aside * std::cos(a) * in);
    };
  };
  Wire wire(needle(), 8);
  for (const double mu : {0.2, 0.6})
    CHECK(unaccounted(wire, mu, circle(0.15, 0.004, 0.002, 0, 0.002), 300) <= 1e-9);
  // Clamped at both ends, it stretches.  It shows its curvature beside the contact with more elements.
  Wire taut(Rod(0.3, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped), 32);
  CHECK(unaccounted(taut, 0.3, circle(0.12, 0.0022, 0.001, 0.0006, 0.001), 300) <= 1e-9);
  // Where the hand turns back it springs back as it begins to slide.
  CHECK(unaccounted(taut, {0.5, 0.3}, circle(0.12, 0.0022, 0.001, 0.0006, 0), 1200) <= 1e-9);
}

// Each sphere goes round a closed path of its own, and aside, so that it rolls on the wire.
TEST_CASE("two spheres on a wire give what friction takes at both", "[rod][friction][several]") {
  using Both = FemModel<Several<RoundRod, 2>>;
  const Rod rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  const double reach = 0.011;
  for (const bool below : {false, true})
    for (const double mu : {0.2, 0.8}) {
      Both model(rod, below == (mu > 0.5) ? 32 : 16);
      const RoundAvatar left(0.01, 1, mu), right(0.01, 1, 0.4);
      TouchSeveral touch(model, {left, right});
      const auto path = [&](double t, double down) {
        const double a = 2 * 3.14159265358979323846 * t, side = below ? -1 : 1;
        std::array<Point, 2> at;
        at[0] = Point(0.07 + 0.002 * std::sin(a), side * (reach - (below ? 1e-3 : 2.2e-3) * down),
                      0.002 * (1 - std::cos(a)));
        at[1] = Point(0.14 + 0.003 * (1 - std::cos(a)), reach - 2e-3 * down, 0.001 * std::sin(a));
        return at;
      };
      for (int k = 0; k <= 100; ++k) (void)touch.tick(path(0, k / 100.0).data(), 2);
      constexpr int ticks = 600;
      double given = 0, taken = 0, stored = 0;
      int otherwise = 0;
      auto before = touch.tick(path(0, 1).data(), 2);
      for (int k = 1; k <= 2 * ticks; ++k) {
        const auto from = path(double(k - 1) / ticks, 1), to = path(double(k) / ticks, 1);
        const auto now = touch.tick(to.data(), 2);
        for (std::size_t i : {0u, 1u}) {
          const auto &a = before.places[i], &b = now.places[i];
          const double normal = (b.force - b.friction).norm(), most = i == 0 ? mu : 0.4;
          otherwise += !b.touching || b.status != Status::ok || b.dissipated < a.dissipated ||
                       !(b.friction.norm() <= most * normal * (1 + 1e-12));
          given -= (a.force + b.force).dot(to[i] - from[i]) / 2;
          taken += b.dissipated - a.dissipated;
        }
        before = now;
        if (k == ticks) given = taken = 0, stored = model.strain_energy();
      }
      CAPTURE(below, mu, given, taken);
      CHECK(otherwise == 0);
      CHECK(taken > 1e-4);
      CHECK(std::abs(given - taken - (model.strain_energy() - stored)) <= 1e-8 * taken);  // and of the skins
    }
}

// A taut wire holds the friction of two spheres between them: where they go on in another direction than they came, both of it turn within a tick.
TEST_CASE("two spheres that turn off on a taut wire slide from the first tick on",
          "[rod][friction][several]") {
  using Both = FemModel<Several<RoundRod, 2>>;
  const Rod rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  for (int where = 0; where < 5; ++where) {
    Both model(rod, 16);
    TouchSeveral touch(model, {RoundAvatar(0.01, 1, 0.2), RoundAvatar(0.01, 1, 0.4)});
    for (int k = 0; k <= 120; ++k) {
      const double down = std::min(k, 100) / 100.0, gone = 2e-5 * std::max(0, k - 100);
      const std::array<Point, 2> at{Point(0.07 + 1e-5 * where + gone, 1e-3 * down - 0.011, 0),
                                    Point(0.14, 0.011 - 2e-3 * down, gone / 2)};
      const auto felt = touch.tick(at.data(), 2);
      CAPTURE(where, k);
      if (k > 0) CHECK(felt.status == Status::ok);
    }
  }
}

TEST_CASE("friction on a wire keeps its cone whatever the hand does", "[rod][friction]") {
  const Friction friction(0.5, 0.3);
  for (const double mu : {0.0, 1.0}) {
    Wire model(needle(), 8);
    const Friction rough(mu * friction.sticking, mu * friction.sliding);
    Touch<Wire> touch(model, 0.01, rough);
    Random random(4);
    Point hand(0.15, 0.02, 0), to = hand;
    int left = 0, answers = 0;
    Felt before;
    for (int k = 0; k < 6000; ++k) {
      if (left-- <= 0) {
        to = Point(0.15, 0.007, 0) + 0.01 * Point(random(1), random(1), random(1));
        left = random.integer(1, 300);
        if (random.integer(0, 30) == 0) hand = to;
      }
      hand += (to - hand) / (left + 1);
      const Felt r = touch.tick(hand);
      check_friction(r, rough);
      answers += is_answer(r.status);
      // Also where the touch goes on after a fall.
      if (before.pressing && r.pressing) REQUIRE(r.dissipated >= before.dissipated);
      before = r;
    }
    CAPTURE(mu);
    CHECK(answers > (mu > 0 ? 5980 : 5900));
  }
}

TEST_CASE("a hand that leans along a beam with friction comes to rest", "[rod][friction][loop]") {
  Random random(7);
  FemModel<Corotational<>> ruler(steel_ruler(), 8);
  Wire wire(needle(), 8);
  for (int i = 0; i < 24; ++i) {
    const Situation who = random_hand(random);
    const double mu = random(0.1, 1), aside = random(-1, 1) * who.push;
    CAPTURE(i, mu, aside, who.hand_stiffness, who.hand_damping, who.grip_mass, who.period, who.delay);
    CHECK(unrest(ruler, 0.12, Friction(mu, 0.7 * mu), who, {aside, 0, 0}) <= 1e-3);
    if (i % 4 == 0) CHECK(unrest(wire, 0.16, mu, who, {aside, 0, 0.2 * aside}) <= 1e-3);
  }
}

// Newton's method leaves more of the place and of the bound where a wire is bent: what it leaves is no reason to seek further.
TEST_CASE("a wire that is bent by nature answers a rough ball that presses it softly", "[rod][friction]") {
  constexpr double length = 0.15, thickness = 0.001, ball = 0.004;
  int ticks = 0, unanswered = 0;
  for (const double bend : {0.5, 1.0, 2.0})
    for (const double coefficient : {0.1, 0.3, 0.6}) {
      Random random(3);
      for (int stroke = 0; stroke < 6; ++stroke) {
        Rod rod(length, RodSection::circle(thickness), spring_steel, RodSupport::clamped, RodSupport::free);
        rod.naturally({{length, bend / length, bend / length, 0}});
        FemModel<TwistedRod> model(rod, 16);
        Touch<FemModel<TwistedRod>> touch(model, ball, Friction(coefficient));
        const auto on = model.shape().at(0.6 * length);
        const Point along = on.tangent.normalized(), any(random(1.0), random(1.0), random(1.0)),
                    to = (any - along * along.dot(any)).normalized();
        const double step = 1.5e-4 * random(0.1, 1.1);
        const int deep = static_cast<int>(0.002 / step);
        for (int k = 0; k <= 2 * deep; ++k, ++ticks) {
          const double way = step * (k <= deep ? k : 2 * deep - k);
          const auto felt = touch.tick(on.r + to * (way - ball - thickness / 2));
          unanswered += !is_answer(felt.status);
        }
      }
    }
  CAPTURE(ticks, unanswered);
  CHECK(ticks > 1500);
  CHECK(unanswered <= 0.02 * ticks);
}

TEST_CASE("a capsule that rubs along a rod between clamps does not lose it", "[stability][rod]") {
  Random random(7);
  const double length = 0.3;
  for (int stroke = 0; stroke < 40; ++stroke) {
    const double diameter = length / std::pow(10, random(1.7, 3)),
                 drawn = stroke % 2 == 0 ? 0. : std::pow(10, random(-5, -2)),
                 radius = length * random(0.01, 0.02), reach = radius + diameter / 2,
                 depth = length * random(0.012, 0.04), from = random(0.2, 0.8), to = random(0.2, 0.8);
    Rod rod(length, RodSection::circle(diameter), RodMaterial::isotropic(2e9, 0.3), RodSupport::clamped,
            RodSupport::clamped);
    rod.place_right({{length * (1 + drawn), 0, 0}, {1, 0, 0}, {0, 1, 0}});
    Wire model(rod, random.integer(8, 20));
    Touch<Wire> touch(model, radius, Friction(stroke % 4 < 2 ? 0.2 : 0.5));
    CAPTURE(stroke, length / diameter, drawn, from, to);
    for (int k = 0; k <= 400; ++k) {
      const double down = std::min(k / 100., 1.), along = std::clamp((k - 100) / 200., 0., 1.),
                   back = std::max((k - 300) / 100., 0.);
      const double x = length * (from + (to - from) * (along - back)), y = reach + 3e-5 - down * depth;
      const auto felt = touch.tick(Point(x, y, -0.5), Point(0, 0, 1));
      CAPTURE(k);
      REQUIRE(felt.status == Status::ok);
      REQUIRE(felt.pressing == (y < reach));
      REQUIRE(felt.force.y() >= 0);
    }
  }
}
