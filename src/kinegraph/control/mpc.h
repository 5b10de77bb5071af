#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline control_internal {
class HorizonNlp;
}

namespace kinegraph::inline kinematics_internal {
struct Parameters;
}

namespace kinegraph::inline komo_internal {
struct PathComponent;
}

namespace kinegraph {

/// The motion that a call of Mpc computed, from the time of the call on: it passes through the points of the slices and
/// is nowhere faster than the fastest slice.
///
/// Between two points q_k is a cubic polynomial, and the velocity at a point is the difference of its neighbors over
/// their time. Where that cubic would exceed, in a dof, the largest mean velocity B of all intervals, the velocities at
/// both points are moved into the range in which it does not; if there is none, the velocity of the interval changes
/// linearly at both ends and is constant between them. It jumps where the mean velocity itself jumps from B. In the
/// first interval, B is at least its own mean velocity and the measured one.
class HorizonTrajectory final : public Trajectory {
 public:
  /// `times` (K) ascend from 0, K >= 1; `q` (n, K) has one point per column; `velocity` (n,) is that at time 0.
  HorizonTrajectory(std::vector<double> times, MatrixXd q, VectorXd velocity);

  /// Replaces the motion; the memory is requested again only if K changes.
  void assign(std::span<const double> times, const Eigen::Ref<const MatrixXd>& q,
              const Eigen::Ref<const VectorXd>& velocity);

  int dimension() const override { return int(q_.rows()); }
  double duration() const override { return times_.back(); }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

 private:
  double secant(int dof, int interval) const {
    return (q_(dof, interval + 1) - q_(dof, interval)) /
           (times_[std::size_t(interval) + 1] - times_[std::size_t(interval)]);
  }
  double largest(int dof, int interval) const { return interval == 0 ? largest_first_[dof] : largest_[dof]; }
  void findVelocities(const Eigen::Ref<const VectorXd>& velocity);
  void limitVelocities();

  std::vector<double> times_;
  MatrixXd q_, velocity_;             ///< (n, K)
  VectorXd largest_, largest_first_;  ///< velocities of an interval, and of the first one
};

struct MpcOptions {
  int evaluations = 50;         ///< budget of a call, at least 2: one step
  double microseconds = 0.;     ///< a call makes no further step after this time; 0: no limit
  int first_evaluations = 500;  ///< budget of a cold call, which has no initial guess and no limit of time
  double tolerance = 1e-3;      ///< rad or m: a step with no larger entry ends a call
  double violation = 1e-4;      ///< largest accepted violation of a scaled constraint
  double penalty = 100.;        ///< initial weight of the squares of constraints
  bool receding = true;         ///< false: the end of the horizon is fixed in time

  void validate() const;  ///< throws ValueError
};

/// Describes how a call of Mpc ended and the quality of its motion.
struct MpcResult {
  SolverStatus status = SolverStatus::limit;
  bool feasible = false;  ///< no scaled constraint is violated by more than 1e-3, or ten tolerances
  double violation = 0.;  ///< of the worst constraint, scaled
  double cost = 0.;       ///< sum of the squares
  int evals = 0;
  double time = 0.;       ///< s
  bool was_cold = false;  ///< the call did not start from the result of the call before
  std::string message;    ///< the reason why the call ended
};

/// A point of a motion q(t).
struct MotionPoint {
  VectorXd q, velocity;  ///< (n,)
};

/// Model predictive control: solves a motion problem again and again while time goes on, each time from the last
/// result.
///
///     Mpc mpc(komo);
///     while (...) {
///       mpc.setPoses("target", poses);          // predicted, one per slice
///       mpc.step(robot.q(), robot.velocity());  // tau after the call before
///       robot.follow(mpc.at(.01));
///     }
///
/// Slice t of the problem lies (t + 1) tau after the call. A call shifts the path and the multipliers by the time since
/// the last call, sets the measured state as start of the motion; then it improves the motion by steps of the augmented
/// Lagrangian until a budget or tolerance is reached. Multipliers, penalty, damping and memory survive from call to
/// call. If many steps found no feasible motion, the next call starts without these, from the last feasible motion.
///
/// With `receding` false the end of the problem is fixed in time: the horizon shrinks, past slices are constant, and
/// mode switches and the last slice come nearer.
class Mpc {
 public:
  /// Copies the problem. Throws ValueError for invalid options, a problem of order 0, objectives of addFreeMotion, and
  /// mode switches in a receding horizon.
  explicit Mpc(const Komo& komo, const MpcOptions& options = {});
  ~Mpc();

