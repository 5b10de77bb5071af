#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/search/branch_log.h"
#include "kinegraph/task_planning/search/task_logic.h"
#include "kinegraph/task_planning/search/waypoint_cache.h"

namespace kinegraph::inline task_planning_internal {

/// Turns failures in geometry into constraints of the logic: which action is impossible, and while which facts hold. A
/// constraint that is more general than the failed sequence prunes all sequences that would fail in the same way.
class ConflictLearner {
 public:
  using Actions = std::vector<TaskAction>;

  /// References must outlive the learner. `scene` is the initial scene.
  ConflictLearner(SpeculativeExecutor& executor, const Config& scene, std::vector<TaskDoor> doors, TaskLogic& logic,
                  WaypointCache& waypoints, BranchLog& log);

  /// Learns from a sequence without waypoints.
  void learnWaypointFailure(const Actions& actions);

  /// The same if it is known that the first `feasible` actions have waypoints, and for what cause the next one fails.
  void learnWaypointFailure(const Actions& actions, std::size_t feasible, const FutureFailure& failure);

  /// With several hands, tests each pick and place of a sequence alone, without other objects: the logic chooses hands
  /// without geometry, and a short problem fails soon. Learns from the first that fails, and returns true then.
  bool learnHandThatFails(const Actions& actions);

  /// Learns from a sequence whose motions failed.
  void learnMotionFailure(const Actions& actions, const TaskFailure& failure);

  /// Whether a constraint was learned. Such constraints are no proofs: solvers may fail on feasible problems.
  bool hasLearned() const { return has_learned_; }

 private:
  void learnLast(const Actions& prefix, const FutureFailure& known);
  void giveUp(const Actions& actions, const std::string& condition, FutureFailure failure);
  void forbidLast(const Actions& prefix, const std::optional<std::vector<Literal>>& facts);
  std::vector<Literal> relevantDoors(const Actions& actions, const SceneVariant& variant);
  std::vector<Literal> withoutConstantDoors(std::vector<Literal> facts) const;

  SpeculativeExecutor& executor_;
  const Config& scene_;
  const std::vector<TaskDoor> doors_;
  TaskLogic& logic_;
  WaypointCache& waypoints_;
  BranchLog& log_;
  bool has_learned_ = false;
};

}  // namespace kinegraph::inline task_planning_internal
