// Beams whose section changes along them, against closed forms, and the laws of every planar model.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pressed.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double taper_length = 0.4, taper_young = 2e9, taper_width = 0.01;

Section taper_section(double height) { return Section::rectangle(taper_width, height); }
double taper_height(double s) { return 0.008 - 0.005 * s / taper_length; }

/// Clamped, 8 mm high there and 3 mm at the free end.
Beam wedge(Support right = Support::free) {
  return Beam(taper_length, taper_section(0.008), Material{taper_young}, Support::clamped, right)
      .section([](double s) { return taper_section(taper_height(s)); });
}
/// Steps from 8 to 4 mm at so much of its length.
Beam stepped(double at) {
  return Beam(taper_length, taper_section(0.008), Material{taper_young}, Support::clamped, Support::free)
      .sections({{at * taper_length, taper_section(0.008)}, {taper_length, taper_section(0.004)}});
}

/// Tip force per displacement of a wedge, ∫(L - s)²/EI ds in closed form: with h = h1 + c(L - s) and z = L - s,
/// ∫z²/h³ dz = (ln(h0/h1) + 2h1/h0 - h1²/2h0² - 3/2)/c³.
double wedge_stiffness() {
  const double h0 = taper_height(0), h1 = taper_height(taper_length), c = (h0 - h1) / taper_length,
               q = h1 / h0;
  const double integral = (std::log(1 / q) + 2 * q - q * q / 2 - 1.5) / (c * c * c);
  return taper_young * taper_width / 12 / integral;
}

}  // namespace

TEST_CASE("a wedge bends as its closed form says, with an error of sixth order", "[taper]") {
  // That of three Gauss points, for the mean of ξ²/EI.
  const double exact = wedge_stiffness(), d = 1e-7;
  const auto error = [&](int elements) {
    return std::abs(pressed<FemModel<Tapered<>>>(wedge(), elements, taper_length, d) / d / exact - 1);
  };
  const double e2 = error(2), e4 = error(4), e8 = error(8);
  INFO("errors " << e2 << ", " << e4 << ", " << e8);
  CHECK(e2 <= 1e-3);
  CHECK(std::log2(e2 / e4) >= 4.5);
  CHECK(e8 <= 1e-6);
}

TEST_CASE("a step of the section is exact wherever it stands", "[taper]") {
  for (const double at : {0.5, 0.43, 0.77}) {
    const auto cubed = [](double x) { return x * x * x; };
    const double EI0 = taper_young * taper_section(0.008).inertia,
                 EI1 = taper_young * taper_section(0.004).inertia, thin = (1 - at) * taper_length;
    const double exact = 1 / ((cubed(taper_length) - cubed(thin)) / (3 * EI0) + cubed(thin) / (3 * EI1));
    for (const int elements : {2, 5, 8}) {
      const double error = std::abs(
          pressed<FemModel<Tapered<Linear>>>(stepped(at), elements, taper_length, 1e-5) / 1e-5 / exact - 1);
      INFO("step at " << at << ", " << elements << " elements: " << error);
      CHECK(error <= 1e-9);
    }
  }
}

TEST_CASE("a beam of two materials bends as its parts do", "[taper]") {
  const Section section = taper_section(0.008);
  const Beam beam =
      Beam(taper_length, section, Material{taper_young}, Support::clamped, Support::free)
          .sections({{0.25 * taper_length, section}, {taper_length, section, Material{taper_young / 10}}});
  const double soft = std::pow(0.75 * taper_length, 3), EI = taper_young * section.inertia,
               exact = 1 / ((std::pow(taper_length, 3) - soft) / (3 * EI) + soft / (0.3 * EI));
  for (const int elements : {2, 5})
    CHECK(std::abs(pressed<FemModel<Tapered<Linear>>>(beam, elements, taper_length, 1e-5) / 1e-5 / exact -
                   1) <= 1e-9);
}

TEST_CASE("a stepped beam sags under its own weight as its closed form says", "[taper]") {
  // M(L - s)/EI, integrated over the thin part of length l and the thick one of length a.
  const double density = 1200, g = 9.81;
  for (const double at : {0.5, 0.43, 0.77}) {
    const Section thick = taper_section(0.008), thin = taper_section(0.004);
    const double a = at * taper_length, l = taper_length - a, q = density * g * thick.area,
                 p = density * g * thin.area;
    const double sag =
        p * l * l * l * l / (8 * taper_young * thin.inertia) +
        (p * l * (a * a * a / 3 + 0.75 * l * a * a + l * l * a / 2) + q * a * a * a * (l / 6 + a / 8)) /
            (taper_young * thick.inertia);
    const FemModel<Tapered<Linear>> model(stepped(at).weight(density, {0, -g}), 5);
    CHECK(model.shape().at(taper_length).w == Approx(-sag).epsilon(1e-9));
  }
}

