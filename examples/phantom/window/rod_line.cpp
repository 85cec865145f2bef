#include "rod_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <hapbeam/rod_centreline.hpp>

namespace phantom {

namespace {

constexpr int pieces = 240;

}  // namespace

RodLine::RodLine(const hapbeam::Rod& rod) : rod_(rod), samples_(pieces + 1) {
  for (int i = 0; i <= pieces; ++i) samples_[static_cast<std::size_t>(i)].s = rod_.length() * i / pieces;
}

double RodLine::radius(double s) const {
  for (const hapbeam::RodPart& part : rod_.parts())
    if (s <= part.end) return part.section(s).thickness / 2;
  return rod_.thickness() / 2;
}

std::vector<double> RodLine::mean_curvatures(const Shape& shape) const {
  // ∫ of a natural curvature up to s.
  const auto natural = [this](double s, double hapbeam::RodArc::*curvature) {
    double sum = 0, from = 0;
    for (const hapbeam::RodArc& arc : rod_.arcs()) {
      sum += arc.*curvature * std::clamp(s - from, 0.0, arc.end - from);
      from = arc.end;
    }
    return sum;
  };
  std::vector<double> means;
  for (int i = 0; i < shape.segments(); ++i) {
    const auto &a = shape[i], &b = shape[i + 1];
    const Vector t = a.tangent.normalized(), to = b.tangent.normalized();
    const double x = to.dot(a.director), y = to.dot(hapbeam::detail::cross3(t, a.director));
    const double sine = std::sqrt(std::max(0.0, 1 - to.dot(t) * to.dot(t))),
                 angle = std::atan2(sine, to.dot(t));
    const double l = b.s - a.s;
    if (rod_.arcs().empty()) {
      means.push_back(angle / l);
      continue;
    }
    const double factor = sine > 0 ? angle / sine : 1;
    means.push_back(std::hypot(factor * x - (natural(b.s, &hapbeam::RodArc::curvature2) -
                                             natural(a.s, &hapbeam::RodArc::curvature2)),
                               factor * y + (natural(b.s, &hapbeam::RodArc::curvature1) -
                                             natural(a.s, &hapbeam::RodArc::curvature1))) /
                    l);
  }
  return means;
}

void RodLine::take(const Shape& shape) {
  const std::vector<double> means = mean_curvatures(shape);
  const auto middle = [&shape](int i) { return (shape[i].s + shape[i + 1].s) / 2; };
  Vector across(0, 1, 0);
  double largest = 0;
  int e = 0;
  for (Sample& sample : samples_) {
    const auto point = shape.at(std::min(sample.s, shape.length()));
    const Vector tangent = point.tangent.normalized();
    if (std::abs(across.dot(tangent)) > 0.99) across = {0, 0, 1};
    across = (across - tangent.dot(across) * tangent).normalized();
    sample.ring = {point.r, tangent, across, radius(sample.s)};
    // Linear from one element's middle to the next one's.
    while (e + 2 < shape.segments() && middle(e + 1) < sample.s) ++e;
    const auto k = static_cast<std::size_t>(e);
    const double t = (sample.s - middle(e)) / (middle(e + 1) - middle(e));
    sample.strain = sample.ring.radius * std::max(0.0, means[k] + t * (means[k + 1] - means[k]));
    largest = std::max(largest, sample.strain);
  }
  largest_strain_ = largest;
}

RodLine::Nearest RodLine::nearest(const Vector& p) const {
  Nearest best{samples_[0].ring.middle, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const Vector &a = samples_[i].ring.middle, way = samples_[i + 1].ring.middle - a;
    const Vector place = a + std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
    const double distance = (p - place).norm();
    if (distance < best.distance) best = {place, distance};
  }
  return best;
}

}  // namespace phantom
