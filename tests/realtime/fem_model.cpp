// FemModel in a servo loop: no allocation, no exception, whatever is asked.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <tuple>

#include "realtime/requests.hpp"
#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <typename S, int Elements = Eigen::Dynamic, int MaxElements = Elements>
using Default = FemModel<VonKarman<>, S, Elements, MaxElements>;

template <typename S, int Elements = Eigen::Dynamic, int MaxElements = Elements>
using Turning = FemModel<Corotational<>, S, Elements, MaxElements>;

// Each element; in float those that most use; the default one and one that turns in each kind of storage.
using Models =
    std::tuple<FemModel<Linear, double>, FemModel<VonKarman<FullIntegration>, double>,
               FemModel<VonKarman<ReducedIntegration>, double>, FemModel<Corotational<Linear>, double>,
               Default<double>, Default<float>, Default<double, 16>, Default<double, Eigen::Dynamic, 32>,
               Turning<double>, Turning<float>, Turning<double, 16>, Turning<double, Eigen::Dynamic, 32>>;

// An exception cannot leave a noexcept function, and one that is caught inside shows on the heap: see guards_fire.cpp.
template <typename Model>
constexpr bool is_noexcept() {
  using S = typename Model::Scalar;
  static_assert(is_force_model<Model>);
  static_assert(noexcept(std::declval<Model&>().press(std::declval<const Press<S>&>())));
  static_assert(noexcept(std::declval<Model&>().reset()));
  static_assert(takes_push<Model> == any_rotation<typename Model::ElementType>);
  static_assert(noexcept(std::declval<const Model&>().shape()));
  static_assert(noexcept(std::declval<const Model&>().range()));
  static_assert(noexcept(std::declval<const Model&>().thickness()));
  static_assert(noexcept(std::declval<const Model&>().rest()));
  static_assert(noexcept(std::declval<const Model&>().report()));
  static_assert(noexcept(std::declval<const Model&>().strain_energy()));
  static_assert(noexcept(std::declval<const Model&>().elements()));
  static_assert(has_internal_forces<Model>);
  static_assert(noexcept(std::declval<const Model&>().internal_forces(S())));
  static_assert(noexcept(peak_strain(std::declval<const Model&>())));
  static_assert(noexcept(std::declval<const Centreline<S>&>().at(S())));
  static_assert(noexcept(std::declval<const Centreline<S>&>().segment(0)));
  return true;
}
template <typename... Model>
constexpr bool all_noexcept(std::tuple<Model...>*) {
  return (is_noexcept<Model>() && ...);
}
static_assert(all_noexcept(static_cast<Models*>(nullptr)));

/// A direction that turns from press to press, all around; now and then none at all.
template <typename S>
Vector2<S> direction(int k) noexcept {
  if (k % 50 == 49) return Vector2<S>::Constant(std::numeric_limits<S>::quiet_NaN());
  const S angle = S(0.1) * S(k);
  return {std::sin(angle), std::cos(angle)};
}

struct Answers {
  int ok = 0;
  int not_finite = 0;
  int pushes = 0;
};

/// Asks the model everything that a servo may ask.
template <typename Model, typename Path>
Answers drive(Model& model, const Path& path) noexcept {
  using S = typename Model::Scalar;
  Answers answers;
  S looked_at = 0;
  for (const Press<S>& press : path) {
    const Response<S> response = model.press(press);
    answers.ok += response.status == Status::ok;
    answers.not_finite += !std::isfinite(response.force);
    if constexpr (takes_push<Model>) {
      const Response<S> pushed = model.push({press.s, press.d, direction<S>(++answers.pushes)});
      answers.not_finite += !std::isfinite(pushed.force);
    }
    const Centreline<S> shape = model.shape();
    looked_at += shape.at(press.s).w + shape.segment(shape.segments() / 2)(1, 1) + model.range().depth +
                 model.thickness() + S(model.report().solves) + model.strain_energy();
    const S strain = peak_strain(model).strain + model.internal_forces(press.s).surface_strain;
    answers.not_finite += !std::isfinite(strain) && std::isfinite(press.s);
  }
  model.reset();
  keep(looked_at);
  return answers;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("FemModel: nothing that a servo may call touches the heap", "", Models) {
  const std::pair<const char*, Beam> beams[] = {
      {"pinned", thesis_beam(Support::pinned, Support::pinned)},
      {"cantilever", thesis_beam(Support::clamped, Support::free)},
      {"guided", thesis_beam(Support::roller, Support::guided)},
      {"pinned, loaded", loaded_beam(Support::pinned, Support::pinned)},
      {"clamped and free, loaded", loaded_beam(Support::free, Support::clamped)},
  };
  unsigned seed = 0;
  for (const auto& [name, beam] : beams) {
    INFO(name << ", " << TestType::ElementType::name());
    TestType model(beam, 16);
    REQUIRE(model.rest().status == Status::ok);
    const auto path = requests(model.range(), model.shape().length(), ++seed);
    Answers answers;
    CHECK(heap_use([&] { answers = drive(model, path); }) == HeapUse{});
    CHECK(answers.not_finite == 0);
    CHECK(answers.ok > static_cast<int>(path.size()) / 3);  // the path was walked, not refused
  }
}

TEMPLATE_TEST_CASE("FemModel of a bounded size: without dead loads it is built without the heap", "",
                   (Default<double, 16>), (Default<double, Eigen::Dynamic, 32>),
                   (FemModel<Linear, double, 16>), (Turning<double, 16>)) {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  CHECK(heap_use([&] {
          TestType model(beam, 16);
          keep(model);
        }) == HeapUse{});
}

TEST_CASE("FemModel of a bounded size: dead loads are the one thing that it keeps on the heap") {
  const Beam beam = loaded_beam(Support::pinned, Support::pinned);
  CHECK(heap_use([&] {
          Default<double, 16> model(beam, 16);
          keep(model);
        }).allocations > 0);
}
