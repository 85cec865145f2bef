// The assembled tangent of a rod that a sphere has pushed is symmetric, and the derivative of the assembled residual: what is condensed of the
// contact included.
#include <type_traits>
#include <vector>

#include <Eigen/SVD>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace rod_tangent {

static Eigen::MatrixXd assembled_tangent;  // of the last system, before ends and contact are held
static Eigen::VectorXd residual;           // likewise

/// Keeps what is added.
template <typename Scalar, int Elements, int MaxElements, int Block>
class Recorder : public BlockTridiagonal<Scalar, Elements, MaxElements, Block> {
  using Base = BlockTridiagonal<Scalar, Elements, MaxElements, Block>;

 public:
  explicit Recorder(int elements) : Base(elements), elements_(elements) {}

  template <class Tangent, class Residual>
  void add_pairs(int first, const Tangent& K, const Residual& r) noexcept {
    const detail::PairOrder order{elements_};
    const int size = Block * (elements_ + 1);
    if (first == 0)
      assembled_tangent = Eigen::MatrixXd::Zero(size, size), residual = Eigen::VectorXd::Zero(size);
    for (int k = 0; k < r[0].size && first + k < 2 * order.pairs(); ++k) {
      const int e = order.element(first + k);
      for (int i = 0; e >= 0 && i < 2 * Block; ++i) {
        residual[Block * e + i] += r[i][k];
        for (int j = 0; j < 2 * Block; ++j) assembled_tangent(Block * e + i, Block * e + j) += K(i, j)[k];
      }
    }
    Base::add_pairs(first, K, r);
  }
  template <class Tangent, class Residual>
  void add_at(int node, const Tangent& K, const Residual& r) noexcept {
    for (int i = 0; i < Block; ++i) {
      residual[Block * node + i] += r[i];
      for (int j = 0; j < Block; ++j) assembled_tangent(Block * node + i, Block * node + j) += K(i, j);
    }
    Base::add_at(node, K, r);
  }

  template <class Tangent, class Residual>
  void add_more(int e, const Tangent& K, const Residual& r) noexcept {
    residual.segment<2 * Block>(Block * e) += r;
    assembled_tangent.block<2 * Block, 2 * Block>(Block * e, Block * e) += K;
    Base::add_more(e, K, r);
  }

 private:
  int elements_;
};

template <class Element>
struct Recorded : Element {
  using Abreast = std::conditional_t<goes_abreast<Element>, Recorded, void>;
};

}  // namespace rod_tangent

template <class Element, typename Scalar, int Elements, int MaxElements>
struct hapbeam::detail::Assembling<rod_tangent::Recorded<Element>, Scalar, Elements, MaxElements> {
  using Type = rod_tangent::Recorder<Scalar, Elements, MaxElements, Element::unknowns>;
};

using namespace rod_tangent;

