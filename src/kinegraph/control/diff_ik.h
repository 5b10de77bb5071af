#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/control/active_set.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

struct DiffIkOptions {
  VectorXd velocity;           ///< (n,), rad/s or m/s: limits; empty: the model's; infinity for none
  VectorXd acceleration;       ///< (n,), rad/s^2 or m/s^2; empty: none
  double posture = 1e-4;       ///< cost per rad or m from the posture that it was made in
  double damping = 1e-9;       ///< cost of the square of a step, so that every problem has one answer
  bool collisions = true;      ///< keeps the collidable pairs apart that joints move
  double margin = .01;         ///< their least distance, m
  double collision_gain = .5;  ///< share of the distance beyond the margin that one step may use up, (0, 1]
  double range = .1;           ///< m: pairs farther apart are not looked at

  void validate(int dofs) const;  ///< throws ValueError
};

enum class DiffIkStatus {
  solved,               ///< all limits and distances are kept
  constraints_relaxed,  ///< some could not be, or an equality; `message()` says which
};

/// Differential inverse kinematics: joint velocities, step by step, that bring features to their targets.
///
///     DiffIk ik(C);
///     ik.addTask(FS::poseDiff, {"l_gripper", "target"});
///     while (...) ik.step(.005);  // moves C
///
/// A step solves one quadratic program exactly (ActiveSet) in the change x of q: least squares of weight (y + J x) with y
/// taken times the task's gain, of the way to the posture, and damping; subject to one interval per joint, which holds
/// position, velocity and acceleration, and lets no joint be faster than it can brake before its limit; and to velocity
/// dampers, d' x >= -gain (d - margin), for all pairs within range. With several levels there is a program for each, in
/// the directions that no task before it minds. The scene is looked at anew in each step: targets and
/// obstacles may move. A step never throws because of limits: from beyond a limit it goes back as fast as velocities
/// allow, and where dampers contradict the limits, they give way as little as possible.
class DiffIk {
 public:
  /// The scene is shared, not copied. Its posture is the one to stay near.
  explicit DiffIk(const Config& config, const DiffIkOptions& options = {});

  /// A feature that is to become zero, or `target`. `weight` multiplies its rows; `gain` in (0, 1] is the share of the error
  /// that one step takes away. Tasks of a higher `level` have what those of lower ones leave open; the posture comes
  /// last. Returns the task's number. Throws as makeResidual does.
  int addTask(const FeatureSource& feature, const std::vector<std::string>& frames, double weight = 1.,
              double gain = 1., const VectorXd& target = {}, int priority = 0);

  /// A feature that must become zero, or `target`, before all tasks. Where limits and dampers do not allow the share
  /// `gain` of the error to be taken away in a step, it gives way as little as possible, and `message()` says so.
  int addEquality(const FeatureSource& feature, const std::vector<std::string>& frames, double gain = 1.,
                  const VectorXd& target = {});

  void setTarget(int task, const VectorXd& target);
  void setPosture(const VectorXd& q);

  /// The velocity for the next `dt` s, (n,). With `apply` the scene moves by it. Throws ValueError for a dt that is not
  /// positive.
  const VectorXd& step(double dt, bool apply = true);

  /// The velocity that accelerations start from becomes zero.
  void reset() { velocity_.setZero(); }

  const VectorXd& velocity() const { return velocity_; }
  DiffIkStatus status() const { return gave_way_.empty() ? DiffIkStatus::solved : DiffIkStatus::constraints_relaxed; }
  std::vector<std::string> active() const;  ///< the limits and pairs that hold the last step back, in words
  std::string message() const;              ///< "" if solved; else what gave way, and by how much

 private:
  struct Task {
    FeatureSource feature;
    std::vector<std::string> frames;
    double weight, gain;
    VectorXd target;
    int priority;                    ///< of an equality: kEquality
    std::vector<Residual> residual;  ///< one
    VectorXd y;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
  };
  /// What a row of the program stands for.
  struct Meaning {
    enum class Kind { lower, upper, pair, equality } kind;
    int index;     ///< dof, pair or task
    double value;  ///< distance of the pair, m
  };
  struct GaveWay {
    Meaning meaning;
    double by;  ///< rad or m
  };

  void prepare();
  int add(Task task);
  void addCosts(const VectorXd& q, int priority, bool is_last);
  void addIntervals(const VectorXd& q, double dt);
  void addDampers(const State& state, double dt);
  void solve();
  bool solveFirst();
  void solveRemaining();
  void noteActive(const ActiveSet& program);
  void giveAway(int priority);
  std::string text(const Meaning& meaning) const;

  Config config_;
  DiffIkOptions options_;
  std::shared_ptr<const KinematicModel> program_;
  std::vector<Task> tasks_;
  VectorXd posture_, velocity_, q_, change_, low_, high_, velocity_limit_, acceleration_limit_;
  MatrixXd limits_;
  std::unique_ptr<BodyPairs> pairs_;
  std::unique_ptr<PlacedBodies> bodies_;
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor> gradient_row_;
  MatrixXd cost_;
  VectorXd slope_, elastic_row_;
  MatrixXd rows_;  ///< a column each
  VectorXd bounds_;
  std::vector<Meaning> meanings_;
  std::vector<GaveWay> gave_way_;
  std::vector<int> priorities_, active_rows_;  ///< ascending; rows that hold the last step back
  MatrixXd open_, turned_, reduced_cost_;      ///< open_: directions that are left, its first open_count_ columns
  VectorXd along_;
  int open_count_ = 0;
  ActiveSet program_rigid_, program_elastic_;
  bool is_elastic_ = false;

  static constexpr int kEquality = std::numeric_limits<int>::min();
};

}  // namespace kinegraph
