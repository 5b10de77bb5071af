#pragma once

#include <optional>
#include <string>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/tool_paths/cubic_pieces.h"
#include "kinegraph/tool_paths/plan_tool_path.h"

namespace kinegraph {

/// A place at which a curve is not collision-free.
struct CurveContact {
  double place = 0.;  ///< s, to within the part of a piece that was checked
  MotionContact contact;
};

/// Finds the first place at which a curve of configurations is not provably free: all pairs keep the checker's margin
/// continuously along chords, by as much more as the curve may deviate from them. Parts that are not free are divided,
/// up to `max_divisions` times. None if the whole curve is free.
std::optional<CurveContact> firstContactAlong(EdgeChecker& checker, const CubicPieces& curve, int max_divisions = 6);

/// The first contact of a motion.
struct MotionTouch {
  double t = 0.;         ///< s
  std::string a, b;      ///< frames
  double distance = 0.;  ///< m; negative: they overlap
};

/// Finds the first time at which a timed path is not provably free: all pairs keep `margin` (m) at all times, not only
/// at samples. None if the whole motion is free. Throws ValueError if there is no motion, for another number of dofs,
/// and for a margin below 0.
std::optional<MotionTouch> firstContact(const Config& config, const TimedPath& motion, double margin = 0.);

/// The same for all parts of a plan. Frames of its `touching` touch here, too, unless the scene excludes the pairs.
std::optional<MotionTouch> firstContact(const Config& config, const ToolPathPlan& plan, double margin = 0.);

}  // namespace kinegraph
