#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

enum class PlanStatus {
  solved,            ///< there is a motion, free at all times
  invalid_start,     ///< the start collides, or is out of limits
  invalid_goal,      ///< all goals do
  goal_unreachable,  ///< no posture was found at which the goal's targets or conditions hold
  infeasible,        ///< proven: a ball inside of a body does not fit through where it would have to go
  no_path_found,     ///< none was found within the effort
  no_timing_found,   ///< ways were found, but no times at which to go along them that keep clear of moving obstacles
  timeout,           ///< nor within the time limit
  cancelled,         ///< by the watch
};

std::string planStatusName(PlanStatus status);

/// What a stage of planMotion took.
struct PlanStage {
  std::string name;      ///< "ends", "search", "shorten", "tighten", "verify", "time", "dynamic_obstacles"
  double seconds = 0.;   ///< wall time
  long evaluations = 0;  ///< see PlanOptions: looks at up to eight postures side by side, or at a motion at all times
  std::string note;      ///< what came of it
};

/// What planMotion found.
class MotionPlan {
 public:
  PlanStatus status = PlanStatus::cancelled;
  std::string message;                ///< "" if solved, else why there is no motion
  std::vector<std::string> warnings;  ///< what is to be known of the motion, as that the start was in contact
  MatrixXd path;                      ///< (K, n): its postures, start and goal included; no rows if there is none
  MatrixXd raw_path;                  ///< the same before it was shortened
  TimedPath timed;                    ///< when it is where; see at()
  double length = 0.;                 ///< of the path, Euclidean in q
  int goal = -1;                      ///< which of several goal postures was reached, in the order given
  std::vector<PlanStage> stages;
  std::vector<SearchReport> attempts;  ///< with trees
  std::vector<MotionTree> trees;       ///< of the last attempt: of the start and of the goals
  std::vector<MetObstacle> obstacles;  ///< where there is no way: what most motions ended at, the first one most often
  double margin = 0.;                  ///< m, that the motion keeps but around ends that keep less
  double verified_margin = 0.;         ///< m, that all of it was verified to keep

  bool feasible() const { return status == PlanStatus::solved; }

  /// (K,): when the motion passes the path's postures, or is nearest to them where corners are rounded, s.
  const VectorXd& times() const { return timed.times; }
  double duration() const { return feasible() ? timed.duration() : 0.; }

  /// Where the motion is at time t (s), held within 0 and duration(). Throws ValueError if there is no motion.
  MotionState at(double t) const;

  /// Where moving obstacles are at time t (s): values as in ObstacleTrajectory, in the order of options.obstacle_trajectories.
  std::vector<VectorXd> obstaclesAt(double t) const;

  /// A motion that goes on from where this one is at time t (s), and as fast as it is there, to a goal, or to its own one, in
  /// a scene that may have changed. With limits of the jerk it has the acceleration of that time, too. Its own time begins at
  /// 0 then. If the rest of the present motion leads to the goal and is free, it stays. No options: optionsAt(t). Throws
  /// ValueError if there is no motion.
  MotionPlan replan(const Config& config, double t, const std::optional<MotionGoal>& goal = std::nullopt,
                    const std::optional<PlanOptions>& options = std::nullopt,
                    const CancellationToken& cancellation = {}) const;

  /// A copy of the scene that was planned in, and lines in it along which frames went: "start tree" (blue) and "goal tree"
  /// (orange) of the last attempt, "first way" (gray), and the "path" (green) that came of it. Where there is none, the
  /// obstacle that most motions ended at is red. Frames are given by names; none: one on each link that no other one hangs
  /// on. Throws ValueError for a scene with another number of dofs, FrameNotFound for a name.
  Config picture(const Config& config, const std::vector<std::string>& frames = {}) const;

  /// Shows the picture in the browser, and plays the motion in it; as Config::view.
  int view(const Config& config, const std::vector<std::string>& frames = {}, bool pause = false) const;

  /// The options, for a motion that begins at time t (s) of this one: times of moving obstacles count from then.
  PlanOptions optionsAt(double t) const;

  /// The least distance of a collidable pair along the path's straight motions, m, if less than `most`, else `most`.
  /// Computed when asked for, to 1e-4 m. Moving obstacles do not count.
  double clearance(double most = .1) const;

  /// Several lines: how it ended, what each stage took, and how the trees look.
  std::string explain() const;
  std::string str() const;  ///< "solved: 5 postures, 2.31 s" or the status and the message

  PlanOptions options;                                ///< that it was planned with
  std::shared_ptr<const DynamicScene> dynamic_scene;  ///< null where nothing moves but the robot
  std::shared_ptr<const State> scene;                 ///< that it was planned in
  std::shared_ptr<const JointSpace> space;            ///< of its joints
};

}  // namespace kinegraph
