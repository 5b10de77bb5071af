#pragma once

#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/damped_step.h"
#include "kinegraph/planning/ik_problem.h"

namespace kinegraph {

/// One thread's search for the answers to a sequence of problems that differ in their targets only.
class IkSearch {
 public:
  explicit IkSearch(std::shared_ptr<const IkProblem> problem);

  /// `targets` are of the problem's frames and kinds.
  IkResult solve(const std::vector<IkTarget>& targets, const IkCancel& cancel);

 private:
  struct Goal {
    Matrix3d R;          ///< of a pose
    Vector3d p;          ///< position, or unit direction
    Vector3d t1, t2;     ///< of a direction: unit, across it
    double position_error = 0., rotation_error = 0.;  ///< at the present x; m^2, rad
  };
  /// Largest errors of the targets and of the distances at the present x.
  struct Errors {
    double position = 0., rotation = 0., penetration = 0.;
    double sum() const { return position + rotation + penetration; }
  };
  struct NearPair {
    int pair;
    double distance;
    bool active;
  };

  void setGoals(const std::vector<IkTarget>& targets);
  void moveTo(const VectorXd& x);
  void measureTargets(bool with_jacobian);
  void measureDistances();
  void fillPairRow(int row, const NearPair& near);
  void stepTowardsTargets();
  void stepApart(const double* pull);
  bool targetsMet() const;
  bool feasible() const { return targetsMet() && errors_.penetration == 0.; }

  enum class Outcome { feasible, missed, cancelled };
  Outcome attempt(const IkCancel& cancel);
  Outcome moveApart(int steps, const IkCancel& cancel);
  Outcome bringNear(const IkCancel& cancel);
  double costOf(const VectorXd& x) const { return (x - problem_->nearest).squaredNorm(); }
  bool polish(const IkCancel& cancel);
  void measure();
  std::string explain(int attempts) const;

  std::shared_ptr<const IkProblem> problem_;
  State state_;
  DampedStep step_;
  std::vector<Goal> goals_;
  VectorXd q_;        ///< the whole joint vector, with x in it
  VectorXd x_;        ///< the variables
  VectorXd pull_, kept_;
  Errors errors_;
  double square_ = 0.;  ///< sum of squares of the targets' rows
  std::vector<NearPair> near_;
  std::vector<double> gradients_;  ///< of the near pairs' distances, one row of variables each
  int evals_ = 0;
};

}  // namespace kinegraph
