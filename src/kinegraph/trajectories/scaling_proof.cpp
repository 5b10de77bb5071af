#include "kinegraph/trajectories/scaling_proof.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr int kMaxProductDegree = 8;  // of b (q''' b + ...)^2 for a path of degree four
constexpr int kHalvings = 3;          // of an interval whose bound exceeds 1

constexpr double kBinomial[kMaxProductDegree + 1][kMaxProductDegree + 1] = {{1},
                                                                            {1, 1},
                                                                            {1, 2, 1},
                                                                            {1, 3, 3, 1},
                                                                            {1, 4, 6, 4, 1},
                                                                            {1, 5, 10, 10, 5, 1},
                                                                            {1, 6, 15, 20, 15, 6, 1},
                                                                            {1, 7, 21, 35, 35, 21, 7, 1},
                                                                            {1, 8, 28, 56, 70, 56, 28, 8, 1}};

/// Polynomials on [0, 1] in Bernstein form. Coefficients include the binomials, so that products are convolutions.
template <class Number, int kMost>
struct Bernstein {
  int degree = 0;
  std::array<Number, kMost + 1> c;

  template <class Other, int kMostOther>
  Bernstein<Number, kMost + kMostOther> operator*(const Bernstein<Other, kMostOther>& other) const {
    Bernstein<Number, kMost + kMostOther> product{degree + other.degree, {}};
    for (int i = 0; i <= product.degree; ++i) {
      const int first = std::max(0, i - degree), last = std::min(i, other.degree);
      product.c[i] = c[i - first] * other.c[first];
      for (int k = first + 1; k <= last; ++k) product.c[i] += c[i - k] * other.c[k];
    }
    return product;
  }
  Bernstein<Number, kMost> derivative() const {
    Bernstein<Number, kMost> rate{std::max(0, degree - 1), {}};
    if (degree == 0) rate.c[0] = Number(c[0] * 0.);
    for (int i = 0; i < degree; ++i)
      rate.c[i] = (degree * kBinomial[rate.degree][i]) *
                  (c[i + 1] * (1. / kBinomial[degree][i + 1]) - c[i] * (1. / kBinomial[degree][i]));
    return rate;
  }
  template <int kMostOther>
  void add(const Bernstein<Number, kMostOther>& other, double factor) {  // of the same degree
    for (int i = 0; i <= degree; ++i) c[i] += factor * other.c[i];
  }
  /// Bounds |value| per lane by the coefficients.
  Number coefficientBound() const {
    Number bound = c[0].abs();
    for (int i = 1; i <= degree; ++i) bound = bound.max(c[i].abs() * (1. / kBinomial[degree][i]));
    return bound;
  }
  /// The same, refined by halving the interval if the bound exceeds 1.
  Number bound(int halvings) const {
    const Number bound = coefficientBound();
    if (halvings == 0 || (bound <= 1.).all()) return bound;
    Bernstein first = *this, second = *this;  // de Casteljau
    std::array<Number, kMost + 1> x;
    for (int i = 0; i <= degree; ++i) x[i] = c[i] * (1. / kBinomial[degree][i]);
    for (int round = 0; round <= degree; ++round) {
      first.c[round] = x[0] * kBinomial[degree][round];
      second.c[degree - round] = x[degree - round] * kBinomial[degree][degree - round];
      for (int i = 0; i < degree - round; ++i) x[i] = (x[i] + x[i + 1]) * .5;
    }
    return first.bound(halvings - 1).max(second.bound(halvings - 1));
  }
};

using Speed = Bernstein<double, 2>;

Speed speedOf(const std::array<double, 3>& b) { return {2, {b[0], 2. * b[1], b[2]}}; }

template <class Tangent>
auto tangentOf(const Tangent& tangent, int degree) {
  Bernstein<typename Tangent::value_type, int(std::tuple_size_v<Tangent>) - 1> q1{degree, {}};
  for (int k = 0; k <= degree; ++k) q1.c[k] = tangent[k] * kBinomial[degree][k];
  return q1;
}

/// Bounds sqrt(b) |p|: by the bounds of p and b if their product is at most 1, else by the polynomial b p^2.
template <class Polynomial>
double shareOf(const Polynomial& p, const Speed& speed, double most_speed) {
  const auto together = (p.coefficientBound() * std::sqrt(most_speed)).eval();
  if ((together <= 1.).all()) return together.maxCoeff();
  return (p * p * speed).bound(kHalvings).min(together.square()).sqrt().maxCoeff();
}

}  // namespace