namespace {

template <class Element>
void check_tangent(const Rod& rod, int elements) {
  using System = RodSystem<Recorded<Element>, double, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr int unknowns = Element::unknowns;
  System system(rod, elements);
  // Within an element, and nearer to one of its ends.
  const double length = rod.length(), place = 0.63 * length, reach = 0.02, h = 1e-6;
  const Point n = detail::unit(Point(0.3, 1, -0.4));
  const auto at = system.centreline().at(place);
  typename System::Contact contact;
  contact.s = place, contact.reach = reach, contact.most = length;
  contact.side = n, contact.normal = -n;
  contact.axis = {at.r + (reach - 0.03) * n + 0.001 * at.tangent, Point::Zero()};
  const auto aim = [&] {
    system.set_goal();
    system.add_goal(contact, nullptr);
  };
  aim();
  REQUIRE(NewtonRaphson{1e-13, 1e-14}.solve(system).status == Status::ok);
  contact = system.rows()[0];
  const double force = contact.force;
  aim();
  system.set_target(1);
  REQUIRE(system.factor(0) == Status::ok);
  const Eigen::MatrixXd K = assembled_tangent;
  typename System::State state(elements);
  system.keep(state);
  const auto gradient = [&](const typename System::State& of) -> Eigen::VectorXd {
    system.set_state(of);
    aim();
    system.set_target(1);
    REQUIRE(system.factor(0) == Status::ok);
    return residual;
  };
  const int first = unknowns, count = unknowns * elements;  // all but the end that is held
  CHECK(std::abs(force) > 1e-3);
  CHECK((K - K.transpose()).norm() <= 1e-14 * K.norm());
  CHECK(gradient(state).tail(count).norm() <= 1e-8 * std::abs(force));
  double worst = 0;
  for (int k = first; k < first + count; ++k) {
    const int i = k / unknowns, component = k % unknowns;
    const auto moved = [&](double by) {
      typename System::State there = state;
      Eigen::Matrix<double, unknowns, 1> x = Eigen::Matrix<double, unknowns, 1>::Zero();
      x[component] = by;
      auto& node = there.nodes[i];
      node.r += x.template segment<3>(0);
      detail::set_tangent<double>(node, node.tangent + x.template segment<3>(3));
      if constexpr (unknowns == 7)
        node.director = detail::turn(node.director, detail::unit(node.tangent), x[6]);
      for (int e = std::max(i - 1, 0); e <= std::min(i, elements - 1); ++e) {
        Eigen::Matrix<double, 2 * unknowns, 1> both = Eigen::Matrix<double, 2 * unknowns, 1>::Zero();
        both.template segment<unknowns>(e == i ? 0 : unknowns) = x;
        auto inner = system.parts().inner(e);
        const auto go = [&](auto& own, double& value) {
          const double before = own.value;
          own.advance(both);
          value += own.value - before;
        };
        go(inner.tension, there.inner[e]);
        if constexpr (unknowns == 7) go(inner.twist, there.inner[elements + e]);
      }
      return gradient(there);
    };
    const Eigen::VectorXd difference = (moved(h) - moved(-h)) / (2 * h);
    worst = std::max(worst, (difference - K.col(k)).tail(count).norm() / K.col(k).norm());
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-6);
}

/// Smallest singular value of the tangent of a straight shaft between hinges, twisted by couples that stay axial, in units of EI/L.
/// A node's director is carried with the tangent t, so its couple is M (e + t)/2.  Of what lacks to M e the work depends on the path: M/2 more
/// between both components of r' across e, which no symmetric tangent has.
double stiffness_under_axial_couples(double torque) {
  constexpr int elements = 16, unknowns = TwistedRod::unknowns;
  const double EI = 2, GJ = 8, angle = torque * EI / GJ;
  Rod shaft(1, RodStiffness{1e7, EI, EI, GJ}, 0.01, RodSupport::cardan, RodSupport::cardan);
  shaft.place_right({{1, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
  RodSystem<Recorded<TwistedRod>, double, Eigen::Dynamic, Eigen::Dynamic> system(shaft, elements);
  system.set_goal();
  REQUIRE(NewtonRaphson{}.solve(system).status == Status::ok);
  REQUIRE(system.factor(0) == Status::ok);
  Eigen::MatrixXd K = assembled_tangent / EI;
  std::vector<int> free;
  for (int k = 0; k < K.rows(); ++k) {
    const int node = k / unknowns, component = k % unknowns;
    const bool end = node == 0 || node == elements;
    if (!end || (component >= 3 && component < 6)) free.push_back(k);
  }
  for (const int node : {0, elements}) {
    const int y = unknowns * node + 4, z = y + 1;
    const double couple = node == 0 ? -torque / 2 : torque / 2;
    K(y, z) += couple, K(z, y) -= couple;
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(K(free, free)).singularValues().tail<1>()[0];
}

}  // namespace

// Greenhill, On the strength of shafting when exposed both to torsion and to end thrust, 1883.
TEST_CASE("a shaft whose couples stay axial buckles at 2 pi EI/L between hinges", "[rod]") {
  double low = 5, high = 7.5;
  while (high - low > 1e-4) {
    const double third = (high - low) / 3;
    if (stiffness_under_axial_couples(low + third) < stiffness_under_axial_couples(high - third))
      high -= third;
    else low += third;
  }
  CAPTURE(low, stiffness_under_axial_couples(low));
  CHECK(low == Approx(2 * pi).epsilon(1e-3));
  CHECK(stiffness_under_axial_couples(low) < 1e-3 * stiffness_under_axial_couples(6));
}

TEST_CASE("the assembled tangent is the derivative of the assembled residual, contact included", "[rod]") {
  check_tangent<RoundRod>(
      Rod(0.3, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free), 8);
  Rod leaf(0.3, RodSection::rectangle(0.012, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  leaf.naturally({{0.1, 1, 3, 2}, {0.3, -2, 1, 4}});
  for (const int elements : {7, 8}) check_tangent<TwistedRod>(leaf, elements);
}
