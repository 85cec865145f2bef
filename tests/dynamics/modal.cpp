// A beam with mass as its modes: their frequencies, exact parts, a hand that rests, strikes and goes to and fro, and what it refuses.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/haptics/servo/sound.hpp>
#include <hapbeam/rom/training/modes.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

static_assert(has_mass<ModalModel<>>);

const Material steel{200e9, 7850};
Beam ruler(const Material& material = steel) {
  return {0.3, Section::rectangle(0.025, 0.001), material, Support::clamped, Support::free};
}

}  // namespace

TEST_CASE("modes of all beams that are held have the frequencies of the closed forms", "[dynamics]") {
  const Csv table("modes.csv");
  struct Ends {
    const char* name;
    Support left, right;
  };
  for (const Ends& ends : {Ends{"pinned-pinned", Support::pinned, Support::roller},
                           {"clamped-free", Support::clamped, Support::free},
                           {"clamped-clamped", Support::clamped, Support::clamped},
                           {"clamped-pinned", Support::clamped, Support::roller}}) {
    const Beam beam(0.3, Section::rectangle(0.025, 0.001), steel, ends.left, ends.right);
    const double unit = std::sqrt(beam.bending_stiffness() / beam.mass_per_length(0)) / 0.09;
    const Modes modes = modes_of(beam, 4);
    int found = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const int mode = static_cast<int>(table.number(row, "mode"));
      if (table.text(row, "support") != ends.name || mode > 4) continue;
      CAPTURE(ends.name, mode);
      // Of fourth order: with 8 elements mode 4 is 7e-3 too high.
      CHECK(modes.frequencies[mode - 1] / unit ==
            Approx(table.number(row, "omega_over_sqrt(EI/rhoA)/L2")).epsilon(7e-3 / 4096));
      ++found;
    }
    CHECK(found == 4);
  }
}

TEST_CASE("the partials of a tuned string are exact, whatever the parts", "[dynamics]") {
  const Csv exact("string_E4.csv");
  const double tension = 72.59131923866309, diameter = 0.000254,
               strain = tension / (200e9 * pi * diameter * diameter / 4);
  // Between 652.6 mm of the same mass, drawn to 648 mm times 1 + ε.
  const Beam string = tensioned(Beam(0.648 / (1 + strain), Section::circle(diameter),
                                     Material{200e9, 7850 * (1 + strain)}, Support::pinned, Support::pinned),
                                tension);
  const Modes modes = modes_of(string, 10);
  for (std::size_t row = 0; row < 10; ++row) {
    const double cents = 1200 * std::log2(modes.frequencies[static_cast<Eigen::Index>(row)] / (2 * pi) /
                                          exact.number(row, "pinned_Hz"));
    CAPTURE(row + 1, cents);
    CHECK(std::abs(cents) <= 0.02);
  }
  ModalModel<> coarse(modes, 1), fine(modes, 48);
  for (ModalModel<>* model : {&coarse, &fine}) model->let_go_of(0.12, {0, 0.5});
  const double energy = coarse.energy().sum();
  CHECK(coarse.shape().position(0.12).y() == fine.shape().position(0.12).y());
  for (int k = 0; k < 1000; ++k) REQUIRE((coarse.step(1e-3) == Status::ok && fine.step(1e-3) == Status::ok));
  for (const double s : {0.1, 0.3, 0.5})
    CHECK((coarse.velocity(s) - fine.velocity(s)).norm() <=
          1e-9 * std::sqrt(energy / (string.mass_per_length(0) * 0.648)));
  CHECK(coarse.energy().sum() == Approx(energy).epsilon(1e-10));
}

TEST_CASE("modes fade as their damping says", "[dynamics]") {
  Material material{200e9, 7850, Damping::ratio(0.01, 9.0598)};
  material.damping.drag = 2;
  const Modes modes = modes_of(ruler(material), 3);
  for (int i = 0; i < 3; ++i) {
    const double w = modes.frequencies[i];
    CHECK(modes.decays[i] == Approx(1 + 0.01 * w * w / (2 * pi * 9.0598)).epsilon(1e-9));
  }
  ModalModel<> model(modes, 1);
  model.let_go_of(0.3, {0, 0.01});
  const double begin = model.energy().sum();
  for (int k = 0; k < 3000; ++k) {
    const double before = model.energy().sum();
    REQUIRE(model.step(1e-3) == Status::ok);
    REQUIRE(model.energy().sum() <= before);
  }
  CHECK(std::log(begin / model.energy().sum()) / (2 * 3) == Approx(modes.decays[0]).epsilon(0.01));
}

