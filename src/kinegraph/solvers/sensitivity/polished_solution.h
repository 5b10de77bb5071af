#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/sensitivity/kkt_system.h"
#include "kinegraph/solvers/sensitivity/lagrangian_curvature.h"

namespace kinegraph {

/// A solution to rounding: from one as solvers give it, a few Newton steps on its conditions, with a set of active
/// constraints that follows from them. The linearized conditions are left factorized.
/// Source: Hintermüller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton method, 2003.
class PolishedSolution {
 public:
  /// From x, with a multiplier per residual; `is_near` says of which residuals it is not known whether they are active
  /// where they are nearly zero. `holds_weak`: are constraints that touch without pressing taken as active? Throws
  /// Error if it does not converge.
  PolishedSolution(Nlp& nlp, const VectorXd& x, const VectorXd& dual, const std::vector<char>& is_near,
                   bool holds_weak);

  VectorXd x, phi;
  VectorXd dual;     ///< multiplier per residual
  VectorXd weights;  ///< per residual: that of its gradient in the gradient of the Lagrangian
  Jacobian J;

  std::vector<int> active;                  ///< residuals that are held at zero
  std::vector<char> fixed;                  ///< per variable: is it held at a bound?
  std::vector<int> weak_rows;               ///< inequalities that touch and do not press
  std::vector<int> weak_lower, weak_upper;  ///< variables whose bound does
  int evals = 0;

  KktSystem& system() { return system_; }
  const std::vector<int>& squared() const { return squared_; }  ///< residuals whose squares count here

 private:
  bool converge();
  bool step();
  void evaluate();
  void weigh();
  void linearize();
  bool chooseActive(bool is_first);
  void solveTightly();
  void classify();

  Nlp& nlp_;
  std::vector<char> is_near_;
  bool holds_weak_;
  bool has_costs_, tells_costs_;
  KktSystem system_;
  LagrangianCurvature curvature_;
  std::vector<int> squared_;
  VectorXd gradient_;    ///< of the Lagrangian
  bool let_go_ = false;  ///< of a residual that pressed, since the last weighing
  VectorXd last_step_;
  double curvature_scale_ = 1.;
  double force_scale_ = 0.;     ///< the largest gradient of a residual with its weight
  double moved_ = 0.;           ///< by the last step
  bool pulls_settled_ = false;  ///< did the last step leave the multipliers as they were?
  VectorXd bound_pull_;         ///< multiplier of the bounds, positive at upper ones
};

}  // namespace kinegraph
