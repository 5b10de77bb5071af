#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/common/option_table.h"
#include "kinegraph/ik/ik_target.h"
#include "kinegraph/planning/dynamic_obstacles/obstacle_trajectory.h"
#include "kinegraph/planning/steering/motion_constraint.h"

namespace kinegraph {

inline constexpr const char* kPlanMotion = "planMotion";  ///< names the caller in messages

/// The goal of a motion: one of several configurations, targets of inverse kinematics, or conditions. For targets and
/// conditions the planner samples several collision-free configurations; the motion ends at one of them.
struct MotionGoal {
  MotionGoal() = default;
  MotionGoal(VectorXd configuration) : configurations{std::move(configuration)} {}
  MotionGoal(std::vector<VectorXd> configurations) : configurations(std::move(configurations)) {}
  MotionGoal(std::vector<IkTarget> targets) : targets(std::move(targets)) {}
  MotionGoal(std::vector<MotionConstraint> conditions) : conditions(std::move(conditions)) {}

  /// A named joint state of the scene (Config::getStateNames).
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

/// Settings of planMotion; planOptionTable() documents the scalar ones. Budgets are evaluations: one evaluation is a
/// collision check of up to eight configurations side by side, a continuous check of one edge, an evaluation of the
/// constraints, or a sample. A check that exits early still counts as one.
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

  VectorXd velocity = {};      ///< limit of |dq/dt|, per dof or one for all, rad/s or m/s; empty: the model's
  VectorXd acceleration = {};  ///< limit of |d2q/dt2|; empty: full speed within a quarter of a second
  VectorXd jerk = {};          ///< limit of |d3q/dt3|; empty: none
  std::vector<MotionConstraint> constraints = {};  ///< of the whole path
  VectorXd start_velocity = {};                    ///< initial dq/dt, rad/s or m/s; empty: at rest
  VectorXd start_acceleration = {};                ///< initial d2q/dt2; needs start_velocity and jerk; empty: zero
  VectorXd end_velocity = {};       ///< final dq/dt; needs one goal configuration and a start at rest; empty: at rest
  VectorXd end_acceleration = {};   ///< final d2q/dt2; needs end_velocity and jerk; empty: zero
  bool prove_infeasibility = true;  ///< if no path is found, searches a proof that there is none
  bool timing = true;               ///< computes a time parameterization; else timed_path is empty
  std::vector<ObstacleTrajectory> obstacle_trajectories = {};  ///< dynamic obstacles; time 0 is the start of the motion

  void validate() const;  ///< throws ValueError that names the first invalid field

  /// Also validates the fields whose length or use depends on the number of dofs.
  void validateFor(int dofs) const;

  /// The rest of time_limit after some seconds; always positive.
  double timeLeft(double seconds) const;
};

const OptionTable<PlanOptions>& planOptionTable();

}  // namespace kinegraph
