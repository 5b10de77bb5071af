#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/task_planning/search/task_plan.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph::inline task_planning_internal {
class TaskSearch;
}

namespace kinegraph {

struct TaskOptions {
  std::optional<LogicDomain> domain = {};  ///< actions in logic; none: defaultDomain()
  TaskRules rules = {};  ///< geometric meaning of actions, by name; replaces or extends the default rules

  /// s of wall time, after which the search ends with `timeout`. With a limit the result depends on the machine.
  double time_limit = std::numeric_limits<double>::infinity();
  long max_evaluations = 200000;  ///< of the functions of waypoint and motion problems
  std::uint64_t seed = 0;         ///< of sampled initial guesses
  VectorXd velocity = {};         ///< |dq/dt| limit, one number or one per dof, rad/s or m/s; empty: the model's, or 1
  VectorXd acceleration = {};     ///< |d2q/dt2| limit, rad/s^2 or m/s^2; empty: full speed is reached in half a second
  double margin = kTaskMargin;  ///< m: clearance of all pairs whose contact is not meant; less only where there is none
  double contact_speed = kContactSpeed;  ///< m/s: of hands up to 5 cm away from where they take or leave something
  int threads = 1;                       ///< that solve variants and motions in parallel; the plan is bit-identical

  /// Queried on the calling thread. planTask throws Cancelled if the token cancels, and passes on what it throws.
  CancellationToken cancellation = {};
  std::function<std::shared_ptr<ManipulationHelper>()> helper = {};  ///< makes helpers; none: ManipulationHelper
};

/// Plans actions and their motion so that a goal holds. A search in logic proposes sequences of actions. Cheap proofs
/// of reach, size and room, then waypoints with grasps and placements, then motions test whether bodies can carry them
/// out. Each failure becomes a constraint of the logic. A solved plan has passed checkTaskPlan.
///
/// Among feasible plans the robust one is taken: objects are put down with their whole footprint on their place,
/// towards its middle and apart from others; hands approach and retreat straight; and all pairs whose contact is not
/// meant keep `margin`. Where only less is possible, TaskPlan::warnings say between what, and how much.
/// TaskPlan::tolerances has the error of poses that each step survives.
///
///     TaskPlan plan = planTask(C, "(on tray cup) (on tray jug)");
///     std::cout << plan.str() << '\n';
///
/// Without a domain, the actions are those of defaultDomain. Grippers, objects and places are the frames that the scene
/// labels (`logical: { is_gripper }`). A scene without labels has as grippers the frames whose names end with
/// "gripper", as objects the frames with a rigid joint and a shape, and as places level boxes that do not move. Fingers
/// are taken to be open, as `execute` opens them before each grasp. The Config is not changed. Finding no plan is a
/// status. Throws ParseError for words of the goal that are not in the scene, ValueError for actions without a rule and
/// for invalid options.
TaskPlan planTask(const Config& C, const std::string& goal, const TaskOptions& options = {});

/// Returns a function for TaskPlan::replanner.
std::function<TaskPlan(const Config&, const RepairOptions&)> replannerTo(std::string goal, TaskOptions options);

/// An anytime search: the first plan is that of planTask, and each further plan is faster than the one before. Further
/// plans come from other waypoints of the same actions, and from other actions.
///
///     TaskPlans plans(C, "(on tray cup)", {.max_evaluations = 20000});
///     while (const auto plan = plans.next()) std::cout << plan->duration() << '\n';
class TaskPlans {
 public:
  TaskPlans(const Config& C, const std::string& goal, const TaskOptions& options = {});
  TaskPlans(TaskPlans&&) noexcept;
  TaskPlans& operator=(TaskPlans&&) noexcept;
  ~TaskPlans();

  /// The next plan; none if the budget is spent or nothing is left to try. If there is no plan at all, the first call
  /// returns a TaskPlan with the reason.
  std::optional<TaskPlan> next();

 private:
  std::unique_ptr<TaskSearch> search_;
};

/// Starts a search for several plans to a goal; `next` returns them one by one.
TaskPlans planTasks(const Config& C, const std::string& goal, const TaskOptions& options = {});

/// Checks a plan by playing it in a copy of the scene. Returns the violations, a sentence each. The check knows the
/// scene, the actions and the motion, and nothing of the search. Objects move only by being taken along.
///
/// - Logic: the goal holds after the last action. `states`, as of statesAlong, has the facts; without them this is
/// skipped.
/// - Timing: the motion does not jump, rests at the beginning and the end of each action, and keeps its velocity and
///   acceleration limits.
/// - Joints stay within their limits, and nothing overlaps by more than 1 mm, continuously (Config::checkMotion).
/// - Pairs whose contact is not meant keep `margin` (m); none: that of the plan. Slides and doors are exempt.
/// - A hand touches the object that it takes, to 1 mm.
/// - An object that is put down stands level to half a degree, at the height of its place to 1 mm, with its center 5 mm
///   inside the edges. Its center of mass, with everything fixed to it, is above the area shared with the place.
/// - Objects that stand on a carried object tilt by less than 5 degrees and are accelerated by at most 2 m/s^2.
/// - A pushed object moves straight and level, away from the pusher and from the contact. A tool that pulls is held.
/// - Doors move only while a hand holds their handle to 1 mm and half a degree, except for the rotation that a round
/// handle   allows. Afterwards they are open or closed.
/// - At rest, nothing overlaps. An object that is held at the start may overlap the robot as it does then, until it is
/// put   down and the hand has left it.
///
/// Throws ValueError for a plan whose parts do not fit each other or the scene.
std::vector<std::string> checkTaskPlan(const Config& C, const TaskPlan& plan,
                                       const std::vector<std::vector<Literal>>& states = {},
                                       std::optional<double> margin = {});

}  // namespace kinegraph
