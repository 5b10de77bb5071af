#include "kinegraph/planning/plan_timing.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kDefaultVelocity = 1.;  // rad/s, m/s
constexpr double kTimeToSpeed = .25;     // s
constexpr double kBothMove = 2.;         // both bodies of a pair

VectorXd perDof(const VectorXd& limit, int dofs) {
  return limit.size() == 1 ? VectorXd::Constant(dofs, limit[0]) : limit;
}

}  // namespace

MotionLimits planLimits(const Config& config, const PlanOptions& options) {
  const int n = config.getJointDimension();
  MotionLimits limits;
  limits.velocity = options.velocity.size() > 0 ? perDof(options.velocity, n) : getVelocityLimits(config);
  for (double& velocity : limits.velocity)
    if (!std::isfinite(velocity)) velocity = kDefaultVelocity;
  limits.acceleration =
      options.acceleration.size() > 0 ? perDof(options.acceleration, n) : VectorXd(limits.velocity / kTimeToSpeed);
  if (options.jerk.size() > 0) limits.jerk = perDof(options.jerk, n);
  return limits;
}

BlendCheck collisionFreeBlends(Steering& steering) {
  const auto shared_state = std::make_shared<State>(steering.check().scene());
  return [shared_state, &steering](const MatrixXd& points, double deviation) {
    State& state = *shared_state;
    for (Eigen::Index k = 1; k < points.rows(); ++k) {
      const VectorXd to = points.row(k).transpose();
      const VectorXd from = points.row(k - 1).transpose();
      if (!steering.manifold().holdsAlong(from, to, Steering::kSpacing, deviation)) return false;
      const VectorXd change = VectorXd::Constant(from.size(), deviation);
      const VectorXd spread = .5 * (to - from).cwiseAbs() + change;  // from the closer end
      double displacement = 0.;
      for (const VectorXd* q : {&from, &to}) {
        state.setJoints(q->data());
        displacement = std::max(displacement, displacementBound(state, change, spread));
      }
      if (!steering.check().isMotionFree(from, to, kBothMove * displacement)) return false;
    }
    return true;
  };
}

bool isFree(Steering& steering, const PathCurve& curve, int parts_of_piece) {
  const BlendCheck is_free = collisionFreeBlends(steering);
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double begin = curve.begin(piece), width = curve.end(piece) - begin;
    const int parts = curve.isLine(piece) ? 1 : parts_of_piece;
    double curvature = 0.;  // bound of |q''|
    for (int power = 2; power <= curve.degree() && !curve.isLine(piece); ++power)
      curvature += power * (power - 1) * std::pow(width, power - 2) *
                   Eigen::Map<const VectorXd>(curve.coefficient(piece, power), curve.dofs()).cwiseAbs().maxCoeff();
    MatrixXd points(parts + 1, curve.dofs());
    for (int k = 0; k <= parts; ++k) points.row(k) = curve.eval(begin + k * width / parts).transpose();
    if (!is_free(points, width * width / (parts * parts) / 8. * curvature)) return false;
  }
  return true;
}

TimedPath timedBy(TimeScaling scaling, const MatrixXd& waypoints, const PathCurve& curve) {
  std::vector<ScalingPhase> phases = scaling.phases();
  for (ScalingPhase& phase : phases) phase.piece = curve.pieceAt(.5 * (phase.begin.s + phase.end));
  scaling = TimeScaling(std::move(phases), scaling.duration());
  VectorXd times(Eigen::Index(curve.marks().size()));
  for (Eigen::Index i = 0; i < times.size(); ++i) times[i] = scaling.timeOf(curve.marks()[std::size_t(i)]);
  return TimedPath::fromParts(RetimeStatus::timed, "", waypoints, std::move(times), curve, std::move(scaling));
}

TimedPath concatenated(const TimedPath& first, const TimedPath& second) {
  MatrixXd waypoints(first.path.rows() + second.path.rows() - 1, first.path.cols());
  waypoints << first.path, second.path.bottomRows(second.path.rows() - 1);
  TimeScaling scaling = first.scaling();
  scaling.append(CurvePart{{}, first.curve().length(), 0}.onWhole(second.scaling()));
  return timedBy(std::move(scaling), waypoints, joined(first.curve(), second.curve()));
}

TimedPath timeMotion(Steering& steering, const MatrixXd& path, const MotionLimits& limits, double blend) {
  RetimeOptions options;
  options.corners = blend > 0. ? Corners::blend : Corners::stop;
  options.tolerance = blend > 0. ? blend : options.tolerance;
  options.is_free = collisionFreeBlends(steering);
  return retime(path, limits, options);
}

}  // namespace kinegraph::inline planning_internal
