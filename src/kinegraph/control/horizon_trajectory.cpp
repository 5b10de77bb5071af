#include "kinegraph/control/mpc.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kExceeded = 1e-9;  // relative: rounding

/// A position, with velocity and acceleration, of one dof.
struct DofState {
  double q, velocity, acceleration;
};

/// An interval of one dof: its length, the velocities at both ends, and its mean velocity.
struct VelocityInterval {
  double length, from, to, mean;

  /// The velocity of the cubic has the Bernstein coefficients from, middle, to.
  double middle() const { return 3. * mean - from - to; }

  /// Returns whether the cubic is nowhere faster than `most`.
  bool isCubicWithin(double most) const {
    const double m = middle(), bend = from - 2. * m + to, s = bend == 0. ? 0. : (from - m) / bend;
    const double peak = s > 0. && s < 1. ? from + s * (2. * (m - from) + s * bend) : 0.;
    return std::max({std::abs(from), std::abs(to), std::abs(peak)}) <= most;
  }

  DofState cubicAt(double time) const {
    const double s = time / length, m = middle(), bend = from - 2. * m + to;
    return {length * s * (from + s * (m - from + s * bend / 3.)), from + s * (2. * (m - from) + s * bend),
            2. * (m - from + s * bend) / length};
  }

  /// Returns the state on the motion whose velocity changes linearly to a constant one in between, over the longest
  /// equal times at both ends for which that is at most `most`.
  DofState rampAt(double time, double most) const {
    const double ends = .5 * (from + to);
    double ramp = .5;  // share of the interval
    if (ends < most) ramp = std::min(ramp, (most - mean) / (most - ends));
    if (ends > -most) ramp = std::min(ramp, (most + mean) / (most + ends));
    ramp = std::max(ramp, 0.);
    const double cruise = (mean - ramp * ends) / (1. - ramp), width = ramp * length;
    const double first = .5 * width * (from + cruise), left = length - time;
    if (time < width) {
      const double a = (cruise - from) / width;
      return {time * (from + .5 * a * time), from + a * time, a};
    }
    if (left < width) {
      const double a = (to - cruise) / width;
      return {mean * length - left * (to - .5 * a * left), to - a * left, a};
    }
    return {first + cruise * (time - width), cruise, 0.};
  }
};

}  // namespace

HorizonTrajectory::HorizonTrajectory(std::vector<double> times, MatrixXd q, VectorXd velocity)
    : times_(std::move(times)), q_(std::move(q)) {
  findVelocities(velocity);
}

void HorizonTrajectory::assign(std::span<const double> times, const Eigen::Ref<const MatrixXd>& q,
                               const Eigen::Ref<const VectorXd>& velocity) {
  times_.assign(times.begin(), times.end());
  q_ = q;
  findVelocities(velocity);
}

void HorizonTrajectory::findVelocities(const Eigen::Ref<const VectorXd>& velocity) {
  const auto last = int(times_.size()) - 1;
  if (last < 0 || q_.cols() != last + 1 || velocity.size() != q_.rows())
    throw ValueError(cat("Mpc: got ", times_.size(), " times, q of shape (", q_.rows(), ", ", q_.cols(), ") and ",
                         velocity.size(), " velocities; expected K >= 1 times, (n, K) and n"));
  velocity_.resize(q_.rows(), q_.cols());
  velocity_.col(0) = velocity;
  for (int k = 1; k <= last; ++k) {
    const int next = std::min(k + 1, last);
    velocity_.col(k) = (q_.col(next) - q_.col(k - 1)) / (times_[std::size_t(next)] - times_[std::size_t(k) - 1]);
  }
  limitVelocities();
}

/// Moves the velocities at the points into the range in which no adjacent cubic exceeds the largest velocity: each of
/// its Bernstein coefficients is within it.
void HorizonTrajectory::limitVelocities() {
  const int n = dimension(), last = int(times_.size()) - 1;
  largest_.setZero(n);
  for (int k = 1; k < last; ++k)
    for (int j = 0; j < n; ++j) largest_[j] = std::max(largest_[j], std::abs(secant(j, k)));
  largest_first_ = largest_.cwiseMax(velocity_.col(0).cwiseAbs());
  for (int j = 0; j < n && last > 0; ++j) largest_first_[j] = std::max(largest_first_[j], std::abs(secant(j, 0)));
  if (last == 1) largest_ = largest_first_;
  for (int k = 1; k <= last; ++k) {
    for (int j = 0; j < n; ++j) {
      double low = -largest_[j], high = largest_[j];
      for (int interval = k - 1; interval <= std::min(k, last - 1); ++interval) {
        const double mean = 3. * secant(j, interval), most = largest(j, interval);
        const double other = interval == 0 ? velocity_(j, 0) : 0.;  // fixed; otherwise both ends share the range
        const double share = interval == 0 ? 1. : .5;
        low = std::max(low, share * (mean - most) - other);
        high = std::min(high, share * (mean + most) - other);
      }
      double& velocity = velocity_(j, k);
      velocity =
          low <= high ? std::clamp(velocity, low, high) : std::clamp(.5 * (low + high), -largest_[j], largest_[j]);
    }
  }
}

void HorizonTrajectory::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  if (std::isnan(t)) throw ValueError("Mpc: t is NaN; expected a time in s");
  t = std::clamp(t, 0., duration());
  const auto after = times_.size() == 1 ? times_.end() : std::lower_bound(times_.begin() + 1, times_.end(), t);
  const int k = int(std::min(after, times_.end() - 1) - times_.begin()) - 1;
  for (int j = 0; j < dimension(); ++j) {
    DofState state{0., velocity_(j, 0), 0.};
    if (k >= 0) {
      const double begin = times_[std::size_t(k)], most = (1. + kExceeded) * largest(j, k);
      const VelocityInterval interval{times_[std::size_t(k) + 1] - begin, velocity_(j, k), velocity_(j, k + 1),
                                      secant(j, k)};
      state = interval.isCubicWithin(most) ? interval.cubicAt(t - begin) : interval.rampAt(t - begin, most);
    }
    q[j] = q_(j, std::max(k, 0)) + state.q, velocity[j] = state.velocity, acceleration[j] = state.acceleration;
  }
}

}  // namespace kinegraph
