#pragma once

#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// What becomes of the corners of a path.
enum class Corners {
  blend,   ///< rounded within a tolerance; where that is not free, a stop
  stop,    ///< the motion stands still at each
  spline,  ///< a cubic spline through all points, which may be far from the lines between them
};

/// "blend", "stop" or "spline"; throws ValueError for another name.
Corners cornersOfName(const std::string& name);

struct RetimeOptions {
  Corners corners = Corners::blend;
  double tolerance = .01;                 ///< of blends: by which they may miss their corner, in every dof (rad or m)
  BlendCheck is_free;                     ///< of blends: whether one may be taken; all are if there is none
  VectorXd start_velocity, end_velocity;  ///< (n,), rad/s or m/s, along the path; empty: at rest
  VectorXd start_acceleration;            ///< (n,), with limits of the jerk; empty: that of a constant speed
  int intervals = 100;                    ///< of the law, on what is curved
  ConstraintSource rows;                  ///< further limits, such as torques; they hold at the ends of the intervals
  CancellationToken cancellation;         ///< called now and then, and may throw to end it

  void validate() const;  ///< throws ValueError
};

enum class RetimeStatus {
  timed,
  start_too_fast,  ///< the start velocity is above the limits, or cannot be braked
  end_too_fast,    ///< the end velocity is above the limits, or cannot be reached
  cannot_move,     ///< a further limit holds for no speed somewhere
};

/// The curve that `retime` takes through the points of a path.
PathCurve curveOf(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options);

std::string retimeStatusName(RetimeStatus status);

/// The motion of a law along a curve at t s, held within 0 and the law's duration, which has phases; (n,) numbers each.
void motionAt(const PathCurve& curve, const TimeScaling& scaling, double t, double* q, double* velocity,
              double* acceleration);
MotionState motionAt(const PathCurve& curve, const TimeScaling& scaling, double t);

/// A path with its time parameterization: q(s(t)) along a curve through the points, s(t) from `retime`.
class TimedPath final : public Trajectory {
 public:
  RetimeStatus status = RetimeStatus::timed;
  std::string message;  ///< "" if timed, else what is too fast, and what would do
  MatrixXd path;        ///< (K, n), as given
  VectorXd times;  ///< (K,): when the motion is at each point, or nearest to it in a blend, s; empty without a motion

  bool feasible() const { return status == RetimeStatus::timed; }
  int dimension() const override { return curve_.dofs(); }
  double duration() const override { return scaling_.duration(); }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const PathCurve& curve() const { return curve_; }
  const TimeScaling& scaling() const { return scaling_; }

  /// What another one had.
  static TimedPath fromParts(RetimeStatus status, std::string message, MatrixXd path, VectorXd times, PathCurve curve,
                             TimeScaling scaling);

  std::string str() const;  ///< "12 points in 2.31 s", or the status and the message

 private:
  friend TimedPath retime(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                          const RetimeOptions& options);
  PathCurve curve_;
  TimeScaling scaling_;
};

/// The fastest motion along a path, rows of `path` (K, n), that keeps the limits at all times.
///
/// Without limits of the jerk: two passes over s'^2 (time_optimal.h). With them: a program in s'^2 that is linear but for
/// its cost and the jerk's limit, by an interior-point method whose matrices are bands (jerk_limited.h). The motion
/// begins and ends at rest unless told otherwise. With limits of the jerk, the speed ds/dt does not change at both ends, unless
/// a start acceleration says how: q' s'' + q'' s'^2 with any s''. Points that equal their predecessor take no time. Throws ValueError for a path without points, numbers that are not finite, limits
/// that are not positive, a dof that moves and that nothing limits, velocities that do not point along the path, and a
/// start acceleration that leaves it; what cannot be followed is a status.
TimedPath retime(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options = {});

/// The same along a curve through the points of `path`.
TimedPath retime(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                 const RetimeOptions& options = {});

}  // namespace kinegraph