TEST_CASE(
    "a triangular leaf sags under its own weight as its closed form says, with an error of fourth order",
    "[taper]") {
  // At z from its point M = ρgbh z³/6L and EI = Ebh³ z/12L, hence w'' = -2ρg z²/Eh².
  const double density = 1200, g = 9.81, h = 0.004, L = taper_length;
  Beam leaf(L, taper_section(h), Material{taper_young}, Support::clamped, Support::free);
  leaf.weight(density, {0, -g}).section([=](double s) {
    return Section::rectangle(taper_width * (1 - s / L), h);
  });
  const auto sag = [=](double s) {
    return density * g * (std::pow(L - s, 4) - std::pow(L, 4) + 4 * std::pow(L, 3) * s) /
           (6 * taper_young * h * h);
  };
  const auto error = [&](int elements) {
    const FemModel<Tapered<Linear>> model(leaf, elements);
    double largest = 0;
    for (const auto& node : model.shape()) largest = std::max(largest, std::abs(node.w + sag(node.s)));
    return largest / sag(L);
  };
  const double e8 = error(8), e16 = error(16), e32 = error(32);
  INFO("errors " << e8 << ", " << e16 << ", " << e32);
  CHECK(e32 <= 1e-7);
  CHECK(observed_order(e8, e16) >= 3.8);
  CHECK(observed_order(e16, e32) >= 3.8);
}

TEST_CASE("a tapered beam that bends far is of fourth order", "[taper]") {
  using Model = FemModel<Corotational<Tapered<>>>;
  for (const Support right : {Support::free, Support::pinned}) {
    const double s = right == Support::free ? taper_length : 0.6 * taper_length,
                 d = right == Support::free ? 0.1 : 0.03;
    const double finest = pressed<Model>(wedge(right), 256, s, d);
    const auto error = [&](int elements) {
      return std::abs(pressed<Model>(wedge(right), elements, s, d) / finest - 1);
    };
    // Between held ends its tension bends it within the elements.
    const int n = right == Support::free ? 16 : 32;
    const double coarse = error(n), fine = error(2 * n);
    INFO("errors " << coarse << ", " << fine);
    CHECK(std::log2(coarse / fine) >= 3.6);
    CHECK(error(16) <= 0.5 / (16 * 16));  // of any press that is accepted
  }
}

TEST_CASE("the force of a tapered beam is the slope of its energy", "[taper]") {
  FemModel<Corotational<Tapered<>>> model(wedge(Support::pinned), 16);
  const double s = 0.45 * taper_length, h = 1e-6;
  for (const double d : {1e-3, 0.01, 0.03, -0.02}) {
    const auto energy = [&](double depth) {
      CHECK(model.press({s, depth}).status == Status::ok);
      return model.strain_energy();
    };
    const double slope = (energy(d + h) - energy(d - h)) / (2 * h);
    CHECK(std::abs(model.press({s, d}).force / slope - 1) <= 1e-6);
  }
}

TEST_CASE("one section given along the beam is the prismatic beam", "[taper]") {
  const Beam plain(taper_length, taper_section(0.005), Material{taper_young}, Support::clamped,
                   Support::pinned);
  Beam given = plain;
  given.section([](double) { return taper_section(0.005); });
  const double expected = pressed<FemModel<Corotational<VonKarman<AssumedStrain>>>>(plain, 8, 0.2, 0.02);
  CHECK(std::abs(pressed<FemModel<Corotational<Tapered<>>>>(given, 8, 0.2, 0.02) / expected - 1) <= 1e-9);
  CHECK(std::abs(pressed<FemModel<Corotational<Tapered<>>>>(plain, 8, 0.2, 0.02) / expected - 1) <= 1e-9);
}

TEST_CASE("a beam whose section changes is rejected where it would be ignored", "[taper]") {
  CHECK_THROWS_WITH(FemModel<>(wedge(), 8), Catch::Matchers::ContainsSubstring("beam sections"));
  CHECK_THROWS_WITH(FemModel<Corotational<>>(wedge(), 8),
                    Catch::Matchers::ContainsSubstring("beam sections"));
  const Beam unknown(taper_length, 1, 1, 0.01, Support::clamped, Support::free);
  CHECK_THROWS_WITH(Beam(unknown).section([](double) { return taper_section(0.01); }),
                    Catch::Matchers::ContainsSubstring("young"));
  CHECK_THROWS_WITH(wedge().sections({{taper_length / 2, taper_section(0.01)}}),
                    Catch::Matchers::ContainsSubstring("part end"));
}
