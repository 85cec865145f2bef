// Ends of rods: springs, sleeves, and any place and direction.
#include "rod/elements.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double length = 0.2, held = std::numeric_limits<double>::infinity();
const RodSection round_bar = RodSection::circle(0.002);

}  // namespace

TEST_CASE("the springs of an end add what springs in series add", "[rod]") {
  const double EI = 200e9 * round_bar.inertia1, place = 3 * EI / std::pow(length, 3), turn = 2 * EI / length,
               d = 1e-5 * length;
  const auto compliance = [&](const RodSupport& support, const Point& n) {
    FemModel<TwistedRod> model(Rod(length, round_bar, spring_steel, support, RodSupport::free), 4);
    return d / model.push({length, d, n}).force;
  };
  const double bar = std::pow(length, 3) / (3 * EI);
  const RodSupport soft = RodSupport::elastic(place, 2 * place, held, turn, 3 * turn, held);
  // d1 is y: pushed along it the tangent turns about d2.
  CHECK(compliance(soft, {0, 1, 0}) / (bar + 1 / place + length * length / (3 * turn)) ==
        Approx(1).epsilon(1e-6));
  CHECK(compliance(soft, {0, 0, 1}) / (bar + 0.5 / place + length * length / turn) ==
        Approx(1).epsilon(1e-6));

  const double GJ = 77e9 * round_bar.torsion, EA = 200e9 * round_bar.area;
  const RodSupport yields = RodSupport::elastic(held, held, EA / length, held, held, GJ / length);
  FemModel<TwistedRod> model(Rod(length, round_bar, spring_steel, yields, RodSupport::clamped), 4);
  const auto twisted =
      model.hold(RodSide::right, {{length, 0, 0}, {1, 0, 0}, {0, std::cos(0.2), std::sin(0.2)}});
  CHECK(twisted.moment.x() / (0.1 * GJ / length) == Approx(1).epsilon(1e-6));
  const auto pulled = model.hold(RodSide::right, {{length + d, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(pulled.force.x() / (EA * d / (2 * length)) == Approx(1).epsilon(1e-6));
}

// V = 2 k sin² α/2, so M = k sin α.  A rod of EI = 1e4 k L bends by 1e-4 of that turn, P L²/3EI; across its tip P has the arm L cos α.
TEST_CASE("the moment of an end's spring against a turn by α is k sin α", "[rod]") {
  const double k = 1;
  for (const double load : {0.1, 0.5, 1.0, 2.0, 4.0})
    for (const Point& across : {Point{0, 1, 0}, Point{0, 0, 1}}) {
      Rod rod(length, {1e9, 1e5 * k * length, 1e5 * k * length, 1e5 * k * length}, 0.005,
              RodSupport::elastic(held, held, held, k, k, held), RodSupport::free);
      rod.add(RodForce{length, load * k / length * across});
      const FemModel<TwistedRod> model(rod, 8);
      const Point tip = model.shape().at(length).r;
      const double turn = std::atan2(tip.dot(across), tip.x());
      CAPTURE(load, turn);
      CHECK(model.rest().status == Status::ok);
      CHECK(load * std::cos(turn) / std::sin(turn) == Approx(1).epsilon(1e-4));
    }
}

TEST_CASE("derivatives of an end's springs are those of their energy", "[rod]") {
  Random random(61);
  for (int trial = 0; trial < 30; ++trial) {
    const auto k = [&] { return 1 + random(0.9); };
    RodSupport support = RodSupport::elastic(k(), k(), k(), k(), k(), k());
    const RandomElement of(random);
    RodNode<Long> home = of.a;
    home.tangent = detail::unit(home.tangent);
    const detail::RodEnd<Long> end(support, home);
    const auto energy = [&](const Long* x) {
      VectorOf<Long, 7> r = VectorOf<Long, 7>::Zero();
      Eigen::Matrix<Long, 7, 7> K = Eigen::Matrix<Long, 7, 7>::Zero();
      return end.add_springs(moved(of.b, x, true), r, K);
    };
    VectorOf<Long, 7> r = VectorOf<Long, 7>::Zero();
    Eigen::Matrix<Long, 7, 7> K = Eigen::Matrix<Long, 7, 7>::Zero();
    end.add_springs(of.b, r, K);
    const Long h = 1e-4L;
    const auto at = [&](int i, Long s, int j, Long t) {
      Long x[7] = {};
      x[i] += s, x[j] += t;
      return energy(x);
    };
    for (int i = 0; i < 7; ++i) {
      const Long slope =
          (8 * (at(i, h, i, 0) - at(i, -h, i, 0)) - at(i, 2 * h, i, 0) + at(i, -2 * h, i, 0)) / (12 * h);
      CHECK(std::abs(slope - r[i]) <= 1e-9L * r.norm());
      for (int j = 0; j <= i; ++j) {
        const auto rough = [&](Long g) {
          return i == j
                     ? (at(i, g, i, 0) - 2 * at(i, 0, i, 0) + at(i, -g, i, 0)) / (g * g)
                     : (at(i, g, j, g) - at(i, g, j, -g) - at(i, -g, j, g) + at(i, -g, j, -g)) / (4 * g * g);
        };
        CHECK(std::abs((4 * rough(h) - rough(2 * h)) / 3 - K(i, j)) <= 1e-8L * K.norm());
        CHECK(std::abs(K(i, j) - K(j, i)) <= 1e-17L * K.norm());
      }
    }
  }
}

TEST_CASE("in a sleeve a rod bends without stretching", "[rod]") {
  // Pressed in its middle by three diameters: 192 EI d/L³, less what the slope of the sleeve's own side takes, (d/L)².
  const double EI = 200e9 * round_bar.inertia1, d = 0.006;
  const auto force = [&](const RodSupport& right) {
    FemModel<TwistedRod> model(Rod(length, round_bar, spring_steel, RodSupport::clamped, right), 16);
    const auto response = model.push({length / 2, d, {0, 0.6, 0.8}});
    REQUIRE(response.status == Status::ok);
    CHECK((model.shape().at(length).r - Point(length, 0, 0)).tail<2>().norm() <= 1e-15);
    return response.force / (192 * EI * d / std::pow(length, 3));
  };
  CHECK(force(RodSupport::sliding) == Approx(1).margin(10 * std::pow(d / length, 2)));
  CHECK(force(RodSupport::clamped) > 3);
}

TEST_CASE("ends, sections and foundations answer the same wherever the rod stands", "[rod]") {
  Random random(62);
  const auto answers = [&](auto&& turn, const Point& at) {
    Rod rod(length, round_bar, spring_steel, RodSupport::elastic(2e4, 3e4, 1e4, 5, 7, 3),
            RodSupport::sliding);
    rod.sections({{0.12, [](double s) { return RodSection::rectangle(0.003 - 0.005 * s, 0.002); }},
                  {length, round_bar}})
        .naturally({{length, 1, 2, 3}})
        .place_left({at, turn({1, 0, 0}), turn({0, 1, 0})})
        .add(RodFoundation{0.05, 0.1, 2e3, 1e3});
    FemModel<TwistedRod> model(rod, 8);
    const Point n = turn({0, 0.6, 0.8});
    const double home = n.dot(model.shape().at(0.13).r), h = 1e-5;
    std::vector<double> forces;
    for (const double d : {0.003, 0.006, 0.01}) {
      forces.push_back(model.push({0.13, home + d, n}).force);
      // And the force is the derivative of the energy.
      const double more = (model.push({0.13, home + d + h, n}), model.strain_energy()),
                   less = (model.push({0.13, home + d - h, n}), model.strain_energy());
      CHECK((more - less) / (2 * h) == Approx(forces.back()).epsilon(1e-5));
    }
    return forces;
  };
  const auto here = answers([](const Point& x) { return x; }, {0, 0, 0});
  for (int trial = 0; trial < 3; ++trial) {
    const Point axis = detail::unit(Point(random(1.0), random(1.0), random(1.0)));
    const double angle = random(20.0);
    const auto there = answers(
        [&](const Point& x) -> Point {
          const Point along = axis.dot(x) * axis;
          return along + std::cos(angle) * (x - along) + std::sin(angle) * detail::cross3(axis, x);
        },
        {random(1.0), random(1.0), random(1.0)});
    for (std::size_t k = 0; k < here.size(); ++k) CHECK(there[k] == Approx(here[k]).epsilon(1e-7));
  }
}
