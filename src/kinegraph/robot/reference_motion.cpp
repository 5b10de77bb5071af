#include "kinegraph/robot/reference_motion.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline robot_internal {

namespace {

constexpr double kTickRounding = 1e-9;  // of a period: in differences of control times

}  // namespace

MatrixXd ReferenceMotion::Part::eval(double time) const {
  if (!trajectory) return spline.eval3(time);
  double t = time - begin;
  const double first = firstPeriod(begin, period), sample = first + std::round((t - first) / period) * period;
  if (std::abs(t - sample) <= kTickRounding * period) t = sample;
  const MotionState state = trajectory->eval(t);
  MatrixXd values(3, state.q.size());
  values << state.q.transpose(), state.velocity.transpose(), state.acceleration.transpose();
  if (time >= end()) values.bottomRows(2).setZero();
  return values;
}

double ReferenceMotion::firstPeriod(double begin, double period) {
  return std::max(0., std::ceil(begin / period - kTickRounding) * period - begin);
}

void ReferenceMotion::add(const BSpline& spline, double begin, double now) {
  add(Part{begin, spline, nullptr, 0.}, now);
}

void ReferenceMotion::add(std::shared_ptr<const SampledTrajectory> trajectory, double begin, double now,
                          double period) {
  add(Part{begin, {}, std::move(trajectory), period}, now);
}

void ReferenceMotion::add(Part part, double now) {
  while (!parts_.empty() && (part.begin <= now || parts_.back().begin >= part.begin)) parts_.pop_back();
  while (parts_.size() > 1 && parts_[1].begin <= now) parts_.erase(parts_.begin());
  parts_.push_back(std::move(part));
}

MatrixXd ReferenceMotion::eval(double time) const {
  std::size_t i = parts_.size() - 1;
  while (i > 0 && parts_[i].begin > time) --i;
  return parts_[i].eval(time);
}

}  // namespace kinegraph::inline robot_internal
