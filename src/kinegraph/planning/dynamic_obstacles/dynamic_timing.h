#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_check.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

/// When a robot is where on a curve, so that it meets no moving obstacle.
struct DynamicTiming {
  /// It stands still.
  struct Wait {
    double begin, seconds;  ///< s
    double place;           ///< s of the curve
  };
  bool was_found = false;
  bool is_fastest = false;  ///< nothing is in the way of the fastest law
  TimeScaling scaling;
  std::vector<Wait> waits;
  std::optional<DynamicContact> met;  ///< what the fastest law meets first
  std::string message;                ///< where none was found: why
  long tries = 0;                     ///< motions from one stop to another that were checked
};

/// Times a curve whose fastest law is known; it is kept where nothing is in its way. At its end the robot stays, and
/// nothing comes there later.
///
/// Otherwise the curve gets stations at which the robot may stop, also where it has to. A leg is the fastest motion from one
/// to a later one, or that motion slowed down. The robot may wait at a station while that is free: between two times at
/// which it is not, coming there early is best, so that a search by arrival (A*) visits each station once per free time. A
/// leg that is not free at a departure is tried at later ones. Source: Phillips, Likhachev, SIPP: Safe interval path
/// planning for dynamic environments, 2011; Kant, Zucker, Toward efficient trajectory planning: the path-velocity
/// decomposition, 1986.
DynamicTiming timeAmongObstacles(const TimedPath& fastest, const MotionLimits& limits, DynamicCheck& check,
                                 const CancellationToken& cancellation = {});

}  // namespace kinegraph