// What modes lack of a place is there without mass: with three of them it is as soft as the beam.
TEST_CASE("a hand that rests feels the force of the beam, however few modes there are", "[dynamics]") {
  Material damped = steel;
  damped.damping.drag = 60;
  const double stiffness = 3500, deep = 1e-6;
  for (const int count : {1, 3, 10})
    for (const double s : {0.05, 0.2, 0.29}) {
      ModalModel<> model(modes_of(ruler(damped), count), 1);
      Pushed<double> felt{};
      for (int k = 0; k < 3000; ++k)
        felt =
            model.step(1e-3, {{s, {s, 0.0055 - deep * std::min(1.0, k / 1000.0)}, 0.0055, 1}, stiffness, 2});
      REQUIRE(felt.status == Status::ok);
      const double k = 3 * ruler().bending_stiffness() / (s * s * s);
      CAPTURE(count, s);
      CHECK(-felt.force == Approx(deep / (1 / k + 1 / stiffness)).epsilon(1e-5));
    }
}

// The force of a part is that of its end: of first order.
TEST_CASE("a body that strikes a ruler feels what many modes give", "[dynamics]") {
  const Csv exact("struck.csv");
  double peak = 0, impulse = 0;
  for (std::size_t k = 0; k + 1 < exact.rows(); ++k) {
    peak = std::max(peak, exact.number(k, "force"));
    impulse += (exact.number(k + 1, "t") - exact.number(k, "t")) *
               (exact.number(k, "force") + exact.number(k + 1, "force")) / 2;
  }
  const Modes modes = modes_of(ruler(), 40);
  double before[2] = {1, 1};
  for (const double h : {2e-5, 1e-5}) {
    ModalModel<> model(modes, 1);
    double y = 0.0055, v = -0.1, most = 0, sum = 0;
    for (double t = 0; t < exact.number(exact.rows() - 1, "t"); t += h) {
      y += h * v;
      const auto felt = model.step(h, {{0.24, {0.24, y}, 0.0055, 1}, 20000, 0});
      v -= h * felt.force / 0.02;
      most = std::max(most, -felt.force), sum -= h * felt.force;
    }
    const double off[2] = {std::abs(most / peak - 1), std::abs(sum / impulse - 1)};
    CAPTURE(h, off[0], off[1]);
    CHECK(off[0] <= 0.01);
    CHECK(off[1] <= 0.003);
    for (int k = 0; k < 2; ++k) {
      CHECK(off[k] <= 0.7 * before[k]);
      before[k] = off[k];
    }
  }
}

// By the force at the end of each step, which pushes for all of it, a hand gives at least what the modes and its spring have then.
TEST_CASE("a hand that goes to and fro across modes takes no energy from them", "[dynamics]") {
  Random random(3);
  int touched = 0;
  for (int trial = 0; trial < 60; ++trial) {
    ModalModel<> model(modes_of(ruler(), random.integer(1, 12), 16), 1);
    const double K = std::pow(10, random(2, 6)), B = random(0, 3), size = std::pow(10, random(-6, -3)),
                 s = random(0.05, 0.3);
    double given = 0, before = 0.01, scale = 0;
    REQUIRE(model.step(1e-3, {{s, {s, before}, 0.0055, 1}, K, B}).force == 0);
    for (int k = 0; k < 2000; ++k) {
      const double y = 0.0055 + size * (std::sin(0.3 * k) + random(1));
      const auto felt = model.step(1e-3, {{s, {s, y}, 0.0055, 1}, K, B});
      REQUIRE(felt.status == Status::ok);
      given += felt.force * (y - before), before = y;
      const double bent = felt.force < 0 ? felt.point.y() + 0.0055 - y : 0,
                   has = model.energy().sum() + K * bent * bent / 2;
      scale = std::max(scale, has), touched += felt.force < 0;
      CAPTURE(trial, k, given, has);
      REQUIRE(given >= has - 1e-9 * scale);
    }
  }
  CHECK(touched > 10000);
}

