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

void validateStartAcceleration(const PlanOptions& options, int dofs) {
  const VectorXd& acceleration = options.start_acceleration;
  if (acceleration.size() == 0) return;
  if (acceleration.size() != dofs)
    throw ValueError(cat("planMotion: start_acceleration has ", acceleration.size(), " numbers; expected ", dofs));
  if (!acceleration.allFinite()) throw ValueError("planMotion: start_acceleration has numbers that are not finite");
  if (acceleration.isZero(0.)) return;
  if (options.jerk.size() == 0) throw ValueError("planMotion: start_acceleration needs jerk limits; pass jerk");
  if (options.start_velocity.size() == 0 || options.start_velocity.isZero(0.))
    throw ValueError(
        "planMotion: start_acceleration needs a start_velocity; a motion from rest starts with zero acceleration");
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
  if (start_velocity.size() > 0 && start_velocity.size() != dofs)
    throw ValueError(cat("planMotion: start_velocity has ", start_velocity.size(), " numbers; expected ", dofs));
  if (!timing && (slices > 0 || !obstacle_trajectories.empty() || start_velocity.size() > 0))
    throw ValueError("planMotion: slices, obstacle_trajectories and start_velocity need timing");
  if (slices > 0 &&
      (optimize != "time" || !constraints.empty() || !obstacle_trajectories.empty() || start_velocity.size() > 0))
    throw ValueError(
        "planMotion: slices needs optimize='time', and no constraints, obstacle_trajectories or start_velocity");
  if (slices == 1 || slices > kMostSlices)
    throw ValueError(cat("planMotion: slices is ", slices, "; expected 0, or 2 to ", kMostSlices));
  if (!start_velocity.allFinite()) throw ValueError("planMotion: start_velocity has numbers that are not finite");
  validateStartAcceleration(*this, dofs);
  if (!obstacle_trajectories.empty() && !acceleration.allFinite())
    throw ValueError("planMotion: acceleration is infinite; dynamic obstacles need a finite limit");
}

}  // namespace kinegraph
