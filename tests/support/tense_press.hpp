// The press of a von Kármán beam between ends that hold u, by brute force: EI w'''' = N w'' on both sides of the contact, the eight
// constants of its solutions from eight linear equations, ½∫w'² by quadrature, and N by regula falsi.  In long double.
// It shares no code with the library.
#pragma once

#include <cmath>

#include <Eigen/LU>

#include <hapbeam/support.hpp>

namespace hapbeam::testing {

class TensePress {
  using Real = long double;

 public:
  /// @param drawn  by how much the ends are further apart than the beam is long [m]
  TensePress(double length, double EA, double EI, Support left, Support right, double drawn = 0)
      : L_(length), EA_(EA), EI_(EI), left_(left), right_(right), drawn_(drawn) {}

  /// @return force [N] of a press by d [m] at s [m]
  double operator()(double s, double d) {
    s_ = s, d_ = d;
    const Real least = EA_ * drawn_ / L_;
    // By regula falsi over √N, where Illinois' halving keeps both ends moving.
    const auto lack = [&](Real root) {
      return solve(root * root), (root * root - least) * L_ / EA_ - longer(L_);
    };
    Real low = std::sqrt(least), high = std::sqrt(least + EI_ / (L_ * L_));
    while (lack(high) < 0) low = high, high *= 2;
    if (low == 0) low = high * 1e-3L;
    Real below = lack(low), above = lack(high);
    for (int i = 0; i < 60 && high - low > 1e-16L * high; ++i) {
      const Real root = (low * above - high * below) / (above - below), at = lack(root);
      if (std::abs(at) < 1e-17L * std::abs(root * root * L_ / EA_)) break;
      if (at < 0) low = root, below = at, above /= 2;
      else high = root, above = at, below /= 2;
    }
    return static_cast<double>(EI_ * (bend(1, s, 3) - bend(0, s, 3)));
  }
  double tension() const { return static_cast<double>(N_); }
  double w(double x) const { return static_cast<double>(bend(side(x), x, 0)); }
  double slope(double x) const { return static_cast<double>(bend(side(x), x, 1)); }
  double moment(double x) const { return static_cast<double>(-EI_ * bend(side(x), x, 2)); }
  double shear(double x) const { return static_cast<double>(-EI_ * bend(side(x), x, 3)); }
  /// From the left end's place.
  double u(double x) const { return static_cast<double>(N_ / EA_ * x - longer(x)); }

 private:
  int side(double x) const { return x > s_; }

  /// n-th derivative of the k-th solution: 1, x, e^-kx, e^-k(l - x).
  Real solution(int piece, Real x, int k, int n) const {
    const Real from = piece == 0 ? 0 : s_, to = piece == 0 ? s_ : L_;
    if (k == 0) return n == 0;
    if (k == 1) return n == 0 ? (x - from) / L_ : n == 1 ? 1 / L_ : 0;
    if (k == 2) return std::pow(-k_, n) * std::exp(-k_ * (x - from));
    return std::pow(k_, n) * std::exp(-k_ * (to - x));
  }
  Real bend(int piece, Real x, int n) const {
    Real sum = 0;
    for (int k = 0; k < 4; ++k) sum += constants_[4 * piece + k] * solution(piece, x, k, n);
    return sum;
  }
  void solve(Real N) {
    N_ = N, k_ = std::sqrt(N / EI_);
    Eigen::Matrix<Real, 8, 8> A = Eigen::Matrix<Real, 8, 8>::Zero();
    Eigen::Matrix<Real, 8, 1> b = Eigen::Matrix<Real, 8, 1>::Zero();
    int row = 0;
    const auto add = [&](int piece, Real x, int n, Real times) {
      for (int k = 0; k < 4; ++k)
        A(row, 4 * piece + k) += times * solution(piece, x, k, n) * std::pow(1 / k_, n);
    };
    const auto end = [&](int piece, Real x, Support support) {
      if (fixes_w(support)) add(piece, x, 0, 1);
      else add(piece, x, 3, 1), add(piece, x, 1, -1);  // no force across: EI w''' = N w'
      ++row;
      add(piece, x, fixes_theta(support) ? 1 : 2, 1), ++row;
    };
    end(0, 0, left_);
    end(1, L_, right_);
    for (const int piece : {0, 1}) add(piece, s_, 0, 1), b[row] = d_, ++row;
    for (const int n : {1, 2}) add(0, s_, n, 1), add(1, s_, n, -1), ++row;
    constants_ = A.fullPivLu().solve(b);
  }
  /// ½∫w'² on a part of a piece, by Gauss' rule.
  Real square(int piece, Real from, Real to) const {
    static const Real at[] = {0.1834346424956498049394761L, 0.5255324099163289858177390L,
                              0.7966664774136267395915539L, 0.9602898564975362316835609L};
    static const Real weight[] = {0.3626837833783619829651504L, 0.3137066458778872873379622L,
                                  0.2223810344533744705443560L, 0.1012285362903762591525314L};
    Real sum = 0;
    const int parts = 2 + static_cast<int>(k_ * (to - from) / 2);
    const Real half = (to - from) / (2 * parts);
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < 4; ++j)
        for (const int sign : {-1, 1}) {
          const Real slope = bend(piece, from + (2 * i + 1 + sign * at[j]) * half, 1);
          sum += half * weight[j] * slope * slope / 2;
        }
    return sum;
  }
  /// The same from the left end to a place.
  Real longer(Real to) const {
    Real sum = 0;
    for (const int piece : {0, 1}) {
      const Real from = piece == 0 ? 0 : s_, end = std::min(piece == 0 ? Real(s_) : L_, to);
      if (end <= from) continue;
      // Beyond the layers at its ends the piece is straight.
      const Real layer = 45 / k_, whole = piece == 0 ? s_ : L_ - s_, start = piece == 0 ? 0 : s_;
      if (whole < 2 * layer) {
        sum += square(piece, from, end);
        continue;
      }
      const Real first = start + layer, last = start + whole - layer,
                 slope = bend(piece, start + whole / 2, 1);
      sum += square(piece, from, std::min(end, first));
      if (end > first) sum += slope * slope / 2 * (std::min(end, last) - first);
      if (end > last) sum += square(piece, last, end);
    }
    return sum;
  }

  Real L_, EA_, EI_;
  Support left_, right_;
  Real drawn_, s_ = 0, d_ = 0, N_ = 0, k_ = 0;
  Eigen::Matrix<Real, 8, 1> constants_;
};

}  // namespace hapbeam::testing
