// Sound: every sample where it belongs, in order, counted where it is missed; and a string that sounds as it is tuned.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstdint>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/servo/sound.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// What moves as a sine, in parts that differ.
struct Sine {
  using Scalar = double;
  using Listener = void (*)(void*, const Sine&, double) noexcept;
  double omega, time = 0;
  void* who = nullptr;
  Listener listener = nullptr;

  void listen(void* w, Listener l) noexcept { who = w, listener = l; }
  Vector2<double> velocity(double) const noexcept { return {0, std::sin(omega * time)}; }
  Vector3<double> reaction(int k) const noexcept { return {0, k == 0 ? 2.0 : -3.0, 0}; }
  Centreline<double> shape() const noexcept { return {nodes, 2, true}; }
  void go(double part) {
    time += part;
    if (listener) listener(who, *this, part);
  }
  CentrelineNode<double> nodes[2] = {{0, 0, 0, 0}, {1, 0, 0, 0}};
};

std::vector<float> all(Sound<Sine>& sound) {
  std::vector<float> samples(100000);
  samples.resize(static_cast<std::size_t>(sound.read(samples.data(), 100000)));
  return samples;
}

/// Size of a windowed partial [1/Hann].
double size_at(const std::vector<float>& samples, double rate, double frequency) {
  std::complex<double> sum = 0;
  const auto n = static_cast<double>(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double t = static_cast<double>(k);
    sum +=
        (1 - std::cos(2 * pi * (t + 0.5) / n)) * samples[k] * std::polar(1.0, -2 * pi * frequency * t / rate);
  }
  return std::abs(sum) / n;
}
/// The highest place of the spectrum within half a percent of a frequency, by golden section [Hz].
double partial(const std::vector<float>& samples, double rate, double about) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = 0.995 * about, b = 1.005 * about;
  while (b - a > 1e-5 * about) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    (size_at(samples, rate, c) > size_at(samples, rate, d) ? b : a) =
        size_at(samples, rate, c) > size_at(samples, rate, d) ? d : c;
  }
  return (a + b) / 2;
}

}  // namespace

TEST_CASE("samples lie on the motion whatever the parts, as near as a cubic through them", "[sound]") {
  const double omega = 2 * pi * 3000;
  for (const double rate : {44100.0, 48000.0})
    for (const double spread : {0.0, 0.3}) {
      Sine sine{omega};
      Sound sound(sine, {SoundSource::velocity, 0.5, rate});
      Random random(1);
      double longest = 0;
      for (int k = 0; k < 20000; ++k) {
        const double part = (1 + random(-spread, spread)) / 48000;
        longest = std::max(longest, part);
        sine.go(part);
      }
      const auto samples = all(sound);
      CHECK(samples.size() == Approx(sine.time * rate).margin(3));
      // |x''''| h⁴ 9/(16 · 24): of three pieces of h, a place in the middle one.  The first two see silence before the beginning.
      const double most = std::pow(omega * longest, 4) * 9 / (16 * 24) + 1e-7;
      // Time begins one sample before the end of a part that is as long as one.
      double off = 0;
      for (std::size_t k = 8; k < samples.size(); ++k)
        off = std::max(off, std::abs(samples[k] - std::sin(omega * (double(k) + 1) / rate)));
      CAPTURE(rate, spread, off, most);
      CHECK(off <= most);
      CHECK(sound.lost() == 0);
    }
}

TEST_CASE("samples that are late or too many are counted", "[sound]") {
  Sine sine{1000};
  Sound sound(sine, {SoundSource::velocity, 0, 48000, 100 / 48000.0});
  float out[200];
  CHECK(sound.read(out, 10) == 0);
  CHECK(sound.missed() == 10);
  CHECK(std::all_of(out, out + 10, [](float x) { return x == 0; }));
  for (int k = 0; k < 301; ++k) sine.go(1.0 / 48000);
  const auto heard = static_cast<int>(100 + sound.lost());
  CHECK((heard >= 299 && heard <= 301));
  CHECK(sound.read(out, 200) == 100);
  CHECK(sound.missed() == 110);
  CHECK(out[99] != 0);
  CHECK(out[100] == 0);
  CHECK(sound.read(out, -3) == 0);
}

