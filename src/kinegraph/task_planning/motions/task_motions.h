#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/speculative_execution.h"
#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/task_planning/motions/meant_contacts.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// A piecewise linear motion.
struct TimedRows {
  MatrixXd path;   ///< (T, n)
  VectorXd times;  ///< (T,), s
};

/// Plans the motions of actions: continuously collision-free, within limits, from rest to rest.
class TaskMotions {
 public:
  /// How motions pass other things.
  struct Manner {
    double margin = 0.;         ///< preferred clearance, m
    double contact_speed = 0.;  ///< of hands close to where they take or leave something, m/s
  };

  /// `limits`: velocity and acceleration of each dof, (2, n). `start`: the initial facts.
  TaskMotions(SpeculativeExecutor& executor, MatrixXd limits, const Manner& manner, const std::vector<Literal>& start,
              std::uint64_t seed);

  struct Found {
    std::optional<TimedRows> motion;
    double margin = 0.;    ///< that the motion was planned with, m
    std::string cause;     ///< of a failure
    long evaluations = 0;  ///< spent
  };

  /// Plans the motion of an action from q0 to q1, in a scene with held objects attached. `before` is the action at q0,
  /// empty if there is none. `stopped` is queried regularly; true ends the search. `threads` returns the number of
  /// threads that a new search may use; the result does not depend on it.
  Found between(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                const TaskAction& before, const CancellationToken& stopped, const std::function<int()>& threads) const;

 private:
  struct PathResult {
    MotionPlan plan;
    long evaluations = 0;
  };

  Found search(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
               const TaskAction& before);
  Found planFree(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                 const TaskAction& before);
  Found planGuided(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action);
  Found planPush(const Config& C, const VectorXd& q0, const VectorXd& q1, const std::string& obj);
  MotionPlan findPath(const Config& C, const VectorXd& start, const VectorXd& goal,
                      const std::vector<MotionConstraint>& constraints = {},
                      const std::function<void()>& at_first_failure = {});
  std::vector<double> margins() const;
  Speculative<PathResult> pathSpeculatively(const Config& C, const VectorXd& start, const VectorXd& goal) const;
  MotionPlan countedPlan(PathResult& findPath);
  TaskAction pickAtStart(const Config& C, const VectorXd& q0) const;
  std::vector<VectorXd> retreat(const Config& C, const Surroundings& around, const VectorXd& q,
                                const TaskAction& action) const;
  std::vector<VectorXd> straight(const Config& C, const VectorXd& q, const std::string& hand,
                                 const Vector3d& step) const;
  TimedRows steady(const Config& C, TimedRows rows, const std::vector<std::string>& carried) const;
  TimedRows slower(const Config& C, TimedRows rows, const std::vector<std::string>& objects, double most) const;
  Found timed(const Surroundings& around, const MatrixXd& configurations) const;

  SpeculativeExecutor& executor_;
  MatrixXd limits_;
  double margin_, contact_speed_;
  bool has_doors_;
  std::vector<std::string> hands_, objects_;
  std::uint64_t seed_;
  CancellationToken stopped_;
  std::function<int()> threads_;
  long evaluations_ = 0;
};

/// Returns the velocity and acceleration limits of each dof, (2, n). Each argument is one number for all dofs or one
/// per dof. Empty: the model's velocities, or 1, and accelerations that reach them in half a second. Throws ValueError
/// for other sizes.
MatrixXd taskMotionLimits(const Config& C, const VectorXd& velocity, const VectorXd& acceleration);

}  // namespace kinegraph::inline task_planning_internal
