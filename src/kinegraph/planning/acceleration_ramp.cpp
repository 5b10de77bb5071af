#include "kinegraph/planning/acceleration_ramp.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kGentle = .5, kMost = .98;  // shares of the jerk limit
constexpr double kLeastTime = .02;           // s, of a ramp that need not be shorter; timings have coarser grids
constexpr double kBelow = .999;              // of the velocity limit, which is not exceeded
constexpr double kHardly = .05;              // of the initial speed: a slower end counts as a stop

/// The share of the jerk limit with which a dof keeps its velocity limit.
double shareOf(double velocity, double acceleration, double most_velocity, double most_jerk) {
  const double gentle = std::min(kGentle, std::abs(acceleration) / (most_jerk * kLeastTime));
  if (velocity * acceleration <= 0.) return gentle;
  const double slack = kBelow * most_velocity - std::abs(velocity);
  const double needed = slack > 0. ? acceleration * acceleration / (2. * most_jerk * slack) : kMost;
  return std::clamp(needed, gentle, kMost);
}

}  // namespace

AccelerationRamp rampDown(const VectorXd& q, const VectorXd& velocity, const VectorXd& acceleration,
                          const MotionLimits& limits) {
  const Eigen::Index n = q.size();
  VectorXd jerk = VectorXd::Zero(n), until = VectorXd::Zero(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    if (acceleration[j] == 0.) continue;
    const double most = std::isfinite(limits.jerk[j]) ? limits.jerk[j] : std::abs(acceleration[j]) * 1e3;
    jerk[j] = -std::copysign(shareOf(velocity[j], acceleration[j], limits.velocity[j], most) * most, acceleration[j]);
    until[j] = acceleration[j] / -jerk[j];
  }
  AccelerationRamp ramp{{}, q, velocity + .5 * acceleration.cwiseProduct(until)};
  const double speed = ramp.velocity.norm();
  std::vector<double> knots(until.begin(), until.end());
  std::sort(knots.begin(), knots.end());
  PathCurve::Parts parts{int(n), 3, speed * knots.back(), {}, {0., speed * knots.back()}, {}, {}, {}};
  VectorXd v = velocity, a = acceleration;
  double time = 0.;
  for (const double knot : knots) {  // in s = speed * time
    const double step = knot - time;
    if (!(step > 1e-9 * knots.back())) continue;
    VectorXd j = jerk;
    for (Eigen::Index i = 0; i < n; ++i)
      if (until[i] <= time + 1e-9 * knots.back()) j[i] = a[i] = 0.;
    parts.begin.push_back(speed * time);
    parts.is_line.push_back(false);
    parts.stops.push_back(false);
    for (const VectorXd& c :
         {ramp.q, VectorXd(v / speed), VectorXd(a / (2. * speed * speed)), VectorXd(j / (6. * speed * speed * speed))})
      parts.coefficients.insert(parts.coefficients.end(), c.begin(), c.end());
    ramp.q += step * (v + step * (.5 * a + step / 6. * j));
    v += step * (a + .5 * step * j);
    a += step * j;
    time = knot;
  }
  ramp.velocity = v;
  if (speed > kHardly * velocity.norm()) ramp.curve = PathCurve::fromParts(parts);
  return ramp;
}

std::vector<VectorXd> bernsteinOf(const PathCurve& curve, int piece) {
  const int degree = curve.degree();
  const double width = curve.end(piece) - curve.begin(piece);
  std::vector<VectorXd> points;
  for (int k = 0; k <= degree; ++k) {  // sum over powers i <= k of C(k, i) / C(degree, i) width^i c_i
    VectorXd point = VectorXd::Zero(curve.dofs());
    double factor = 1.;
    for (int i = 0; i <= k; ++i) {
      point += factor * Eigen::Map<const VectorXd>(curve.coefficient(piece, i), curve.dofs());
      factor *= width * double(k - i) / double(degree - i);
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace kinegraph::inline planning_internal
