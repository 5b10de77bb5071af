#pragma once

#include <functional>
#include <optional>

#include "kinegraph/api/execution/observed_world.h"
#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {
struct ExecutionOptions;
}

namespace kinegraph::inline api_internal {

/// Returns the limits of external efforts of n joints; empty: none. Throws ValueError if options are wrong.
VectorXd effortLimits(const ExecutionOptions& options, Eigen::Index n);

/// A part of a plan's motion, slow and in reverse.
struct Retreat {
  MatrixXd path;   ///< (K, n)
  VectorXd times;  ///< (K,) s, the first one above 0
};

/// Returns the motion along rows of a plan from the one that is nearest to the robot at q back to the first one that
/// `is_end`; none if there is no such row, or the robot is not near these rows. Doors stay where they are. Rows are
/// counted from the first of these.
std::optional<Retreat> retreatAlong(const TaskPlan& plan, const RowRange& rows, const ObservedWorld& world,
                                    const VectorXd& q,
                                    const std::function<bool(Eigen::Index row, const VectorXd& q)>& is_end);

/// Returns the way back out of the grasp of an action for a hand that has lost its object, to where the hand opens to a
/// width (m) without pushing anything; none if it can do so where it is, or nowhere.
std::optional<Retreat> retreatToOpen(const TaskPlan& plan, std::size_t action, const ObservedWorld& world,
                                     const VectorXd& q, const std::string& hand, double width);

/// Whether a robot at q overlaps nothing by more than 1 mm.
bool isClear(Config& C, const VectorXd& q);

/// Plans a motion in an observed scene to the beginning of a plan, with a margin if there is room.
MotionPlan motionToStart(const TaskPlan& plan, Config C, const VectorXd& start);

}  // namespace kinegraph::inline api_internal
