#include "kinegraph/planning/plan_options.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr int kMostSlices = 10000;
constexpr double kAMoment = 1e-9;  // s

void validateLimit(const VectorXd& limit, const char* name, int dofs) {
  if (limit.size() > 1 && limit.size() != dofs)
    throw ValueError(cat("planMotion: ", name, " has ", limit.size(), " numbers; expected one, or ", dofs));
  for (const double value : limit) {
    if (!(value > 0.)) throw ValueError(cat("planMotion: ", name, " is ", value, "; expected positive numbers"));
  }
}

void validateStartAcceleration(const PlanOptions& options, int dofs) {
  const VectorXd& given = options.start_acceleration;
  if (given.size() == 0) return;
  if (given.size() != dofs)
    throw ValueError(cat("planMotion: start_acceleration has ", given.size(), " numbers; expected ", dofs));
  if (!given.allFinite()) throw ValueError("planMotion: start_acceleration has numbers that are not finite");
  if (given.isZero(0.)) return;
  if (options.jerk.size() == 0)
    throw ValueError("planMotion: start_acceleration is for motions with limits of the jerk; give jerk, too");
  if (options.start_velocity.size() == 0 || options.start_velocity.isZero(0.))
    throw ValueError("planMotion: there is a start_acceleration and no start_velocity; from rest there is none");
}

}  // namespace

const OptionTable<PlanOptions>& planOptionTable() {
  using O = PlanOptions;
  using Range = OptionRange;
  static const OptionTable<O> table(
      "planMotion",
      {{"margin", &O::margin, "m",
        "Distance that all collidable pairs keep; around a start or goal that keeps less, what that keeps.",
        Range::notNegative()},
       {"optimize",
        &O::optimize,
        "",
        "What is made small: 'time', 'length', or 'clearance' (the largest margin that is found, then the time).",
        {"time", "length", "clearance"}},
       {"restarts", &O::restarts, "", "Ways that are searched and shortened; the best one counts.",
        Range::atLeastOne()},
       {"blend", &O::blend, "rad or m", "By how much corners may be rounded, in every dof; 0 stops at them.",
        Range::notNegative()},
       {"max_start_penetration", &O::max_start_penetration, "m",
        "Depth up to which a start or goal in collision is mended: the motion first leaves, and says so.",
        Range::notNegative()},
       {"constraint_tolerance", &O::constraint_tolerance, "",
        "Violation of each row of the constraints that is allowed, in its own unit.", Range::positive()},
       {"max_goal_samples", &O::max_goal_samples, "",
        "Most postures that are looked for where the goal is targets or conditions.", Range::atLeastOne()},
       {"max_evaluations", &O::max_evaluations, "",
        "Effort of the search of the first way, at most: looks at up to eight postures side by side, or at a motion at "
        "all times; "
        "postures that are drawn, or at which constraints are computed, count one each.",
        Range::atLeastOne()},
       {"improvement_evaluations", &O::improvement_evaluations, "",
        "Effort that is spent on further ways after `tries`: evaluations, each round of ways to its end. planMotions "
        "takes 1000000 where this is 0.",
        Range::notNegative()},
       {"slices", &O::slices, "",
        "Of a KOMO that bends the motion so that it accelerates less; taken if that is free and faster. 0: none, else "
        "80 are a good number. For 'time' alone, without constraints, moving obstacles and start velocity.",
        Range::notNegative()},
       {"prove_infeasibility", &O::prove_infeasibility, "",
        "Where no way is found, a proof that there is none is looked for, up to 1.25 times the time limit; without, "
        "the "
        "status is 'no_path_found' sooner."},
       {"timing", &O::timing, "",
        "The motion gets times; without, there is a path alone, and `at` has nothing to say."},
       {"time_limit",
        &O::time_limit,
        "s",
        "Ends the search, or what would improve its answer; effort is what evaluations and tries say.",
        {[](double v) { return v > 0.; }, "a positive number"}},
       {"seed", &O::seed, "", "Of random postures; the same one gives the same motion."},
       {"threads", &O::threads, "", "How many share the work; answers do not depend on it.", Range::atLeastOne()}});
  return table;
}

void PlanOptions::validate() const { planOptionTable().validate(*this); }

double PlanOptions::timeLeft(double seconds) const { return std::max(kAMoment, time_limit - seconds); }

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
        "planMotion: slices is for optimize 'time', without constraints, obstacle_trajectories and start_velocity");
  if (slices == 1 || slices > kMostSlices)
    throw ValueError(cat("planMotion: slices is ", slices, "; expected 0, or 2 to ", kMostSlices));
  if (!start_velocity.allFinite()) throw ValueError("planMotion: start_velocity has numbers that are not finite");
  validateStartAcceleration(*this, dofs);
  if (!obstacle_trajectories.empty() && !acceleration.allFinite())
    throw ValueError("planMotion: acceleration is infinite; among moving obstacles it has to be limited");
}

}  // namespace kinegraph
