#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/speculative_execution.h"
#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// A motion as rows, straight in between.
struct TimedRows {
  MatrixXd path;   ///< (T, n)
  VectorXd times;  ///< (T,), s
};

/// Finds the motions of actions: free of collisions at all times, within limits, at rest where an action ends.
class TaskMotions {
 public:
  /// `limits`: most velocity and acceleration of each dof, 2 x n. `start`: what holds at first.
  TaskMotions(SpeculativeExecutor& ahead, MatrixXd limits, const std::vector<Literal>& start, std::uint64_t seed);

  struct Found {
    std::optional<TimedRows> motion;
    std::string why;       ///< there is none
    long evaluations = 0;  ///< it took
  };

  /// The motion of an action from q0 to q1, in a scene with what is held attached. `before` is what was done at its start,
  /// empty if nothing was. `stopped` is asked now and then; true ends the search. `threads`: how many a search may take that
  /// begins now; what is found does not depend on it.
  Found between(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                const TaskAction& before, const CancellationToken& stopped, const std::function<int()>& threads) const;

 private:
  struct Way {
    MotionPlan plan;
    long evaluations = 0;
  };

  Found search(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
               const TaskAction& before);
  Found among(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
              const TaskAction& before);
  Found guided(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action);
  Found pushed(const Config& C, const VectorXd& q0, const VectorXd& q1, const std::string& obj);
  MotionPlan way(const Config& C, const VectorXd& start, const VectorXd& goal,
                 const std::vector<MotionConstraint>& constraints = {},
                 const std::function<void()>& at_first_failure = {});
  Speculative<Way> pathSpeculatively(const Config& C, const VectorXd& start, const VectorXd& goal) const;
  MotionPlan taken(Way& way);
  std::vector<VectorXd> piece(const Config& C, const VectorXd& q, const std::optional<VectorXd>& away) const;
  std::optional<VectorXd> leaving(const Config& C, const VectorXd& q, const TaskAction& action) const;
  TimedRows steady(const Config& C, TimedRows rows, const std::vector<std::string>& carried) const;
  TimedRows slower(const Config& C, TimedRows rows, const std::vector<std::string>& objects, double most) const;
  TimedRows timed(const Config& C, const MatrixXd& configurations) const;

  SpeculativeExecutor& ahead_;
  MatrixXd limits_;
  bool has_doors_;
  std::vector<std::string> hands_, objects_;
  std::uint64_t seed_;
  CancellationToken stopped_;
  std::function<int()> threads_;
  long evaluations_ = 0;  ///< so far
};

/// Most velocity and acceleration of each dof, 2 x n: as given, a number for all or one per dof; empty: the model's
/// velocities (1 where it says none), and accelerations that reach them in half a second. Throws ValueError for other
/// sizes.
MatrixXd taskMotionLimits(const Config& C, const VectorXd& velocity, const VectorXd& acceleration);

}  // namespace kinegraph
