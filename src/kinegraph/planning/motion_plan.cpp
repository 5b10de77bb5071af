#include "kinegraph/planning/motion_plan.h"

#include <algorithm>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"
#include "kinegraph/planning/endpoints.h"

namespace kinegraph {

std::string planStatusName(PlanStatus status) {
  switch (status) {
    case PlanStatus::solved:
      return "solved";
    case PlanStatus::invalid_start:
      return "invalid_start";
    case PlanStatus::invalid_goal:
      return "invalid_goal";
    case PlanStatus::goal_unreachable:
      return "goal_unreachable";
    case PlanStatus::infeasible:
      return "infeasible";
    case PlanStatus::no_path_found:
      return "no_path_found";
    case PlanStatus::no_timing_found:
      return "no_timing_found";
    case PlanStatus::timeout:
      return "timeout";
    case PlanStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

int MotionPlan::dimension() const { return space ? space->dofs() : timed_path.dimension(); }

void MotionPlan::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  if (!feasible()) throw ValueError(cat("MotionPlan.eval: there is no motion; ", message));
  if (!options.timing) throw ValueError("MotionPlan.eval: the path has no times; it was planned without timing");
  timed_path.evalTo(t, q, velocity, acceleration);
}

std::vector<VectorXd> MotionPlan::obstaclesAt(double t) const {
  std::vector<VectorXd> values;
  for (std::size_t i = 0; dynamic_scene && i < dynamic_scene->obstacles().size(); ++i)
    values.push_back(dynamic_scene->valuesAt(int(i), t));
  return values;
}

PlanOptions MotionPlan::optionsAt(double t) const {
  PlanOptions later = options;
  for (ObstacleTrajectory& obstacle : later.obstacle_trajectories) obstacle.times.array() -= t;
  return later;
}

double MotionPlan::clearance(double max_distance) const {
  if (!feasible()) throw ValueError(cat("MotionPlan.clearance: there is no motion; ", message));
  EdgeChecker checker(*scene, 0., 1e-4);
  double least = max_distance;
  for (Eigen::Index k = 0; k < path.rows(); ++k) {
    const VectorXd from = path.row(std::max<Eigen::Index>(k - 1, 0)).transpose(), to = path.row(k).transpose();
    least = checker.clearance(from.data(), to.data(), least);
  }
  return std::max(least, std::min(verified_margin, max_distance));
}

void MotionPlan::addSetupStage(double seconds) {
  if (stages.empty() || stages.front().name != "setup") stages.insert(stages.begin(), PlanStage{"setup", 0., 0, ""});
  for (const PlanStage& stage : stages) seconds -= stage.seconds;
  stages.front().seconds += std::max(0., seconds);
}

std::string MotionPlan::str() const {
  if (!feasible()) return cat(planStatusName(status), ": ", message);
  return cat("solved: ", path.rows(), " configurations, length ", length,
             options.timing ? cat(", ", duration(), " s") : "");
}

std::string MotionPlan::explain() const {
  std::string text = str();
  for (const std::string& warning : warnings) text += cat("\n  ", warning);
  for (const PlanStage& stage : stages) {
    text += cat("\n  ", stage.name, ": ", 1e3 * stage.seconds, " ms, ", stage.evaluations, " evaluations",
                stage.note.empty() ? "" : cat("; ", stage.note));
  }
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const SearchReport& search = searches[i];
    text += cat("\n  search ", i + 1, ": ", search.samples, " samples, trees of ", search.start_nodes,
                " nodes (start) and ", search.goal_nodes, " nodes (goals)");
  }
  if (feasible()) text += cat("\n  clearance: ", clearance() < .1 ? formatLength(clearance()) : "100 mm or more");
  return text;
}

}  // namespace kinegraph
