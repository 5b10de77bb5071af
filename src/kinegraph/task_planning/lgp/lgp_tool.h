#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"
#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

namespace kinegraph::inline task_planning_internal {
class LgpWaypoints;
}

namespace kinegraph {

/// Options of LgpTool.
struct LgpOptions {
  int threads = 1;         ///< that solve in parallel; results are bit-identical
  std::uint64_t seed = 0;  ///< of sampled initial guesses
  SolverOptions solver = {.verbose = 0};
  std::function<bool(const SolverResult&)> accepts =
      {};  ///< whether a result is a solution; none: SolverResult::feasible
  std::function<std::string(const SolverResult&)> describes = {};  ///< describes a result; none: SolverResult::summary
  std::function<void(const std::string& line)> print = {};         ///< none: logMessage
  CancellationToken cancellation = {};                             ///< queried on the calling thread; may throw

  bool isSolved(const SolverResult& result) const { return accepts ? accepts(result) : result.feasible; }
  std::string describe(const SolverResult& result) const;
  void printLine(const std::string& line) const;
};

/// The result of solving a problem from several initial guesses.
struct LgpSolve {
  SolverResult result;  ///< of the first guess that led to a solution, else of the last one
  bool is_solved = false;
  int solves = 0;  ///< number of guesses that were tried
  long evaluations = 0;
};

/// Solves from guesses in turn, or in parallel, until one leads to a solution, and leaves the problem there.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options);

/// The same with other solver options.
LgpSolve solveFrom(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts, const LgpOptions& options,
                   const SolverOptions& solver);

/// Solves independent problems from their current paths, in parallel. `take` is called for each, in order.
void solveEach(const std::vector<std::shared_ptr<Komo>>& problems, const LgpOptions& options,
               const std::function<void(int problem, SolverResult result)>& take);

/// How LgpTool::solve ended.
enum class LgpStatus {
  not_started,    ///< LgpTool::solve was not called yet
  solved,         ///< there is a plan with feasible waypoints
  infeasible,     ///< proved: the logic has no plan at all
  no_plan_found,  ///< no plan was found within the budget of solves; this proves nothing
};

/// The enumerator's spelling: "no_plan_found".
std::string lgpStatusName(LgpStatus status);

/// Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. No further plan
/// begins like one that failed from all initial guesses. If there is no further plan, the failed ones are tried from
/// other guesses, in three rounds. The budget counts solves. In Python it is LGP_Tool; calls are spelled as in the
/// reference.
///
///     LgpTool lgp(C, std::make_shared<DefaultLgpAbstraction>(C, "problem.lgp"));
///     if (lgp.solve()) lgp.solveFullMotion();
///
/// Calls that need a plan throw ValueError before one is found.
class LgpTool {
 public:
  using Plan = std::vector<TaskAction>;

  /// Makes a tool that shares the scene, later changes included. Throws ValueError for less than one thread and for
  /// invalid options.
  LgpTool(const Config& C, std::shared_ptr<LgpAbstraction> tamp, LgpOptions options = {});
  LgpTool(const LgpTool&) = delete;
  LgpTool& operator=(const LgpTool&) = delete;
  ~LgpTool();

  const Config C;                              ///< the scene
  const std::shared_ptr<LgpAbstraction> tamp;  ///< plans, and the constraints of their actions
  LgpOptions options;

  LgpStatus status = LgpStatus::not_started;
  std::string message;  ///< "" if solved, else the reason for which there is no plan

  int solves() const;        ///< of waypoint problems so far; each guess counts
  long evaluations() const;  ///< spent by them

  /// Searches for a new plan with feasible waypoints, with at most `maxSolves` solves of waypoint problems.
  /// Repeated calls give further plans. With `verbose`, reports each plan that was tried in a line. Returns whether a
  /// plan was found; `status` and `message` tell why not.
  bool solve(int verbose = 1, int maxSolves = 2000);

  bool hasPlan() const { return bool(komo_); }         ///< whether a plan was found
  const Plan& getSolvedPlan() const;                   ///< the last plan
  const std::shared_ptr<Komo>& getSolvedKOMO() const;  ///< its waypoint problem, at the solution: a slice per action

  /// Returns the motion problem of one action (0: the first) between its waypoints, with the attachments of that time:
  /// 30 slices, initialized by interpolation. `fixEnd`: the motion ends exactly at the waypoint. Throws ValueError for
  /// other indices.
  std::shared_ptr<Komo> get_piecewiseMotionProblem(int phase, bool fixEnd = true) const;

  /// Returns the motion problem of all actions, 30 slices each, initialized with the waypoints or with the scene.
  std::shared_ptr<Komo> get_fullMotionProblem(bool initWithWaypoints = true) const;

  /// Solves the motions of all actions, and stores them in `paths`.
  std::vector<SolverResult> solvePiecewiseMotions(int verbose = 1);
  std::vector<MatrixXd> paths;  ///< 30 x n each, rad or m

  /// Solves the motion of all actions, from the waypoints, then from perturbed ones, and stores it in `motion` and
  /// `path`.
  SolverResult solveFullMotion(int verbose = 1);
  std::shared_ptr<Komo> motion;
  MatrixXd path;  ///< T x n, rad or m

  /// Shows the waypoints in the browser; `pause` waits for a key. Returns the key, or 0. Defined in api.
  int view_solved(bool pause = true);
  void view_close();

 private:
  bool found(const Plan& plan);
  LgpSolve solveFromFreeWaypoints(const std::shared_ptr<Komo>& problem);
  void conclude(bool is_spent);

  std::unique_ptr<LgpWaypoints> waypoints_;
  Plan plan_;                   ///< the last plan; empty: none
  std::shared_ptr<Komo> komo_;  ///< of it
  VectorXd x_;
  bool has_plans_ = false;    ///< whether the logic gave any
  std::vector<Plan> failed_;  ///< plans to be tried from other guesses
  std::size_t next_ = 0;      ///< index in failed_
  int round_ = 1;
};

}  // namespace kinegraph
