// What an accepted press is worth, on beams at random: its force agrees with that of four times the elements, 256 at least,
// within the law that docs/limits.md states, and in float with that of double.
//
// Errors are relative to the largest transverse force that the stroke has seen: that of the press, the dead load, or the
// tension's component N θ.  With h the longest element and k = √(|N|/EI) the law is ½ (h/L)² + 0.15 (hk)³, at most ½,
// at 5 % of the length and two thicknesses from the ends.  For beams that are bent by nature it is six times that where
// hk <= 1.  Beyond, such a beam has no digit: what is asserted is that the force has not blown up.
//
// Largest errors of 67 000 presses on 4000 beams: five pairs of ends, h/L 1/10 to 1/1000, -0.7 to 20 Euler loads, stretch to 30 %,
// dead loads, natural arcs, depths up to the range.  The median of each entry is smaller by a factor of 60 to 10⁷.
//
//                       hk          4 to 7 elements   8 to 15    16 to 31   32 to 63   64 to 512
//     straight          below 0.3   3·10⁻³            1.2·10⁻³   5·10⁻⁴     5·10⁻⁵     6·10⁻⁵
//                       0.3 to 1    8·10⁻³            2·10⁻³     1.2·10⁻³   5·10⁻⁴     8·10⁻⁵
//                       1 to 3      4 %               3·10⁻³     6·10⁻⁴     8·10⁻⁴     3·10⁻⁴
//                       3 to 10     1.7 %             1.4·10⁻³   1.4·10⁻³   8·10⁻⁵     1.2·10⁻⁴
//                       above 10    6·10⁻³            1.6·10⁻⁴   1.8·10⁻³   5·10⁻⁶     3·10⁻⁶
//     bent by nature    below 0.3   1.2 %             2.3 %      3·10⁻⁴     6·10⁻⁵     7·10⁻⁵
//                       0.3 to 1    1.5 %             4 %        10⁻³       8·10⁻⁴     5·10⁻⁵
//                       1 to 3      5 %               12 %       2·10⁻³     7·10⁻⁴     1.1·10⁻⁴
//                       3 to 10     1.8 %             5·10⁻³     9·10⁻⁴     7·10⁻⁴     5·10⁻⁴
//                       above 10    8·10⁻³            8·10⁻⁴     2·10⁻⁴     8·10⁻⁵     3·10⁻⁵
//
// A part of the beams runs with the other tests; all of them take half a minute: test_stability "[sweep]".
#include <memory>
#include <stdexcept>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/random_beam.hpp"
#include "support/random_scene.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Tension N [N] and the largest |θ|, from the deformed shape: how much longer than the beam the centreline is.
struct PressedState {
  double tension = 0, turn = 0;

  template <class Model>
  PressedState(const Model& model, const Beam& beam) {
    const auto shape = model.shape();
    double stretch = 0;
    for (int i = 0; i < shape.segments(); ++i) {
      const auto &a = shape[i], &b = shape[i + 1];
      const double ds = b.s - a.s, dx = ds + b.u - a.u, dw = b.w - a.w;
      constexpr bool finite = any_rotation<typename Model::ElementType>;
      const double chord = finite ? std::atan2(dw, dx) : dw / ds;
      const double p = std::remainder(-a.theta - chord, 2 * pi), q = std::remainder(-b.theta - chord, 2 * pi);
      stretch += finite ? std::hypot(dx, dw) - ds : dx - ds + ds * chord * chord / 2;
      stretch += ds * (2 * p * p - p * q + 2 * q * q) / 30;  // ½ ∫w'² of the cubic above its chord
      turn = std::max({turn, std::abs(a.theta), std::abs(b.theta)});
    }
    tension = beam.axial_stiffness() * stretch / beam.length();
  }
};

double dead_load(const Beam& beam) {
  double most = 0;
  for (const PointLoad& load : beam.point_loads())
    most = std::max({most, std::abs(load.transverse), std::abs(load.moment) / beam.length()});
  if (beam.transverse()) most = std::max(most, std::abs(beam.transverse()(0)) * beam.length());
  if (beam.axial()) most = std::max(most, std::abs(beam.axial()(0)) * beam.length());
  return most;
}

double allowed_error(const Beam& beam, double h, double kh) {
  const double law = std::min(h * h / 2 + 0.15 * kh * kh * kh, 0.5);
  return beam.arcs().empty() ? law : kh <= 1 ? 6 * law : 20;
}

struct SweepCount {
  int presses = 0, refused = 0;              // double
  int rounded = 0, rounded_refused = 0;      // float
  int rests = 0, rounded_rests_refused = 0;  // in float, of all that were sought
  double worst = 0, worst_rounded = 0;       // of what is allowed
};

