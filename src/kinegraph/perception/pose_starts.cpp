#include <algorithm>
#include <cmath>

#include "kinegraph/perception/registration.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kNearStart = .03;     // m, reached from the last place
constexpr double kStepOfStarts = .06;  // m, of a joint; less for small search radii

}  // namespace

std::vector<RigidTransform> Registration::starts(const Thing& thing, const RigidTransform& from, bool wide) const {
  std::vector<RigidTransform> starts;
  const PoseFreedom& freedom = thing.freedom;
  Vector6d move = Vector6d::Zero();
  if (freedom.hasJoint()) {
    const int count = std::max(2, int(std::ceil(thing.search / kStepOfStarts)));  // on each side
    for (int i = 0; i <= 2 * count; ++i) {
      const double at = (i % 2 == 0 ? .5 : -.5) * (i + i % 2) * 1.6 / count * thing.search;
      move << at * freedom.axis, 6. * at * freedom.axis;
      starts.push_back(freedom.moved(from, move));
    }
    return starts;
  }
  const Vector3d middle = from * thing.middle();
  const auto around = [&](const Matrix3d& R, std::initializer_list<double> angles) {
    for (const double angle : angles) {
      const Matrix3d turned = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix() * R;
      starts.push_back({turned, middle - turned * thing.middle()});
    }
  };
  if (!wide) {
    around(from.R, {0., .4, -.4, .8, -.8, 1.571});
    return starts;
  }
  for (const int axis : {0, 1}) {  // it may have slid along itself
    for (const double by : {kNearStart, -kNearStart}) starts.push_back({from.R, from.p + by * Vector3d::Unit(axis)});
  }
  if (freedom.kind != PoseFreedom::Kind::resting) {
    around(from.R, {1.2, -1.2, 1.8, -1.8, 2.4, -2.4, 3.1});
    return starts;
  }
  std::vector<Vector3d> tried;
  for (const Vector3d& down : thing.shape.restingDirections()) {
    const bool is_new = std::none_of(tried.begin(), tried.end(), [&](const Vector3d& t) { return t.dot(down) > .8; });
    if (!is_new || tried.size() > 8) continue;
    tried.push_back(down);
    const Matrix3d R = Quaterniond::FromTwoVectors(from.R * down, -Vector3d::UnitZ()).toRotationMatrix() * from.R;
    around(R, {0., .785, 1.571, 2.356, 3.142, -.785, -1.571, -2.356});
  }
  return starts;
}

/// Whether a pose leaves measured points beside the surface unexplained, or surface that a camera looked through.
bool Registration::isDoubtful(const Thing& thing, const std::vector<int>& owners) const {
  constexpr double kFewThrough = .04, kMostExplained = .92;
  const SurfaceCounts counts = countSurface(thing.shape, thing.best.X, views_, kFineSamples);
  return counts.through > kFewThrough * (counts.agree + counts.through) ||
         explainedBeside(thing, owners) < kMostExplained;
}

void Registration::tryStarts(const Thing& thing, int index, const std::vector<int>& owners, const RigidTransform& from,
                             bool wide, std::vector<PoseCandidate>& candidates) const {
  const FitPoints fine =
      pointsNear(thing, index, owners, thing.start.p, thing.shape.radius() + thing.search, kFinePoints);
  FitPoints coarse{{}, fine.keep_out};
  const std::size_t step = std::max<std::size_t>(1, fine.measured.size() / kCoarsePoints);
  for (std::size_t i = 0; i < fine.measured.size(); i += step) coarse.measured.push_back(fine.measured[i]);
  const auto tryStart = [&](RigidTransform X) {
    fitPose(thing.shape, thing.freedom, coarse, views_, kCoarseWidths, kCoarseSamples, X);
    candidates.push_back({X, valueOf(thing, index, fine, X), 0.});
  };
  std::vector<RigidTransform> begin = starts(thing, from, wide);
  if (index >= 0 && thing.score < kSureScore && !thing.freedom.hasJoint()) {  // at points that nothing explains
    const Vector3d middle = thing.start * thing.middle();
    for (const Vector3d& place : placesOfPoints(owners, std::min(thing.shape.radius(), kNearStart))) {
      const Vector3d shift(place.x() - middle.x(), place.y() - middle.y(), 0.);
      if (shift.norm() < kNearStart || shift.norm() > thing.search + .01) continue;
      const std::vector<RigidTransform> around = starts(thing, thing.start, wide);
      for (const RigidTransform& X : around) begin.push_back({X.R, X.p + shift});
    }
  }
  for (const RigidTransform& X : begin) {
    if (thing.freedom.kind != PoseFreedom::Kind::resting)
      tryStart(X);
    else
      for (const double height : thing.heights) tryStart(restingPose(thing.shape, X, height));
  }
}

}  // namespace kinegraph::inline perception_internal