  /// Sets the predicted poses of a frame that no joint moves, and of the frames below it: T x 7, T x 3 (position only),
  /// or one row for all slices. Throws FrameNotFound. Throws ValueError for other sizes, and for frames that joints
  /// move or that carry joints.
  void setPoses(const std::string& frame, const MatrixXd& poses);

  /// Sets all frames that no joint moves, in all slices, to their poses in this configuration. Throws ValueError unless
  /// the configuration has the frames and joints of the problem.
  void updateRootObjects(const Config& config);

  /// Sets the target of an objective, by its index in the order of addObjective: one row per slice of the objective, or
  /// one row for all. Throws ValueError for other sizes, and for orientations by quaternions.
  void setTarget(int objective, const MatrixXd& targets);

  /// Computes the motion from the measured q and dq/dt (n,), `dt` s after the last call (none: tau; ignored in the
  /// first call). Throws ValueError for vectors of another size or with entries that are not finite, and for a dt that
  /// is negative or not finite, before anything changes.
  const MpcResult& step(const VectorXd& q, const VectorXd& velocity, std::optional<double> dt = {});

  /// Forgets all results: the next call is cold and at the beginning of the horizon.
  void reset();

  /// Returns the motion `time` s after the last call, at rest after the end. It is cubic between slices, and linear in
  /// velocity where a cubic would be faster than the fastest slice (HorizonTrajectory). Throws ValueError for NaN.
  MotionPoint at(double time) const;

  /// Writes the same point; a control loop that passes the same `point` again requests no memory.
  void at(double time, MotionPoint& point) const;

  /// Returns a copy of the motion of the last call as a trajectory from the time of that call on, which equals `at`.
  HorizonTrajectory horizon() const { return motion_; }

  MatrixXd getPath() const { return komo_->getPath(); }  ///< T x n
  const MpcResult& result() const { return result_; }
  const Komo& komo() const { return *komo_; }  ///< the problem, at the last path
  double elapsed() const { return elapsed_; }  ///< s since the first call
  MpcOptions options;                          ///< budgets and tolerances may change between calls

 private:
  struct Carried {
    int frame;
    Pose pose;  ///< relative to the frame that setPoses moves
  };
  using Memory = AugmentedLagrangianMemory;

  void requireProblem() const;
  void findLaterResiduals();
  const std::vector<Carried>& carriedBy(int frame);
  void setPresent(const VectorXd& q, const VectorXd& velocity);
  void shiftPath(double slices, VectorXd& x);
  void shiftMultipliers(double slices);
  void search();
  void restAt(const VectorXd& q);
  void forget();

  void updateMotion();
  double sliceTime(int t) const;
  void sliceJoints(int t, Eigen::Ref<VectorXd> q) const;

  std::shared_ptr<Komo> komo_;
  std::shared_ptr<Nlp> separate_;  ///< with one residual per pair instead of sums over pairs
  std::unique_ptr<HorizonNlp> problem_;
  std::vector<PathComponent> residuals_;
  std::vector<int> later_;  ///< per residual: the same one in the next slice; in the last slice: itself
  std::vector<std::shared_ptr<Parameters>> parameters_;  ///< per slice; slices before the start come first
  std::map<int, std::vector<Carried>> carried_;
  Memory memory_;
  SolverOptions solver_;
  VectorXd x_, shifted_x_, dual_, shifted_dual_, q_, velocity_, measured_;
  VectorXd feasible_x_;  ///< the last feasible motion, shifted to the present
  MpcResult result_;
  HorizonTrajectory motion_{{0.}, MatrixXd::Zero(0, 1), VectorXd::Zero(0)};  ///< of the last call
  std::vector<double> times_;                                                ///< of its points
  MatrixXd points_;                                                          ///< (n, K)
  double elapsed_ = 0., step_seconds_ = 0.;
  int past_ = 0;                    ///< number of past slices
  int evals_without_feasible_ = 0;  ///< evaluations since the last feasible motion
  bool has_path_ = false;
  bool restores_feasible_ = false;  ///< the next call starts from feasible_x_
};

}  // namespace kinegraph
