#include "kinegraph/spline/law_proof.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr int kMostDegree = 8;  // of b (q''' b + ...)^2 for a path of degree four

constexpr double kBinomial[kMostDegree + 1][kMostDegree + 1] = {{1},
                                                                {1, 1},
                                                                {1, 2, 1},
                                                                {1, 3, 3, 1},
                                                                {1, 4, 6, 4, 1},
                                                                {1, 5, 10, 10, 5, 1},
                                                                {1, 6, 15, 20, 15, 6, 1},
                                                                {1, 7, 21, 35, 35, 21, 7, 1},
                                                                {1, 8, 28, 56, 70, 56, 28, 8, 1}};

/// A polynomial on [0, 1] in Bernstein form, its coefficients times the binomials, so that products are convolutions.
struct Bernstein {
  int degree = 0;
  std::array<double, kMostDegree + 1> c{};

  Bernstein operator*(const Bernstein& other) const {
    Bernstein product{degree + other.degree, {}};
    for (int i = 0; i <= degree; ++i)
      for (int k = 0; k <= other.degree; ++k) product.c[i + k] += c[i] * other.c[k];
    return product;
  }
  /// Both of the same degree.
  Bernstein plus(const Bernstein& other, double factor) const {
    Bernstein sum = *this;
    for (int i = 0; i <= degree; ++i) sum.c[i] += factor * other.c[i];
    return sum;
  }
  /// Times h: of the interval's length.
  Bernstein derivative() const {
    Bernstein rate{std::max(0, degree - 1), {}};
    for (int i = 0; i < degree; ++i)
      rate.c[i] =
          degree * (c[i + 1] / kBinomial[degree][i + 1] - c[i] / kBinomial[degree][i]) * kBinomial[rate.degree][i];
    return rate;
  }
  Bernstein times(double factor) const {
    Bernstein product = *this;
    for (double& x : product.c) x *= factor;
    return product;
  }
  /// At least the largest |value|.
  double most() const {
    double most = 0.;
    for (int i = 0; i <= degree; ++i) most = std::max(most, std::abs(c[i]) / kBinomial[degree][i]);
    return most;
  }
  /// The same; where coefficients are beyond `enough`, those of halves tell more.
  double bound(double enough, int halvings = 3) const {
    const double most = this->most();
    if (most <= enough || halvings == 0) return most;
    Bernstein first = *this, second = *this;  // de Casteljau
    std::array<double, kMostDegree + 1> x{};
    for (int i = 0; i <= degree; ++i) x[i] = c[i] / kBinomial[degree][i];
    for (int round = 0; round <= degree; ++round) {
      first.c[round] = x[0] * kBinomial[degree][round];
      second.c[degree - round] = x[degree - round] * kBinomial[degree][degree - round];
      for (int i = 0; i < degree - round; ++i) x[i] = (x[i] + x[i + 1]) / 2.;
    }
    return std::max(first.bound(enough, halvings - 1), second.bound(enough, halvings - 1));
  }
};

/// At least the share of a limit that sqrt(b) |p| uses. The largest p and the largest b say enough where both together
/// keep the limit; else their product is looked at.
double shareOf(const Bernstein& p, const Bernstein& speed, double most_speed, double limit) {
  const double together = p.most() * std::sqrt(most_speed);
  if (together <= limit) return together / limit;
  return std::sqrt((p * p * speed).bound(limit * limit)) / limit;
}

}  // namespace

std::array<double, 3> limitShares(const LawGrid& grid, int interval, const std::array<double, 3>& b,
                                  const MotionLimits& limits) {
  const double h = grid.width(interval);
  const auto tangent = grid.tangent(interval);
  const Bernstein speed{2, {b[0], 2. * b[1], b[2]}}, slope = speed.derivative(), curve = slope.derivative();
  const double most_speed = speed.most();
  std::array<double, 3> shares{};
  for (int j = 0; j < tangent.rows(); ++j) {
    Bernstein q1{grid.degree(), {}};
    for (int k = 0; k <= q1.degree; ++k) q1.c[k] = tangent(j, k) * kBinomial[q1.degree][k];
    const Bernstein q2 = q1.derivative(), q3 = q2.derivative();
    const int m = q1.degree;
    shares[0] = std::max(shares[0], shareOf(q1, speed, most_speed, limits.velocity[j]));
    Bernstein acceleration = (q1 * slope).times(.5);
    if (m > 0) acceleration = acceleration.plus(q2 * speed, 1.);
    const double most_acceleration = h * limits.acceleration[j];
    shares[1] = std::max(shares[1], acceleration.bound(most_acceleration) / most_acceleration);
    if (!limits.limitsJerk() || !std::isfinite(limits.jerk[j])) continue;
    Bernstein jerk = (q1 * curve).times(.5);
    if (m > 0) jerk = jerk.plus(q2 * slope, 1.5);
    if (m > 1) jerk = jerk.plus(q3 * speed, 1.);
    const double most_jerk = h * h * limits.jerk[j];
    shares[2] = std::max(shares[2], shareOf(jerk, speed, most_speed, most_jerk));
  }
  return shares;
}

}  // namespace kinegraph
