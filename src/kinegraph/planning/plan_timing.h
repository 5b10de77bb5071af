#pragma once

#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

/// Most |dq/dt|, |d2q/dt2|, |d3q/dt3| per dof: as the options say, else the model's velocities, 1 rad/s or m/s where it
/// says none, and accelerations that reach them in a quarter of a second.
MotionLimits planLimits(const Config& config, const PlanOptions& options);

/// Whether a rounded corner keeps the margins and constraints of a Steering, which must stay, at all times.
BlendCheck freeBlends(Steering& steering);

/// Is every piece of a curve free at all times, by a Steering's margins and constraints? Each one that is no line is looked at
/// in so many parts, with room for how far these leave their chords.
bool isFree(Steering& steering, const PathCurve& curve, int parts);

/// The motion of a law that is known along a curve, which is as `rows` at its marks; of its phases, s says on which pieces they
/// are.
TimedPath timedBy(TimeScaling scaling, const MatrixXd& rows, const PathCurve& curve);

/// One motion and then another one: the first ends at rest where the second begins at rest.
TimedPath inTurn(const TimedPath& first, const TimedPath& second);

/// The fastest motion along a path. Corners are rounded where that keeps the margins and constraints; at others it
/// stops.
TimedPath timeMotion(Steering& steering, const MatrixXd& path, const MotionLimits& limits, double blend);

}  // namespace kinegraph