TEST_CASE("a support is heard by the force on it, and what is no sound is rejected", "[sound]") {
  Sine sine{0};
  for (const auto source : {SoundSource::left_support, SoundSource::right_support}) {
    Sound sound(sine, {source});
    for (int k = 0; k < 10; ++k) sine.go(1.0 / 48000);
    CHECK(all(sound).back() == (source == SoundSource::left_support ? -2 : 3));
  }
  CHECK(sine.listener == nullptr);  // one that is gone hears nothing
  const auto rejects = [&](const SoundOptions& options, const char* field) {
    CHECK_THROWS_WITH(Sound<Sine>(sine, options), Catch::Matchers::ContainsSubstring(field));
  };
  const double nan = std::nan("");
  for (const double place : {-0.1, 1.1, nan}) rejects({SoundSource::velocity, place}, "place");
  for (const double rate : {0.0, 2e6, nan}) rejects({SoundSource::velocity, 0, rate}, "rate");
  for (const double room : {0.0, 1e-5, 3601.0, nan}) rejects({SoundSource::velocity, 0, 48000, room}, "room");
  CHECK_THROWS_WITH(Ring<int>(0), Catch::Matchers::ContainsSubstring("room"));
}

TEST_CASE("a ring hands over each value once, in order, or counts it", "[sound][thread]") {
  Ring<std::uint64_t> ring(64);
  std::atomic<bool> enough{false};
  std::uint64_t added = 0, last = 0, taken = 0, disorder = 0;
  std::thread writer([&] {
    while (!enough) ring.add(++added);
  });
  const auto take = [&] {
    taken += ring.take([&](std::uint64_t k) {
      disorder += k <= last;
      last = k;
    });
  };
  while (taken < 200000) take();
  enough = true;
  writer.join();
  take();
  CHECK(disorder == 0);
  CHECK(taken + ring.lost() == added);
  CHECK(ring.take([](std::uint64_t) {}) == 0);
}

// 0.254 mm of steel, tuned to 648 mm and 72.6 N, plucked by a tenth of a millimetre: its tension changes by 1e-5 of itself, 0.02 cents.
TEST_CASE("a plucked string is heard with its partials, by a pickup and on the bridge", "[sound]") {
  const Csv exact("string_E4.csv");
  const double tension = 72.59131923866309, young = 200e9, diameter = 0.000254,
               stretch = 1 + tension / (young * pi * diameter * diameter / 4);
  // As heavy a metre, when it is stretched.
  const Beam slack(0.648 / stretch, Section::circle(diameter), Material{young, 7850 * stretch},
                   Support::pinned, Support::pinned);
  const Beam string = tensioned(slack, tension);
  const double L = string.length();
  Beam plucked = string;
  const double at = 0.13 * L, depth = 1e-4, pull = tension * depth * (1 / at + 1 / (L - at));
  plucked.add(PointLoad{at, 0, pull, 0});
  const FemModel<Corotational<>> start(plucked, 16);
  // At 48 kHz the tenth is 13 cents low: 192 parts of each millisecond.
  for (const auto source : {SoundSource::velocity, SoundSource::right_support}) {
    DynamicModel<> model(string, 16, 192);
    model.let_go_from(start.shape());
    Sound sound(model, {source, 0.17 * L});
    for (int k = 0; k < 250; ++k) REQUIRE(model.step(1e-3) == Status::ok);
    std::vector<float> samples(12000);
    REQUIRE(sound.read(samples.data(), 12000) >= 11998);
    samples.resize(11998);
    for (std::size_t row = 0; row < 10; ++row) {
      const double frequency = exact.number(row, "pinned_Hz"),
                   cents = 1200 * std::log2(partial(samples, 48000, frequency) / frequency);
      CAPTURE(row + 1, cents);
      CHECK(std::abs(cents) <= 1.5);
    }
  }
}

