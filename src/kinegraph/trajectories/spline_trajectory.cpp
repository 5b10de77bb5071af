#include "kinegraph/trajectories/trajectory.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

SplineTrajectory::SplineTrajectory(BSpline spline) : SplineTrajectory(spline, spline.isEmpty() ? 0. : spline.start()) {}

SplineTrajectory::SplineTrajectory(BSpline spline, double origin) : spline_(std::move(spline)), origin_(origin) {
  if (spline_.isEmpty())
    throw ValueError("SplineTrajectory: the spline has no control points; call BSpline::set first");
  if (!(spline_.end() >= origin_))
    throw ValueError(
        cat("SplineTrajectory: the spline ends at ", spline_.end(), " s, before the origin, ", origin_, " s"));
  duration_ = spline_.end() - origin_;
}

void SplineTrajectory::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  if (std::isnan(t)) throw ValueError("SplineTrajectory::eval: t is NaN; expected a time in s");
  const double end = spline_.end(), time = t >= duration_ ? end : origin_ + std::max(t, 0.);
  const double before = std::min(time, std::nextafter(end, spline_.start()));
  const Eigen::Index n = dimension();
  Eigen::Map<VectorXd>(q, n) = spline_.eval(time);
  Eigen::Map<VectorXd>(velocity, n) = spline_.eval(before, 1);
  Eigen::Map<VectorXd>(acceleration, n) = spline_.eval(before, 2);
}

}  // namespace kinegraph
