#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/speculative_execution.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph {

/// Why there are no waypoints, or no motion, and the scene at the waypoint that failed; null where there is none.
struct TaskFailure {
  std::string why;
  std::shared_ptr<const Config> ghost;
  std::size_t action = 0;           ///< that has no motion
  std::vector<Literal> doors = {};  ///< what is true of doors that shut it off: (closed drawer)
};

/// A failure whose cause is found out when it is asked for, which takes as long as other work.
using TaskCause = std::shared_ptr<const Speculative<TaskFailure>>;

/// Finds the waypoints of a sequence of actions: variants are tried, each from several starts, until one is feasible. Of
/// those that are tried side by side the first in order that is feasible counts.
class TaskAttempt {
 public:
  struct Settings {
    TaskRules rules;
    std::uint64_t seed = 0;
    int threads = 1;
    std::function<bool()> is_late = {};  ///< true: gives up; several threads ask
    std::function<std::shared_ptr<ManipulationHelper>()> helper =
        {};  ///< of waypoint problems; none: of the usual kind
  };

  /// `seed`: other waypoints for each; 0: placements and grasps begin where nothing is drawn. The scene is only copied;
  /// the settings must stay. `stopped`, which threads may ask: nobody wants the waypoints any more.
  TaskAttempt(SpeculativeExecutor& ahead, const Settings& settings, std::shared_ptr<const Config> scene,
              std::vector<TaskAction> actions, int seed, CancellationToken stopped = {});
  ~TaskAttempt();

  /// May be worked at from now on: the first start as much as `first` says, the others as much as `others`.
  void begin(Priority first, Priority others) const;

  struct Found {
    std::shared_ptr<TaskWaypoints> waypoints;  ///< that satisfy all that the actions ask; null: there are none
    TaskCause cause;                           ///< why not
    long evaluations = 0;
  };

  /// `at_first_failure` is called when the first start has led nowhere.
  Found find(Priority wanted = Priority::high, const std::function<void()>& at_first_failure = {});

 private:
  struct Problem;
  struct Choice;
  struct Start;

  static Start solve(const Problem& problem, Choice& choice, std::size_t start, int number,
                     const CancellationToken& stopped);
  TaskCause causeOf(VectorXd x) const;

  SpeculativeExecutor& ahead_;
  std::shared_ptr<Problem> problem_;
  std::vector<std::shared_ptr<Choice>> choices_;  ///< of variants
  std::vector<Speculative<Start>> starts_;        ///< of each choice, in order
};

}  // namespace kinegraph