TEST_CASE("a string in space sounds as the one in its plane", "[sound]") {
  const double length = 0.648, d = 0.000254, longer = 1.007, density = 7850 * longer;
  const Beam slack(length / longer, Section::circle(d), Material{200e9, density}, Support::pinned,
                   Support::pinned);
  Rod rod(length / longer, RodSection::circle(d), RodMaterial::isotropic(200e9, 0.3, density),
          RodSupport::hinged, RodSupport::hinged);
  rod.place_right({{length, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const int n = 16;
  DynamicModel<> planar(stretched(slack, length - length / longer), n, 48);
  DynamicModel<RoundRod> space(rod, n, 48);
  std::vector<CentrelineNode<double>> flat;
  std::vector<RodNode<double>> nodes;
  for (int i = 0; i <= n; ++i) {
    const double x = length * i / n, s = x / longer, wave = 3 * pi / length, size = 1e-4;
    const double slope = size * wave * std::cos(wave * x), w = size * std::sin(wave * x);
    flat.push_back({s, x - s, w, -std::atan(slope)});
    nodes.push_back({s, {x, w, 0}, longer * Vector3<double>(1, slope, 0), {0, 0, 1}});
  }
  for (const SoundSource source :
       {SoundSource::velocity, SoundSource::left_support, SoundSource::right_support}) {
    planar.let_go_from({flat.data(), n + 1, true}), space.let_go_from({nodes.data(), n + 1});
    Sound<DynamicModel<>> there(planar, {source, 0.1});
    Sound<DynamicModel<RoundRod>> here(space, {source, 0.1});
    for (int k = 0; k < 10; ++k) {
      REQUIRE(planar.step(1e-3) == Status::ok);
      REQUIRE(space.step(1e-3) == Status::ok);
    }
    float a[470], b[470];
    REQUIRE(there.read(a, 470) == 470);
    REQUIRE(here.read(b, 470) == 470);
    float loudest = 0, off = 0;
    for (int k = 0; k < 470; ++k)
      loudest = std::max(loudest, std::abs(a[k])), off = std::max(off, std::abs(a[k] - b[k]));
    CAPTURE(static_cast<int>(source), loudest, off);
    CHECK(loudest > 0.1F);
    CHECK(off <= 2e-3F * loudest);
  }
}

TEST_CASE("both supports give what the momentum of the beam changes by", "[sound]") {
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850, Damping::ratio(0.01, 20)},
                  Support::pinned, Support::roller);
  Beam pressed = beam;
  pressed.add(PointLoad{0.1, 0, -1, 0});
  DynamicModel<> model(beam, 2, 1);  // so that the elements at the ends have nearly all of the mass
  model.let_go_from(FemModel<Corotational<>>(pressed, 2).shape());
  const auto momentum = [&] {  // Simpson's rule is exact for a cubic
    double sum = 0;
    for (const double from : {0.0, 0.15})
      sum +=
          0.15 / 6 *
          (model.velocity(from).y() + 4 * model.velocity(from + 0.075).y() + model.velocity(from + 0.15).y());
    return sum * beam.mass_per_length(0);
  };
  const auto force = [&] { return model.reaction(0).y() + model.reaction(1).y(); };
  constexpr double dt = 2e-6;
  REQUIRE(model.step(dt) == Status::ok);
  double largest = 0, off = 0;
  for (int k = 0; k < 5000; ++k) {
    const double before = momentum(), f = force();
    REQUIRE(model.step(dt) == Status::ok);
    off = std::max(off, std::abs((momentum() - before) / dt - (f + force()) / 2));
    largest = std::max(largest, std::abs(f));
  }
  CAPTURE(off, largest);
  CHECK(largest > 0.3);
  CHECK(off <= 2e-3 * largest);
}

TEST_CASE("supports hold what acts on a beam that is held still", "[sound]") {
  Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850, Damping::air(1, 40)},
            Support::clamped, Support::clamped);
  constexpr double pull = 0.1;  // [N]
  beam.add(PointLoad{0.12, 0, -pull, 0});
  DynamicModel<> model(beam, 8);
  const auto check = [&](double left, double right, double e) {
    CAPTURE(model.reaction(0).transpose(), model.reaction(1).transpose());
    CHECK(model.reaction(0).y() == Approx(left).epsilon(e));
    CHECK(model.reaction(1).y() == Approx(right).epsilon(e));
  };
  // b²(3a + b)/L³
  check(0.648 * pull, 0.352 * pull, 1e-4);
  const double before = model.reaction(0).y();
  // A hand that presses within the element at the left end: what both supports hold is what it gives, and the load.
  Pushed<double> felt{0, Status::ok};
  for (int k = 0; k < 3000; ++k) felt = model.step(1e-3, {{0.02, {0.02, 0.0}, 0.005, 1}, 1000, 2});
  CHECK(felt.force < -1e-3);
  CHECK(model.reaction(0).y() > before);
  CHECK(model.reaction(0).y() + model.reaction(1).y() ==
        Approx(pull - felt.force * felt.normal.y()).epsilon(1e-6));
}
