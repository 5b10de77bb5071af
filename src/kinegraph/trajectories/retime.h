#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline trajectories_internal {
class PathCurve;
class TimeScaling;
}

namespace kinegraph {

/// Limits per dof: |dq/dt| <= velocity, |d2q/dt2| <= acceleration, |d3q/dt3| <= jerk. Positive, in rad or m, s;
/// infinity for none. An empty `jerk` limits no jerk.
struct MotionLimits {
  VectorXd velocity, acceleration, jerk;

  bool limitsJerk() const { return jerk.size() > 0; }
  void validate(int dofs) const;  ///< throws ValueError
};

/// Linear constraints at a gridpoint, such as torque limits: low <= a s'' + b s'^2 + c <= high, (m,) each.
struct ScalingConstraints {
  VectorXd a, b, c;
};

/// Constraints of the caller: `at(s, piece)` returns m of them; their limits do not depend on s.
struct ConstraintSource {
  VectorXd low, high;  ///< (m,); infinity for none
  std::function<ScalingConstraints(double s, int piece)> at;
  std::vector<std::string> names;  ///< of the constraints, for messages
  std::string unit;
  explicit operator bool() const { return bool(at); }
};

/// Tells whether a curve along these points (M, dofs) is collision-free; between two points it deviates from the chord
/// by at most `deviation` in every dof.
using BlendCheck = std::function<bool(const MatrixXd& points, double deviation)>;

/// Treatment of the corners of a path.
enum class Corners {
  blend,   ///< blended within a tolerance; a stop if no blend is collision-free, or if the stop is faster
  stop,    ///< the motion stops at each
  spline,  ///< a cubic spline through all points, which may deviate far from the lines between them
};

/// Returns the value of "blend", "stop" or "spline"; throws ValueError for another name.
Corners cornersOfName(const std::string& name);

struct RetimeOptions {
  Corners corners = Corners::blend;
  double tolerance = .01;                 ///< largest distance of a blend from its corner, in every dof (rad or m)
  BlendCheck is_free;                     ///< checks a blend for collisions; none: all are free
  VectorXd start_velocity, end_velocity;  ///< (n,), rad/s or m/s, along the path; empty: at rest
  VectorXd start_acceleration;            ///< (n,), with jerk limits only; empty: that of a constant speed
  int intervals = 100;                    ///< of the time scaling, on curved pieces
  ConstraintSource constraints;           ///< further limits, such as torques; they hold at the ends of the intervals
  CancellationToken cancellation;         ///< checked regularly; may throw

  void validate() const;  ///< throws ValueError
};
/// Whether retime found a timing, and why not.
enum class RetimeStatus {
  timed,
  start_too_fast,  ///< the start velocity is above the limits, or cannot be braked
  end_too_fast,    ///< the end velocity is above the limits, or cannot be reached
  cannot_move,     ///< a further limit holds for no speed at some s
};

std::string retimeStatusName(RetimeStatus status);

/// Evaluates a time scaling (with at least one phase) along a curve at t (s), clamped to its duration; (n,) numbers
/// each.
void motionAt(const PathCurve& curve, const TimeScaling& scaling, double t, double* q, double* velocity,
              double* acceleration);
MotionState motionAt(const PathCurve& curve, const TimeScaling& scaling, double t);

/// A path with its time parameterization: q(s(t)) along a curve through the points, s(t) from `retime`.
class TimedPath final : public Trajectory {
 public:
  RetimeStatus status = RetimeStatus::timed;
  std::string message;  ///< "" if timed, else the cause, with a value that would do
  MatrixXd path;        ///< (K, n), as given
  VectorXd times;       ///< (K,) s: time of each point, or of the nearest point of its blend; empty without a motion

  bool feasible() const { return status == RetimeStatus::timed; }
  int dimension() const override;
  double duration() const override;
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const PathCurve& curve() const;
  const TimeScaling& scaling() const;

  /// Builds a TimedPath from its members.
  static TimedPath fromParts(RetimeStatus status, std::string message, MatrixXd path, VectorXd times, PathCurve curve,
                             TimeScaling scaling);

  std::string str() const;  ///< "12 points in 2.31 s", or the status and the message

 private:
  struct Motion;
  const Motion& motion() const;
  std::shared_ptr<const Motion> motion_;  ///< null: empty
};

/// Computes the fastest motion along the points of a path (K, n) that keeps the limits at all times.
///
/// Without jerk limits, two passes compute s'^2 (time_optimal.h). With jerk limits, an interior-point method with
/// banded matrices solves a program in s'^2 (jerk_limited.h). The motion starts and ends at rest unless `options` has
/// velocities. With jerk limits, s'' = 0 at both ends, unless `start_acceleration` = q' s'' + q'' s'^2 sets s'' at the
/// start. Points that equal their predecessor take no time.
///
/// Throws ValueError for a path without points, numbers that are not finite, limits that are not positive; a moving dof
/// without limits, velocities that do not point along the path, and a start acceleration that leaves it. A path that
/// cannot be followed is a status.
TimedPath retime(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options = {});

/// The same with further limits that depend on the curve; they are read before the call returns.
TimedPath retime(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options,
                 const std::function<ConstraintSource(const PathCurve&)>& constraints_of);

/// The same along a given curve through the points of `path`.
TimedPath retime(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                 const RetimeOptions& options = {});

/// The same, but shorter with jerk limits: limits that are exceeded between gridpoints are tightened there until they
/// demand a slow-down of the whole motion by less than .05 %. Such a motion is near its limits on all of its way, and
/// may leave no room for a change of plans in its midst (MotionPlan::replan).
TimedPath retimeTightly(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                        const RetimeOptions& options = {});

}  // namespace kinegraph
