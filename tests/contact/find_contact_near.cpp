// The contact sought where it was, against the one that is sought on the whole shape: the same, to the bit, or not found.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Tried {
  int found = 0, elsewhere = 0, apart = 0, kept = 0;
};

/// Whether a touch keeps its place although another one is nearer, by no more than half a reach.
template <typename Scalar>
bool keeps_its_own(const Contact<Scalar>& own, const Contact<Scalar>& nearest, const Avatar<Scalar>& avatar,
                   Scalar reach) {
  const auto away = [&](const Contact<Scalar>& contact) { return (contact.foot - avatar.position).norm(); };
  return own.s != nearest.s && away(own) - away(nearest) <= reach / 2;
}

/// Presses anywhere, then looks from avatars near and far, fine and coarse, remembered at the right place or another.
template <class Model>
Tried try_random(Model model, int presses) {
  using Scalar = typename Model::Scalar;
  const Range<Scalar> range = model.range();
  const double length = static_cast<double>(model.shape().length());
  Random random(17);
  Tried tried;
  for (int k = 0; k < presses; ++k) {
    const Scalar s = static_cast<Scalar>(random(range.s_min, range.s_max));
    model.press({s, static_cast<Scalar>(random(1)) * range.depth_at(s)});
    BoundingVolumes<Scalar> volumes(model.shape().segments());
    for (int j = 0; j < 20; ++j) {
      const double far = std::pow(10, random(-5, 0)) * length;
      const Displacement<Scalar> at = part_of(model, s, s).line.at(s);
      const Vector2<Scalar> q(s + at.u + static_cast<Scalar>(random(far)),
                              at.w + static_cast<Scalar>(random(far)));
      const Avatar<Scalar> avatar{q, static_cast<Scalar>(random(0.0, 0.05) * length)};
      const Scalar from = j % 4 == 3 ? static_cast<Scalar>(random(0.0, length)) : s;
      const int side = random.integer(0, 1) ? 1 : -1;
      ContactMemory<Scalar> near{q, true, true, j % 2 == 0, side}, all = near;
      Contact<Scalar> found;
      if (!detail::find_contact_near(model, from, avatar, near, found)) {
        ++tried.elsewhere;
        continue;
      }
      ++tried.found;
      volumes.refit(model.shape());
      const Contact<Scalar> whole = find_contact(avatar, model.shape(), volumes, model.thickness(), all);
      if (any_rotation<typename Model::ElementType> &&
          keeps_its_own(found, whole, avatar, avatar.radius + model.thickness() / 2)) {
        ++tried.kept;
        continue;
      }
      const bool alike = found.touching == whole.touching && found.side == whole.side &&
                         found.segment == whole.segment && found.past_end == whole.past_end &&
                         found.s == whole.s && found.depth == whole.depth && found.foot == whole.foot &&
                         found.normal == whole.normal && near.through == all.through;
      tried.apart += !alike;
    }
  }
  return tried;
}

}  // namespace

TEST_CASE("near where it was the contact is that of the whole shape, and little is looked at") {
  const Beam bar = thesis_beam(Support::pinned, Support::pinned);
  SECTION("finite elements, to the bit") {
    const Tried tried = try_random(FemModel<>(bar, 16), 1000);
    CHECK(tried.apart == 0);
    CHECK(tried.found > 10000);
  }
  SECTION("a cantilever, in float") {
    const Tried tried =
        try_random(FemModel<VonKarman<>, float>(thesis_beam(Support::clamped, Support::free), 32), 1000);
    CHECK(tried.apart == 0);
    CHECK(tried.found > 10000);
  }
  SECTION("a ruler of finite rotation, every time") {
    const Beam ruler(0.3, Section::rectangle(0.03, 0.001), Material{210e9}, Support::clamped, Support::free);
    const Tried tried = try_random(FemModel<Corotational<>>(ruler, 8), 1000);
    CHECK(tried.apart == 0);
    CHECK(tried.elsewhere == 0);
    CHECK(tried.kept < 10);  // a ruler does not wind
  }
  SECTION("half a ring, of which a hand within is as near to either side") {
    const Beam tall = arch(0.1, 0.049, Section::rectangle(0.02, 0.0005), Material{210e9}, Support::clamped);
    const Tried tried = try_random(FemModel<Corotational<>>(tall, 16), 1000);
    CHECK(tried.apart == 0);
    CHECK(tried.elsewhere == 0);
    CHECK(tried.kept > 50);
  }
}

TEST_CASE("a piece is excluded only where it is farther") {
  Random random(3);
  int excluded = 0, wrong = 0;
  double tightest = 1;
  for (int k = 0; k < 100000; ++k) {
    const auto turn = [&random] { return random(3.2); };
    const double length = random(0.5, 1.5), first = turn(), last = turn(), up = turn(), x = random(10),
                 w = random(10);
    const CentrelineNode<double> nodes[] = {{0, 0, 0, first},
                                            {1, length * std::cos(up) - 1, length * std::sin(up), last}};
    const Centreline<double> line(nodes, 2, true);
    const Vector2<double> q(x, w);
    const double d = std::sqrt(closest_point(line.segment(0), q).distance_squared);
    const double asked = d * random(0.0, 2.0);
    if (!line.excludes(0, q, asked)) continue;
    ++excluded;
    wrong += asked >= d;
    tightest = std::min(tightest, 1 - asked / d);
  }
  CHECK(wrong == 0);
  CHECK(excluded > 10000);
  CHECK(tightest < 0.05);
}

TEST_CASE("of what is no position nothing is said") {
  const Beam bar = thesis_beam(Support::pinned, Support::pinned);
  FemModel<Corotational<>> turning(bar, 8);
  FemModel<> straight(bar, 8);
  Contact<double> contact;
  ContactMemory<double> memory{{0, 0}, true, true, false, 1};
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(detail::find_contact_near(straight, 1.0, {{1.0, not_a_number}, 0.01}, memory, contact));
  CHECK_FALSE(detail::find_contact_near(straight, 1.0, {{1e200, 0.0}, 0.01}, memory, contact));
  CHECK_FALSE(detail::find_contact_near(turning, 1.0, {{1.0, not_a_number}, 0.01}, memory, contact));
  CHECK_FALSE(detail::find_contact_near(turning, 1.0, {{1e200, 0.0}, 0.01}, memory, contact));
  CHECK(detail::find_contact_near(straight, 1.0, {{1.0, 0.0}, 0.01}, memory, contact));
  CHECK(detail::find_contact_near(turning, 1.0, {{1.0, 0.0}, 0.01}, memory, contact));
}
