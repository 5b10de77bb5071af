#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/task_planning/lgp/default_lgp_abstraction.h"
#include "kinegraph/task_planning/lgp/lgp_waypoints.h"

namespace kinegraph {

/// Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. No further plan begins
/// as one that failed from all starts; where there is no further plan, those that failed are tried from other starts, in
/// three rounds. Effort is counted in solves. Python has it as LGP_Tool; calls are spelled as scripts know them.
///
///     LgpTool lgp(C, std::make_shared<DefaultLgpAbstraction>(C, "problem.lgp"));
///     if (lgp.solve()) lgp.solveFullMotion();
///
/// Calls that need a plan throw ValueError where none was found yet.
class LgpTool {
 public:
  using Plan = std::vector<TaskAction>;

  /// Nothing is searched yet. The tool sees what is changed in the scene later. Throws ValueError for less than one thread
  /// and options that make no sense.
  LgpTool(const Config& C, std::shared_ptr<LgpAbstraction> tamp, LgpOptions options = {});
  LgpTool(const LgpTool&) = delete;
  LgpTool& operator=(const LgpTool&) = delete;

  const Config C;                              ///< the scene
  const std::shared_ptr<LgpAbstraction> tamp;  ///< what is asked for plans, and for what their actions ask
  LgpOptions options;

  std::string status = "not started";  ///< then: solved, proved impossible, not found
  std::string message;                 ///< why there is no plan

  int solves() const { return waypoints_.solves; }             ///< waypoint problems so far, each start counts
  long evaluations() const { return waypoints_.evaluations; }  ///< of them

  /// Searches until a new plan with feasible waypoints is found, for `maxSolves` solves of waypoint problems at most.
  /// Repeated calls give further plans. With `verbose`, a line per plan that was tried. If there is none, `status` is
  /// "proved impossible" (the logic has no plan at all) or "not found", and `message` says why plans failed.
  bool solve(int verbose = 1, int maxSolves = 2000);

  bool hasPlan() const { return bool(komo_); }         ///< was one found?
  const Plan& getSolvedPlan() const;                   ///< that was found last
  const std::shared_ptr<Komo>& getSolvedKOMO() const;  ///< its waypoint problem, at the solution: a slice per action

  /// The motion of one action (0: the first) between its waypoints, with attachments as they are then: 30 slices, on the
  /// straight way. `fixEnd`: it ends exactly at the waypoint. Throws ValueError for an action that is not there.
  std::shared_ptr<Komo> get_piecewiseMotionProblem(int phase, bool fixEnd = true) const;

  /// The motion over all actions, 30 slices each, that starts at the waypoints, or where the scene is.
  std::shared_ptr<Komo> get_fullMotionProblem(bool initWithWaypoints = true) const;

  /// Solves the motions of all actions; leaves them in `paths`.
  std::vector<SolverResult> solvePiecewiseMotions(int verbose = 1);
  std::vector<MatrixXd> paths;  ///< 30 x n each, rad or m

  /// Solves the motion over all actions, from the waypoints, then from near them; leaves it in `motion` and `path`.
  SolverResult solveFullMotion(int verbose = 1);
  std::shared_ptr<Komo> motion;
  MatrixXd path;  ///< T x n, rad or m

  /// Shows the waypoints in the browser; `pause` waits for a key. Returns the key, or 0. Defined in front.
  int view_solved(bool pause = true);
  void view_close();

 private:
  bool found(const Plan& plan);
  LgpSolve solveFromFreeWaypoints(const std::shared_ptr<Komo>& problem);
  void conclude(bool is_spent);

  LgpWaypoints waypoints_;
  Plan plan_;                   ///< that was found last; empty: none
  std::shared_ptr<Komo> komo_;  ///< of it
  VectorXd x_;
  bool has_plans_ = false;    ///< did the logic give any?
  std::vector<Plan> failed_;  ///< to be tried from other starts
  std::size_t next_ = 0;      ///< of them
  int round_ = 1;
};

}  // namespace kinegraph
