// The mass of an element, by the modes of straight beams, by the partials of a string, and by a swing that no linear mode has.
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/eigenvalues.hpp"
#include "support/first_mode_swing.hpp"
#include "support/pi.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/dynamic_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Element = Corotational<VonKarman<AssumedStrain>>;
static_assert(std::is_same_v<DynamicModel<>, DynamicModel<Element>>);

/// Circular frequencies of bending alone [1/s].   @param strain  along it, of the same tension everywhere   @param held  of w and θ at both ends
std::vector<double> frequencies(const Beam& beam, int n, const std::array<bool, 4>& held, double strain = 0) {
  const double l = beam.length() / n;
  detail::Inertia<double, Eigen::Dynamic, Eigen::Dynamic> inertia(beam, n, [l](int i) { return l * i; });
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  const ElementProperties<double> p(l, beam.axial_stiffness(), beam.bending_stiffness());
  detail::PerNode<CentrelineNode<double>, Eigen::Dynamic, Eigen::Dynamic> nodes(n);
  for (int i = 0; i <= n; ++i) nodes[i] = {l * i, strain * l * i, 0, 0};
  inertia.draw(nodes);
  for (int i = 0; i <= n; ++i) inertia.ghost()[i] = detail::placed(nodes[i]);
  CHECK(inertia.look(nodes) == 0);
  Vector6<double> drawn = Vector6<double>::Zero();
  drawn[3] = strain * l;
  for (int e = 0; e < n; ++e) {
    Vector6<double> r;
    Matrix6<double> k;
    (void)Element::tangent(p, drawn, r, k);
    const int of[4] = {1, 2, 4, 5};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) K(2 * e + i, 2 * e + j) += k(of[i], of[j]);
  }
  std::vector<int> across;
  for (int i = 0; i < 2 * n + 2; ++i) across.push_back(i / 2 * 3 + 1 + i % 2);
  const Eigen::MatrixXd M = inertia.matrix()(across, across);
  std::vector<int> free;
  for (int i = 0; i < 2 * n + 2; ++i) {
    const int end = i < 2 ? i : i - 2 * n + 2;
    if (!(end >= 0 && end < 4 && (i < 2 || i >= 2 * n) && held[static_cast<std::size_t>(end)]))
      free.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd k(size, size), m(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) {
      const int row = free[static_cast<std::size_t>(i)], column = free[static_cast<std::size_t>(j)];
      k(i, j) = K(row, column), m(i, j) = M(row, column);
    }
  // M = V D Vᵀ, and the spectrum of D^-½ Vᵀ K V D^-½.
  const Spectrum mass(m);
  Eigen::MatrixXd half = mass.vectors;
  for (Eigen::Index j = 0; j < size; ++j) half.col(j) /= std::sqrt(mass.values[j]);
  const Spectrum all(half.transpose() * k * half);
  std::vector<double> omega;
  for (Eigen::Index i = 0; i < size; ++i) omega.push_back(std::sqrt(std::max(0.0, all.values[i])));
  std::sort(omega.begin(), omega.end());
  return omega;
}

}  // namespace

TEST_CASE("the mass of the cubic gives the modes of a beam, to fourth order", "[dynamics]") {
  const Csv table("modes.csv");
  const double EA = 1e4;  // of length, ρA and EI 1
  const Beam beam(1, Section{EA, 1, 0.01}, Material{1, 1 / EA}, Support::clamped, Support::free);
  struct Ends {
    const char* name;
    std::array<bool, 4> held;
    int rigid;
  };
  for (const Ends& ends : {Ends{"pinned-pinned", {true, false, true, false}, 0},
                           {"clamped-free", {true, true, false, false}, 0},
                           {"clamped-clamped", {true, true, true, true}, 0},
                           {"clamped-pinned", {true, true, true, false}, 0},
                           {"clamped-guided", {true, true, false, true}, 0},
                           {"free-free", {false, false, false, false}, 2}}) {
    const auto coarse = frequencies(beam, 8, ends.held), fine = frequencies(beam, 16, ends.held);
    const double most[4] = {1e-4, 7e-4, 2.5e-3, 7e-3};
    int found = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const int mode = static_cast<int>(table.number(row, "mode"));
      if (table.text(row, "support") != ends.name || mode > 4) continue;
      const double exact = table.number(row, "omega_over_sqrt(EI/rhoA)/L2");
      const auto at = static_cast<std::size_t>(ends.rigid + mode - 1);
      const double e = coarse[at] / exact - 1, f = fine[at] / exact - 1;
      CAPTURE(ends.name, mode, e, f);
      CHECK(e > 0);  // a beam that cannot take each shape is stiffer
      CHECK(e <= most[mode - 1]);
      if (mode > 1) CHECK(e >= 13 * f);
      ++found;
    }
    CHECK(found == 4);
  }
}

// 648 mm of steel, when it is tuned.
TEST_CASE("the partials of a string are those of its tension, to a cent", "[dynamics]") {
  const Csv exact("string_E4.csv");
  const double tension = 72.59131923866309, diameter = 0.000254, young = 200e9,
               strain = tension / (young * pi * diameter * diameter / 4);
  const Beam string(0.648 / (1 + strain), Section::circle(diameter), Material{young, 7850 * (1 + strain)},
                    Support::pinned, Support::pinned);
  const auto omega = frequencies(string, 16, {true, false, true, false}, strain);
  for (std::size_t row = 0; row < 10; ++row) {
    const double cents = 1200 * std::log2(omega[row] / (2 * pi) / exact.number(row, "pinned_Hz"));
    CAPTURE(row + 1, cents);
    CHECK(std::abs(cents) <= 1);
  }
}

// The beam here is a thousand times as fast as that of the table, for no step is longer than 2 ms.
TEST_CASE("a beam swings by more than a radian as its elastica does", "[dynamics]") {
  const double EA = 12 * 300. * 300;
  const int n = 8;
  const Beam beam(1, Section{EA, 1, 0.01}, Material{1, 1e-6 / EA}, Support::clamped, Support::free);
  const auto nodes = first_mode_shape(1, n);
  const FirstModeSwing swing(beam);
  struct Expected {
    int parts;
    double error;
  };
  for (const Expected& expected : {Expected{4, 4e-4}, {16, 1.6e-4}}) {
    DynamicModel<> model(beam, n, 1);
    model.let_go_from({nodes.data(), static_cast<int>(nodes.size()), true});
    const double energy = model.energy().sum();
    const double off = swing.error(
        expected.parts,
        [&](double dt) {
          return model.step(dt) == Status::ok && model.energy().sum() <= energy * (1 + 1e-9);
        },
        [&] { return model.shape().position(1); });
    CAPTURE(expected.parts, off);
    CHECK(off <= expected.error);
  }
}
