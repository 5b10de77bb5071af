#pragma once

#include <optional>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/tool_paths/cubic_pieces.h"

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

}  // namespace kinegraph
