#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "kinegraph/task_planning/motions/task_motions.h"
#include "kinegraph/task_planning/search/task_plan.h"
#include "kinegraph/task_planning/search/waypoint_solver.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

/// Evaluates sequences of actions in geometry: solves for waypoints, plans the motions between them, and checks the
/// plan. A long sequence whose waypoints are not found together is solved in pieces, one after the other, each from the
/// end of the one before, with backtracking; its placements leave room for those of later pieces. The outcome depends
/// on the actions and the seed only. Several threads may evaluate at the same time.
class SequenceEvaluator {
 public:
  /// `scene` is planned in; checkTaskPlan gets `original`. Both are only copied. `limits`: velocity and acceleration of
  /// each dof, (2, n). `executor` and `settings` must outlive the evaluator.
  SequenceEvaluator(SpeculativeExecutor& executor, const WaypointSolver::Settings& settings,
                    std::shared_ptr<const Config> scene, std::shared_ptr<const Config> original, MatrixXd limits,
                    std::vector<Literal> goal, std::vector<Literal> start);

  struct Request {
    std::vector<TaskAction> actions;
    std::vector<std::vector<Literal>> states;  ///< in logic, before and after each action
    int seed = 0;
    Priority priority = Priority::high;
    std::function<void()> at_first_failure = {};  ///< called when the first guess has led to no waypoints
  };
  struct Outcome {
    FutureFailure waypoint_failure;             ///< null if there are waypoints
    std::optional<TaskFailure> motion_failure;  ///< of the motions, or of the check
    std::size_t feasible_actions = 0;           ///< at the beginning of the sequence; a failure is behind them
    double margin = 0.;                         ///< of the motions, m
    std::optional<TaskPlan> plan;               ///< without the fields that describe the search
    long evaluations = 0;
  };
  Outcome evaluate(const Request& request, const CancellationToken& stopped) const;

 private:
  struct Motion {
    SubProblem part;
    TaskAction action, before;
  };
  using Motions = std::vector<Motion>;

  /// A part of a sequence, from a scene on.
  struct Piece {
    std::shared_ptr<const Config> scene;
    std::vector<TaskAction> actions, later;
    TaskAction before;
    int seed = 0;
  };

  Outcome evaluatePiece(const Piece& piece, const Request& request, const CancellationToken& stopped,
                        WaypointSolver& solver, bool only_first) const;
  Outcome evaluateInPieces(const Request& request, const CancellationToken& stopped) const;
  void check(Outcome& outcome, const Request& request) const;
  Motions motionsBetween(const Config& C, const TaskWaypoints& waypoints, const TaskAction& before) const;
  std::vector<TimedRows> planMotions(const Config& C, const std::shared_ptr<const Motions>& parts, Priority priority,
                                     const CancellationToken& stopped, Outcome& outcome) const;
  std::vector<Literal> blockingDoors(const Config& C, const Motion& motion, const CancellationToken& stopped,
                                     Outcome& outcome) const;
  void judge(TaskPlan& plan, const Motions& parts) const;
  TaskPlan assemble(const Config& C, const TaskWaypoints& waypoints, const std::vector<TimedRows>& rows) const;

  SpeculativeExecutor& executor_;
  const WaypointSolver::Settings& settings_;
  const std::shared_ptr<const Config> scene_, original_;
  const MatrixXd limits_;
  const std::vector<Literal> goal_, start_;
  const TaskMotions motions_;
};

}  // namespace kinegraph::inline task_planning_internal
