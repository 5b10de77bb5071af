#include "kinegraph/planning/plan_options.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr int kMostSlices = 10000;
constexpr double kLeastTime = 1e-9;  // s

void validateLimit(const VectorXd& limit, const char* name, int dofs) {
  if (limit.size() > 1 && limit.size() != dofs)
    throw ValueError(cat("planMotion: ", name, " has ", limit.size(), " numbers; expected one, or ", dofs));
  for (const double value : limit) {
    if (!(value > 0.)) throw ValueError(cat("planMotion: ", name, " is ", value, "; expected positive numbers"));
  }
}

bool isMoving(const VectorXd& velocity) { return velocity.size() > 0 && !velocity.isZero(0.); }

void validateDofs(const VectorXd& numbers, const char* name, int dofs) {
  if (numbers.size() > 0 && numbers.size() != dofs)
    throw ValueError(cat("planMotion: ", name, " has ", numbers.size(), " numbers; expected ", dofs));
  if (!numbers.allFinite()) throw ValueError(cat("planMotion: ", name, " has numbers that are not finite"));
}

/// `end`: "start" or "end".
void validateEnd(const PlanOptions& options, const std::string& end, const VectorXd& velocity,
                 const VectorXd& acceleration, int dofs) {
  validateDofs(velocity, cat(end, "_velocity").c_str(), dofs);
  validateDofs(acceleration, cat(end, "_acceleration").c_str(), dofs);
  if (!isMoving(acceleration)) return;
  if (options.jerk.size() == 0)
    throw ValueError(cat("planMotion: ", end, "_acceleration needs jerk limits; pass jerk"));
  if (!isMoving(velocity))
    throw ValueError(cat("planMotion: ", end, "_acceleration needs ", end == "start" ? "a " : "an ", end,
                         "_velocity; a motion ", end == "start" ? "from rest starts" : "to rest ends",
                         " with zero acceleration"));
}

}  // namespace

const OptionTable<PlanOptions>& planOptionTable() {
  using O = PlanOptions;
  using Range = OptionRange;
  static const OptionTable<O> table(
      "planMotion",
      {{"margin", &O::margin, "m",
        "Least distance of all collidable pairs. Around a start or goal that keeps less, its own distance counts.",
        Range::notNegative()},
       {"optimize",
        &O::optimize,
        "",
        "Quantity to minimize: 'time', 'length', or 'clearance' (the largest margin for which a path is found, then "
        "the time).",
        {"time", "length", "clearance"}},
       {"restarts", &O::restarts, "", "Number of paths that are searched and shortened; the best one counts.",
        Range::atLeastOne()},
       {"blend", &O::blend, "rad or m",
        "Largest deviation, in every dof, of a rounded corner from the path; 0 stops at corners.",
        Range::notNegative()},
       {"max_start_penetration", &O::max_start_penetration, "m",
        "Maximum penetration of the start or goal that the planner resolves by a retreat motion, with a warning.",
        Range::notNegative()},
       {"constraint_tolerance", &O::constraint_tolerance, "",
        "Maximum violation of each constraint row, in its own unit.", Range::positive()},
       {"max_goal_samples", &O::max_goal_samples, "",
        "Maximum number of goal configurations that are sampled for targets or conditions.", Range::atLeastOne()},
       {"max_evaluations", &O::max_evaluations, "",
        "Budget of the first search. One evaluation is a collision check of up to eight configurations, a continuous "
        "check of one edge, an evaluation of the constraints, or a sample.",
        Range::atLeastOne()},
       {"improvement_evaluations", &O::improvement_evaluations, "",
        "Evaluations that are spent on further paths after `restarts`; a started round is completed. planMotions takes "
        "1000000 if this is 0.",
        Range::notNegative()},
       {"slices", &O::slices, "",
        "Slices of a KOMO problem that smooths the motion, so that it accelerates less. The result replaces the motion "
        "if it is collision-free and faster. 0: none; 80 is a good number. Needs optimize='time', and no constraints, "
        "dynamic obstacles or start velocity.",
        Range::notNegative()},
       {"prove_infeasibility", &O::prove_infeasibility, "",
        "If no path is found, searches a proof that there is none, for up to 1.25 times the time limit. Without it the "
        "status 'no_path_found' comes sooner."},
       {"timing", &O::timing, "", "Computes a time parameterization. Without it the plan has a path only."},
       {"time_limit",
        &O::time_limit,
        "s",
        "Ends the search, and further improvements of a motion.",
        {[](double v) { return v > 0.; }, "a positive number"}},
       {"seed", &O::seed, "", "Seed of the samples. Equal seeds give equal motions."},
       {"threads", &O::threads, "", "Number of threads. The result does not depend on it.", Range::atLeastOne()}});
  return table;
}

void PlanOptions::validate() const { planOptionTable().validate(*this); }

double PlanOptions::timeLeft(double seconds) const { return std::max(kLeastTime, time_limit - seconds); }

void PlanOptions::validateFor(int dofs) const {
  validate();
  validateLimit(velocity, "velocity", dofs);
  validateLimit(acceleration, "acceleration", dofs);
  validateLimit(jerk, "jerk", dofs);
  validateEnd(*this, "start", start_velocity, start_acceleration, dofs);
  validateEnd(*this, "end", end_velocity, end_acceleration, dofs);
  const bool has_velocity = start_velocity.size() > 0 || end_velocity.size() > 0;
  if (!timing && (slices > 0 || !obstacle_trajectories.empty() || has_velocity))
    throw ValueError("planMotion: slices, obstacle_trajectories, start_velocity and end_velocity need timing");
  if (slices > 0 && (optimize != "time" || !constraints.empty() || !obstacle_trajectories.empty() || has_velocity))
    throw ValueError(
        "planMotion: slices needs optimize='time', and no constraints, obstacle_trajectories, start_velocity or "
        "end_velocity");
  if (isMoving(end_velocity) && (isMoving(start_velocity) || !obstacle_trajectories.empty()))
    throw ValueError("planMotion: end_velocity needs a start at rest, and no obstacle_trajectories");
  if (isMoving(end_velocity) && !acceleration.allFinite())
    throw ValueError("planMotion: acceleration is infinite; end_velocity needs a finite limit");
  if (slices == 1 || slices > kMostSlices)
    throw ValueError(cat("planMotion: slices is ", slices, "; expected 0, or 2 to ", kMostSlices));
  if (!obstacle_trajectories.empty() && !acceleration.allFinite())
    throw ValueError("planMotion: acceleration is infinite; dynamic obstacles need a finite limit");
}

}  // namespace kinegraph
