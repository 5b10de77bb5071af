#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline collision_internal {
class PlacedBodies;
struct BodyPairs;
}

namespace kinegraph::inline control_internal {
class ChatterDamping;
}

namespace kinegraph::inline kinematics_internal {
class State;
struct KinematicModel;
}

namespace kinegraph::inline solvers_internal {
class DualActiveSet;
}

namespace kinegraph {

struct DiffIkOptions {
  VectorXd velocity;               ///< (n,), rad/s or m/s: limits; empty: the model's; infinity for none
  VectorXd acceleration;           ///< (n,), rad/s^2 or m/s^2: limits; empty: none
  double posture = 1e-4;           ///< cost per rad or m of distance from the posture (see setPosture)
  double damping = 1e-9;           ///< cost of the squared step; makes the solution unique
  bool collisions = true;          ///< keeps collidable pairs apart whose distance depends on joints
  double margin = .01;             ///< least distance of these pairs, m
  double collision_gain = .5;      ///< share of the distance beyond the margin that one step may use up, (0, 1]
  double influence_distance = .1;  ///< m: pairs farther apart have no constraint

  void validate(int dofs) const;  ///< throws ValueError
};
/// Whether the last step of a DiffIk met all constraints.
enum class DiffIkStatus {
  solved,               ///< all limits, distances and equalities hold
  constraints_relaxed,  ///< some limits, distances or equalities could not hold; `message()` names them
};

/// Differential inverse kinematics: computes joint velocities, step by step, that bring features to their targets.
///
///     DiffIk ik(C);
///     ik.addTask(FS::poseDiff, {"l_gripper", "target"});
///     while (...) ik.step(.005);  // moves C
///
/// A step solves one quadratic program exactly (DualActiveSet) in the change x of q. The costs are the least squares of
/// weight (gain y + J x) over all tasks, the distance to the posture, and damping. The constraints are
///   - one interval per joint, which combines limits of position, velocity and acceleration and the speed from which
///     the joint can brake before its position limit;
///   - a velocity damper, d' x >= -gain (d - margin), for each pair within the influence distance.
/// Tasks of several priorities have one program per priority, in the directions that no earlier task depends on.
///
/// Each step reads the scene again, so that targets and obstacles may move. A step never throws because of limits: from
/// beyond a limit the joint returns as fast as velocities allow. If dampers contradict the limits or each other, they
/// are relaxed by the least sum of squares, and the tasks are followed in the remaining directions. A joint with equal
/// limits does not move. Joints that would move back and forth, because a target is out of reach, are damped until they
/// stand still. After the first step nothing allocates.
class DiffIk {
 public:
  /// Moves this scene, without a copy. Its current q is the posture.
  explicit DiffIk(Config& config, const DiffIkOptions& options = {});
  ~DiffIk();
  DiffIk(DiffIk&&) noexcept;
  DiffIk& operator=(DiffIk&&) noexcept;

  /// Adds a feature that shall become zero, or `target`. `weight` multiplies its components. `gain` in (0, 1] is the
  /// share of the error that one step removes. Tasks with a higher `priority` number only use directions that tasks
  /// with lower numbers leave free; the posture comes last. Returns the index of the task. Throws as makeResidual does.
  int addTask(const FeatureSource& feature, const std::vector<std::string>& frames, double weight = 1.,
              double gain = 1., const VectorXd& target = {}, int priority = 0);

  /// Adds a feature that must become zero, or `target`, before all tasks. If limits and dampers do not allow a step to
  /// remove the share `gain` of the error, the equality is relaxed as little as possible, and `message()` reports it.
  int addEquality(const FeatureSource& feature, const std::vector<std::string>& frames, double gain = 1.,
                  const VectorXd& target = {});

  void setTarget(int task, const VectorXd& target);

  /// Sets the configuration that the nullspace of the tasks moves to, (n,). Throws ValueError for another size and for
  /// numbers that are not finite.
  void setPosture(const VectorXd& q);

  /// Computes the velocity for the next `dt` s, (n,), and moves the scene by it if `apply`. Throws ValueError unless dt
  /// is positive and finite, before anything moves.
  const VectorXd& step(double dt, bool apply = true);

  /// Sets the velocity to zero that the next acceleration starts from, and ends the damping of joints.
  void reset();

  const VectorXd& velocity() const { return velocity_; }
  DiffIkStatus status() const { return relaxed_.empty() ? DiffIkStatus::solved : DiffIkStatus::constraints_relaxed; }
  std::vector<std::string> active() const;  ///< names of the limits and pairs that restrict the last step
  std::string message() const;              ///< "" if solved; else the relaxed constraints, and by how much

 private:
  struct Task;

  /// The origin of a constraint of the program.
  struct Source {
    enum class Kind { lower, upper, pair, equality } kind;
    int index;     ///< dof, pair or task
    double value;  ///< distance of the pair, m
  };
  struct Relaxed {
    Source source;
    double by;  ///< rad or m
  };

  void prepare();
  int add(Task task);
  void addCosts(const VectorXd& q, int priority, bool is_last);
  void learnChatter();
  void addIntervals(const VectorXd& q, double dt);
  void addDampers(const State& state, double dt);
  void solve();
  void solveFirst();
  bool solveWithDamping(double damping);
  void findLeastViolation();
  void solveRemaining();
  void collectActive(const DualActiveSet& program);
  void removeDirections(int priority);
  std::string describe(const Source& source) const;

  static constexpr double kDependence = 1e-12;  ///< of constraints, see DualActiveSet

  Config config_;
  DiffIkOptions options_;
  std::shared_ptr<const KinematicModel> model_;
  std::vector<Task> tasks_;
  VectorXd posture_, velocity_, q_, change_, low_, high_, velocity_limit_, acceleration_limit_;
  std::unique_ptr<ChatterDamping> chatter_;
  MatrixXd limits_;
  std::unique_ptr<BodyPairs> pairs_;
  std::unique_ptr<PlacedBodies> bodies_;
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor> gradient_row_;
  MatrixXd cost_;
  VectorXd slope_;
  MatrixXd normals_;  ///< of the constraints a' x >= b, one column each
  VectorXd bounds_;
  VectorXd slack_;  ///< relaxation of each constraint
  VectorXd excess_, rate_, direction_;
  std::vector<Source> sources_;  ///< per constraint
  std::vector<Relaxed> relaxed_;
  std::vector<int> priorities_;             ///< of the tasks, ascending
  std::vector<int> active_;                 ///< constraints that restrict the last step
  MatrixXd free_, product_, reduced_cost_;  ///< free_: its first free_count_ columns span the free directions
  VectorXd along_;
  int free_count_ = 0;
  std::unique_ptr<DualActiveSet> program_;

  static constexpr int kEquality = std::numeric_limits<int>::min();
};

}  // namespace kinegraph
