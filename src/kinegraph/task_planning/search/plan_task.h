#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/task_planning/search/task_plan.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph {

struct TaskOptions {
  std::optional<LogicDomain> domain = {};  ///< actions in logic; none: defaultDomain()
  TaskRules rules = {};                    ///< what actions of other names ask, or others in place of the default ones
  double seconds =
      std::numeric_limits<double>::infinity();  ///< gives up after that; the answer then depends on the machine
  long evaluations = 200000;                    ///< effort: of motion problems
  std::uint64_t seed = 0;                       ///< of the starts that are drawn
  VectorXd velocity = {};      ///< most |dq/dt|, a number or one per dof, rad/s or m/s; empty: the model's, or 1
  VectorXd acceleration = {};  ///< most |d2q/dt2|, rad/s^2 or m/s^2; empty: what reaches full speed in half a second
  int threads = 1;             ///< that try variants, and motions, side by side: the plan is the same, to the bit
  CancellationToken cancellation = {};  ///< asked now and then on the calling thread; may throw to end it
  std::function<std::shared_ptr<ManipulationHelper>()> helper = {};  ///< of waypoint problems; none: the usual kind
};

/// Finds what to do, and how to move, so that a goal holds: a search in logic proposes sequences of actions; cheap proofs
/// of reach, size and room, then waypoints with grasps and placements, then motions say whether bodies can carry them out;
/// conflicts go back into the logic. What is called solved has passed checkTaskPlan.
///
///     TaskPlan plan = planTask(C, "(on tray cup) (on tray jug)");
///     std::cout << plan.str() << '\n';
///
/// Without a domain the actions are those of defaultDomain. Grippers, objects and places are those that the scene names
/// (`logical: { is_gripper }`); else frames whose names end with gripper, frames with a joint of type rigid and a shape,
/// and level boxes that do not move. The Config is not changed. Not finding a plan is a status. Throws ParseError for
/// words of the goal that are not in the scene, ValueError for actions of which nothing is known and for options that make
/// no sense.
TaskPlan planTask(const Config& C, const std::string& goal, const TaskOptions& options = {});

class TaskSearch;

/// Plans that get better while one waits: the first is that of planTask, each further one takes less time than the one
/// before. They come from other waypoints of the same actions, and from other actions.
///
///     TaskPlans plans(C, "(on tray cup)", {.evaluations = 20000});
///     while (const auto plan = plans.next()) std::cout << plan->duration() << '\n';
class TaskPlans {
 public:
  TaskPlans(const Config& C, const std::string& goal, const TaskOptions& options = {});
  TaskPlans(TaskPlans&&) noexcept;
  TaskPlans& operator=(TaskPlans&&) noexcept;
  ~TaskPlans();

  /// None when the effort has ended, or nothing is left to try. Where there is no plan at all, the first says why.
  std::optional<TaskPlan> next();

 private:
  std::unique_ptr<TaskSearch> search_;
};

TaskPlans planTasks(const Config& C, const std::string& goal, const TaskOptions& options = {});

}  // namespace kinegraph
