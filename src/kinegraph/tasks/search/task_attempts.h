#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/base/in_order.h"
#include "kinegraph/tasks/task_waypoints.h"

namespace kinegraph {

/// Why there are no waypoints, or no motion, and the scene at the waypoint that failed; null where there is none.
struct TaskFailure {
  std::string why;
  std::shared_ptr<const Config> ghost;
  std::size_t action = 0;           ///< that has no motion
  std::vector<Literal> doors = {};  ///< what is true of doors that shut it off: (closed drawer)
};

/// Finds the waypoints of sequences of actions: variants are tried, each from several starts, until one is feasible.
/// Threads try variants side by side; the first in order that is feasible counts, whatever the number of threads.
class TaskAttempts {
 public:
  struct Settings {
    TaskRules rules;
    std::uint64_t seed = 0;
    int threads = 1;
    std::function<bool()> is_late = {};  ///< true: gives up
    std::function<void()> between = {};  ///< asked now and then on the calling thread; may throw
    std::function<std::shared_ptr<ManipulationHelper>()> helper =
        {};  ///< of waypoint problems; none: of the usual kind
  };

  explicit TaskAttempts(Settings settings) : settings_(std::move(settings)) {}

  struct Found {
    std::shared_ptr<TaskWaypoints> waypoints;  ///< that satisfy all that the actions ask; null: there are none
    TaskFailure failure;                       ///< why not
  };

  /// `seed`: other waypoints for each; 0: placements and grasps begin where nothing is drawn.
  Found find(const Config& C, const std::vector<TaskAction>& actions, int seed);

  const TaskRules& rules() const { return settings_.rules; }

  long evaluations = 0;  ///< so far

 private:
  struct Attempt : Found {
    long evaluations = 0;
  };
  Attempt attempt(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants,
                  int seed, int index, const JobStopped& stopped) const;
  bool isLate() const { return settings_.is_late && settings_.is_late(); }

  Settings settings_;
};

}  // namespace kinegraph
