// Contacts close beside a clamp: what is said to be in range is as exact as the pages say.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

TEST_CASE("a hand close beside a clamp is in range where its force is right", "[touch]") {
  using Model = FemModel<Corotational<>>;
  constexpr double length = 0.2;
  double worst = 0, beyond_worst = 0;
  int in_range = 0, beyond = 0;
  for (const Support right : {Support::free, Support::clamped})
    for (const double height : {0.0002, 0.002}) {
      const Beam beam(length, Section::rectangle(0.01, height), Material{200e9}, Support::clamped, right);
      for (const int elements : {4, 8, 32}) {
        Model coarse(beam, elements), fine(beam, 256);
        for (const double radius : {0.0005, 0.004})
          for (const double part : {0.05, 0.1, 0.2, 0.4, 0.8}) {
            Touch<Model> on_coarse(coarse, radius), on_fine(fine, radius);
            const double s = part * length / elements;
            for (int k = 1; k <= 100; ++k) {
              const Vector2<double> hand(s, radius + height / 2 - 0.01 * k * s);
              const auto felt = on_coarse.tick(hand), of = on_fine.tick(hand);
              // Beyond the first element ForceError has it.
              if (!is_answer(felt.status) || !is_answer(of.status) || !felt.pressing || !of.pressing ||
                  felt.press.s > length / elements)
                continue;
              const double error = std::abs(felt.force.norm() / of.force.norm() - 1);
              const bool ok = felt.status == Status::ok;
              ++(ok ? in_range : beyond);
              double& most = ok ? worst : beyond_worst;
              most = std::max(most, error);
            }
          }
      }
    }
  INFO(in_range << " in range, worst " << worst << ", " << beyond << " beyond, worst " << beyond_worst);
  CHECK(in_range > 2000);
  CHECK(worst < 0.015);
  CHECK(beyond > 2000);
  CHECK(beyond_worst > 0.05);
}
