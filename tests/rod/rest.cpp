// Any rod finds its rest: sections, tapers, natural shapes, ends, foundations and loads at random, up to forty times the load EI/L³.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("five hundred random rods find their rest", "[rod]") {
  Random random(7);
  int most = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double length = random(0.1, 1.0), d = length * random(0.003, 0.02);
    const bool flat = random(1.0) > 0, free = random(1.0) > 0, hinged = random(1.0) > 0,
               curved = random(1.0) > 0;
    const RodSection section = flat ? RodSection::rectangle(d * random(0.5, 4), d) : RodSection::circle(d);
    Rod rod(length, section, RodMaterial::isotropic(std::pow(10, random(7.5, 11.3)), 0.3),
            RodSupport::clamped,
            free     ? RodSupport::free
            : hinged ? RodSupport::hinged
                     : RodSupport::clamped);
    const auto rate = [&] { return random(6) / length; };
    if (curved) {
      const RodArc first{length * random(0.2, 0.8), rate(), rate(), rate()},
          second{length, rate(), rate(), rate()};
      rod.naturally({first, second});
    }
    if (random(1.0) > 0) {
      const double taper = random(0.5) / length;  // up to half of the thickness, or half more
      rod.section([=](double s) {
        return flat ? RodSection::rectangle(section.thickness * (1 + taper * s), section.thickness)
                    : RodSection::circle(d * (1 + taper * s));
      });
    }
    const double EI = std::min(rod.stiffness().bending1, rod.stiffness().bending2);
    if (random(1.0) > 0.5) {
      const double from = length * random(0.0, 0.5),
                   k = std::pow(10, random(0, 3)) * EI / std::pow(length, 4);
      rod.add(RodFoundation{from, from + 0.3 * length, k, k * random(0.0, 1.0)});
    }
    const double load = std::pow(10, random(-1, 1.6)) * EI / (length * length * length);
    const double x = random(1.0), y = random(1.0), z = random(1.0);
    rod.load(Point(load * detail::unit(Point(x, y, z))));
    const FemModel<TwistedRod> model(rod, random.integer(8, 24));
    INFO("trial " << trial);
    CHECK(is_answer(model.rest().status));
    most = std::max(most, model.rest().solves);
  }
  CHECK(most <= 10000);  // LoadPath's own bound
}

