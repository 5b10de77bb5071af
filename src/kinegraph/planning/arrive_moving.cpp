#include "kinegraph/planning/arrive_moving.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/planning/acceleration_ramp.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_from_velocity.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kArrivalLengths[] = {1.5, 3., 6., 12.};     // of the run-up, as multiples of the stopping distance
constexpr double kMostOfLine = .45, kMostBehindCorner = .3;  // the latter leaves place for the blend before
constexpr int kPieces = 3, kMarksPerPiece = 4;               // of a bend
constexpr int kPartsOfPiece = 16;                            // in collision checks
constexpr double kShortestArrival = 1e-6;                    // rad or m
constexpr double kLeastRunUp = .01;                          // rad or m: of slow ends
constexpr double kBeyondLimits = 1e-12;                      // rad or m: rounding

/// Position, slope and second derivative at an end of a curve.
struct CurveEnd {
  VectorXd p, slope, bend;
};

/// Three cubics of equal lengths with continuous second derivatives, between two ends. M1 and M2, the second
/// derivatives at the inner knots, follow from the slope and the position at the end.
PathCurve smoothBetween(const CurveEnd& from, const CurveEnd& to, double length) {
  const double h = length / kPieces;
  const VectorXd& M0 = from.bend;
  const VectorXd& M3 = to.bend;
  const VectorXd sum = (to.slope - from.slope) / h - .5 * (M0 + M3);                                   // M1 + M2
  const VectorXd weighted = (to.p - from.p - length * from.slope) / (h * h) - 4. / 3. * M0 - M3 / 6.;  // 2 M1 + M2
  const VectorXd M[] = {M0, weighted - sum, 2. * sum - weighted, M3};
  PathCurve::Parts parts{.dofs = int(from.p.size()), .degree = 3, .length = length, .marks = {0.}};
  VectorXd p = from.p, slope = from.slope;
  for (int k = 0; k < kPieces; ++k) {
    const VectorXd cubic = (M[k + 1] - M[k]) / (6. * h);
    for (const VectorXd& c : {p, slope, VectorXd(.5 * M[k]), cubic})
      parts.coefficients.insert(parts.coefficients.end(), c.begin(), c.end());
    parts.begin.push_back(k * h);
    parts.is_line.push_back(false), parts.stops.push_back(false);
    for (int i = 1; i <= kMarksPerPiece; ++i) parts.marks.push_back((k + double(i) / kMarksPerPiece) * h);
    p += h * (slope + h * (.5 * M[k] + h * cubic));
    slope += h * (M[k] + 3. * h * cubic);
  }
  return PathCurve::fromParts(parts);
}

/// The distance in which the velocity is reached from rest along a line, and the time, s.
double stoppingDistance(const VectorXd& velocity, const MotionLimits& limits) {
  double time = 0.;
  for (Eigen::Index j = 0; j < velocity.size(); ++j) {
    const double speed = std::abs(velocity[j]), acceleration = limits.acceleration[j];
    const double rise = limits.limitsJerk() ? acceleration / limits.jerk[j] : 0.;
    const double gentle = limits.limitsJerk() ? 2. * std::sqrt(speed / limits.jerk[j]) : 0.;  // below the acceleration
    if (std::isfinite(acceleration))
      time = std::max(time, speed < acceleration * rise ? gentle : speed / acceleration + rise);
  }
  return .5 * time * velocity.norm();
}

/// One arriveMoving call.
class Arrival {
 public:
  Arrival(const Config& config, const MotionPlan& at_rest, const PlanOptions& options,
          const CancellationToken& cancellation)
      : config_(config),
        at_rest_(at_rest),
        options_(options),
        cancellation_(cancellation),
        limits_(planLimits(config, options)),
        space_(*config.model()),
        scene_(config.state()) {}

