#pragma once

#include <compare>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/search/waypoint_solver.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

/// A change of the initial scene, in which a sequence of actions is tested by itself.
struct SceneVariant {
  std::vector<std::string> without;  ///< objects that do not collide
  std::vector<double> doors;         ///< joint positions of the doors, in the order of doorsOf; empty: unchanged
  auto operator<=>(const SceneVariant&) const = default;
};

/// Remembers which sequences of actions have waypoints in which variant of the scene, and solves for those that will be
/// asked for ahead of time, if there are threads for that.
class WaypointCache {
 public:
  using Actions = std::vector<TaskAction>;

  /// `executor` and `settings` must outlive the cache.
  WaypointCache(SpeculativeExecutor& executor, const WaypointSolver::Settings& settings,
                std::shared_ptr<const Config> scene, std::vector<TaskDoor> doors);

  /// The failure for which a sequence has no waypoints; null if it has some. Solves if that is unknown.
  const FutureFailure& failureOf(const Actions& actions, const SceneVariant& variant = {});

  /// Whether a sequence is known to fail in the scene as it is.
  bool isKnownToFail(const Actions& actions) const;

  /// Remembers a failure in the scene as it is.
  void setFailure(const Actions& actions, FutureFailure failure);

  /// Proper prefixes of a sequence whose result is unknown, up to the first one known to fail. They show the
  /// action at which the sequence fails.
  std::vector<Actions> unknownPrefixes(const Actions& actions) const;

  /// Allows threads to solve for these sequences. Any thread may call this.
  void prefetch(const std::vector<Actions>& all, Priority first);

  /// Stops and forgets all that was prefetched.
  void dropPrefetched();

  long evaluations() const { return evaluations_; }  ///< spent by failureOf so far

 private:
  using Key = std::pair<Actions, SceneVariant>;

  std::shared_ptr<const Config> sceneOf(const SceneVariant& variant) const;
  WaypointSolver::Result solve(const Key& key);

  SpeculativeExecutor& executor_;
  const WaypointSolver::Settings& settings_;
  const std::shared_ptr<const Config> scene_;
  const std::vector<TaskDoor> doors_;
  std::map<Key, FutureFailure> failures_;
  long evaluations_ = 0;
  std::mutex mutex_;                          ///< guards prefetched_
  std::map<Key, WaypointSolver> prefetched_;  ///< threads may be working on them
};

}  // namespace kinegraph::inline task_planning_internal