template <class Element>
void press_along_a_stroke(FemModel<Element>& model, FemModel<Element>& fine,
                          FemModel<Element, float>* rounded, const Beam& beam, Random& random,
                          SweepCount& count) {
  constexpr int steps = 6;
  const double L = beam.length(), away = std::max(0.05, 2 * beam.thickness() / L);
  const double s = L * random(away, fixes_w(beam.right()) ? 1 - away : 0.95);
  const double side = random.integer(0, 1) ? 1 : -1, part = log_even(random, 1e-2, 1);
  model.reset();
  fine.reset();
  if (rounded) rounded->reset();
  const double rest = fine.shape().at(s).w, limit = 0.99 * model.range().depth_at(s);
  if (std::abs(rest) >= limit) return;
  const int n = model.elements();
  const double h = 1.0 / n;
  const PressedState before(fine, beam);
  double k = std::sqrt(std::abs(before.tension) / beam.bending_stiffness());
  double scale = std::max(dead_load(beam), std::abs(before.tension) * before.turn);
  bool in_double = true, in_float = rounded != nullptr;
  for (int step = 1; step <= steps && in_double; ++step) {
    const double d = rest + (side * limit - rest) * part * step / steps;
    const Response<double> answer = model.press({s, d}), refined = fine.press({s, d});
    ++count.presses;
    count.refused += answer.status != Status::ok;
    // Beyond a jump of either they may be on different branches.
    in_double = answer.status == Status::ok && refined.status == Status::ok;
    if (!in_double) break;
    const PressedState now(fine, beam);
    k = std::max(k, std::sqrt(std::abs(now.tension) / beam.bending_stiffness()));
    scale = std::max({scale, std::abs(refined.force), std::abs(now.tension) * now.turn});
    const double error = std::abs(answer.force - refined.force) / scale;
    const double allowed = allowed_error(beam, h, h * L * k);
    CAPTURE(s / L, d / L, answer.force, refined.force, k * L, L / beam.thickness());
    count.worst = std::max(count.worst, error / allowed);
    CHECK(error <= allowed);
    if (!in_float) continue;
    const Response<float> rough = rounded->press({static_cast<float>(s), static_cast<float>(d)});
    ++count.rounded;
    if (rough.status != Status::ok) {
      ++count.rounded_refused;
      continue;
    }
    const double lost = std::abs(static_cast<double>(rough.force) - answer.force) / scale;
    const double bound = (fixes_w(beam.right()) ? 100 : 400) * 1.2e-7 * n * n;
    CAPTURE(rough.force);
    count.worst_rounded = std::max(count.worst_rounded, lost / bound);
    CHECK(lost <= bound);
  }
}

template <class Element>
void sweep_presses(int beams) {
  Random random(2026);
  SweepCount count;
  for (int trial = 0; trial < beams; ++trial) {
    const Beam beam = any_beam(random);
    const int elements = static_cast<int>(log_even(random, 4, 513));
    CAPTURE(trial, elements, name(beam.left()), name(beam.right()));
    FemModel<Element> model(beam, elements), fine(beam, std::max(4 * elements, 256));
    CHECK(is_answer(model.rest().status));
    CHECK(is_answer(fine.rest().status));
    std::unique_ptr<FemModel<Element, float>> rounded;
    if (elements <= 64) {
      ++count.rests;
      try {
        rounded = std::make_unique<FemModel<Element, float>>(beam, elements);
        CHECK(is_answer(rounded->rest().status));
      } catch (const std::invalid_argument&) {  // in float its tangent has lost its digits
        ++count.rounded_rests_refused;
      }
    }
    Random places(static_cast<std::uint64_t>(trial) + 1);
    for (int stroke = 0; stroke < 3; ++stroke)
      press_along_a_stroke(model, fine, rounded.get(), beam, places, count);
  }
  CAPTURE(count.presses, count.refused, count.worst);
  CAPTURE(count.rounded, count.rounded_refused, count.worst_rounded, count.rests,
          count.rounded_rests_refused);
  CHECK(count.refused <= count.presses / 500);
  CHECK(count.rounded_refused <= count.rounded / 30);
  CHECK(count.rounded_rests_refused <= count.rests / 100 + 1);
}

}  // namespace

TEMPLATE_TEST_CASE("an accepted press on a random beam is worth what the limits say", "[press]", VonKarman<>,
                   Corotational<>) {
  sweep_presses<TestType>(100);
}

TEMPLATE_TEST_CASE("two thousand random beams are pressed as the limits say", "[.][sweep]", VonKarman<>,
                   Corotational<>) {
  sweep_presses<TestType>(2000);
}