  std::optional<MotionPlan> run() {
    const MatrixXd& path = at_rest_.path;
    if (path.rows() < 2) return std::nullopt;
    const VectorXd goal = path.bottomRows(1).transpose(), before = path.row(path.rows() - 2).transpose();
    const double most = (path.rows() > 2 ? kMostBehindCorner : kMostOfLine) * (goal - before).norm();
    if (most < kShortestArrival) return std::nullopt;
    Steering loose(constraintsAround(scene_, space_, options_, {}));
    const Endpoint start = endpoint(loose, path.row(0).transpose()), end = endpoint(loose, goal);
    if (!start.isFree() || !end.isFree()) return std::nullopt;
    Steering steering(constraintsAround(scene_, space_, options_, {&start, &end}));
    const double distance = std::max(kLeastRunUp, stoppingDistance(options_.end_velocity, limits_));
    for (const double factor : kArrivalLengths) {
      const double length = factor * distance;
      const bool is_slower = take(steering, before, goal, std::min(length, most));
      if (is_slower || length >= most || (cancellation_ && cancellation_())) break;
    }
    return std::move(best_);
  }

 private:
  Endpoint endpoint(Steering& steering, const VectorXd& q) {
    return checkEndpoint(steering, *config_.model(), q, options_.margin, "end", kPlanMotion);
  }

  /// The curve whose last line leads to a point `run_up` before the goal, against the end velocity. A smooth bend
  /// rounds this corner. None if the line is too short, or not collision-free.
  std::optional<PathCurve> bentPath(Steering& steering, const VectorXd& before, const VectorXd& goal, double run_up) {
    const double speed = options_.end_velocity.norm();
    const VectorXd along = options_.end_velocity / speed, corner = goal - run_up * along;
    const double line = (corner - before).norm();
    if (line < 2. * run_up) return std::nullopt;
    const VectorXd direction = (corner - before) / line, from = corner - run_up * direction;
    VectorXd bend = VectorXd::Zero(goal.size());
    if (options_.end_acceleration.size() > 0) bend = options_.end_acceleration / (speed * speed);
    const double length = (2. * (goal - from).norm() + 2. * run_up) / 3.;  // between chord and corner
    bend_ = smoothBetween({from, direction, VectorXd::Zero(goal.size())}, {goal, along, bend}, length);
    MatrixXd front = at_rest_.path;
    front.bottomRows(1) = from.transpose();
    if (!isFree(steering, polyline(front.bottomRows(2)), 1)) return std::nullopt;
    const BlendOptions blends{options_.blend, limits_.limitsJerk(), collisionFreeBlends(steering)};
    return joined(blendedPolyline(front, blends), bend_, false);
  }

  bool keepsJointLimits() const {
    for (int piece = 0; piece < bend_.pieces(); ++piece)
      for (const VectorXd& q : bernsteinOf(bend_, piece))
        if (!space_.beyondLimits(q, kBeyondLimits).empty()) return false;
    return true;
  }

  /// Takes the motion if it is the fastest one. True if a shorter run-up gave a faster one.
  bool take(Steering& steering, const VectorXd& before, const VectorXd& goal, double run_up) {
    const std::optional<PathCurve> bent = bentPath(steering, before, goal, run_up);
    if (!bent || !keepsJointLimits() || !isFree(steering, bend_, kPartsOfPiece)) return false;
    const PathCurve& curve = *bent;
    MatrixXd rows(Eigen::Index(curve.marks().size()), curve.dofs());
    for (Eigen::Index k = 0; k < rows.rows(); ++k) rows.row(k) = curve.eval(curve.marks()[std::size_t(k)]).transpose();
    RetimeOptions timing;
    timing.end_velocity = options_.end_velocity;
    TimedPath timed = retime(rows, curve, limits_, timing);
    if (!timed.feasible()) return false;
    if (best_ && best_->duration() <= timed.duration()) return true;
    best_ = at_rest_;
    best_->path = std::move(rows);
    best_->length = pathLength(space_, best_->path);
    best_->verified_margin = std::min(at_rest_.verified_margin, options_.margin);
    best_->timed_path = std::move(timed);
    return false;
  }

  const Config& config_;
  const MotionPlan& at_rest_;
  const PlanOptions& options_;
  const CancellationToken& cancellation_;
  const MotionLimits limits_;
  const JointSpace space_;
  const State scene_;
  PathCurve bend_;
  std::optional<MotionPlan> best_;
};

}  // namespace

std::optional<MotionPlan> arriveMoving(const Config& config, const MotionPlan& at_rest, const PlanOptions& options,
                                       const CancellationToken& cancellation) {
  return Arrival(config, at_rest, options, cancellation).run();
}

}  // namespace kinegraph::inline planning_internal
