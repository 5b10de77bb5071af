#include "kinegraph/trajectories/time_scaling.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline trajectories_internal {

ScalingState ScalingPhase::at(double tau) const {
  const auto& [s0, v, a, j] = begin;
  if (growth == 0.) {
    return {s0 + tau * (v + tau * (a / 2. + tau * j / 6.)), v + tau * (a + tau * j / 2.), a + tau * j, j};
  }
  // s - s0 = v S + a C, with sines S and C for a negative growth, hyperbolic sines for a positive one
  const double rate = std::sqrt(std::abs(growth)), angle = rate * tau;
  const bool grows = growth > 0.;
  const double sine = (grows ? std::sinh(angle) : std::sin(angle)) / rate;
  const double half = (grows ? std::sinh(angle / 2.) : std::sin(angle / 2.)) / rate;
  const double C = 2. * half * half, cosine = 1. + growth * C;
  const double speed = v * cosine + a * sine;
  return {s0 + v * sine + a * C, speed, a * cosine + v * growth * sine, growth * speed};
}

double ScalingPhase::squaredSpeed(double s) const {
  const double distance = s - begin.s;
  return begin.speed * begin.speed + distance * (2. * begin.acceleration + distance * growth);
}

const ScalingPhase& TimeScaling::phaseAt(double t) const {
  const auto after = std::upper_bound(phases_.begin(), phases_.end(), t,
                                      [](double time, const ScalingPhase& p) { return time < p.time; });
  return *(after == phases_.begin() ? after : after - 1);
}

namespace {

/// Returns the time at which a phase reaches the speed and acceleration of `end`. For growth -u^2 the point (v, a / u)
/// rotates at the rate u; for growth u^2, a + u v grows and a - u v decays with exp(u t).
double timeUntil(const ScalingPhase& phase, const ScalingState& end) {
  const ScalingState& begin = phase.begin;
  const double u = std::sqrt(std::abs(phase.growth));
  if (phase.growth == 0.) return 2. * (end.s - begin.s) / (begin.speed + end.speed);
  if (phase.growth < 0.)
    return (std::atan2(begin.acceleration / u, begin.speed) - std::atan2(end.acceleration / u, end.speed)) / u;
  if (begin.acceleration + end.acceleration >= 0.)
    return std::log((end.acceleration + u * end.speed) / (begin.acceleration + u * begin.speed)) / u;
  return std::log((begin.acceleration - u * begin.speed) / (end.acceleration - u * end.speed)) / u;
}

/// The same, with the rounding errors reduced by Newton steps.
double refinedTime(const ScalingPhase& phase, const ScalingState& end) {
  double time = timeUntil(phase, end);
  constexpr int kNewtonSteps = 2;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const ScalingState there = phase.at(time);
    const double mean = (end.s - phase.begin.s) / time;
    if (there.speed > .1 * mean) time -= (there.s - end.s) / there.speed;
  }
  return time;
}

}  // namespace

std::vector<ScalingPhase>::const_iterator TimeScaling::phaseTo(double s) const {
  return std::lower_bound(phases_.begin(), phases_.end(), s,
                          [](const ScalingPhase& p, double at) { return p.end < at; });
}

double TimeScaling::squaredSpeedAt(double s) const {
  const auto found = phaseTo(s);
  const ScalingPhase& phase = found == phases_.end() ? phases_.back() : *found;
  return std::max(0., phase.squaredSpeed(std::clamp(s, phase.begin.s, phase.end)));
}

double TimeScaling::timeOf(double s) const {
  const auto found = phaseTo(s);
  if (found == phases_.end()) return duration_;
  if (s <= found->begin.s) return found->time;
  const double until = found + 1 == phases_.end() ? duration_ : (found + 1)->time;
  double low = 0., high = until - found->time;
  if (s >= found->end) return until;
  if (found->begin.jerk == 0.) {
    const double distance = s - found->begin.s, square = found->squaredSpeed(s);
    const ScalingState there{s, std::sqrt(std::max(0., square)), found->begin.acceleration + found->growth * distance,
                             0.};
    const double time = refinedTime(*found, there);
    if (time >= 0. && time <= high) return found->time + time;
  }
  for (int i = 0; i < 60 && high - low > 1e-15 * duration_; ++i) {
    const double middle = (low + high) / 2.;
    (found->at(middle).s < s ? low : high) = middle;
  }
  return found->time + (low + high) / 2.;
}

void TimeScaling::add(ScalingPhase phase, double time) {
  phase.time = duration_;
  phases_.push_back(phase);
  duration_ += time;
}

void TimeScaling::addConstantAcceleration(double s0, double s1, double speed0, double speed1, double most, int piece) {
  const double acceleration = (speed1 - speed0) * (speed1 + speed0) / (2. * (s1 - s0));
  add({0., {s0, speed0, std::clamp(acceleration, -most, most), 0.}, 0., s1, piece}, 2. * (s1 - s0) / (speed0 + speed1));
}

void TimeScaling::addQuadratic(double s0, double s1, double first, double middle, double last, int piece) {
  const double h = s1 - s0;
  // s'' is half the slope of s'^2, and linear in s
  ScalingPhase phase{
      0., {s0, std::sqrt(first), (middle - first) / h, 0.}, (first - 2. * middle + last) / (h * h), s1, piece};
  const double largest = std::max({first, middle, last});
  constexpr double kNoGrowth = 1e-13;  // relative to s'^2, which then counts as linear
  if (std::abs(phase.growth) * h * h <= kNoGrowth * largest) phase.growth = 0.;
  add(phase, refinedTime(phase, {s1, std::sqrt(last), (last - middle) / h, 0.}));
}

void TimeScaling::append(const TimeScaling& other) {
  for (ScalingPhase phase : other.phases_) {
    phase.time += duration_;
    phases_.push_back(phase);
  }
  duration_ += other.duration_;
}

void TimeScaling::slowDown(double factor) {
  duration_ *= factor;
  for (ScalingPhase& phase : phases_) {
    phase.time *= factor;
    phase.begin.speed /= factor;
    phase.begin.acceleration /= factor * factor;
    phase.begin.jerk /= factor * factor * factor;
    phase.growth /= factor * factor;
  }
}

}  // namespace kinegraph::inline trajectories_internal
