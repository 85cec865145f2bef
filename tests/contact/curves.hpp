// Centrelines for the tests of contact: from straight to strongly bent, with their storage.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <hapbeam/centreline.hpp>

template <typename Scalar>
struct Curve {
  std::vector<hapbeam::CentrelineNode<Scalar>> nodes;
  hapbeam::Centreline<Scalar> line() const { return {nodes.data(), static_cast<int>(nodes.size())}; }
};

/// Nodes at even distances on w = f(s), with f and f' given.
template <typename Scalar, typename F, typename Slope>
Curve<Scalar> sampled_curve(int segments, Scalar length, F f, Slope slope) {
  Curve<Scalar> curve;
  for (int i = 0; i <= segments; ++i) {
    const Scalar s = length * static_cast<Scalar>(i) / static_cast<Scalar>(segments);
    curve.nodes.push_back({s, 0, f(s), -slope(s)});
  }
  return curve;
}

template <typename Scalar>
Curve<Scalar> straight_curve(int segments, Scalar length) {
  return sampled_curve(
      segments, length, [](Scalar) { return Scalar(0); }, [](Scalar) { return Scalar(0); });
}

/// A random shape of length 1: mostly a graph over x, with uneven nodes, stretched or compressed.
enum class Shape { straight, nearly_straight, sagging, wavy, ragged };
constexpr Shape all_shapes[] = {Shape::straight, Shape::nearly_straight, Shape::sagging, Shape::wavy,
                                Shape::ragged};

template <typename Scalar>
Curve<Scalar> random_curve(Shape shape, int segments, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
  const double amplitude = shape == Shape::straight          ? 0
                           : shape == Shape::nearly_straight ? 1e-7
                           : shape == Shape::sagging         ? 0.1
                                                             : 0.3;
  const double waves = shape == Shape::wavy ? 2 + 4 * unit(random) : 1, phase = unit(random);
  const double stretch = shape == Shape::straight ? 0 : 0.02 * both(random);
  const double k = 2 * std::acos(0.0) * waves;
  std::vector<double> s{0};
  for (int i = 0; i < segments; ++i) s.push_back(s.back() + 0.3 + unit(random));
  Curve<Scalar> curve;
  for (const double position : s) {
    const double x = position / s.back();
    double w = amplitude * std::sin(k * x + phase), theta = -amplitude * k * std::cos(k * x + phase);
    double u = stretch * x;
    if (shape == Shape::ragged) {  // every piece its own arbitrary cubic; slopes to 60 degrees and more
      w = 0.5 * both(random) / segments;
      theta = 2 * both(random);
      u = 0.1 * both(random) / segments;
    }
    curve.nodes.push_back(
        {static_cast<Scalar>(x), static_cast<Scalar>(u), static_cast<Scalar>(w), static_cast<Scalar>(theta)});
  }
  return curve;
}
