#pragma once

#include <memory>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/ik/damped_step.h"
#include "kinegraph/ik/ik_job.h"
#include "kinegraph/ik/ik_problem.h"

namespace kinegraph::inline ik_internal {

/// The present x of a search: its errors, its near pairs, and the steps from there. One per thread.
class IkIterate {
 public:
  /// Largest errors of the targets, and how much closer than the margin the worst pair is (m).
  struct Errors {
    double position = 0., rotation = 0., feature = 0., penetration = 0.;
    double sum() const { return position + rotation + feature + penetration; }
  };
  struct NearPair {
    int pair;
    double distance;
    bool active;  ///< the step has a row for it
  };

  explicit IkIterate(const IkProblem& problem);

  /// Sets the numbers of `job.goals` and of the features' residuals.
  void setTargets(IkJob& job, const std::vector<IkTarget>& targets);

  /// Selects the job whose goals are measured and whose evaluations are counted.
  void select(IkJob& job) { job_ = &job; }

  const VectorXd& x() const { return x_; }
  const VectorXd& q() const { return q_; }  ///< the whole joint vector, which contains x
  void setX(const VectorXd& x) { x_ = x; }
  void setStartingPoint(int number, const VectorXd& first) { problem_.startingPoint(number, x_.data(), first); }

  /// Computes the errors of the targets at x, and their Jacobian if requested.
  void evaluateTargets(bool with_jacobian);

  /// Computes all errors at x.
  void evaluate();

  /// Finds the pairs that are not much farther apart than the margin, with the gradients of their distances.
  void evaluateDistances();
  void assumeNoPenetration() { errors_.penetration = 0.; }
  void forgetNearPairs() { near_.clear(); }

  /// Steps towards the targets and ignores collisions. The Jacobian of the targets is up to date.
  void stepTowardsTargets();

  /// Steps towards the targets while near pairs are moved apart, and along `preferred` as far as that leaves freedom.
  /// Which pairs need a row is not known before the step. Pairs that it would bring too close get a row, and the step
  /// is solved again; pairs whose row pulls them together lose it, since no inequality does that. This is an active
  /// set method that stops after a few passes, because the next step continues it.
  void stepApart(const double* preferred, double damping = 0.);
  double lastStep() const { return step_.step().lpNorm<Eigen::Infinity>(); }  ///< largest entry of the last step

  bool targetsMet() const;
  bool feasible() const { return targetsMet() && errors_.penetration == 0.; }
  const Errors& errors() const { return errors_; }
  double squaredTargets() const { return square_; }  ///< sum of squares of the targets' rows
  double squaredError() const;                       ///< sum of squares of all errors
  const std::vector<NearPair>& nearPairs() const { return near_; }

  /// Per variable: the negative gradient of half the squared error. It vanishes at a point of least error except at
  /// limits.
  VectorXd descentDirection();

 private:
  void place();
  void measureTargets(bool with_jacobian);
  void measureFrame(std::size_t target, int row, bool with_jacobian);
  void measureFeature(std::size_t target, Residual& residual, int row, bool with_jacobian);
  void placeGoal(const IkTask& task, IkGoal& goal, const Vector3d& p_WF) const;

  const IkProblem& problem_;
  State state_;
  PlacedBodies placed_;
  DampedStep step_;
  IkJob* job_ = nullptr;
  VectorXd q_, x_;
  Errors errors_;
  bool features_met_ = true;
  std::vector<Residual> residuals_;  ///< of the feature tasks, with the targets of the last setTargets
  VectorXd feature_value_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> feature_jacobian_;
  double square_ = 0.;
  std::vector<NearPair> near_;
  std::vector<double> gradients_;  ///< (near pairs, variables): gradients of the distances
};

}  // namespace kinegraph::inline ik_internal