// A slender one gives way when its end has gone a ten thousandth of its way.  A round one may roll about the line between its ends.
TEST_CASE("straight rods whose ends face each other and stand nearer find their bow", "[rod]") {
  Random random(5);
  int missed = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double length = random(0.1, 1.0), d = length * random(0.003, 0.02);
    Rod rod(length, trial % 2 == 0 ? RodSection::circle(d) : RodSection::rectangle(d * random(0.5, 4), d),
            RodMaterial::isotropic(1e10, 0.3), RodSupport::clamped, RodSupport::clamped);
    rod.place_right({{length * random(0.3, 0.99), 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const FemModel<TwistedRod> model(rod, random.integer(8, 32));
    missed += !is_answer(model.rest().status);
  }
  CHECK(missed == 0);
}

// Its energy is round-off, of either sign, and Newton's increments are the round-off of places: eps |r| √(EA/l).
TEST_CASE("a rod without stress answers a push that leaves it where it is", "[rod]") {
  Random random(1);
  int not_ok = 0;
  double largest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
    const auto direction = [&] { return detail::unit(Point(random(1.0), random(1.0), random(1.0))); };
    const bool turned = trial % 2 != 0;
    const Point along = turned ? direction() : Point(1, 0, 0);
    if (turned)
      wire.place_left({{random(0.1), random(0.1), random(0.1)}, along, detail::across(direction(), along)});
    FemModel<RoundRod> model(wire, 8);
    for (int k = 0; k < 5; ++k) {
      const double s = random(0.02, 0.2);
      const Point n = detail::across(direction(), along);
      const auto response = model.push({s, n.dot(model.shape().at(s).r), n});
      not_ok += response.status != Status::ok;
      largest = std::max(largest, std::abs(response.force));
    }
  }
  CHECK(not_ok == 0);
  CHECK(largest <= 1e-9);  // of 4 N/mm at the clamp
}

TEMPLATE_TEST_CASE("a catenary in space hangs where its weight pulls it, and nothing has snapped", "[rod]",
                   TwistedRod, RoundRod) {
  for (const int elements : {8, 9, 15, 32})
    for (const double slack : {0.001, 0.01, 0.05, 0.2, 0.5})
      for (const double load : {0.01, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5}) {
        Rod rod(1, RodSection::circle(0.002), RodMaterial::isotropic(2e9, 0.3), RodSupport::clamped,
                RodSupport::clamped);
        const Point pull = detail::unit(Point(0, 0.6, -0.8));
        rod.place_right({{1 - slack, 0, 0}, {1, 0, 0}, {0, 0, 1}})
            .load(Point(load * rod.stiffness().bending1 * pull));
        const FemModel<TestType> model(rod, elements);
        CAPTURE(elements, slack, load, model.rest().solves);
        CHECK(model.rest().status == Status::ok);
        CHECK(model.shape().at(0.5).r.dot(pull) > 0);
      }
}

// A corner within an element has another natural shape on each mesh.  A push moves the mesh: the corner has to stay.
TEST_CASE("an L in space answers a push that leaves it where it is", "[rod]") {
  const double leg = 0.24;
  for (const int elements : {8, 9, 12, 15, 16, 32, 64})
    for (const double radius : {1e-4, 1e-3, 0.01, 0.1})
      for (const RodSupport end : {RodSupport::free, RodSupport::hinged, RodSupport::clamped}) {
        const double arc = pi / 2 * radius, straight = leg - radius, length = 2 * straight + arc;
        const auto hook = [&](RodSupport right) {
          Rod rod(length, RodSection::rectangle(0.0006, 0.03), RodMaterial::isotropic(71.24e9, 0.31),
                  RodSupport::clamped, right);
          rod.place_left({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
          return rod.naturally({{straight, 0, 0, 0}, {straight + arc, 1 / radius, 0, 0}});
        };
        Rod rod = hook(end);
        if (end != RodSupport::free) {
          const FemModel<TwistedRod> at_rest(hook(RodSupport::free), elements);
          const RodNode<double> tip = at_rest.shape()[at_rest.shape().segments()];
          rod.place_right({tip.r, detail::unit(tip.tangent), tip.director});
        }
        FemModel<TwistedRod> model(rod, elements);
        for (const double share : {0.1, 0.3, 0.45, 0.5, 0.52, 0.55, 0.8, 0.95})
          for (const Point& n : {Point(0, 0, 1), Point(1, 0, 0), Point(0, 1, 0)}) {
            const double s = share * length;
            const Response<double> answer = model.push({s, n.dot(model.shape().at(s).r), n});
            CAPTURE(elements, radius, name(end), share, n.x(), n.y());
            CHECK(answer.status == Status::ok);
            CHECK(std::abs(answer.force) <= 1e-15 * elements * rod.stiffness().axial);
          }
      }
}

// The right-angled frame of Argyris and others (1979), 240 mm a leg, clamped, is pushed in its plane at its free end, and by a thousandth of that across.  It goes aside near 1.08 N.
// Exact: both legs by collocation, and a true corner.  An arc shorter than a thousandth of the length has an element of that length, which bends.
TEST_CASE("a right-angled frame in space goes aside as one with a true corner, on any mesh", "[rod]") {
  const double leg = 0.24, radius = 1e-4, arc = pi / 2 * radius, straight = leg - radius,
               length = 2 * straight + arc;
  struct Exact {
    double force, aside,
        error;  // [N], [m], relative: 8e-4 of the force, which counts most where the frame begins to go
  };
  for (const Exact& exact : {Exact{1.1, 0.02135, 0.02}, {1.15, 0.03773, 0.006}, {1.3, 0.05573, 0.002}})
    for (const int elements : {8, 16, 33}) {
      Rod frame(length, RodSection::rectangle(0.0006, 0.03), RodMaterial::isotropic(71.24e9, 0.31),
                RodSupport::clamped, RodSupport::free);
      frame.place_left({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
      frame.naturally({{straight, 0, 0, 0}, {straight + arc, 1 / radius, 0, 0}})
          .add(RodForce{length, {exact.force, 0, exact.force / 1000}});
      const FemModel<TwistedRod> model(frame, elements);
      CAPTURE(exact.force, elements);
      CHECK(is_answer(model.rest().status));
      CHECK(model.shape().at(length).r.z() == Approx(exact.aside).epsilon(exact.error));
    }
}