ScalingProof::ScalingProof(const ScalingGrid& grid, const MotionLimits& limits) : grid_(grid) {
  const int dofs = grid.curve().dofs();
  for (int first = 0; first < dofs; first += kLanes) {
    Inverse inverse{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    for (int j = first; j < std::min(dofs, first + kLanes); ++j) {
      inverse.velocity[j - first] = 1. / limits.velocity[j];
      inverse.acceleration[j - first] = 1. / limits.acceleration[j];
      if (limits.limitsJerk()) inverse.jerk[j - first] = 1. / limits.jerk[j];
    }
    inverse.limits_jerk = (inverse.jerk > 0.).any();
    inverse_.push_back(inverse);
  }
}

double ScalingProof::velocityShare(const Tangent& tangent, const std::array<double, 3>& b, double most_speed,
                                   const Inverse& inverse) const {
  auto q1 = tangentOf(tangent, grid_.degree());
  for (int k = 0; k <= q1.degree; ++k) q1.c[k] *= inverse.velocity;
  return shareOf(q1, speedOf(b), most_speed);
}

/// q' b'/2 + q'' b, with derivatives by s relative to the interval's width.
double ScalingProof::accelerationShare(const Tangent& tangent, const std::array<double, 3>& b,
                                       const Inverse& inverse) const {
  const auto q1 = tangentOf(tangent, grid_.degree());
  const Speed speed = speedOf(b);
  auto acceleration = q1 * speed.derivative();
  for (int k = 0; k <= acceleration.degree; ++k) acceleration.c[k] *= .5;
  if (q1.degree > 0) acceleration.add(q1.derivative() * speed, 1.);
  for (int k = 0; k <= acceleration.degree; ++k) acceleration.c[k] *= inverse.acceleration;
  return acceleration.bound(kHalvings).maxCoeff();
}

/// sqrt(b) (q''' b + 3/2 q'' b' + 1/2 q' b''), likewise.
double ScalingProof::jerkShare(const Tangent& tangent, const std::array<double, 3>& b, double most_speed,
                               const Inverse& inverse) const {
  const auto q1 = tangentOf(tangent, grid_.degree());
  const Speed speed = speedOf(b), slope = speed.derivative();
  auto jerk = q1;
  const double half_curve = .5 * slope.derivative().c[0];
  for (int k = 0; k <= jerk.degree; ++k) jerk.c[k] *= half_curve;
  if (q1.degree > 0) jerk.add(q1.derivative() * slope, 1.5);
  if (q1.degree > 1) jerk.add(q1.derivative().derivative() * speed, 1.);
  for (int k = 0; k <= jerk.degree; ++k) jerk.c[k] *= inverse.jerk;
  return shareOf(jerk, speed, most_speed);
}

std::array<double, 3> ScalingProof::shares(int interval, const std::array<double, 3>& b) const {
  const auto tangent = grid_.tangent(interval);
  const double most_speed = std::max({b[0], b[1], b[2]}), h = grid_.width(interval);
  std::array<double, 3> shares{};
  for (std::size_t n = 0; n < inverse_.size(); ++n) {
    const auto first = Eigen::Index(n) * kLanes, count = std::min(Eigen::Index(kLanes), tangent.rows() - first);
    Tangent of_dofs;
    for (int k = 0; k <= grid_.degree(); ++k) {
      of_dofs[k].setZero();
      for (Eigen::Index j = 0; j < count; ++j) of_dofs[k][j] = tangent(first + j, k);
    }
    shares[0] = std::max(shares[0], velocityShare(of_dofs, b, most_speed, inverse_[n]));
    Inverse scaled = inverse_[n];
    scaled.acceleration /= h;
    shares[1] = std::max(shares[1], accelerationShare(of_dofs, b, scaled));
    if (!scaled.limits_jerk) continue;
    scaled.jerk /= h * h;
    shares[2] = std::max(shares[2], jerkShare(of_dofs, b, most_speed, scaled));
  }
  return shares;
}

}  // namespace kinegraph::inline trajectories_internal
