#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/rrt/search_tree.h"
#include "kinegraph/trajectories/retime.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph::inline planning_internal {
class DynamicScene;
class JointSpace;
}

namespace kinegraph {

/// How planMotion ended.
enum class PlanStatus {
  solved,            ///< the motion is continuously collision-free
  invalid_start,     ///< the start is in collision or beyond limits
  invalid_goal,      ///< so are all goals
  goal_unreachable,  ///< no configuration satisfies the goal's targets or conditions
  infeasible,        ///< proved: a part of a body does not fit through any passage to the goal
  no_path_found,     ///< the search found none within its budget
  no_timing_found,   ///< paths were found, but no timing that avoids the dynamic obstacles
  timeout,           ///< the time limit ended the search
  cancelled,         ///< by the cancellation token
};

std::string planStatusName(PlanStatus status);

/// Statistics of one stage of planMotion.
struct PlanStage {
  std::string name;      ///< "setup", "endpoints", "search", "shortcut", "rope_shortcut", "verify", "timing", ...
  double seconds = 0.;   ///< wall time
  long evaluations = 0;  ///< PlanOptions says what one counts
  std::string note;      ///< the outcome; may be ""
};

/// A frame that edges of the search collided with.
struct MetObstacle {
  int frame;  ///< id
  std::string name;
  double share;                 ///< of all colliding edges
  std::vector<std::string> by;  ///< frames that collided with it
};

/// The first place on the way to a goal that is blocked only because no camera has seen it.
struct UnseenPlace {
  Vector3d position = Vector3d::Zero();  ///< middle of the first unseen cell in the way, m
  std::string frame;                     ///< the shape that would enter it
  VectorXd q;                            ///< of the motion that would be possible if unseen cells were free
  double depth = 0.;                     ///< of the deepest of these cells in unseen space, to within a cell, m
  std::vector<Vector3d> cells = {};      ///< middles of all unseen cells that it enters, the first ones first, m

  std::string str() const;
};

/// The motion that planMotion found, or the reason why there is none. Without a motion, eval throws ValueError.
class MotionPlan : public Trajectory {
 public:
  PlanStatus status = PlanStatus::cancelled;
  std::string message;                 ///< "" if solved, else why there is no motion
  std::vector<std::string> warnings;   ///< caveats of the motion, such as a start in contact
  MatrixXd path;                       ///< (K, n): configurations from start to goal; no rows without a motion
  MatrixXd raw_path;                   ///< the path before shortcutting
  TimedPath timed_path;                ///< the path with its time parameterization
  double length = 0.;                  ///< of the path, Euclidean in q
  int goal = -1;                       ///< index of the goal configuration that was reached
  std::vector<PlanStage> stages;       ///< in the order in which they ran; their times add up to that of the call
  std::vector<SearchReport> searches;  ///< tree searches of the "search" stage
  std::vector<SearchTree> trees;       ///< of the last search: from the start, from the goals
  std::vector<MetObstacle> obstacles;  ///< if no path was found: the most frequent obstacles, the first most often
  double margin = 0.;                  ///< m, kept everywhere but around endpoints that keep less
  double verified_margin = 0.;         ///< m, verified along the whole motion

  /// The first unseen place of an occupancy map that prevents the motion. None if there is a motion, or if free unseen
  /// cells would not help.
  std::optional<UnseenPlace> blockedByUnseen;

  bool feasible() const { return status == PlanStatus::solved; }

  /// (K,): times at which the motion passes the configurations of the path, or is nearest to them at rounded corners,
  /// s.
  const VectorXd& times() const { return timed_path.times; }

  int dimension() const override;
  double duration() const override { return feasible() ? timed_path.duration() : 0.; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  /// Values of the dynamic obstacles at time t (s) as in ObstacleTrajectory, in the order of
  /// options.obstacle_trajectories.
  std::vector<VectorXd> obstaclesAt(double t) const;

  /// Plans a motion that continues this one from time t (s), with its velocity at that time, to a goal, in a scene that
  /// may have changed. No goal: the present one. With jerk limits the motion also continues the acceleration. Time 0 of
  /// the new motion is t of this one. If the rest of this motion leads to the goal and is collision-free, it stays. No
  /// options: optionsAt(t). The new motion ends at rest; if this one has an end_velocity, a warning says so. Throws
  /// ValueError if there is no motion.
  MotionPlan replan(const Config& config, double t, const std::optional<MotionGoal>& goal = std::nullopt,
                    const std::optional<PlanOptions>& options = std::nullopt,
                    const CancellationToken& cancellation = {}) const;

  /// Returns a copy of the scene with the traces of frames as lines: "start tree" (blue) and "goal tree" (orange) of
  /// the last search, "raw path" (gray), and "path" (green). Without a motion, the most frequent obstacle is red. No
  /// frame names: one frame on each link without children. Throws ValueError for a scene with another number of dofs,
  /// FrameNotFound for an unknown name.
  Config picture(const Config& config, const std::vector<std::string>& frames = {}) const;

  /// Shows the picture on the page of `config`, until its next view, and plays the motion there.
  int view(const Config& config, const std::vector<std::string>& frames = {}, bool pause = false) const;

  /// The options for a motion that begins at time t (s) of this one: times of dynamic obstacles are shifted by t.
  PlanOptions optionsAt(double t) const;

  /// Computes the least distance of a collidable pair along the edges of the path, m, to 1e-4 m; `max_distance` if no
  /// pair is closer. Does not include dynamic obstacles.
  double clearance(double max_distance = .1) const;

  /// Adds the stage "setup" in front, or extends it, so that the stages add up to `seconds`, the duration of the call.
  void addSetupStage(double seconds);

  /// Several lines: the outcome, the stages, the sizes of the trees, and the clearance.
  std::string explain() const;
  std::string str() const;  ///< "solved: 5 configurations, 2.31 s", or the status and the message

  PlanOptions options;                                ///< of the call
  std::shared_ptr<const DynamicScene> dynamic_scene;  ///< null without dynamic obstacles
  std::shared_ptr<const State> scene;                 ///< at the time of the call
  std::shared_ptr<const JointSpace> space;            ///< of its joints
};

}  // namespace kinegraph
