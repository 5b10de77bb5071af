#pragma once

#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/retime.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline trajectories_internal {

/// A part of a curve as a curve of its own, whose s starts at 0.
struct CurvePart {
  PathCurve curve;
  double begin = 0.;    ///< s of the whole curve at the start of the part
  int first_piece = 0;  ///< number of the first piece in the whole curve

  /// Expresses a time scaling along the part in s of the whole curve.
  TimeScaling onWhole(const TimeScaling& scaling) const;

  /// Cuts a time scaling along the whole curve to the part. `time` is the time at which it passes the start of the
  /// part.
  TimeScaling restOf(const TimeScaling& whole, double time) const;
};

/// Returns the part from s = `from` to `to` > from, both clamped to the curve. Its marks are its ends. Pieces shorter
/// than 1e-12 of the curve are left out.
CurvePart partOf(const PathCurve& curve, double from, double to);

/// Joins two curves of the same dofs; the second starts at the end of the first. With `jumps`, a motion stops in
/// between. The marks are those of both; the mark at the joint counts once.
PathCurve joined(const PathCurve& first, const PathCurve& second, bool jumps = true);

/// The motion that takes the way of a timed path back: at time t it is where the other one is at duration - t, with the
/// opposite velocity and the same acceleration.
TimedPath reversed(const TimedPath& motion);

}  // namespace kinegraph::inline trajectories_internal
