#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/motion/plan_motion.h"
#include "kinegraph/tasks/task_words.h"

namespace kinegraph {

/// A motion as rows, straight in between.
struct TimedRows {
  MatrixXd path;   ///< (T, n)
  VectorXd times;  ///< (T,), s
};

/// Finds the motions of actions: free of collisions at all times, within limits, at rest where an action ends.
class TaskMotions {
 public:
  /// `limits`: most velocity and acceleration of each dof, 2 x n. `start`: what holds at first. `stopped` is asked now and
  /// then; true ends a search, and it may throw. What is found does not depend on `threads`.
  TaskMotions(MatrixXd limits, const std::vector<Literal>& start, std::uint64_t seed, int threads = 1,
              std::function<bool()> stopped = {});

  struct Found {
    std::optional<TimedRows> motion;
    std::string why;  ///< there is none
  };

  /// The motion of an action from q0 to q1, in a scene with what is held attached. `before` is what was done at its start,
  /// empty if nothing was.
  Found between(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                const TaskAction& before);

  long evaluations = 0;  ///< so far

 private:
  Found among(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
              const TaskAction& before);
  Found guided(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action);
  Found pushed(const Config& C, const VectorXd& q0, const VectorXd& q1, const std::string& obj);
  MotionPlan way(const Config& C, const VectorXd& start, const VectorXd& goal,
                 const std::vector<MotionConstraint>& constraints = {});
  std::vector<VectorXd> piece(const Config& C, const VectorXd& q, const std::optional<VectorXd>& away) const;
  std::optional<VectorXd> leaving(const Config& C, const VectorXd& q, const TaskAction& action) const;
  TimedRows steady(const Config& C, TimedRows rows, const std::vector<std::string>& carried) const;
  TimedRows slower(const Config& C, TimedRows rows, const std::vector<std::string>& objects, double most) const;
  TimedRows timed(const Config& C, const MatrixXd& postures) const;

  MatrixXd limits_;
  bool has_doors_;
  std::vector<std::string> hands_, objects_;
  std::uint64_t seed_;
  int threads_;
  std::function<bool()> stopped_;
};

/// Most velocity and acceleration of each dof, 2 x n: as given, a number for all or one per dof; empty: the model's
/// velocities (1 where it says none), and accelerations that reach them in half a second. Throws ValueError for other
/// sizes.
MatrixXd taskMotionLimits(const Config& C, const VectorXd& velocity, const VectorXd& acceleration);

}  // namespace kinegraph
