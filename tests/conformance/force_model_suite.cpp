// The suite of force_model_suite.hpp.
#include "conformance/force_model_suite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "conformance/touch_laws.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

namespace hapbeam::testing {

// Only models behind one interface are seen here: what is instantiated is at the end.
/// How far two forces of the same press may be apart, relative to the larger: ten times what a solver's tolerance
/// is, or round-off of float near an end.
template <typename Scalar>
constexpr Scalar force_tolerance = std::is_same_v<Scalar, float> ? Scalar(1e-3) : Scalar(1e-7);

/// The depth to which a model is tried [m].  A push in space has no limit of it, but one that pulls a rod taut may take more than one
/// call: a tenth of the length.
template <class Model>
typename Model::Scalar deepest(const Model& model) {
  const auto depth = model.range().depth;
  return std::isfinite(depth) ? depth : model.shape().length() / 10;
}

/// The same at a place: beside a support no steeper than 1 : 60 where the model states no slope, as in space, where a steeper press is out of range beside a
/// clamp.
template <class Model>
typename Model::Scalar deepest_at(const Model& model, typename Model::Scalar s) {
  const auto range = model.range();
  return std::isfinite(range.depth) ? range.depth_at(s)
                                    : std::min(s - range.left_support, range.right_support - s) / 60;
}

template <typename Scalar>
bool close(Scalar a, Scalar b) {
  return std::abs(a - b) <= force_tolerance<Scalar> * std::max(std::abs(a), std::abs(b));
}

/// Presses over the range, up to a depth that a hand reaches, in a fixed random order.  Within half a percent
/// of the ends a model may round s, if it says so.
template <class Model>
std::vector<Press<typename Model::Scalar>> presses_in(const Model& model, int number) {
  using Scalar = typename Model::Scalar;
  const Range<Scalar> range = model.range();
  const double length = static_cast<double>(model.shape().length()),
               low = std::max<double>(range.s_min, 0.005 * length),
               high = std::min<double>(range.s_max, 0.995 * length);
  Random random(11);
  std::vector<Press<Scalar>> presses;
  for (int k = 0; k < number; ++k) {
    const Scalar s = static_cast<Scalar>(random(low, high));
    presses.push_back(
        {s, static_cast<Scalar>(random(1)) * std::min(deepest_at(model, s), deepest(model) / 5)});
  }
  return presses;
}

/// The shape passes through the press, is finite, runs from 0 to the length, and its nodes are in order.
template <class Model>
void check_shape(const Model& model, const Press<typename Model::Scalar>& press) {
  using Scalar = typename Model::Scalar;
  const Centreline<Scalar> shape = model.shape();
  REQUIRE(shape.size() >= 2);
  bool ordered = shape[0].s == 0, finite = true;
  for (int i = 0; i < shape.size(); ++i) {
    ordered = ordered && (i == 0 || shape[i].s > shape[i - 1].s);
    finite =
        finite && std::isfinite(shape[i].u) && std::isfinite(shape[i].w) && std::isfinite(shape[i].theta);
  }
  REQUIRE(ordered);
  REQUIRE(finite);
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  REQUIRE(std::abs(shape.at(press.s).w - press.d) <= 16 * eps * deepest(model));
}

template <class Model>
void check_contract(const std::function<Model()>& make) {
  using Scalar = typename Model::Scalar;
  static_assert(is_force_model<Model>);
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  constexpr Scalar not_a_number = std::numeric_limits<Scalar>::quiet_NaN();
  Model model = make();
  const Range<Scalar> range = model.range();
  const auto presses = presses_in(model, 50);
  const Press<Scalar> middle{(range.s_min + range.s_max) / 2, deepest(model) / 50};
  const bool limited = std::isfinite(range.depth);

  SECTION("range and thickness are positive and finite where they must be") {
    CHECK((0 <= range.s_min && range.s_min <= range.s_max && range.s_max <= model.shape().length()));
    CHECK((range.depth > 0 && (limited || std::isinf(range.slope))));
    CHECK((model.thickness() > 0 && std::isfinite(model.thickness())));
  }
  SECTION("within range the status is ok, the force finite, and the shape passes through the press") {
    for (const Press<Scalar>& press : presses) {
      const Response<Scalar> response = model.press(press);
      INFO("s " << press.s << " m, d " << press.d << " m");
      REQUIRE(response.status == Status::ok);
      REQUIRE(std::isfinite(response.force));
      check_shape(model, press);
    }
  }
  SECTION("the force pushes along the press") {  // an unloaded beam resists
    for (const Press<Scalar>& press : presses) REQUIRE(model.press(press).force * press.d >= 0);
  }
  SECTION("a deeper press takes more force") {
    Scalar before = 0;
    for (int k = 1; k <= 20; ++k) {
      const Scalar force = model.press({middle.s, middle.d * Scalar(k)}).force;
      CHECK(force > before);
      before = force;
    }
  }
  SECTION("no displacement takes no force") {
    const Scalar scale = model.press(middle).force;
    CHECK(std::abs(model.press({middle.s, 0}).force) <= force_tolerance<Scalar> * scale);
  }
  SECTION("the same press gives the same force on every way to it") {
    for (std::size_t k = 0; k + 1 < presses.size(); ++k) {
      Model fresh = make();
      model.press(presses[k]);
      INFO("s " << presses[k + 1].s << " m, d " << presses[k + 1].d << " m");
      REQUIRE(close(model.press(presses[k + 1]).force, fresh.press(presses[k + 1]).force));
    }
  }
  SECTION("out of range it says so, and pushes no less than the nearest press in range") {
    if (!limited) return;
    const Scalar deep = 2 * range.depth;
    for (const Press<Scalar>& press : {Press<Scalar>{middle.s, deep}, Press<Scalar>{middle.s, -deep},
                                       Press<Scalar>{middle.s, Scalar(1e9)}}) {
      const Response<Scalar> response = model.press(press);
      CHECK(response.status == Status::out_of_range);
      CHECK(is_answer(response.status));
      CHECK(std::isfinite(response.force));
      // The shape is that of some press between the nearest one and the one asked for.
      const Press<Scalar> nearest = range.nearest(press);
      const Scalar w = model.shape().at(nearest.s).w, eps = std::numeric_limits<Scalar>::epsilon();
      CHECK(w * nearest.d > 0);
      CHECK(std::abs(w) >= std::abs(nearest.d) * (1 - 16 * eps));
      CHECK(std::abs(w) <= std::abs(press.d) * (1 + 16 * eps));
      Model fresh = make();
      const Scalar inside = fresh.press(nearest).force;
      CHECK(response.force * inside > 0);
      CHECK(std::abs(response.force) >= std::abs(inside) * (1 - force_tolerance<Scalar>));
    }
  }
  SECTION("an invalid request gets force 0, keeps the shape, and does no harm") {
    model.press(middle);
    const Scalar held = model.shape().at(middle.s).w;
    for (const Press<Scalar>& press :
         {Press<Scalar>{not_a_number, 0}, Press<Scalar>{middle.s, not_a_number}, Press<Scalar>{infinity, 0},
          Press<Scalar>{middle.s, -infinity}, Press<Scalar>{-middle.s, middle.d},
          Press<Scalar>{2 * model.shape().length(), middle.d}}) {
      const Response<Scalar> response = model.press(press);
      CHECK(response.status == Status::invalid_request);
      CHECK(response.force == 0);
      CHECK(model.shape().at(middle.s).w == held);
    }
    Model fresh = make();
    CHECK(close(model.press(middle).force, fresh.press(middle).force));
  }
  SECTION("what a touch remembers ends with its release") {
    if (limited) check_touch<Model>(make, force_tolerance<Scalar>);
  }
  SECTION("reset goes back to the untouched shape") {
    Model untouched = make();
    for (const Press<Scalar>& press : presses) model.press(press);
    model.reset();
    REQUIRE(model.shape().size() == untouched.shape().size());
    for (int i = 0; i < model.shape().size(); ++i) {
      CHECK(model.shape()[i].s == untouched.shape()[i].s);
      CHECK(model.shape()[i].w == untouched.shape()[i].w);
    }
  }
}

template void check_contract(const std::function<AnyModel<double>()>&);
template void check_contract(const std::function<AnyModel<float>()>&);
template void check_contract(const std::function<AnyPushedModel<double>()>&);
template void check_contract(const std::function<AnyPushedModel<float>()>&);

}  // namespace hapbeam::testing
