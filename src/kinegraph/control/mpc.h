#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/control/horizon_nlp.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path_components.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

struct MpcOptions {
  int evaluations = 50;         ///< most of them in a call, at least 2: one step
  double microseconds = 0.;     ///< after which a call makes no further step; 0: any time
  int first_evaluations = 500;  ///< most of them in a cold call, which knows nothing and has no other budget
  double tolerance = 1e-3;      ///< rad or m: a step with no larger entry ends a call
  double violation = 1e-4;      ///< of a scaled constraint, that counts as none
  double penalty = 100.;        ///< first weight of the squares of constraints
  bool receding = true;         ///< false: the horizon's end stays where it is in time, and comes nearer

  void validate() const;  ///< throws ValueError
};

/// How a call of Mpc ended, and how good the motion is that it left.
struct MpcResult {
  SolverStatus status = SolverStatus::limit;
  bool feasible = false;  ///< no scaled constraint is violated by more than 1e-3, or ten tolerances
  double violation = 0.;  ///< of the worst constraint, scaled
  double cost = 0.;       ///< sum of the squares
  int evals = 0;
  double time = 0.;       ///< s
  bool was_cold = false;  ///< it did not go on from the call before
  std::string message;    ///< why it ended
};

/// A motion q(t) from the present on.
struct MotionPoint {
  VectorXd q, velocity;  ///< (n,)
};

/// Receding horizon: a motion problem that is solved again and again while time goes on, each time from what it knew.
///
///     Mpc mpc(komo);
///     while (...) {
///       mpc.setPoses("target", poses);             // where it will be, slice by slice
///       mpc.step(robot.q(), robot.velocity());     // tau later than the call before
///       robot.follow(mpc.at(.01));
///     }
///
/// Slice t of the problem is (t + 1) tau after the call. A call moves path and multipliers on by the time since the last
/// one, lets the motion begin at the measured state, and improves it by steps of the augmented Lagrangian, as many as it
/// may. What it learned stays: multipliers, penalty, damping, memory. Where steps have led to no feasible motion for long,
/// the next call starts with none of that, from the last motion that was feasible.
///
/// With `receding` false the problem's end stays where it is in time: slices of the past are given, mode switches and the
/// last slice come nearer.
class Mpc {
 public:
  /// Takes a copy of the problem. Throws ValueError for options that make no sense, a problem of order 0, objectives of
  /// addFreeMotion, and mode switches in a horizon that recedes.
  explicit Mpc(const Komo& komo, const MpcOptions& options = {});

  /// Where a frame that no joint moves will be, with what hangs below it: T x 7 or T x 3 (position alone), or one row for
  /// all slices. Throws FrameNotFound, and ValueError for sizes that do not fit and frames that joints move or that carry
  /// joints.
  void setPoses(const std::string& frame, const MatrixXd& poses);

  /// All frames that no joint moves are in all slices where they are in this configuration, which has the frames of the
  /// given one. Throws ValueError if it has not.
  void updateRootObjects(const Config& config);

  /// The target of an objective, by its number in the order in which objectives were added: a row for each of its slices,
  /// or one for all. Throws ValueError for sizes that do not fit, and for orientations by quaternions.
  void setTarget(int objective, const MatrixXd& targets);

  /// Finds the motion from the measured q and dq/dt (n,), `dt` s after the last call (not counted in the first one; < 0:
  /// tau). Throws ValueError for vectors that do not fit or are not finite: nothing has changed then.
  const MpcResult& step(const VectorXd& q, const VectorXd& velocity, double dt = -1.);

  /// Forgets what it learned: the next call is cold, and in a horizon that does not recede, at its beginning.
  void reset();

  /// The motion `time` s after the last call: through the slices, with their velocities. After its end it rests there.
  MotionPoint at(double time) const;

  MatrixXd getPath() const { return komo_->getPath(); }  ///< T x n
  const MpcResult& result() const { return result_; }
  const Komo& komo() const { return *komo_; }  ///< the problem, at the last path
  double elapsed() const { return elapsed_; }  ///< s since the first call
  MpcOptions options;                          ///< budgets and tolerances may change between calls

 private:
  struct Carried {
    int frame;
    Pose pose;  ///< in the frame that is moved
  };
  using Memory = AugmentedLagrangianMemory;

  void requireProblem() const;
  void findLaterRows();
  const std::vector<Carried>& carriedBy(int frame);
  void setPresent(const VectorXd& q, const VectorXd& velocity);
  void shiftPath(double slices, VectorXd& x);
  void shiftMultipliers(double slices);
  void search();
  void restAt(const VectorXd& q);
  void forget();

  std::shared_ptr<Komo> komo_;
  std::shared_ptr<Nlp> separate_;  ///< with a row per pair in place of sums
  std::unique_ptr<HorizonNlp> problem_;
  std::vector<PathComponent> rows_;
  std::vector<int> later_;  ///< per row: that of its objective a slice later; in the last slice itself
  std::vector<std::shared_ptr<Parameters>> parameters_;  ///< per slice, those before the start first
  std::map<int, std::vector<Carried>> carried_;
  Memory memory_;
  SolverOptions solver_;
  VectorXd x_, shifted_x_, dual_, shifted_dual_, q_, velocity_, placed_;
  VectorXd feasible_x_;  ///< the last motion that was feasible, up to now
  MpcResult result_;
  double elapsed_ = 0., step_seconds_ = 0.;
  int past_ = 0;                             ///< slices that are over
  int struggled_ = 0;                        ///< evaluations since a motion was feasible
  bool has_path_ = false, returns_ = false;  ///< to the last feasible motion, in the next call
};

}  // namespace kinegraph
