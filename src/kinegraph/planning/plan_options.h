#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/common/option_table.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"
#include "kinegraph/planning/steering/manifold.h"

namespace kinegraph {

/// Where a motion is to end: at one of several postures, or where targets of inverse kinematics are met, or where
/// conditions hold. Of the latter two, several free postures are looked for, and the motion goes to one of them.
struct MotionGoal {
  MotionGoal() = default;
  MotionGoal(VectorXd configuration) : configurations{std::move(configuration)} {}
  MotionGoal(std::vector<VectorXd> configurations) : configurations(std::move(configurations)) {}
  MotionGoal(std::vector<IkTarget> targets) : targets(std::move(targets)) {}
  MotionGoal(std::vector<MotionConstraint> conditions) : conditions(std::move(conditions)) {}

  /// A joint state that the scene knows by name (Config::getStateNames).
  static MotionGoal named(std::string state) {
    MotionGoal goal;
    goal.state = std::move(state);
    return goal;
  }

  std::vector<VectorXd> configurations;
  std::vector<IkTarget> targets;
  std::vector<MotionConstraint> conditions;
  std::string state;
};

/// Settings of planMotion; planOptionTable() says what each number means.
struct PlanOptions {
  double margin = 0.;
  std::string optimize = "time";
  int restarts = 4;
  double blend = .05;
  double max_start_penetration = .005;
  double constraint_tolerance = 1e-3;
  int max_goal_samples = 8;
  int max_evaluations = 1000000;
  int improvement_evaluations = 0;
  int slices = 0;
  double time_limit = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 0;
  int threads = 1;

  VectorXd velocity = {};      ///< most |dq/dt| per dof, or one for all, rad/s or m/s; empty: the model's
  VectorXd acceleration = {};  ///< most |d2q/dt2|; empty: full speed within a quarter of a second
  VectorXd jerk = {};          ///< most |d3q/dt3|; empty: none
  std::vector<MotionConstraint> constraints = {};  ///< that hold all along the path
  VectorXd start_velocity = {};                    ///< dq/dt with which the motion begins, rad/s or m/s; empty: at rest
  VectorXd start_acceleration = {};                ///< d2q/dt2, with start_velocity and limits of the jerk; empty: none
  bool prove_infeasibility = true;                 ///< where no way is found, a proof that there is none is looked for
  bool timing = true;                              ///< the path gets times; else `timed` is empty
  std::vector<ObstacleTrajectory> obstacle_trajectories =
      {};  ///< what moves meanwhile; times count from the begin of the motion, s

  void validate() const;  ///< throws ValueError naming the first field that makes no sense

  /// The same for a scene with that many dofs.
  void validateFor(int dofs) const;

  /// What is left of time_limit after so many seconds, and a moment at least.
  double timeLeft(double seconds) const;
};

const OptionTable<PlanOptions>& planOptionTable();

}  // namespace kinegraph