TEST_CASE("a hand that comes back meets the beam as at first", "[dynamics]") {
  Material damped = steel;
  damped.damping.drag = 60;
  ModalModel<> model(modes_of(ruler(damped), 6), 1);
  const auto stroke = [&] {
    double sum = 0;
    for (int k = 0; k < 2000; ++k) {
      const double y = k < 200 ? 0.007 - 1e-5 * k : 0.01;
      sum -= model.step(1e-3, {{0.2, {0.2, y}, 0.0055, 1}, 1000, 20}).force;
    }
    return sum;
  };
  const double first = stroke();
  CHECK(first > 0);
  CHECK(stroke() == Approx(first).epsilon(1e-6));
}

TEST_CASE("modes are felt and heard as a model with mass", "[dynamics]") {
  ModalModel<> model(modes_of(ruler(), 8), 48);
  Touch<ModalModel<>> touch(model, 0.005);
  Sound<ModalModel<>> sound(model, {SoundSource::velocity, 0.3});
  TouchResult<double> felt;
  for (int k = 0; k < 400; ++k) felt = touch.tick({0.28, 0.0055 - 1e-5 * std::min(k, 200)}, 1e-3, 3500, 2);
  CHECK(felt.status == Status::ok);
  CHECK(felt.force.y() > 0.1);
  for (int k = 0; k < 100; ++k) felt = touch.tick({0.28, 0.05}, 1e-3, 3500, 2);
  CHECK_FALSE(felt.pressing);
  CHECK(sound.waiting() > 23000);
  std::vector<float> samples(sound.waiting());
  CHECK(sound.read(samples.data(), static_cast<int>(samples.size())) == static_cast<int>(samples.size()));
  // It rings when it is let go: upward first, and 9 times a second.
  CHECK(*std::max_element(samples.end() - 4000, samples.end()) > 0.01F);
  // What holds it at rest takes its weight.
  Beam heavy = ruler();
  heavy.weight(7850, {0, -9.81});
  const ModalModel<> hangs(modes_of(heavy, 4));
  CHECK(hangs.reaction(0).y() == Approx(0.3 * 9.81 * heavy.mass_per_length(0)).epsilon(1e-6));
}

TEST_CASE("what has no modes says why", "[dynamics]") {
  CHECK_THROWS_WITH(modes_of(ruler(Material{200e9}), 4), Catch::Matchers::ContainsSubstring("density"));
  CHECK_THROWS_WITH(modes_of(ruler(), 0), Catch::Matchers::ContainsSubstring("modes = 0"));
  CHECK_THROWS_WITH(
      modes_of(Beam(0.3, Section::rectangle(0.025, 0.001), steel, Support::free, Support::free), 4),
      Catch::Matchers::ContainsSubstring("free"));
  Material creeps = steel;
  creeps.damping.branches[0] = {0.5, 0.1};
  CHECK_THROWS_WITH(modes_of(ruler(creeps), 4), Catch::Matchers::ContainsSubstring("relaxation share"));
  CHECK_THROWS_WITH(modes_of(ruler({200e9, 7850, Damping::ratio(0.5, 9)}), 4),
                    Catch::Matchers::ContainsSubstring("overdamped"));
  CHECK_THROWS_WITH(ModalModel<>(modes_of(ruler(), 2), 0), Catch::Matchers::ContainsSubstring("parts = 0"));
  ModalModel<> model(modes_of(ruler(), 2));
  CHECK(model.step(-1) == Status::invalid_request);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(model.step(1e-3, {{0.2, {0.2, nan}, 0.005, 1}, 1000, 0}).status == Status::invalid_request);
  FrictionState<double, 2> rough;
  rough.sticking = 0.5;
  CHECK(model.step(1e-3, {{0.2, {0.2, 0.004}, 0.005, 1}, 1000, 0, &rough}).status == Status::invalid_request);
  CHECK(model.energy().sum() == 0);
}
