#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/task_planning/search/task_failure.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph::inline task_planning_internal {

/// Solves for the waypoints of a sequence of actions. It tries the variants of the actions, each from several initial
/// guesses, until one is feasible. Guesses may be solved in parallel: the first feasible one in order counts, so that
/// the result does not depend on the number of threads.
class WaypointSolver {
 public:
  struct Settings {
    TaskRules rules;
    std::uint64_t seed = 0;
    int threads = 1;
    std::function<bool()> is_late = {};  ///< true: the solver gives up; called by several threads
    std::function<std::shared_ptr<ManipulationHelper>()> helper = {};  ///< makes helpers; none: ManipulationHelper
    double contact_speed = kContactSpeed;                              ///< of hands near contacts, m/s
    double margin = kTaskMargin;                                       ///< preferred clearance, m
  };

  /// Prepares the problems. Each `seed` leads to other waypoints; with 0, the first guess samples neither placements
  /// nor grasps. The scene is only copied; `settings` must outlive the solver. Threads query `stopped`; once it returns
  /// true, nobody needs the result. `later`: actions that follow; placements leave room for theirs.
  WaypointSolver(SpeculativeExecutor& executor, const Settings& settings, std::shared_ptr<const Config> scene,
                 std::vector<TaskAction> actions, int seed, CancellationToken stopped = {},
                 std::vector<TaskAction> later = {});
  ~WaypointSolver();

  /// Allows threads to start: on the first guess with priority `first`, on the others with priority `others`.
  void begin(Priority first, Priority others) const;

  struct Result {
    std::shared_ptr<TaskWaypoints> waypoints;  ///< at the solution; null if there is none
    FutureFailure failure;                     ///< of the first guess; null if there are waypoints
    long evaluations = 0;
  };

  /// Solves, with `priority` for guesses that threads still have to start. `at_first_failure` is called when the first
  /// guess has failed. With `only_first`, no other guess is tried; a second call tries the others.
  Result solve(Priority priority = Priority::high, const std::function<void()>& at_first_failure = {},
               bool only_first = false);

 private:
  struct Problem;
  struct Choice;
  struct Solution;

  static Solution solveFrom(const Problem& problem, Choice& choice, std::size_t guess, int number,
                            const CancellationToken& stopped);
  FutureFailure failureAt(VectorXd x) const;

  SpeculativeExecutor& executor_;
  std::shared_ptr<Problem> problem_;
  std::vector<std::shared_ptr<Choice>> choices_;  ///< of variants
  std::vector<Speculative<Solution>> solutions_;  ///< of the guesses of each choice, in order
  std::size_t next_ = 0;                          ///< the next guess
  VectorXd first_;                                ///< the end of the solver from the first guess
};

}  // namespace kinegraph::inline task_planning_internal
