#pragma once

#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/damped_step.h"
#include "kinegraph/planning/ik_problem.h"

namespace kinegraph {

/// One thread's search for the answers to a sequence of problems that differ in their targets only.
class IkSearch {
 public:
  using Stop = std::function<bool()>;

  explicit IkSearch(std::shared_ptr<const IkProblem> problem);

  /// `targets` are of the problem's frames and kinds. `stop` is asked now and then; true ends the search.
  IkResult solve(const std::vector<IkTarget>& targets, const Stop& stop);

 private:
  struct Goal {
    Matrix3d R;          ///< of a pose
    Vector3d p;          ///< position, or unit direction
    Vector3d t1, t2;     ///< of a direction: unit, across it
    double position_error = 0., rotation_error = 0.;  ///< at the present x; m, rad
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
  void stepApart(const double* pull, double damping = 0.);
  double squaredMiss() const;
  bool targetsMet() const;
  bool feasible() const { return targetsMet() && errors_.penetration == 0.; }

  enum class Outcome { feasible, missed, cancelled };
  Outcome attempt(const Stop& stop);
  Outcome moveApart(int steps, const Stop& stop);
  Outcome bringNear(const Stop& stop);
  double costOf(const VectorXd& x) const { return (x - problem_->nearest).squaredNorm(); }
  bool polish(const Stop& stop);
  void measure();
  std::string explain(int attempts, bool cancelled);
  std::string pairName(int pair) const;
  std::vector<std::string> misses() const;
  std::vector<std::string> pairsInTheWay() const;
  std::vector<std::string> bindingLimits();

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
  std::vector<int> blocked_;        ///< per pair: attempts that met their targets with it as the worst collision
  int evals_ = 0;
};

}  // namespace kinegraph
