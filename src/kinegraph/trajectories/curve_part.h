#pragma once

#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

/// What a curve does from one place until a later one, as a curve of its own whose s begins at 0.
struct CurvePart {
  PathCurve curve;
  double begin = 0.;    ///< s of the whole curve where it begins
  int first_piece = 0;  ///< of the whole curve, the one that its first piece is of

  /// A law along the part as one along the whole curve.
  TimeScaling onWhole(const TimeScaling& scaling) const;

  /// What is left of a law along the whole curve from `time` on, which is when it is where the part begins, until it is where
  /// the part ends: a law along the part.
  TimeScaling restOf(const TimeScaling& whole, double time) const;
};

/// From s = `from` to `to` > from, both held within the curve. Its marks are its ends. Pieces shorter than 1e-12 of the
/// curve are left out.
CurvePart partOf(const PathCurve& curve, double from, double to);

/// One curve and then another one, which begins where the first one ends and has as many dofs. Where the direction counts as
/// jumping there, a motion stops. The marks are those of both, the last one of the first curve and the first one of
/// the second once.
PathCurve joined(const PathCurve& first, const PathCurve& second, bool jumps = true);

}  // namespace kinegraph
