#pragma once

#include <limits>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/ik/damped_step.h"
#include "kinegraph/ik/ik_problem.h"

namespace kinegraph {

/// A target as numbers, and how far it is missed.
struct IkGoal {
  Matrix3d R = Matrix3d::Identity();                      ///< of a pose, rotation; in the world, where it is at present
  Vector3d p = Vector3d::Zero();                          ///< position, or unit direction; the same
  Vector3d t1 = Vector3d::Zero(), t2 = Vector3d::Zero();  ///< of a direction: unit, across it
  RigidTransform given;                                   ///< as seen from the frame that the target is relative to
  double position_error = 0., rotation_error = 0.;        ///< at the present x; m, rad
  double feature_error = 0.;                              ///< of the worst row
  int worst_row = 0;

  void setDirection(const Vector3d& direction);  ///< `p`, `t1` and `t2`, for a unit vector
};

/// How the first part of an attempt ended, which goes for the targets alone.
struct IkApproach {
  bool met;
  double missed;  ///< position, rotation and feature errors
  int evals;
};

/// A problem on its way to its answer.
struct IkJob {
  std::vector<IkGoal> goals;
  int attempts = 0;  ///< that have been judged
  int evals = 0;
  bool feasible = false, cancelled = false;
  VectorXd kept;                                           ///< the best answer so far, or the best failure
  bool kept_is_present = false;                            ///< the search that judged last is at it
  double least = std::numeric_limits<double>::infinity();  ///< its cost, or what it misses by
  std::vector<int> blocked;  ///< per pair: attempts that met their targets with it as the worst collision
};

/// One thread's search for the answers to problems that differ in their targets only.
class IkSearch {
 public:
  explicit IkSearch(std::shared_ptr<const IkProblem> problem);

  /// `targets` are of the problem's frames and kinds.
  IkResult solve(const std::vector<IkTarget>& targets, const CancellationToken& cancellation);

  // The same in parts, for those who make the approaches themselves: open, judge until it is true, finish.
  void open(IkJob& job, const std::vector<IkTarget>& targets);

  /// Goes on from where the approach of attempt number `job.attempts` ended, and keeps what it finds. True if no
  /// further attempt is needed.
  bool judge(IkJob& job, const VectorXd& x, const IkApproach& approach, const CancellationToken& cancellation);
  IkResult finish(IkJob& job, bool cancelled, const CancellationToken& cancellation);

  /// True if an approach is not worth going on with at this step; `before` is its memory, large at first.
  static bool stalls(int step, double square, double& before);

 private:
  static constexpr double kSlack = 1e-4;  ///< m: what colliding pairs are moved apart beyond the margin

  /// Largest errors of the targets and of the distances at the present x.
  struct Errors {
    double position = 0., rotation = 0., feature = 0., penetration = 0.;
    double sum() const { return position + rotation + feature + penetration; }
  };
  struct NearPair {
    int pair;
    double distance;
    bool active;
  };

  void moveTo(const VectorXd& x);
  void measureTargets(bool with_jacobian);
  void measureFrame(std::size_t target, int row, bool with_jacobian);
  void measureFeature(std::size_t target, Residual& residual, int row, bool with_jacobian);
  void placeGoal(const IkProblem::Task& task, IkGoal& goal, const Vector3d& p_WF) const;
  void measureDistances();
  void measure();
  void stepTowardsTargets();
  void stepApart(const double* pull, double damping = 0.);
  bool targetsMet() const;
  bool feasible() const { return targetsMet() && errors_.penetration == 0.; }
  double squaredMiss() const;

  enum class Outcome { feasible, missed, cancelled };
  IkApproach approach();
  Outcome avoidCollisions(const CancellationToken& cancellation);
  Outcome moveApart(int steps, const CancellationToken& cancellation);
  Outcome bringNear(const CancellationToken& cancellation);
  double costOf(const VectorXd& x) const { return (x - problem_->nearest).squaredNorm(); }
  bool polish(const CancellationToken& cancellation);

  std::string explain();
  std::string pairName(int pair) const;
  std::vector<std::string> misses() const;
  std::vector<std::string> pairsInTheWay() const;
  std::vector<std::string> bindingLimits();

  std::shared_ptr<const IkProblem> problem_;
  State state_;
  PlacedBodies placed_;
  DampedStep step_;
  IkJob* job_ = nullptr;  ///< that is being worked on
  VectorXd q_;            ///< the whole joint vector, with x in it
  VectorXd x_;            ///< the variables
  VectorXd pull_, kept_;
  Errors errors_;
  bool features_met_ = true;         ///< are all within their tolerances?
  std::vector<Residual> residuals_;  ///< of the tasks that have one, with targets of the job that was opened last
  VectorXd feature_value_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> feature_jacobian_;
  double square_ = 0.;  ///< sum of squares of the targets' rows
  std::vector<NearPair> near_;
  std::vector<double> gradients_;  ///< of the near pairs' distances, one row of variables each
};

}  // namespace kinegraph
